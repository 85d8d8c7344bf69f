// SPDX-License-Identifier: Apache-2.0
// Meshes whose own coordinates are tiny or huge, and rays from 2^24 and more times their size away.
#include "head.inc"
#include "ball.inc"
camera { location -3000 * z direction 700 * z right 1.333 * x up y }
light_source { <-3000, 5000, -9000> rgb 1 }
#macro Scaled_Ball(Side, Size)
    mesh2 {
        vertex_vectors {
            (Side + 1) * (Side + 1)
            #local K = 0;
            #while (K < (Side + 1) * (Side + 1))
                , Size * Ball_Point(mod(K, Side + 1), floor(K / (Side + 1)), Side)
                #local K = K + 1;
            #end
        }
        face_indices {
            2 * Side * Side
            #local K = 0;
            #while (K < Side * Side)
                #local A = mod(K, Side) + (Side + 1) * floor(K / Side);
                , <A, A + 1, A + Side + 1>, <A + 1, A + Side + 2, A + Side + 1>
                #local K = K + 1;
            #end
        }
        hierarchy Hierarchy
    }
#end
object { Scaled_Ball(16, 1e-4) scale 1e4 texture { Matter[0] } translate <-1.5, 0.8, 0> }
object { Scaled_Ball(16, 1e-5) scale 1e5 texture { Matter[1] } translate <0.5, 0.8, 0> }
object { Scaled_Ball(16, 1e-9) scale 1e9 texture { Matter[2] } translate <2, 0.8, 0> }
object { Scaled_Ball(16, 1e5) scale 1e-5 texture { Matter[3] } translate <-1.5, -0.9, 0> }
object { Scaled_Ball(16, 1e9) scale 1e-9 texture { Matter[4] } translate <0.5, -0.9, 0> }
object { Scaled_Ball(16, 1e-4) scale 1e4 texture { Matter[1] } rotate 30 * z translate <2, -0.9, 0> }
