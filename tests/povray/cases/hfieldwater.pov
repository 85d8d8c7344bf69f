// red: 148
// unbounded: 0
// What is below the water level of a height field counts as inside, however deep: a ball far below one is kept by the intersection.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -10> direction z right 12*x up 12*y }
#declare Glow = finish { emission 1 ambient 0 diffuse 0 }
intersection {
  sphere { <0, -4, 0>, 1.2 }
  height_field { function 24, 24 { 0.3 + 0.2 * sin(x * 20) } water_level 0.1 translate <-0.5, 0, -0.5> scale <4, 2, 4> }
  pigment { rgb <1, 0, 0> } finish { Glow }
}
box { <-5, -5.9, 2>, <5, 5.9, 3> pigment { rgb <0, 0, 1> } finish { Glow } }
sphere { <4.8, 4.8, -2>, 0.1 pigment { rgb <0, 1, 0> } finish { Glow } }
