// SPDX-License-Identifier: Apache-2.0
// An orthographic camera whose rays begin inside coloured glass, for each ray inside other objects:
// which ones they are, and in what order, shows in the colour and in the refraction.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 12 }
camera { orthographic location <0, 0, 0> direction z right 8 * x up 6 * y }
light_source { <2, 6, -8> rgb 1 }
plane { z, 12 pigment { checker rgb 0.3, rgb 1 } finish { ambient 0.6 } }
#declare Place = seed(7);
#for (I, 1, 60)
    sphere {
        <8 * rand(Place) - 4, 6 * rand(Place) - 3, 3 * rand(Place) - 2>, 0.3 + rand(Place)
        hollow
        pigment { rgbt 1 }
        interior {
            ior 1 + 0.3 * rand(Place)
            fade_distance 1
            fade_power 1001
            fade_color rgb <rand(Place), rand(Place), rand(Place)>
        }
    }
#end
difference {
    box { <-4, -3, -1>, <4, -2, 1> }
    cylinder { <0, -2.5, -2>, <0, -2.5, 2>, 0.4 }
    hollow
    pigment { rgbt <0.8, 0.9, 1, 1> }
    interior { ior 1.2 }
}
