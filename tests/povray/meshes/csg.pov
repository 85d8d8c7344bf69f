// SPDX-License-Identifier: Apache-2.0
// Meshes as parts: with and without an inside, inverted, nested, more than one, and hits behind hits.
#include "head.inc"
#include "ball.inc"
camera { location <0, 3, -9> look_at <0, 0, 1> angle 50 }
Light_And_Floor(-1.6)
#declare Body = Ball("flat2", 20, <0.3, 1, 0.1>) }
#declare Solid = object { Ball("smooth", 14, y) } rotate 20 * z }
#declare Sheet = Ball("textured2", 20, 0) }
difference { box { -1, 1 } object { Body scale 1.2 } texture { Matter[1] } rotate 30 * y translate <-3, 0, 0> }
difference { object { Body } sphere { <0.4, 0.5, -0.8>, 0.7 } object { Solid scale 0.6 translate <-0.8, 0, -0.3> } texture { Matter[2] } }
intersection { object { Body } object { Solid translate 0.5 * x } texture { Matter[3] } translate <2.2, 0, 0> }
merge { object { Body } object { Solid translate 0.8 * y } texture { pigment { rgbt <1, 0.8, 0.8, 0.6> } } translate <-1.5, 0, 3> }
intersection { object { Sheet } box { <-2, -2, 0.2>, <2, 2, 2> } scale 0.8 translate <2.6, 1.6, 0> }
union { object { Sheet } sphere { <0, 1, 0>, 0.4 texture { Matter[4] } } clipped_by { plane { x, 0.3 } } translate <1, 2, 4> }
object { Body inverse texture { Matter[0] } scale 30 translate 10 * z }
