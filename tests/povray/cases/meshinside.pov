// red: 2141
// unbounded: 0
// Meshes with and without an inside in CSG, as clips and clipped. One is open: what lies behind it counts as inside.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -10> direction z right 6*x up 6*y }
#declare Glow = finish { emission 1 ambient 0 diffuse 0 }
#declare Red = texture { pigment { rgb <1, 0, 0> } finish { Glow } }
#macro Cube(Inside)
  mesh2 {
    vertex_vectors { 8, <-1,-1,-1>, <1,-1,-1>, <-1,1,-1>, <1,1,-1>, <-1,-1,1>, <1,-1,1>, <-1,1,1>, <1,1,1> }
    face_indices { 12, <0,1,2>, <1,3,2>, <4,5,6>, <5,7,6>, <0,1,4>, <1,5,4>, <2,3,6>, <3,7,6>, <0,2,4>, <2,6,4>, <1,3,5>, <3,7,5> }
    #if (Inside) inside_vector <0.2, 0.3, 1> #end
  }
#end
difference { object { Cube(true) scale 0.7 } sphere { <0, 0, -0.7>, 0.4 } rotate <10, 20, 0> translate <-1.8, 1.8, 0> texture { Red } }
intersection { sphere { 0, 0.9 } object { Cube(true) scale 0.7 rotate 45*z } translate <0, 1.8, 0> texture { Red } }
difference { sphere { 0, 0.9 } object { Cube(true) scale 0.5 translate -0.8*z } translate <1.8, 1.8, 0> texture { Red } }
sphere { <-1.8, 0, 0>, 0.9 clipped_by { object { Cube(true) scale 0.6 translate <-1.8, 0, 0> } } texture { Red } }
object { Cube(true) scale 0.7 clipped_by { sphere { -0.7*z, 0.5 inverse } } texture { Red } }
intersection { sphere { <1.8, 0, 0>, 0.9 } mesh { triangle { <0.8, -1, 1.5>, <2.8, -1, 1.5>, <1.8, 1, 1.5> } inside_vector z } texture { Red } }
union { object { Cube(false) scale 0.6 translate <-1.8, -1.8, 0> } sphere { <-1.2, -1.8, 0>, 0.4 } clipped_by { disc { <-1.5, -1.8, 0>, <1, 1, 0>, 1 } } texture { Red } }
intersection { object { Cube(false) scale 0.7 } sphere { 0, 0.9 } translate <0, -1.8, 0> texture { Red } }
object { Cube(true) inverse scale 0.7 rotate <20, 30, 0> translate <1.8, -1.8, 0> texture { Red } }
box { <-3, -3, 3>, <3, 3, 4> pigment { rgb <0, 0, 1> } finish { Glow } }
