// SPDX-License-Identifier: Apache-2.0
// red: 1474
// unbounded: 0
// options:
// A straight sphere_sweep of radius 0.1, seen almost square to its axis. POV-Ray takes discriminants
// below 1e-10 for 0, so rays that come through its box hit it though they pass it by at some times its
// radius, outside that box.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <-5, 5, -5> direction <1 + 5e-5, -1 + 5e-5, 1> right 4 * x up 3 * y }
#declare Glow = finish { emission 1 ambient 0 diffuse 0 }
sphere_sweep { linear_spline 2, <-1.5, 0, 0>, 0.1, <1.5, 0, 0>, 0.1 rotate 45 * z pigment { rgb <1, 0, 0> } finish { Glow } }
box { <-9, -9, 5>, <9, 9, 5.1> pigment { rgb <0, 0, 1> } finish { Glow } }
box { <-9, -9, 6>, <9, 9, 6.1> pigment { rgb <0, 0, 1> } finish { Glow } }
