// SPDX-License-Identifier: Apache-2.0
// A few objects of many sorts, for tests of options: finite and infinite, CSG, clipped and bounded,
// a mesh, a light with a body, a mirror, glass, shadows, a blurred area light, and equal depths.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -8> look_at <0, 0.5, 0> }
light_source {
    <4, 6, -5> rgb 1
    area_light x, y, 3, 3 jitter
    looks_like { sphere { 0, 0.2 pigment { rgb 1 } finish { emission 1 } } }
}
light_source { <-5, 8, -3> rgb 0.4 }
plane { y, -1 pigment { checker rgb 0.2, rgb 0.9 } finish { reflection 0.2 } }
sphere { <-2, 0, 0>, 1 pigment { rgb <1, 0.3, 0.3> } finish { reflection 0.4 } }
sphere { <0, 0, 0>, 1 pigment { rgbt <0.6, 1, 0.6, 0.8> } interior { ior 1.4 } }
difference {
    box { <1.2, -1, -0.8>, <2.8, 0.6, 0.8> }
    cylinder { <2, -2, 0>, <2, 2, 0>, 0.5 }
    pigment { rgb <0.3, 0.4, 1> }
}
torus { 0.7, 0.2 translate <2, 1.2, 0> pigment { rgb <1, 0.8, 0.2> } }
sphere { <-2, 1.6, 0>, 0.6 clipped_by { plane { x, -2 } } pigment { rgb <1, 0, 1> } }
union {
    cone { <0, 1.1, 0>, 0.5, <0, 2, 0>, 0 }
    sphere { <0, 2.2, 0>, 0.2 }
    bounded_by { box { <-0.6, 1, -0.6>, <0.6, 2.5, 0.6> } }
    pigment { rgb <0, 1, 1> }
}
// equal depths: the first one is in front
box { <3.2, -1, -0.5>, <4.2, 1, 0.5> pigment { rgb <1, 0, 0> } }
box { <3.2, -1, -0.5>, <4.2, 1, 0.5> pigment { rgb <0, 1, 0> } }
mesh2 {
    vertex_vectors { 4, <-4.5, -1, 1>, <-3.2, -1, 1>, <-3.8, 1, 1.4>, <-3.9, -1, 0> }
    face_indices { 4, <0, 1, 2>, <1, 3, 2>, <3, 0, 2>, <0, 3, 1> }
    pigment { rgb <0.8, 0.8, 0.3> }
}
sphere { <-0.8, -0.7, -1.6>, 0.3 no_shadow pigment { rgb 1 } }
sphere { <0.8, -0.7, -1.6>, 0.3 no_image pigment { rgb 1 } }
