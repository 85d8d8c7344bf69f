// red: 18
// unbounded: 0
#version 3.7;
// quadric paraboloid seen nearly along its axis: the quadratic terms of the rays are about 1e-11,
// which takes hits some millionths before its apex, and before the plate there
global_settings { assumed_gamma 1 }
camera { location <0, -300, 0> direction 1000000*<4e-6, 1, 0> right x up z }
#declare Glow = finish { emission 1 ambient 0 diffuse 0 }
polygon { 4, <-1, -1>, <1, -1>, <1, 1>, <-1, 1> rotate 90*x translate -1e-6*y pigment { rgb <0, 0, 1> } finish { Glow } }
quadric {
  <1, 0, 1>, <0, 0, 0>, <0, -1, 0>, 0
  clipped_by { plane { y, 1 } }
  pigment { rgb <1, 0, 0> } finish { Glow }
}
sphere { <-0.4, 0.5, 3>, 0.1 pigment { rgb <0, 1, 0> } finish { Glow } }
sphere { <0.4, 0.5, 3>, 0.1 pigment { rgb <0, 1, 0> } finish { Glow } }
