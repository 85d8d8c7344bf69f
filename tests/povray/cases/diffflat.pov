// red: 0
// unbounded: 0
#version 3.7;
// N bricks, each with a few holes that are grouped in a union
global_settings { assumed_gamma 1 }
camera { location <0, 30, -60> look_at 0 angle 50 }
light_source { <30, 60, -50> rgb 1 }
#declare Holes = union { cylinder { <-0.3, -1, 0>, <-0.3, 1, 0>, 0.15 } cylinder { <0.3, -1, 0>, <0.3, 1, 0>, 0.15 } }
#ifndef (N) #declare N = 3; #end
#for (I, -N, N) #for (J, -N, N)
  difference { box { <-0.6, -0.4, -0.4>, <0.6, 0.4, 0.4> } cylinder { <-0.3, -1, 0>, <-0.3, 1, 0>, 0.15 } cylinder { <0.3, -1, 0>, <0.3, 1, 0>, 0.15 } translate <1.4 * I, 0, 1.4 * J> pigment { rgb <1, 0.5, 0.3> } }
#end #end
