// SPDX-License-Identifier: Apache-2.0
// Declare=Count=N spheres that overlap: slow to build for a deep octree with one sphere in a leaf.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -3> look_at 0 }
light_source { <4, 6, -5> rgb 1 }
#declare Place = seed(1);
#for (I, 1, Count)
    sphere { <rand(Place), rand(Place), rand(Place)> * 2 - 1, 0.2 pigment { rgb 1 } }
#end
