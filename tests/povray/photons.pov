// SPDX-License-Identifier: Apache-2.0
// Photons that begin inside coloured glass, from an area light in many places: inside spheres that
// overlap, inside what a clip or bound cuts away (which POV-Ray still takes for inside), outside an
// inverted sphere. Which interiors they begin in, and in what order, shows in the light they bring.
#version 3.7;
global_settings { assumed_gamma 1 photons { spacing 0.06 } max_trace_level 8 }
camera { location <0, 9, -9> look_at <0, 0, 0> }
light_source {
    <0, 4, 0> rgb 1
    area_light 6 * x, 6 * z, 4, 4
    photons { refraction on reflection on area_light }
}
plane { y, -1 pigment { rgb 1 } finish { ambient 0.02 diffuse 0.9 } }
#declare Place = seed(11);
#declare Tint =
    interior {
        ior 1.05
        fade_distance 2
        fade_power 1001
        fade_color <rand(Place), rand(Place), rand(Place)>
    }
#macro Glass()
    hollow
    pigment { rgbt 1 }
    interior {
        ior 1 + 0.2 * rand(Place)
        fade_distance 3
        fade_power 1001
        fade_color <rand(Place), rand(Place), rand(Place)>
    }
    photons { pass_through }
#end
#for (I, 1, 40)
    sphere {
        <8 * rand(Place) - 4, 4 + 3 * rand(Place) - 1.5, 8 * rand(Place) - 4>, 0.5 + rand(Place)
        #switch (mod(I, 4))
        #case (1) clipped_by { box { <-5, 0, -5>, <5, 3.6, 5> } } #break
        #case (2) bounded_by { box { <-5, 3, -5>, <5, 9, 5> } } #break
        #end
        Glass()
    }
#end
sphere { <3, -3, 2>, 1 inverse Glass() }
difference { box { <-3, 3, -3>, <3, 5, 3> } sphere { <0, 4, 0>, 1.5 } Glass() }
union { sphere { <-2, 4, 0>, 1.2 } torus { 1.5, 0.7 translate <2, 4, 0> } Glass() }
sphere {
    <0, 1, 0>, 0.8
    pigment { rgbt <1, 1, 1, 0.95> }
    interior { ior 1.5 }
    photons { target refraction on reflection on collect off }
}
