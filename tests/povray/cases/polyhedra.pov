// red: 1186
// unbounded: 0
// Bodies made of planes and quadrics alone, turned: each has a box although none of its parts has one.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -10> direction z right 12*x up 12*y }
#declare Glow = finish { emission 1 ambient 0 diffuse 0 }
#declare Red = texture { pigment { rgb <1, 0, 0> } finish { Glow } }
#declare Cube = intersection { plane { x, 1 } plane { -x, 1 } plane { y, 1 } plane { -y, 1 } plane { z, 1 } plane { -z, 1 } }
object { Cube texture { Red } translate <-4, 4, 0> }
object { Cube rotate <30, 40, 50> texture { Red } translate <0, 4, 0> }
intersection { plane { -x, 0 } plane { -y, 0 } plane { -z, 0 } plane { <1, 1, 1>, 1.2 } rotate <20, 0, 10> texture { Red } translate <3.5, 3, 0> }
#declare Pipe = quadric { <1, 0, 1>, <0, 0, 0>, <0, 0, 0>, -1 }
intersection { object { Pipe } plane { y, 1 } plane { -y, 1 } texture { Red } translate <-4, 0, 0> }
intersection { object { Pipe } plane { y, 1 } plane { -y, 1 } rotate <30, 40, 50> texture { Red } }
difference { intersection { object { Pipe } plane { y, 1 } plane { -y, 1 } } object { Pipe scale <0.5, 1, 0.5> } rotate <60, 0, 30> texture { Red } translate <4, 0, 0> }
intersection { quadric { <1, -1, 1>, <0, 0, 0>, <0, 0, 0>, 0 } plane { y, 1 } plane { -y, 0 } rotate <20, 10, 140> texture { Red } translate <-4, -4, 0> }
intersection { quadric { <1, 0, 1>, <0, 0, 0>, <0, -1, 0>, 0 } plane { y, 1.4 } rotate <20, 10, 150> texture { Red } translate <0, -3, 0> }
intersection { quadric { <1, -0.4, 1>, <0, 0, 0>, <0, 0, 0>, -0.3 } plane { y, 1 } plane { -y, 1 } rotate <50, 10, 40> texture { Red } translate <3.8, -4, 0> }
quadric { <1, 2, 3>, <0.3, 0.2, -0.1>, <1, 2, 0>, 0.4 texture { Red } translate <-2, 1.7, 0> }
box { <-7, -7, 3>, <7, 7, 4> pigment { rgb <0, 0, 1> } finish { Glow } }
