// SPDX-License-Identifier: Apache-2.0
// Copies of one mesh: scaled, turned, mirrored, sheared, very flat, very large and very small.
#include "head.inc"
#include "ball.inc"
camera { location <0, 3, -9> look_at <0, 0, 1> angle 50 }
Light_And_Floor(-1.6)
#declare One = Ball("smooth2", 24, <0.1, 1, 0.2>) }
#declare S = seed(7);
#declare I = 0;
#while (I < 40)
    object {
        One
        texture { Matter[mod(I, 5)] }
        scale <0.2 + 0.4 * rand(S), 0.2 + 0.4 * rand(S), 0.1 + 0.4 * rand(S)>
        rotate 360 * <rand(S), rand(S), rand(S)>
        #if (mod(I, 3) = 0) matrix <1, 0.4, 0, -0.6, 1, 0.2, 0, 0.3, 1, 0, 0, 0> #end
        #if (mod(I, 5) = 0) scale <-1, 1, 1> #end
        translate <7 * rand(S) - 3.5, 3 * rand(S) - 1.5, 6 * rand(S) - 2>
    }
    #declare I = I + 1;
#end
object { One texture { Matter[1] } scale <2, 1e-5, 2> rotate 20 * x translate <0, 1.5, 3> }
object { One texture { Matter[2] } scale 1e4 translate <0, 0, 3e4> }
object { One texture { Matter[3] } scale 1e-3 translate <0, 2.99, -8.99> }
