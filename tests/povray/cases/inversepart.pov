// red: 140
// unbounded: 0
// A union with an inverted part inside an intersection: the inside of the union is nearly everything.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -10> direction z right 6*x up 6*y }
#declare Glow = finish { emission 1 ambient 0 diffuse 0 }
intersection {
  sphere { 0, 2 }
  union { sphere { <0.6, 0, -1.6>, 0.5 inverse } sphere { <0.6, 0, -1.9>, 0.3 } }
  pigment { rgb <1, 0, 0> } finish { Glow }
}
box { <-3, -3, 2.5>, <3, 3, 3> pigment { rgb <0, 0, 1> } finish { Glow } }
sphere { <2.8, 2.8, -5>, 0.1 pigment { rgb <0, 1, 0> } finish { Glow } }
