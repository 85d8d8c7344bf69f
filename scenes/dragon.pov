// SPDX-License-Identifier: Apache-2.0
// The Stanford dragon at full resolution: 871,414 triangles in one mesh2.
//
// What it stresses: one very large mesh. To a structure over the scene's objects it is a single
// object: all the work is within the mesh.
//
// Geometry: build/scenes/dragon.inc, which scenes/fetch.sh dragon makes (+Lbuild/scenes).
// No jitter, no crand, no area light: the pixels do not depend on the number of threads.
#version 3.7;

#if (!file_exists("dragon.inc"))
    #error "dragon.inc is not in the library path: run scenes/fetch.sh dragon, add +Lbuild/scenes\n"
#end

global_settings { assumed_gamma 1 max_trace_level 5 }

camera {
    location <-2.3, 4.9, 8.4>
    direction z
    right -image_width / image_height * x
    up y
    look_at <-0.15, 2.35, 0>
    angle 43
}

light_source { <-9, 17, 11> rgb <1.10, 1.00, 0.84> }
light_source { <16, 9, 7> rgb <0.22, 0.30, 0.44> }
light_source { <2, 10, -16> rgb <0.55, 0.45, 0.35> }

sky_sphere {
    pigment { gradient y color_map { [0 rgb <0.30, 0.27, 0.25>] [1 rgb <0.06, 0.08, 0.13>] } }
}

#include "dragon.inc"
object {
    Geometry[0]
    scale 20
    pigment { rgb <0.13, 0.42, 0.30> }
    finish { ambient 0.03 diffuse 0.65 specular 0.85 roughness 0.012 reflection { 0.03, 0.25 fresnel on } }
    interior { ior 1.6 }
}

// A round stone to stand on; the dragon's feet are at y = 1.056.
cylinder {
    <-0.1, 0.66, 0>, <-0.1, 1.056, 0>, 2.6
    pigment { rgb <0.30, 0.28, 0.27> }
    finish { ambient 0.03 diffuse 0.7 specular 0.3 roughness 0.02 }
}
box {
    <-20, 0.46, -20>, <20, 0.66, 20>
    pigment { checker rgb <0.17, 0.16, 0.16> rgb <0.10, 0.095, 0.10> scale 1.2 }
    finish { ambient 0.02 diffuse 0.6 reflection { 0.03, 0.4 fresnel on } }
    interior { ior 1.5 }
}
