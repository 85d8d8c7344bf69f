// red: 1092
// unbounded: 0
// Every type of object that is bounded by itself, turned: none is without a box.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -10> direction z right 16*x up 12*y }
#declare Glow = finish { emission 1 ambient 0 diffuse 0 }
#declare Red = texture { pigment { rgb <1, 0, 0> } finish { Glow } }
#declare Place = 0;
#macro Put(Thing)
  object { Thing texture { Red } rotate <20, 30, 40> + Place * <7, 11, 13> translate <-7 + 2 * mod(Place, 8), -4.6 + 2.3 * floor(Place / 8), 0> }
  #declare Place = Place + 1;
#end
Put(sphere { 0.2, 0.7 })
Put(sphere { 0, 1 scale <0.9, 0.4, 0.7> })
Put(box { -0.6, 0.5 })
Put(cone { -0.8*y, 0.7, 0.8*y, 0.2 })
Put(cone { -0.8*y, 0.7, 0.8*y, 0 open })
Put(cylinder { -0.8*x, 0.8*x, 0.3 })
Put(torus { 0.7, 0.2 })
Put(torus { 0.3, 0.5 })
Put(superellipsoid { <0.3, 1.5> scale 0.7 })
Put(prism { linear_sweep cubic_spline -0.5, 0.5, 7, <0.8, 0>, <0.4, 0.6>, <-0.6, 0.4>, <-0.4, -0.7>, <0.8, 0>, <0.4, 0.6>, <-0.6, 0.4> })
Put(prism { conic_sweep linear_spline 0.3, 1, 5, <0.7, 0>, <0, 0.7>, <-0.7, 0>, <0, -0.7>, <0.7, 0> translate -0.6*y })
Put(lathe { bezier_spline 4, <0.1, -0.9>, <1.2, -0.4>, <0, 0.4>, <0.6, 0.9> })
Put(lathe { quadratic_spline 5, <0.1, -0.9>, <0.5, -0.7>, <0.8, 0>, <0.2, 0.4>, <0.6, 0.9> })
Put(sor { 6, <0, -1>, <0.3, -0.8>, <0.7, -0.2>, <0.3, 0.3>, <0.5, 0.8>, <0.1, 1> })
Put(sphere_sweep { linear_spline 3, <-0.7, -0.3, 0>, 0.2, <0, 0.5, 0.2>, 0.3, <0.7, -0.4, 0>, 0.1 })
Put(sphere_sweep { b_spline 5, <-0.9, -0.3, 0>, 0.2, <-0.5, 0.9, 0.2>, 0.3, <0, -0.9, 0>, 0.2, <0.5, 0.9, -0.3>, 0.3, <0.9, 0, 0>, 0.1 })
Put(sphere_sweep { cubic_spline 5, <-0.9, -0.3, 0>, 0.2, <-0.5, 0.6, 0.2>, 0.3, <0, -0.6, 0>, 0.2, <0.5, 0.6, -0.3>, 0.3, <0.9, 0, 0>, 0.1 })
Put(text { ttf "timrom.ttf" "g" 0.3, 0 scale 1.4 translate -0.4 })
Put(polygon { 6, <-0.7, -0.7>, <0.7, -0.7>, <0.2, 0>, <0.7, 0.7>, <-0.7, 0.5>, <-0.7, -0.7> })
Put(triangle { -0.8*x, 0.8*x, 0.9*y })
Put(smooth_triangle { -0.8*x, <-1, 0, -1>, 0.8*x, <1, 0, -1>, 0.9*y, <0, 1, -1> })
Put(disc { 0, z, 0.8, 0.3 })
Put(blob { threshold 0.4 sphere { -0.3*x, 0.8, 1 } cylinder { 0, 0.7*y, 0.5, 1 } sphere { 0.3, 0.5, -0.6 scale <1, 2, 1> } rotate 10 })
Put(bicubic_patch { type 0 flatness 0.01 u_steps 3 v_steps 3
  <-0.8, -0.8, 0>, <-0.3, -0.8, -1>, <0.3, -0.8, 1>, <0.8, -0.8, 0>, <-0.8, -0.3, 0>, <-0.3, -0.3, -1>, <0.3, -0.3, 1>, <0.8, -0.3, 0>,
  <-0.8, 0.3, 0>, <-0.3, 0.3, -1>, <0.3, 0.3, 1>, <0.8, 0.3, 0>, <-0.8, 0.8, 0>, <-0.3, 0.8, -1>, <0.3, 0.8, 1>, <0.8, 0.8, 0> })
Put(mesh { triangle { -0.8*x, 0.8*x, 0.9*y } triangle { -0.8*x, 0.8*x, 0.9*z } })
Put(height_field { function 9, 9 { 0.5 + 0.4 * sin(x * 9) * cos(y * 7) } translate <-0.5, 0, -0.5> scale <1.4, 0.8, 1.4> })
Put(julia_fractal { <-0.083, 0, -0.83, -0.025> quaternion sqr max_iteration 6 precision 30 scale 0.6 })
Put(isosurface { function { x * x + y * y * 2 + z * z - 0.3 } contained_by { box { -0.7, 0.7 } } max_gradient 4 })
Put(isosurface { function { abs(x) - 0.2 } contained_by { sphere { 0, 0.8 } } max_gradient 2 })
Put(parametric { function { 0.7 * sin(u) * cos(v) }, function { 0.7 * sin(u) * sin(v) }, function { 0.7 * cos(u) } <0, 0>, <pi, 2 * pi> contained_by { box { -0.75, 0.75 } } max_gradient 2 accuracy 0.005 })
Put(ovus { 0.6, 0.4 })
Put(quadric { <1, 2, 3>, <0.3, 0.2, -0.1>, <0.1, 0, 0>, -0.4 })
Put(intersection { sphere { 0, 0.8 } quartic { <1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, -0.2> } })
Put(light_source { 0 rgb 0 looks_like { sphere { 0, 0.6 texture { Red } } } })
Put(merge { sphere { 0, 0.5 } box { -0.4, 0.6 } })
Put(difference { box { -0.6, 0.6 } merge { sphere { -0.6*z, 0.5 } cylinder { -z, z, 0.2 } } })
Put(union { sphere { -0.4*x, 0.5 } sphere { 0.4*x, 0.5 } clipped_by { plane { y, 0.2 } } })
box { <-9, -7, 3>, <9, 7, 4> pigment { rgb <0, 0, 1> } finish { Glow } }
