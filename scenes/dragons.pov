// SPDX-License-Identifier: Apache-2.0
// Stanford dragons that mirror, under a soft light: one, or Dragons=100 copies of the same mesh.
//
// What it stresses: one structure for all copies of a mesh, and shadow rays, of which there are many.
//
// Geometry: build/scenes/dragon.inc, which scenes/fetch.sh dragon makes (+Lbuild/scenes).
// No jitter, no crand: the pixels do not depend on the number of threads.
#version 3.7;

#if (!file_exists("dragon.inc"))
    #error "dragon.inc is not in the library path: run scenes/fetch.sh dragon, add +Lbuild/scenes\n"
#end
#ifndef (Dragons) #declare Dragons = 1; #end

global_settings { assumed_gamma 1 max_trace_level 5 }

#declare Side = ceil(sqrt(Dragons));

camera {
    location <-2.3, 4.9, 8.4> * (1 + 0.5 * (Side - 1))
    direction z
    right -image_width / image_height * x
    up y
    look_at <-0.15, 2.35 - 0.25 * (Side - 1), 0>
    angle 43
}

light_source { <-9, 17, 11> * Side rgb <1.10, 1.00, 0.84> area_light 3 * Side * x, 3 * Side * z, 4, 4 }
light_source { <2, 10, -16> * Side rgb <0.55, 0.45, 0.35> }

sky_sphere {
    pigment { gradient y color_map { [0 rgb <0.30, 0.27, 0.25>] [1 rgb <0.06, 0.08, 0.13>] } }
}

#include "dragon.inc"
#declare I = 0;
#while (I < Dragons)
    object {
        Geometry[0]
        scale 20
        rotate 37 * I * y
        translate 4.6 * <mod(I, Side) - (Side - 1) / 2, 0, floor(I / Side) - (Side - 1) / 2>
        pigment { rgb <0.13 + 0.3 * mod(I, 3), 0.42, 0.30 + 0.15 * mod(I, 4)> }
        finish { ambient 0.03 diffuse 0.6 specular 0.85 roughness 0.012 reflection 0.35 }
    }
    #declare I = I + 1;
#end

// A ball that sees them all.
sphere { <-3.2 * Side, 2.2, -3 * Side>, 1.1 pigment { rgb 0.1 } finish { ambient 0 diffuse 0.2 reflection 0.8 } }
box {
    <-200, 0.46, -200>, <200, 1.056, 200>
    pigment { checker rgb <0.17, 0.16, 0.16> rgb <0.10, 0.095, 0.10> scale 1.2 }
    finish { ambient 0.02 diffuse 0.6 reflection 0.2 }
}
