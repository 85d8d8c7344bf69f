// SPDX-License-Identifier: Apache-2.0
// Triangles at equal depths: rays along common edges and through common corners, and coincident
// triangles of other textures, near in the list and far, also where only the depths of the scene
// are equal: scaled up, depths that differ by a bit round to one.
#include "head.inc"
#include "ball.inc"
camera { orthographic location -10 * z right 8 * x up 6 * y direction z }
light_source { <-3, 5, -10> rgb 1 }
#macro Board(N, Layers)
    mesh2 {
        vertex_vectors {
            (N + 1) * (N + 1)
            #local K = 0;
            #while (K < (N + 1) * (N + 1)) , <mod(K, N + 1) / N - 0.5, floor(K / (N + 1)) / N - 0.5, 0> #local K = K + 1; #end
        }
        texture_list { 5, texture { Matter[0] } texture { Matter[1] } texture { Matter[2] } texture { Matter[3] } texture { Matter[4] } }
        face_indices {
            2 * N * N * Layers
            #local L = 0;
            #while (L < Layers)
                #local K = 0;
                #while (K < N * N)
                    #local A = mod(K, N) + (N + 1) * floor(K / N);
                    , <A, A + 1, A + N + 1>, mod(K + L, 5), <A + 1, A + N + 2, A + N + 1>, mod(3 * K + 2 * L, 5)
                    #local K = K + 1;
                #end
                #local L = L + 1;
            #end
        }
        hierarchy Hierarchy
    }
#end
#declare Plain = Board(8, 1)
#declare Layered = Board(8, 3)
object { Plain scale 2.75 translate <-2.5, 1.4, 0> }
object { Layered scale 2.75 translate <0.5, 1.4, 0> }
object { Layered scale <1.9, 2.75, 1> rotate <30, 30, 0> translate <3, 1.4, 0> }
object { Layered matrix <1, 0, 0.3, 0, 1, 0.4, 0, 0, 1, 0, 0, 0> scale 1e-4 * <1, 1, 1e4> scale 2.75e4 translate <-2.5, -1.5, 7e5> }
object { Layered rotate 45 * x scale <2.75, 2.75, 1e-7> translate <0.5, -1.5, 0> }
object { Plain scale 2.3 rotate 10 * y translate <3, -1.5, 0> no_shadow }
// no ray comes here: meshes.sh sees that this one is not built
object { Ball("flat2", 20, 0) } translate -100 * z }
