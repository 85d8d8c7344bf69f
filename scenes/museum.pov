// SPDX-License-Identifier: Apache-2.0
// A museum: eight real scans as mesh2, far apart and of very different size.
//
// What it stresses: few objects, each a large mesh with a tree of its own. The diplodocus is 65
// times as long as the rabbit. At the level of the scene there is little to accelerate.
//
// Geometry: build/scenes/*.inc, which scenes/fetch.sh museum makes (+Lbuild/scenes).
// No jitter, no crand, no area light: the pixels do not depend on the number of threads.
#version 3.7;

#if (!file_exists("diplodocus.inc"))
    #error "diplodocus.inc is not in the library path: run scenes/fetch.sh museum, add +Lbuild/scenes\n"
#end

global_settings { assumed_gamma 1 max_trace_level 4 }

camera {
    location <-2.6, 1.9, -13.2>
    direction z
    right image_width / image_height * x
    up y
    look_at <0.1, 2.35, 0>
    angle 57
}

light_source { <-14, 15.5, -17> rgb <1.05, 0.97, 0.84> * 0.85 }
light_source { <19, 11, -7> rgb <0.30, 0.37, 0.50> * 0.8 }
light_source { <2, 13, 13> rgb <0.50, 0.44, 0.36> * 0.6 }

// The hall.
#declare Plaster = texture {
    pigment { rgb <0.58, 0.54, 0.48> }
    finish { ambient 0.08 diffuse 0.75 }
}
box {
    <-22, -0.2, -28>, <22, 0, 22>
    pigment { checker rgb <0.30, 0.27, 0.24> rgb <0.13, 0.115, 0.11> scale 1.25 }
    finish { ambient 0.03 diffuse 0.6 specular 0.3 roughness 0.01 reflection { 0.02, 0.35 fresnel on } }
    interior { ior 1.45 }
}
box { <-22, 0, 22>, <22, 18, 22.4> texture { Plaster } }
box { <-22.4, 0, -28>, <-22, 18, 22> texture { Plaster } }
box { <22, 0, -28>, <22.4, 18, 22> texture { Plaster } }
#declare I = 0;
#while (I < 6)
    #declare At = -17.5 + 7 * I;
    cylinder { <At, 0.5, 19>, <At, 12, 19>, 0.75 texture { Plaster } }
    torus { 0.78, 0.16 translate <At, 0.5, 19> texture { Plaster } }
    box { <At - 1.05, 0, 17.95>, <At + 1.05, 0.4, 20.05> texture { Plaster } }
    box { <At - 0.95, 12, 18.05>, <At + 0.95, 12.5, 19.95> texture { Plaster } }
    #declare I = I + 1;
#end
box { <-22, 12.5, 18>, <22, 14, 20> texture { Plaster } }

// Stone, bronze, jade, clay: a colour and how it shines.
#macro Matter(Colour, Shine, Mirror)
    texture {
        pigment { rgb Colour }
        finish { ambient 0.05 diffuse 0.75 specular Shine roughness 0.03 reflection Mirror }
    }
#end

// Exhibit(Mesh, Turn, Size, Place, Rise): Mesh turned by Turn about y, its longest side scaled to
// Size, standing at Place on a plinth of height Rise.
#macro Exhibit(Mesh, Turn, Size, Place, Rise, Colour, Shine, Mirror)
    #local Lo = min_extent(Mesh);
    #local Hi = max_extent(Mesh);
    #local Side = Hi - Lo;
    #local Scale = Size / max(Side.x, Side.y, Side.z);
    object {
        Mesh
        translate -<(Lo.x + Hi.x) / 2, Lo.y, (Lo.z + Hi.z) / 2>
        scale Scale
        rotate Turn * y
        translate Place + Rise * y
        Matter(Colour, Shine, Mirror)
    }
    #if (Rise > 0)
        #local Half = 0.62 * Scale * max(Side.x, Side.z);
        box {
            <-Half, 0, -Half>, <Half, Rise, Half>
            rotate Turn * y
            translate Place
            pigment { rgb <0.36, 0.34, 0.33> }
            finish { ambient 0.05 diffuse 0.65 specular 0.2 roughness 0.02 }
        }
    #end
#end

#include "diplodocus.inc"
Exhibit(Geometry[0], 18, 10.5, <1.2, 0, 11>, 0.5, <0.52, 0.44, 0.33>, 0.25, 0)
#include "elephant.inc"
Exhibit(Geometry[0], 25, 4.6, <-6.7, 0, 6.5>, 0.6, <0.40, 0.41, 0.43>, 0.35, 0)
#include "camel.inc"
Exhibit(Geometry[0], 120, 3.0, <8.2, 0, 4.2>, 0.4, <0.62, 0.46, 0.26>, 0.2, 0)
#include "chinese_dragon.inc"
Exhibit(Geometry[0], 205, 1.5, <1.15, 0, -0.9>, 0.9, <0.16, 0.44, 0.32>, 0.9, 0.06)
#include "armadillo.inc"
Exhibit(Geometry[0], 12, 1.0, <-2.9, 0, -5.2>, 1.0, <0.46, 0.29, 0.15>, 0.8, 0.05)
#include "lion.inc"
Exhibit(Geometry[0], 200, 0.9, <2.9, 0, -4.6>, 1.05, <0.78, 0.75, 0.68>, 0.3, 0)
#include "turbine.inc"
#declare Upright = object { Geometry[0] rotate -90 * z }
Exhibit(Upright, 0, 0.75, <-5.2, 0, -3.4>, 1.1, <0.55, 0.56, 0.60>, 1.0, 0.2)
#include "bunny.inc"
Exhibit(Geometry[0], -30, 0.16, <-2.12, 0, -11.75>, 1.53, <0.80, 0.74, 0.66>, 0.2, 0)
