// SPDX-License-Identifier: Apache-2.0
// The paper's figure 3: two clusters of 8 x 8 x 8 cubes of 12 triangles with empty space between.
//
// What it stresses: the empty space. One octree over both clusters spends its depth on the gap; the
// wider the gap, the deeper the cubes lie. A light stands over each cluster, as in the paper.
//
// Declare=Gap=X    empty space between the clusters in cluster sides (default 8)
// Declare=Space=X  empty space between two cubes in cube edges (default 1)
// Declare=Form=F   0: 12,288 triangles, each an object of the scene, as in the paper (default);
//                  1: a mesh2 of 12 triangles for each cube, 1024 objects
// Declare=Photons=N    a glass ball over each cluster, which N photons from the lights pass
// Declare=Radiosity=N  light that surfaces reflect diffusely, N rays for each sample
// Geometry: cubes.inc; the same as accel's scene cubes:gap=X,space=X.
// No jitter, no crand, no area light: the pixels do not depend on the number of threads.
#version 3.7;

#ifndef (Gap) #declare Gap = 8; #end
#ifndef (Space) #declare Space = 1; #end
#ifndef (Form) #declare Form = 0; #end

#include "cubes.inc"
#include "illumination.inc"

global_settings { assumed_gamma 1 max_trace_level 3 Illumination() }

#declare Far = (8 + 7 * Space) * (1 + Gap);

camera {
    location <-17, 17, -18>
    direction z
    right image_width / image_height * x
    up y
    look_at <20, 5.4, 6>
    angle 66
}

background { rgb <0.035, 0.045, 0.065> }

light_source { <6, 32, -16> rgb <1.10, 1.00, 0.84> }
light_source { <Far + 6, 32, -16> rgb <0.80, 0.78, 0.74> fade_distance 60 fade_power 2 }
light_source { <-70, 24, -20> rgb <0.34, 0.42, 0.58> }

// From warm below to cool above; the second cluster the other way round.
#macro Skin(C, At)
    texture {
        #local Part = mod(int(C / 8), 8) / 7;
        #if (C < 512)
            pigment { rgb (1 - Part) * <0.86, 0.36, 0.16> + Part * <0.93, 0.86, 0.66> }
        #else
            pigment { rgb (1 - Part) * <0.16, 0.40, 0.66> + Part * <0.72, 0.86, 0.84> }
        #end
        finish { ambient 0.02 diffuse 0.85 specular 0.25 roughness 0.03 }
    }
#end

#macro Cube(C, At)
    #if (Form = 0)
        #local T = 0;
        #while (T < 12)
            triangle {
                At + Cube_Corners[Cube_Faces[T].x],
                At + Cube_Corners[Cube_Faces[T].y],
                At + Cube_Corners[Cube_Faces[T].z]
                Skin(C, At)
            }
            #local T = T + 1;
        #end
    #else
        mesh2 {
            vertex_vectors {
                8, At + Cube_Corners[0], At + Cube_Corners[1], At + Cube_Corners[2],
                At + Cube_Corners[3], At + Cube_Corners[4], At + Cube_Corners[5],
                At + Cube_Corners[6], At + Cube_Corners[7]
            }
            face_indices {
                12, Cube_Faces[0], Cube_Faces[1], Cube_Faces[2], Cube_Faces[3], Cube_Faces[4],
                Cube_Faces[5], Cube_Faces[6], Cube_Faces[7], Cube_Faces[8], Cube_Faces[9],
                Cube_Faces[10], Cube_Faces[11]
            }
            Skin(C, At)
        }
    #end
#end

Cubes(Gap, Space)
Lens(<7.5, 21, 7.5>, 4)
Lens(<Far + 7.5, 21, 7.5>, 4)
