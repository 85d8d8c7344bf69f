// red: 0
// unbounded: 0
// options: -UR
// options: +UR
#version 3.7;
// N lenses, each with a fitting bounded_by, as older scenes have them
global_settings { assumed_gamma 1 }
camera { location <0, 30, -60> look_at 0 angle 50 }
light_source { <30, 60, -50> rgb 1 }
#declare S = seed(2);
#ifndef (N) #declare N = 60; #end
#for (I, 1, N)
  intersection { sphere { -0.5*z, 1 } sphere { 0.5*z, 1 } bounded_by { sphere { 0, 0.9 } } translate <rand(S)*60-30, rand(S)*20-10, rand(S)*60-30> pigment { rgb <rand(S), rand(S), rand(S)> } }
#end
