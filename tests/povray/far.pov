// SPDX-License-Identifier: Apache-2.0
// An intersection that is made far from the origin and moved back. POV-Ray keeps boxes in float, so
// its box is wrong by up to 1 unit, and its surface begins half a unit before its box. The plate in
// between hides it from any accelerator that trusts that box, as stock's +BM1 and +BM2 do.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <-5, 0, 0> direction x right 1.5 * z up 1.5 * y }
#declare Far = 16777216;
#declare Glow = finish { emission 1 ambient 0 diffuse 0 }
box { <-0.25, -2, -2>, <-0.24, 2, 2> pigment { rgb <0, 0, 1> } finish { Glow } }
intersection {
    sphere { <Far + 0.5, 0, 0>, 1 }
    box { <Far - 9, -9, -9>, <Far + 9, 9, 9> }
    translate -Far * x
    pigment { rgb <1, 0, 0> } finish { Glow }
}
sphere { <3, 0, 0>, 1 pigment { rgb <0, 1, 0> } finish { Glow } }
