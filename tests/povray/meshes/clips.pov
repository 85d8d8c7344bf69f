// SPDX-License-Identifier: Apache-2.0
// Meshes that clip, bound and hold others; light projected through one; containers of the camera.
#include "head.inc"
#include "ball.inc"
camera { location <0, 2, -7> look_at <0, 0, 0> angle 50 }
light_source { <-6, 9, -8> rgb 1 }
#declare Body = Ball("flat2", 20, <0.3, 1, 0.1>) }
#declare Sheet = Ball("smooth2", 18, 0) }
object { Sheet texture { Matter[1] } clipped_by { object { Body scale 0.7 translate <0.5, 0.5, -0.6> } } translate -1.6 * x }
object { Sheet texture { Matter[2] } clipped_by { object { Body inverse scale 0.7 translate <0.5, 0.5, -0.6> } } translate 1.6 * x }
sphere { 0, 1 texture { Matter[3] } bounded_by { object { Body scale <0.7, 1.2, 1.2> } } clipped_by { object { Body scale <0.9, 1, 0.9> } } translate 1.5 * y }
#declare Window = object { Sheet scale 0.6 translate <-4, 5, -5> }
light_source { <-6, 7.2, -7> rgb 2 projected_through { Window } }
plane { y, -1.3 texture { Matter[4] } }
object { Body texture { pigment { rgbt <1, 1, 1, 0.9> } } interior { media { emission 0.02 } } hollow scale 20 }
// what the parser finds
#declare N = <0, 0, 0>;
#declare I = 0;
#while (I < 200)
    #declare P = <1.4 * sin(I), 1.4 * cos(2 * I), -1.4 * cos(I)>;
    #declare Hit = trace(Body, P, -P, N);
    #if (inside(Body, P * 0.75)) #declare K = 1; #else #declare K = 3; #end
    sphere { Hit * 0.3 + <0, -0.6, -3>, 0.01 + 0.02 * abs(N.x) texture { Matter[K] } }
    #declare I = I + 1;
#end
