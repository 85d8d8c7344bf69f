// red: 754
// unbounded: 0
// options: -UR
// options: +UR
// The body of a light source: clipped by a disc, by an inverted ball, and bounded too narrowly.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -10> direction z right 6*x up 6*y }
#declare Glow = finish { emission 1 ambient 0 diffuse 0 }
#declare Red = texture { pigment { rgb <1, 0, 0> } finish { Glow } }
light_source { <-1.5, 0, 0> rgb 1 looks_like { sphere { 0, 1 clipped_by { disc { 0, y, 0.4 } } texture { Red } } } }
light_source { <1.5, 0, 0> rgb 1 looks_like { box { -0.9, 0.9 clipped_by { sphere { <0, 0, -0.9>, 0.4 inverse } } texture { Red } } } }
light_source { <0, 2, 0> rgb 1 looks_like { union { sphere { -0.4*x, 0.5 } sphere { 0.4*x, 0.5 } bounded_by { sphere { 0.4*x, 0.6 } } texture { Red } } } }
light_source { <0, -2, 0> rgb 1 }
box { <-3, -3, 3>, <3, 3, 4> pigment { rgb <0, 0, 1> } finish { Glow } }
