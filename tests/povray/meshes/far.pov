// SPDX-License-Identifier: Apache-2.0
// Meshes far from the origin of the scene and of their own space, tiny, huge, and seen from afar.
#include "head.inc"
#include "ball.inc"
#ifndef (Away) #declare Away = 1e5; #end
camera { location <Away, Away / 2, -8> direction 3 * z right 1.333 * x up y }
light_source { <Away - 6, Away / 2 + 9, -20> rgb 1 }
light_source { <1e6, 1e6, -3e6> rgb 0.3 }
// at these places of their own space corners lie on a coarse grid of float
#macro Shifted_Board(N, Shift)
    mesh2 {
        vertex_vectors {
            (N + 1) * (N + 1)
            #local K = 0;
            #while (K < (N + 1) * (N + 1))
                , <mod(K, N + 1) / N - 0.5, floor(K / (N + 1)) / N - 0.5, 0.1 * sin(K)> + Shift
                #local K = K + 1;
            #end
        }
        texture_list { 5, texture { Matter[0] } texture { Matter[1] } texture { Matter[2] } texture { Matter[3] } texture { Matter[4] } }
        face_indices {
            2 * N * N
            #local K = 0;
            #while (K < N * N)
                #local A = mod(K, N) + (N + 1) * floor(K / N);
                , <A, A + 1, A + N + 1>, mod(K, 5), <A + 1, A + N + 2, A + N + 1>, mod(3 * K, 5)
                #local K = K + 1;
            #end
        }
        hierarchy Hierarchy
    }
#end
#declare Ball_2 = Ball("smooth2", 20, 0) }
object { Ball_2 texture { Matter[1] } scale 0.8 translate <Away - 0.7, Away / 2 + 0.5, 0> }
object { Ball_2 texture { Matter[2] } scale 1e5 translate <Away + 1e5, Away / 2 + 5e4, 8e5> }
object { Shifted_Board(12, <1e4, 1e4, 1e4>) translate <Away + 0.6, Away / 2 + 0.4, 0> - <1e4, 1e4, 1e4> }
object { Shifted_Board(12, <1e-3, 2e6, 1e5>) scale <1, 1, 1> translate <Away - 0.6, Away / 2 - 0.5, 0> - <1e-3, 2e6, 1e5> }
object { Shifted_Board(12, 0) scale 1e-6 scale 1e6 rotate 40 * y translate <Away + 0.7, Away / 2 - 0.5, 0> }
