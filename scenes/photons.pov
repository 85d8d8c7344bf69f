// SPDX-License-Identifier: Apache-2.0
// A glass ball and its photons beside 20,000 small spheres. POV-Ray asks every object of the scene
// whether a photon begins inside it; the accelerator asks those that are near.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 6 photons { spacing 0.02 } }
camera { location <0, 5, -12> look_at <0, 0.5, 0> angle 42 }
light_source { <-6, 9, -6> rgb 1.2 }
background { rgb <0.2, 0.25, 0.35> }
plane { y, 0 pigment { rgb 0.9 } photons { collect on } }
#declare Place = seed(3);
#for (I, 1, 20000)
    #declare Far = 2.2 + 9 * sqrt(rand(Place));
    sphere {
        <0, 0, 0>, 0.05
        translate vrotate(<Far, 0.05, 0>, 360 * rand(Place) * y)
        pigment { rgb <0.5 + 0.5 * rand(Place), 0.4 + 0.5 * rand(Place), 0.3> }
    }
#end
sphere {
    <0, 1.5, 0>, 1.5
    pigment { rgbt 1 }
    finish { specular 0.6 roughness 0.005 reflection { 0.05, 0.6 fresnel on } conserve_energy }
    interior { ior 1.5 }
    photons { target refraction on reflection on collect off }
}
