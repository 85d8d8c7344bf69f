// SPDX-License-Identifier: Apache-2.0
// Where stock POV-Ray's trace() finds the rays of accel's camera to hit a scene of triangles.
//
// Every triangle becomes a smooth_triangle with one and the same normal at its three corners:
// POV-Ray intersects it as a plain triangle, in double, and the normal that trace() returns names
// the triangle. The normal is 1 along the axis that the triangle faces most and NUMBER / (4 Total)
// along the next one: POV-Ray drops a smooth_triangle whose normals stand across it. Triangles
// without area, which POV-Ray refuses and no ray hits, are left out.
// One union holds them all; POV-Ray tests each of its parts for every ray.
//
// Declare=Total=N   triangles in the scene
// Declare=Scene=S   0: cubes.inc with Declare=Gap=X; 1: triangles.inc, as accel export --as triangles
// Declare=Eye_X=X and so on, At_X, Fov, Columns, Rows: the camera of accel trace, whose formula
//                   stands in accel/cli/scenes/camera.h and below, in the same order in double
// Traces a ray for each pixel, and from each of their hits one more in a direction of its own.
// Writes rays.txt, "ORIGIN DIRECTION TMIN TMAX" for accel trace --rays, and hits.txt, on the same
// line the point and the number of the triangle, in 20 digits, or "miss".
#version 3.7;
global_settings { assumed_gamma 1 }

#declare Number = 0;

#macro Coded(A, B, C)
    #local Facing = vcross(B - A, C - A);
    #local Part = Number / (4 * Total);
    #local Code = <1, Part, 0>;
    #if (abs(Facing.y) > max(abs(Facing.x), abs(Facing.z))) #local Code = <0, 1, Part>; #end
    #if (abs(Facing.z) > max(abs(Facing.x), abs(Facing.y))) #local Code = <Part, 0, 1>; #end
    #if (vlength(Facing) > 0) smooth_triangle { A, Code, B, Code, C, Code } #end
    #declare Number = Number + 1;
#end

#macro Decoded(N)
    #local Part = N.y / N.x;
    #if (N.y > max(N.x, N.z)) #local Part = N.z / N.y; #end
    #if (N.z > max(N.x, N.y)) #local Part = N.x / N.z; #end
    (Part * 4 * Total)
#end

#if (Scene = 0)
    #include "cubes.inc"
    #macro Cube(C, At)
        #local T = 0;
        #while (T < 12)
            Coded(At + Cube_Corners[Cube_Faces[T].x], At + Cube_Corners[Cube_Faces[T].y],
                  At + Cube_Corners[Cube_Faces[T].z])
            #local T = T + 1;
        #end
    #end
    #declare All = union { Cubes(Gap, 1) }
#else
    #include "triangles.inc"
    #declare All = union {
        #declare T = 0;
        #while (T < dimension_size(Corners, 1))
            Coded(Corners[T][0], Corners[T][1], Corners[T][2])
            #declare T = T + 1;
        #end
    }
#end

#if (Number != Total)
    #error concat("the scene has ", str(Number, 0, 0), " triangles instead of ", str(Total, 0, 0))
#end

#declare Eye = <Eye_X, Eye_Y, Eye_Z>;
#declare W = <At_X, At_Y, At_Z> - Eye;
#declare W = W / sqrt(W.x * W.x + W.y * W.y + W.z * W.z);
#declare R = <-W.z, 0, W.x>;
#declare R = R / sqrt(R.x * R.x + R.y * R.y + R.z * R.z);
#declare U = <R.y * W.z - R.z * W.y, R.z * W.x - R.x * W.z, R.x * W.y - R.y * W.x>;
#declare H = tan(Fov * pi / 360);

// What POV-Ray takes for a hit: MIN_ISECT_DEPTH to MAX_DISTANCE, in lengths of the direction here.
#macro Trace_Ray(Start, Along)
    #local From = Start;
    #declare Normal = <0, 0, 0>;
    #declare Point = trace(All, From, Along, Normal);
    #write (Rays, vstr(3, From, " ", 0, 20), " ", vstr(3, Along, " ", 0, 20), " ",
            str(1e-4 / vlength(Along), 0, 20), " ", str(1e7 / vlength(Along), 0, 20), "\n")
    #if (vlength(Normal) = 0)
        #write (Hits, "miss\n")
    #else
        #write (Hits, vstr(3, Point, " ", 0, 20), " ", str(Decoded(Normal), 0, 20), "\n")
    #end
#end

#declare Random = seed(1);
#fopen Rays "rays.txt" write
#fopen Hits "hits.txt" write
#declare J = 0;
#while (J < Rows)
    #declare Y = (1 - 2 * (J + 0.5) / Rows) * (H * Rows / Columns);
    #declare I = 0;
    #while (I < Columns)
        #declare X = (2 * (I + 0.5) / Columns - 1) * H;
        Trace_Ray(Eye, (W + X * R) + Y * U)
        #if (vlength(Normal) > 0)
            Trace_Ray(Point, <rand(Random), rand(Random), rand(Random)> - 0.5)
        #end
        #declare I = I + 1;
    #end
    #declare J = J + 1;
#end
#fclose Hits
#fclose Rays
