// SPDX-License-Identifier: Apache-2.0
// Gardens of spheres on a dark lake: clusters of small objects, far apart, of different size.
//
// What it stresses: bounding. 64 gardens of spheres and CSG, about 30,000 objects in clusters that
// fill less than a thousandth of the scene's box; most rays cross empty space and then
// one or two clusters. The lake doubles the picture by reflection, the lights add shadow rays.
//
// Everything comes from one fixed seed; no jitter, no crand, no area light, no anti-aliasing
// state: the pixels do not depend on the number of threads.
//
// Declare=Gardens=N (default 64) changes the number of clusters,
// Declare=Spread=X (default 1) their distance.
#version 3.7;

#ifndef (Gardens) #declare Gardens = 64; #end
#ifndef (Spread) #declare Spread = 1; #end

global_settings { assumed_gamma 1 max_trace_level 5 }

camera {
    location <-20, 7.2, -47>
    direction z
    right image_width / image_height * x
    up y
    look_at <-2.5, 1.4, 0>
    angle 46
}

light_source { <-260, 330, -240> rgb <1.25, 1.08, 0.86> }
light_source { <340, 120, -60> rgb <0.16, 0.24, 0.42> }

sky_sphere {
    pigment {
        gradient y
        color_map {
            [0.00 rgb <0.55, 0.36, 0.26>]
            [0.06 rgb <0.42, 0.38, 0.42>]
            [0.25 rgb <0.10, 0.16, 0.30>]
            [1.00 rgb <0.01, 0.02, 0.07>]
        }
    }
}

fog { fog_type 2 distance 120 rgb <0.46, 0.34, 0.29> fog_offset 0 fog_alt 0.9 }

plane {
    y, 0
    pigment { rgb <0.012, 0.022, 0.032> }
    finish { ambient 0 diffuse 0.5 reflection { 0.06, 0.7 fresnel on } conserve_energy }
    interior { ior 1.33 }
}

#declare Random = seed(19640);
#declare Golden = pi * (3 - sqrt(5));

// The colours of a garden: from Core in the middle to Rim outside.
#macro Petal(Core, Rim, Part)
    pigment { rgb Core * (1 - Part) + Rim * Part }
    finish { ambient 0 diffuse 0.8 specular 0.5 roughness 0.02 }
#end

// A dome of spheres in the order of a sunflower's seeds, on a hemisphere of radius Radius.
#macro Dome(Centre, Radius, Count, Core, Rim)
    #local I = 0;
    #while (I < Count)
        #local Part = (I + 0.5) / Count;
        #local Height = 1 - Part;
        #local Across = sqrt(1 - Height * Height);
        #local Size = Radius * 1.25 / sqrt(Count) * (0.75 + 0.35 * rand(Random));
        sphere {
            Centre + Radius * <Across * cos(I * Golden), Height, Across * sin(I * Golden)>, Size
            Petal(Core, Rim, Part)
        }
        #local I = I + 1;
    #end
#end

// A bowl: a ball, hollowed and pierced. All of it CSG, one object of the scene.
#macro Bowl(Centre, Radius, Core)
    difference {
        sphere { 0, 1 }
        sphere { 0, 0.9 }
        box { <-1.1, 0.35, -1.1>, <1.1, 1.1, 1.1> }
        #local I = 0;
        #while (I < 5)
            cylinder { -1.2 * x, 1.2 * x, 0.2 rotate 36 * I * y }
            #local I = I + 1;
        #end
        scale Radius
        rotate 36 * rand(Random) * y
        translate Centre
        pigment { rgb 0.35 * Core + 0.55 }
        finish { ambient 0 diffuse 0.6 specular 0.7 roughness 0.008 reflection 0.12 }
    }
#end

// A lens: what two balls share, standing on its edge.
#macro Lens(Centre, Radius, Rim)
    intersection {
        sphere { -0.7 * x, 1 }
        sphere { 0.7 * x, 1 }
        scale Radius
        rotate <0, 360 * rand(Random), 20 * rand(Random) - 10>
        translate Centre
        pigment { rgb 0.5 * Rim + 0.4 }
        finish { ambient 0 diffuse 0.7 specular 0.8 roughness 0.005 }
    }
#end

// A garden: a bowl within a dome, a ring of lenses, and seeds that fell around it.
#macro Garden(Centre, Radius, Core, Rim)
    Dome(Centre, Radius, 320, Core, Rim)
    Bowl(Centre + 1.75 * Radius * y, 0.62 * Radius, Core)
    #local I = 0;
    #while (I < 24)
        #local Turn = 2 * pi * I / 24;
        Lens(Centre + Radius * <1.45 * cos(Turn), 0.16, 1.45 * sin(Turn)>, 0.19 * Radius, Rim)
        #local I = I + 1;
    #end
    #local I = 0;
    #while (I < 130)
        #local Turn = 2 * pi * rand(Random);
        #local Far = Radius * (1.65 + 0.8 * pow(rand(Random), 2));
        #local Size = Radius * 0.045 * (0.4 + rand(Random));
        sphere {
            Centre + <Far * cos(Turn), Size, Far * sin(Turn)>, Size
            Petal(Rim, Core, rand(Random))
        }
        #local I = I + 1;
    #end
#end

#declare Cores = array[5] {
    <0.95, 0.72, 0.15>, <0.95, 0.38, 0.16>, <0.90, 0.86, 0.72>, <0.75, 0.18, 0.22>, <0.30, 0.72, 0.66>
}
#declare Rims = array[5] {
    <0.80, 0.16, 0.20>, <0.42, 0.10, 0.36>, <0.16, 0.42, 0.70>, <0.95, 0.62, 0.34>, <0.08, 0.22, 0.46>
}

// Sunflower places again, so that no two gardens touch; each is moved and scaled at random.
#declare G = 0;
#while (G < Gardens)
    #declare Away = 8.6 * Spread * sqrt(G + 0.3);
    #declare Place = Away * <cos(G * Golden), 0, sin(G * Golden)>;
    #declare Place = Place + 3.4 * Spread * <rand(Random) - 0.5, 0, rand(Random) - 0.5>;
    #declare Radius = 0.9 + 1.9 * pow(rand(Random), 2);
    #declare Tint = int(5 * rand(Random));
    Garden(Place, Radius, Cores[Tint], Rims[Tint])
    #declare G = G + 1;
#end
