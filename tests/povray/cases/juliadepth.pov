// POV-Ray reports other depths for a julia than those of the points that it asks other parts and clips about: some hits lie
// outside the ball that keeps them.
// unbounded: 0
// red: 102
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -10> direction z right 3*x up 2.25*y }
#declare Glow = finish { emission 1 ambient 0 diffuse 0 }
#declare Red = texture { pigment { rgb <1, 0, 0> } finish { Glow } }
#for (I, 0, 3)
  #declare S = seed(15 + 8 * I);
  #declare Julia = julia_fractal { <-0.637, 0.975, -0.5, 0.125> hypercomplex sqr max_iteration 6 precision 15 slice <-0.797, -1, -0.986, 0.66>, 0.00623 scale 0.83 rotate <rand(S), rand(S), rand(S)> * 360 }
  #declare Ball = sphere { (<rand(S), rand(S), rand(S)> - 0.5) * 1.5, 0.2 + 0.6 * rand(S) }
  intersection { object { Ball } object { Julia } texture { Red } }
  object { Julia clipped_by { object { Ball } } texture { Red } }
#end
box { <-3, -3, 3>, <3, 3, 4> pigment { rgb <0, 0, 1> } finish { Glow } }
