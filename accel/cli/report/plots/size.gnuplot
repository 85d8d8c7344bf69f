# SPDX-License-Identifier: Apache-2.0
# Work against size, from 10^3 to 10^7 triangles.

csv = 'size.csv'
array titles[6] = ["nodes visited per ray", "triangles tested per ray", "ns per ray", \
    "build, ns per triangle", "build and 10⁶ rays, seconds", "bytes per triangle"]
figure(p) = p == 1 ? column('nodes') : p == 2 ? column('tests') : p == 3 ? column('ns_per_ray') : \
    p == 4 ? 1e9 * column('build_seconds') / column('primitives') : \
    p == 5 ? column('seconds_with_build') : column('bytes_per_primitive')
here(c) = c ? column('primitives') : NaN

eval canvas(960, 640)
eval panels
set logscale xy
set xrange [4e2:2e7]
set format xy '10^{%T}'
set size 0.25,0.3
do for [p = 1:6] {
    set origin 0.06 + 0.32 * ((p - 1) % 3), p <= 3 ? 0.64 : 0.23
    set xlabel p <= 3 ? '' : 'triangles' offset 0,0.5
    set title titles[p] offset 0,-0.5
    # Embree tells no nodes
    plot for [m = 1:p > 2 ? 2 : 0] csv using (here(ends(strcol('contender'), mode(m)))):(figure(p)) \
            with linespoints lc rgb '#882255' pt m, \
        for [f in forms] csv using (here(strcol('contender') eq f)):(figure(p)) \
            with linespoints lc rgb colour(f) pt shape(f)
}
eval key_panel(0.05, 0.13)
plot for [m = 1:2] NaN with linespoints lc rgb '#882255' pt m title mode_title(m), \
    for [f in forms] NaN with linespoints lc rgb colour(f) pt shape(f) title f
unset multiplot
