// SPDX-License-Identifier: Apache-2.0
// A plate with holes: one object, a difference of a box and 1,600 cylinders.
#version 3.7;
#ifndef (Side) #declare Side = 40; #end
global_settings { assumed_gamma 1 max_trace_level 6 }
camera { location <-4, 9, -11> look_at <0, 0, 0.5> angle 48 }
light_source { <-8, 14, -6> rgb 1.1 }
background { rgb <0.25, 0.3, 0.4> }
plane { y, -1.5 pigment { checker rgb <0.8, 0.5, 0.3>, rgb 0.9 } }
difference {
    box { <-5, -0.3, -5>, <5, 0.3, 5> }
    #for (I, 0, Side - 1)
        #for (K, 0, Side - 1)
            cylinder {
                <-5 + 10 * (I + 0.5) / Side, -0.31, -5 + 10 * (K + 0.5) / Side>,
                <-5 + 10 * (I + 0.5) / Side, 0.31, -5 + 10 * (K + 0.5) / Side>, 3.6 / Side
            }
        #end
    #end
    pigment { rgb <0.7, 0.75, 0.8> }
    finish { reflection 0.25 specular 0.3 }
}
