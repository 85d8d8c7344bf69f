// SPDX-License-Identifier: Apache-2.0
// A sphere_sweep seen along a direction that is nearly, but not quite, perpendicular to it: POV-Ray divides by the
// cosine, and hits lie anywhere along the ray, as its linear search reports them too. No box holds these.
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Tilt = 4e-9;
camera { orthographic location <0, 0, -10> direction <Tilt, 0, 1> right 4 * x up 3 * y }
#declare Glow = finish { emission 1 ambient 0 diffuse 0 }
sphere_sweep { linear_spline 2, <-1, 0.3, 0>, 0.5, <1, 0.3, 0>, 0.5 pigment { rgb <1, 0, 0> } finish { Glow } }
box { <-2, -2, -5>, <2, 2, -4.9> pigment { rgb <0, 0, 1> } finish { Glow } }
box { <-2, -2, 5>, <2, 2, 5.1> pigment { rgb <0, 1, 1> } finish { Glow } }
sphere { <1.5, 1.2, -8>, 0.1 pigment { rgb <0, 1, 0> } finish { Glow } }
