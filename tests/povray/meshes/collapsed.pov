// SPDX-License-Identifier: Apache-2.0
// Triangles that float makes lines and points: POV-Ray's test then finds them anywhere in a line or
// in their whole plane. Also none at all, needles, and equal corners.
#include "head.inc"
#include "ball.inc"
camera { location <0, 1, -8> look_at 0 angle 45 }
light_source { <-3, 5, -10> rgb 1 }
mesh {
    Ball_Faces("flat", 10)
    triangle { <5, 5, 3>, <5 + 1e-11, 5, 3>, <5, 5 + 1e-11, 3 + 2e-12> }
    hierarchy Hierarchy
    texture { Matter[1] }
}
mesh {
    triangle { <-2, -2, 1>, <-2 + 3e-9, -2 + 1e-9, 1>, <-2 + 7e-9, -2 + 9e-9, 1 + 1e-9> }
    triangle { <1, 1, 0>, <2, 1, 0>, <1.5, 1.00000001, 1e-9> }
    triangle { <1, -1, 0>, <1, -1, 0>, <1.5, -1, 0> }
    triangle { <-3, 1, 0>, <3, 1.5, 0.3>, <-3, 1.0001, 0> }
    triangle { <-3, -1.5, 0>, <3, -1.4, 0.3>, <0, -1.45, 0.15> }
    hierarchy Hierarchy
    texture { Matter[2] }
    scale 0.9
}
mesh2 {
    vertex_vectors { 6, <2, 0, 1>, <2, 0, 1>, <3, 0, 1>, <2, 1, 1>, <2.5, 0.5, 1>, <3, 1, 1> }
    face_indices { 5, <0, 1, 2>, <0, 2, 3>, <2, 4, 3>, <2, 2, 2>, <2, 5, 3> }
    hierarchy Hierarchy
    texture { Matter[3] }
}
