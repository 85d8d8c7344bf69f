// SPDX-License-Identifier: Apache-2.0
// red: 4800
// unbounded: 0
// refused: 0
// options:
// Rays begin on a mesh far from the objects, which are small, and from the place that other cameras
// have: they must not be taken for rays from too far away.
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Film = mesh {
    #for (Row, 0, 59) #for (Column, 0, 79)
        triangle { <Column, 59 - Row, 0>, <Column + 1, 60 - Row, 0>, <Column + 1, 59 - Row, 0> }
    #end #end
    translate <-40, -30, 0> scale 1/40
}
camera { mesh_camera { 1 0 mesh { Film translate -10 * z } } }
#declare Glow = finish { emission 1 ambient 0 diffuse 0 }
box { <-2, -2, 0>, <2, 2, 0.1> pigment { rgb <1, 0, 0> } finish { Glow } }
sphere { <0.5, 0.5, 1>, 0.001 pigment { rgb <0, 0, 1> } finish { Glow } }
sphere { <-0.5, 0.5, 1>, 0.001 pigment { rgb <0, 0, 1> } finish { Glow } }
