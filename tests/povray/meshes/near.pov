// SPDX-License-Identifier: Apache-2.0
// A triangle nearer than POV-Ray's least depth hides nothing; stock's own tree lets it.
#include "head.inc"
#include "ball.inc"
camera { orthographic location <0, 0, -0.00005> right 4 * x up 3 * y direction z }
light_source { <-3, 5, -10> rgb 1 shadowless }
mesh {
    triangle { <-5, -5, 0>, <5, -5, 0>, <0, 8, 0> }
    triangle { <-5, -5, 1>, <5, -5, 1.2>, <0, 8, 1> }
    #declare I = 0;
    #while (I < 40) triangle { <50 + I, 0, 0>, <50 + I, 1, 0>, <50 + I, 0, 1> } #declare I = I + 1; #end
    hierarchy Hierarchy
    pigment { rgb <1, 0.2, 0.2> } finish { ambient 0.6 }
}
