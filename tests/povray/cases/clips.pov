// red: 1371
// unbounded: 0
// What counts of a clip is its inside: planes, inverted clips, clips that are clipped, unions, differences, and clips of a clipped part.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -10> direction z right 12*x up 12*y }
#declare Glow = finish { emission 1 ambient 0 diffuse 0 }
#declare Red = texture { pigment { rgb <1, 0, 0> } finish { Glow } }
plane { z, 0 clipped_by { box { <-5.5, 3.5, -1>, <-3.5, 5.5, 1> } } texture { Red } }
plane { <1, 1, 3>, 0 clipped_by { cylinder { <-2, 4.5, -5>, <-2, 4.5, 5>, 1 } } texture { Red } }
plane { z, 0 clipped_by { union { sphere { <0, 4.5, 0>, 0.7 } sphere { <1.2, 4.5, 0>, 0.7 } } } texture { Red } }
plane { z, 0 clipped_by { difference { box { <2.3, 3.5, -1>, <5.5, 5.5, 1> } sphere { <4, 4.5, 0>, 0.8 } } } texture { Red } }
sphere { <-4.5, 1.5, 0>, 1.2 clipped_by { plane { y, 1.5 } } texture { Red } }
sphere { <-1.5, 1.5, 0>, 1.2 clipped_by { sphere { <-1.5, 1.5, 0>, 3 clipped_by { plane { <1, 1, 0>, 0 } } } } texture { Red } }
box { <0.3, 0.3, -1>, <2.7, 2.7, 1> clipped_by { box { <0.3, 0.3, -1.1>, <1.5, 1.5, -0.5> inverse } plane { x, 2.3 } } texture { Red } }
union { sphere { <4, 1.5, 0>, 0.8 } box { <3.5, 0.5, -0.2>, <5.5, 1, 0.2> } clipped_by { disc { <4.5, 1.2, 0>, <1, 1, 0>, 0.3 inverse } } texture { Red } }
quadric { <1, 1, 0>, <0, 0, 0>, <0, 0, 0>, -1 rotate <60, 20, 0> translate <-4.5, -1.5, 0> clipped_by { box { <-5.7, -2.7, -1>, <-3.3, -0.3, 1> } } texture { Red } }
quadric { <1, -1, 1>, <0, 0, 0>, <0, 0, 0>, -0.1 translate <-1.5, -1.5, 0> clipped_by { plane { y, -0.5 } plane { -y, 2.5 } } texture { Red } }
cubic { <1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0> translate <1.5, -1.5, 0> clipped_by { sphere { <1.5, -1.5, 0>, 1.2 } } texture { Red } }
triangle { <3, -3, 0>, <6, -3, 0>, <4, 0, 0> clipped_by { sphere { <4.5, -2, 0>, 1 inverse } } texture { Red } }
torus { 0.8, 0.3 rotate 90*x translate <-4.5, -4.5, 0> clipped_by { disc { <-4.5, -4.5, 0>, x, 0.1 } } texture { Red } }
bicubic_patch { type 1 flatness 0.01 u_steps 3 v_steps 3
  <-2.5, -5.5, 0>, <-2, -5.5, -1>, <-1, -5.5, 1>, <-0.5, -5.5, 0>, <-2.5, -5, 0>, <-2, -5, -1>, <-1, -5, 1>, <-0.5, -5, 0>,
  <-2.5, -4, 0>, <-2, -4, -1>, <-1, -4, 1>, <-0.5, -4, 0>, <-2.5, -3.5, 0>, <-2, -3.5, -1>, <-1, -3.5, 1>, <-0.5, -3.5, 0>
  clipped_by { sphere { <-1.5, -4.5, 0>, 0.3 } } texture { Red } }
blob { threshold 0.5 sphere { <1, -4.5, 0>, 1.2, 1 } sphere { <2, -4.5, 0>, 1.2, 1 } sphere { <1.5, -4, -1>, 0.8, -2 } clipped_by { disc { <1.5, -4.2, 0>, y, 0.1 } } texture { Red } }
superellipsoid { <0.3, 0.3> translate <4.5, -4.5, 0> clipped_by { sphere { <4.5, -4.5, -1>, 0.6 inverse } } texture { Red } }
box { <-7, -7, 3>, <7, 7, 4> pigment { rgb <0, 0, 1> } finish { Glow } }
