// red: 1080
// unbounded: 0
// A height field, half of which a disc cuts off, looked at from above. A plate lies behind it.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 10, 0> direction -y right 6*x up 6*z sky z }
#declare Glow = finish { emission 1 ambient 0 diffuse 0 }
height_field {
  function 24, 24 { 0.3 + 0.2 * sin(x * 20) * cos(y * 17) }
  translate <-0.5, 0, -0.5> scale <4, 2, 4>
  clipped_by { disc { 0, x, 0.5 } }
  pigment { rgb <1, 0, 0> } finish { Glow }
}
box { <-3, -3, -3>, <3, -2, 3> pigment { rgb <0, 0, 1> } finish { Glow } }
sphere { <2.8, 4, 2.8>, 0.1 pigment { rgb <0, 1, 0> } finish { Glow } }
