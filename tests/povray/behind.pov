// SPDX-License-Identifier: Apache-2.0
// A block of spheres before the camera, and one behind it that no ray comes near.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -3> look_at 0 }
light_source { <0.5, 1, -2.5> rgb 1 }
#macro Block(Place)
    #for (X, -3, 3) #for (Y, -3, 3) #for (Z, -3, 3)
        sphere { Place + 0.1 * <X, Y, Z>, 0.06 pigment { rgb 1 } }
    #end #end #end
#end
Block(<0, 0, 0>)
Block(<0, 0, -50>)
