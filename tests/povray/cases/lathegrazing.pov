// SPDX-License-Identifier: Apache-2.0
// red: 2448
// unbounded: 0
// options:
// A lathe seen almost square to its axis: hits are a height divided by 8e-9, and lie far from it.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0.08, -9> direction <0, 8e-9, 1> right 2.5 * x up 1.9 * y }
#declare Glow = finish { emission 1 ambient 0 diffuse 0 }
lathe {
    bezier_spline 12, <0.394007345, -0.920718199>, <0.615999066, -0.754016516>,
    <0.0547853086, -0.711285865>, <0.75, -0.463684636>, <0.0449257375, -0.297514402>,
    <0, -0.166666667>, <0.745358771, 0.0149402838>, <0.883669606, 0.0876753856>,
    <0.583814467, 0.342854197>, <0.50407328, 0.583002262>, <1, 0.734275314>,
    <0.675772867, 0.915420249> sturm
    pigment { rgb <1, 0, 0> } finish { Glow }
}
box { <-9, -9, 15>, <9, 9, 15.1> pigment { rgb <0, 0, 1> } finish { Glow } }
box { <-9, -9, 16>, <9, 9, 16.1> pigment { rgb <0, 0, 1> } finish { Glow } }
