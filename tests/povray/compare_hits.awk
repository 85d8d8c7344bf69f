# SPDX-License-Identifier: Apache-2.0
# Compares hits of stock POV-Ray's trace() with those of accel trace, ray by ray.
#
#     awk -v name=NAME -f compare_hits.awk FIRST ALL
#
# FIRST: lines "GEOMETRY NUMBER", the number of each geometry's first triangle in POV-Ray's file.
# ALL: lines "OX OY OZ DX DY DZ TMIN TMAX | X Y Z NUMBER | GEOMETRY PRIM T U V", where "miss" stands
# for the second or the third part of a ray that hits nothing.
#
# A ray agrees if both miss, or if both hit the same triangle at distances that differ by less than
# 1e-9 of them. A hit of another triangle is counted apart, as on an edge, if the distances agree as
# before and accel's hit lies on the border of its triangle (a weight below 1e-9), so that both
# triangles hold the point. Everything else is a difference; the first ten are printed. Ends with 1
# where there is one, or where no ray hit anything.

function distance(x, y, z) { return sqrt(x * x + y * y + z * z) }

function differ(why)
{
    if (++different <= 10) print "  difference, " why ": " line
}

# p: the hit of POV-Ray, a: of accel, ray: origin and direction.
function compare_hits(    t, off, number, weight)
{
    t = distance(p[1] - ray[1], p[2] - ray[2], p[3] - ray[3]) / distance(ray[4], ray[5], ray[6])
    off = t > a[3] ? (t - a[3]) / a[3] : (a[3] - t) / a[3]
    if (!(off < 1e-9)) { differ("relative difference of distances " off); return }
    if (off > worst) worst = off
    number = first[a[1]] + a[2]
    if (p[4] > number - 0.01 && p[4] < number + 0.01) { same++; return }
    weight = 1 - a[4] - a[5]
    if (a[4] + 0 < weight) weight = a[4]
    if (a[5] + 0 < weight) weight = a[5]
    if (weight < 1e-9) edge++
    else differ("another triangle")
}

FILENAME == ARGV[1] { first[$1] = $2; next }

{
    rays++
    line = $0
    split($0, part, " \\| *")
    split(part[1], ray, " ")
    in_pov = split(part[2], p, " ")
    in_accel = split(part[3], a, " ")
    if (p[1] == "miss" && a[1] == "miss") missed++
    else if (p[1] == "miss" || a[1] == "miss") differ("one of both misses")
    else if (in_pov != 4 || in_accel != 5) differ("not understood")
    else compare_hits()
}

END {
    printf "%s: %d rays: %d hit the same triangle, %d miss in both, %d on an edge, %d differ; ", name,
        rays, same, missed, edge, different
    printf "largest relative difference of distances %.2g\n", worst
    exit different > 0 || same == 0
}
