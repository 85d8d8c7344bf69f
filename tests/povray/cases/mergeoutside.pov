// Parts of a merge that other parts bound by their outside, which an inverted ball, or a CSG object turned around, has.
// The last but one has none, as no_image keeps the camera's rays from asking the ball.
// unbounded: 1
// red: 971
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -10> direction z right 12*x up 12*y }
#declare Glow = finish { emission 1 ambient 0 diffuse 0 }
#declare Red = texture { pigment { rgb <1, 0, 0> } finish { Glow } }
#declare Pipe = quadric { <1, 0, 1>, <0, 0, 0>, <0, 0, 0>, -0.3 }
merge { plane { <1, 1, 0>, 0 } sphere { 0, 1.2 inverse } texture { Red } translate <-4, 4, 0> }
merge { object { Pipe } box { -1, 1 inverse } texture { Red } translate <0, 4, 0> }
intersection { sphere { 0, 1.2 } plane { <1, 1, -1>, 0.2 } object { Pipe inverse } inverse texture { Red } translate <4, 4, 0> }
intersection { plane { x, 1 } plane { -x, 1 } plane { y, 1 } plane { -y, 1 } plane { z, 1 } plane { -z, 1 } inverse rotate <20, 30, 0> texture { Red } translate <-4, 0, 0> }
difference { box { -1.2, 1.2 } plane { <1, 1, -1>, 0 } object { Pipe } inverse texture { Red } }
merge { plane { y, 0 no_image } sphere { 0, 1.2 inverse no_image } texture { Red } translate <4, 0, 0> }
difference { sphere { 0, 1.4 } merge { sphere { 0, 1.2 inverse } plane { x, 0 } } texture { Red } translate <-4, -4, 0> }
merge { disc { 0, <1, 2, -3>, 1.2 } object { Pipe clipped_by { sphere { 0, 1.2 } } } plane { z, 0 clipped_by { box { -1.3, 1.3 } } } texture { Red } translate <0, -4, 0> }
merge { torus { 0.8, 0.3 inverse rotate 60*x } Pipe texture { Red } translate <4, -4, 0> }
merge { plane { -z, -5 } sphere { <0, 0, 7>, 1 inverse no_image } texture { Red } }
box { <-7, -7, 3>, <7, 7, 4> pigment { rgb <0, 0, 1> } finish { Glow } }
