// SPDX-License-Identifier: Apache-2.0
// The paper's figure 5: nine Utah teapots on a floor, 49,370 triangles of similar size.
//
// What it stresses: ten clusters side by side, one of them (the floor) flat and under all others.
//
// Declare=Form=F  0: 49,370 triangles, each an object of the scene, as in the paper (default);
//                 1: ten meshes, one for each teapot and the floor
// Declare=Photons=N    a glass ball over the middle, which N photons from the lights pass
// Declare=Radiosity=N  light that surfaces reflect diffusely, N rays for each sample
// Geometry: build/scenes/teapots*.inc, which scenes/fetch.sh teapots makes (+Lbuild/scenes): the
// same as accel's scene teapots, in form 1 with coordinates rounded to float.
// No jitter, no crand, no area light: the pixels do not depend on the number of threads.
#version 3.7;

#ifndef (Form) #declare Form = 0; #end

#if (!file_exists("teapots.inc") | !file_exists("teapots-corners.inc"))
    #error "teapots*.inc are not in the library path: run scenes/fetch.sh teapots, add +Lbuild/scenes\n"
#end

#include "illumination.inc"

global_settings { assumed_gamma 1 max_trace_level 5 Illumination() }

camera {
    location <-9.5, 11.5, -17.5>
    direction z
    right image_width / image_height * x
    up y
    look_at <-0.9, 0.4, -0.6>
    angle 57
}

light_source { <-14, 19, -12> rgb <1.05, 0.96, 0.82> }
light_source { <17, 14, -6> rgb <0.30, 0.38, 0.52> }

background { rgb <0.045, 0.05, 0.065> }

// Glazes of the nine teapots, row by row, then the floor.
#declare Glaze = array[10] {
    <0.72, 0.20, 0.12>, <0.86, 0.56, 0.14>, <0.80, 0.76, 0.62>, <0.16, 0.40, 0.46>, <0.88, 0.84, 0.76>,
    <0.36, 0.16, 0.28>, <0.12, 0.20, 0.40>, <0.36, 0.46, 0.20>, <0.82, 0.42, 0.26>, <0.30, 0.29, 0.28>
}

#declare Skins = array[10]
#declare I = 0;
#while (I < 10)
    #declare Skins[I] = texture {
        pigment { rgb Glaze[I] }
        #if (I < 9)
            finish { ambient 0.03 diffuse 0.7 specular 0.8 roughness 0.008 reflection { 0.03, 0.25 } }
        #else
            finish { ambient 0.03 diffuse 0.7 reflection { 0.02, 0.15 } }
        #end
    }
    #declare I = I + 1;
#end

#if (Form = 0)
    #include "teapots-corners.inc"
    #declare I = 0;
    #while (I < 10)
        #declare T = First[I];
        #while (T < First[I + 1])
            triangle { Corners[T][0], Corners[T][1], Corners[T][2] texture { Skins[I] } }
            #declare T = T + 1;
        #end
        #declare I = I + 1;
    #end
#else
    #include "teapots.inc"
    #declare I = 0;
    #while (I < 10)
        object { Geometry[I] texture { Skins[I] } }
        #declare I = I + 1;
    #end
#end
Lens(<-1, 6, -1>, 2)
