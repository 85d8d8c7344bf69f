// SPDX-License-Identifier: Apache-2.0
// red: 597
// unbounded: 0
// A paraboloid that a plane closes which is far from square to its axis.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -5> look_at 0.5 * y }
#declare Glow = finish { emission 1 ambient 0 diffuse 0 }
intersection {
    quadric { <1, 0, 1>, <0, 0, 0>, <0, -1, 0>, 0 rotate degrees(0.5) * <1, 0, 2> }
    plane { y, 1 }
    pigment { rgb <1, 0, 0> } finish { Glow }
}
sphere { <2.5, 0, 0>, 0.5 pigment { rgb <0, 0, 1> } finish { Glow } }
box { <-9, -9, 5>, <9, 9, 5.1> pigment { rgb <0, 0, 1> } finish { Glow } }
