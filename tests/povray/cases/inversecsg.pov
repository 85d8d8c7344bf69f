// red: 1550
// unbounded: 0
// CSG turned around: a union by `inverse` keeps what is outside all its parts, an intersection what is outside one of them.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -10> direction z right 6*x up 6*y }
#declare Glow = finish { emission 1 ambient 0 diffuse 0 }
#declare Red = texture { pigment { rgb <1, 0, 0> } finish { Glow } }
intersection {
  box { <-2.5, -1, -1>, <-0.2, 1, 1> }
  union { sphere { <-2, 0, -1>, 0.5 } sphere { <-1, 0, -1>, 0.5 } inverse }
  texture { Red }
}
intersection {
  box { <0.2, -1, -1>, <2.5, 1, 1> }
  intersection { sphere { <1.2, 0, -1>, 0.7 } sphere { <1.6, 0, -1>, 0.7 } inverse }
  texture { Red }
}
difference {
  sphere { <0, 2, 0>, 0.8 }
  difference { sphere { <0, 2, -0.8>, 0.5 } box { <-1, 2, -2>, <1, 3, 0> } inverse }
  texture { Red }
}
merge { sphere { <-1, -2, 0>, 0.6 inverse } box { <-1.5, -2.5, -0.2>, <-0.5, -1.5, 0.2> } texture { Red } }
merge { sphere { <1, -2, 0>, 0.6 } box { <0.5, -2.5, -1>, <1.5, -2, 0.2> } inverse texture { Red } }
box { <-3, -3, 3>, <3, 3, 4> pigment { rgb <0, 0, 1> } finish { Glow } }
