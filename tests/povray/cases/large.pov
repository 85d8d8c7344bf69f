// red: 895
// unbounded: 0
// options: -UR
// options: +UR
// Large units: volumes over 2e10, sides over 1e6, where POV-Ray's own boxes become infinite.
#version 3.7;
global_settings { assumed_gamma 1 }
#declare S = 1e6;
camera { orthographic location <0, 0, -10*S> direction z right 12*x*S up 12*y*S }
#declare Glow = finish { emission 1 ambient 0 diffuse 0 }
#declare Red = texture { pigment { rgb <1, 0, 0> } finish { Glow } }
union {
  sphere { <-4, 4, 0>, 1 texture { Red } }
  box { <-1, 3, -1>, <1, 5, 1> texture { Red } }
  difference { sphere { <4, 4, 0>, 1.2 } union { cylinder { <4, 2, 0>, <4, 6, 0>, 0.4 } sphere { <4, 4, -1>, 0.6 } } texture { Red } }
  torus { 1, 0.4 rotate 60*x translate <-4, 0, 0> texture { Red } }
  intersection { sphere { <-0.4, 0, 0>, 1 } sphere { <0.4, 0, 0>, 1 } bounded_by { sphere { 0, 1.1 } } texture { Red } }
  sphere { <4, 0, 0>, 1 clipped_by { plane { <1, 1, 0>, 2 } } texture { Red } }
  cone { <-4, -5, 0>, 1, <-4, -3, 0>, 0.2 texture { Red } }
  merge { sphere { <-0.4, -4, 0>, 0.8 } sphere { <0.4, -4, 0>, 0.8 } texture { Red } }
  object { blob { threshold 0.4 sphere { <3.6, -4, 0>, 1.4, 1 } sphere { <4.4, -4, 0>, 1.4, 1 } } texture { Red } }
  scale S
}
box { <-7, -7, 3>*S, <7, 7, 4>*S pigment { rgb <0, 0, 1> } finish { Glow } }
