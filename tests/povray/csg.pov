// SPDX-License-Identifier: Apache-2.0
// CSG objects of many parts, which have a structure inside: all operations, nested, inverted, as
// clips and bounds of others, with parts that are unbounded, hidden from some rays, clipped or
// coincident, with lights among them. Many edges and much glass, so that a part that is passed over
// shows. Seed chooses another scene.
#version 3.7;
#ifndef (Seed) #declare Seed = 1; #end
global_settings { assumed_gamma 1 max_trace_level 7 }
camera { location <3, 5, -13> look_at <0, 0.4, 0> angle 50 }
light_source { <-6, 12, -9> rgb 0.7 }
light_source { <8, 6, -4> rgb 0.5 }
plane { y, -3 pigment { checker rgb 0.3, rgb 1 } finish { reflection 0.2 } }
#declare Place = seed(Seed);
#macro Random() <4 * rand(Place) - 2, 4 * rand(Place) - 2, 4 * rand(Place) - 2> #end
#macro Colour() pigment { rgb <rand(Place), rand(Place), rand(Place)> } #end
#macro Part(I, Size)
    #switch (mod(I, 9))
    #case (0) sphere { Random(), Size Colour() } #break
    #case (1) #local At = Random(); box { At - Size, At + Size * (0.3 + rand(Place)) Colour() } #break
    #case (2) cylinder { Random(), Random(), Size / 2 Colour() no_shadow } #break
    #case (3) torus { Size, Size / 3 rotate 90 * Random() translate Random() Colour() } #break
    #case (4) cone { Random(), Size, Random(), 0 Colour() no_reflection } #break
    #case (5) sphere { Random(), Size clipped_by { plane { y, 2 * rand(Place) - 1 } } Colour() } #break
    #case (6)
        union {
            #for (J, 1, 7) sphere { Random(), Size / 2 Colour() } #end
            #if (mod(I, 2)) scale 0.7 #end
        }
        #break
    #case (7) disc { Random(), Random(), Size Colour() } #break
    #case (8) sphere { 0, Size scale <1, 0.4, 2> rotate 90 * Random() translate Random() Colour() no_image } #break
    #end
#end
#macro Parts(Count, Size) #for (I, 0, Count - 1) Part(I, Size) #end #end

union { Parts(30, 0.35) light_source { <0, 0, 0> rgb 0.3 looks_like { sphere { 0, 0.2 } } } translate <-5, 0, 3> }
merge { Parts(30, 0.5) pigment { rgbt <1, 0.9, 0.8, 0.7> } interior { ior 1.1 } translate <0, 0, 3> }
difference {
    box { -2, 2 }
    #for (I, 1, 60) sphere { Random() * 1.1, 0.45 } #end
    union { #for (I, 1, 12) box { -0.2, 0.2 rotate 90 * Random() translate Random() } #end }
    plane { y + x, -2.4 }
    Colour() finish { reflection 0.3 }
    cutaway_textures
    scale 0.8 translate <5, 0, 3>
}
intersection {
    #for (I, 1, 14) box { -2, 2 rotate 90 * Random() } #end
    sphere { 0, 1.9 inverse scale 0.9 }
    plane { y, 0.8 }
    Colour()
    scale 0.8 translate <-3, 0, -2>
}
// what is cut away is a merge, turned inside out
intersection {
    sphere { 0, 1.5 }
    merge { #for (I, 1, 25) cylinder { Random(), Random(), 0.15 } #end inverse }
    #for (I, 1, 5) plane { vnormalize(Random()), 1.2 } #end
    hollow pigment { rgbt <0.8, 0.9, 1, 0.6> } interior { ior 1.2 }
    translate <0.2, -0.4, -2.5>
}
// CSG as a clip and as a bound, coincident parts, a part twice
sphere {
    0, 1.4
    clipped_by { union { #for (I, 1, 9) sphere { Random(), 0.7 } #end inverse } }
    bounded_by { union { #for (I, 1, 7) box { -2, 2 rotate 90 * Random() } #end } }
    Colour()
    translate <3, -0.5, -2.5>
}
union {
    #for (I, 1, 8) sphere { <I / 4 - 1, 0, 0>, 0.5 Colour() } sphere { <I / 4 - 1, 0, 0>, 0.5 Colour() } #end
    clipped_by { box { <-2, -0.3, -2>, <2, 0.3, 2> } }
    translate <0, 3.2, 0>
}
// a sheet has no inside, so what is cut out of it is not bounded by that; many parts and few
#declare Sheet = mesh { triangle { <-2, 0, -2>, <2, 0, -2>, <2, 0.3, 2> } triangle { <-2, 0, -2>, <2, 0.3, 2>, <-2, 0, 2> } }
difference {
    object { Sheet }
    #for (I, 1, 9) sphere { Random() * <1, 0.1, 1>, 0.5 } #end
    Colour()
    rotate -60 * x scale 0.6 translate <-3.2, 3, -1>
}
difference {
    object { Sheet }
    torus { 0.9, 0.3 }
    torus { 0.4, 0.2 translate <1.2, 0.1, 1.2> }
    Colour()
    rotate -60 * x scale 0.6 translate <-0.4, 3, -3>
}
