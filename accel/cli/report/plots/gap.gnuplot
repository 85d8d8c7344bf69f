# SPDX-License-Identifier: Apache-2.0
# Work against the gap between two clusters.

csv = 'gap.csv'
array titles[3] = ["nodes visited per ray", "triangles tested per ray", "ns per ray"]
figure(p) = word("nodes tests ns_per_ray", p)
# a gap of 0 has no logarithm: it stands at 1/4
here(c) = c ? (column('gap') > 0 ? column('gap') : 0.25) : NaN

eval canvas(960, 400)
eval panels
set logscale xy
set format y '10^{%T}'
set xrange [0.18:400]
set xtics ('0' 0.25, '1' 1, '4' 4, '16' 16, '64' 64, '256' 256)
set size 0.25,0.46
do for [p = 1:3] {
    set origin 0.06 + 0.32 * (p - 1), 0.42
    set xlabel 'gap, cluster sides' offset 0,0.3
    set title titles[p] offset 0,-0.5
    # Embree tells no nodes
    plot for [m = 1:p > 2 ? 2 : 0] csv using (here(ends(strcol('contender'), mode(m)))):figure(p) \
            with linespoints lc rgb '#882255' pt m, \
        for [f in forms] csv using (here(strcol('contender') eq f)):figure(p) \
            with linespoints lc rgb colour(f) pt shape(f)
}
eval key_panel(0.05, 0.2)
plot for [m = 1:2] NaN with linespoints lc rgb '#882255' pt m title mode_title(m), \
    for [f in forms] NaN with linespoints lc rgb colour(f) pt shape(f) title f
unset multiplot
