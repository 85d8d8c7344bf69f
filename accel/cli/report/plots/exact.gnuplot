# SPDX-License-Identifier: Apache-2.0
# Time against the share of wrong answers, a panel for each scene.
# Given: over, a column; label, what it is; lo and hi, its range.

csv = 'exact.csv'
scenes = "random-rays shards shift-1e3 shift-1e6 scale-1e-12 slivers sizes leaks leaks-1e5"
array titles[9] = ["1,000 triangles, random rays", "the same, rays at vertices and edges too", \
    "10³ off the origin", "10⁶ off the origin", "tiny: all sizes times 10⁻¹²", "slivers, aspect 10⁻³ to 10⁻¹⁴", \
    "edges from 10⁻¹² to 1", "closed mesh, at vertices and edges", "the same, 10⁵ off the origin"]

# Dark: Embree judged by the scene as given, light: as rounded.
input(i) = i == 1 ? 'given' : 'rounded'
pale(i) = i == 1 ? '#882255' : '#d59fbd'

eval canvas(960, 880)
eval panels
set logscale xy
set xrange [lo:hi]
set yrange [5e-6:2]
set ytics 100
set size 0.27,0.2
do for [p = 1:words(scenes)] {
    col = (p - 1) % 3
    row = (p - 1) / 3
    set origin 0.085 + 0.31 * col, 0.76 - 0.25 * row
    set title titles[p] offset 0,-0.5
    set xlabel row == 2 ? label : '' offset 0,0.5
    set ylabel col == 0 ? 'share of wrong answers' : '' offset 1,0
    set format x row == 2 ? '10^{%T}' : ''
    set format y col == 0 ? '10^{%T}' : ''
    here(c) = strcol('scene') eq word(scenes, p) && c ? column(over) : NaN
    # a small triangle below where none is wrong
    plot csv using (here(column('wrong') == 0)):(0.45 * column('shown')) with points pt 11 ps 0.45 lc rgb faint, \
        for [i = 1:2] for [m = 1:2] csv using (here(ends(strcol('contender'), mode(m)) && \
            strcol('input') eq input(i))):'shown' with points lc rgb pale(i) pt m lw 2, \
        for [f in forms] csv using (here(strcol('contender') eq f)):'shown' with points lc rgb colour(f) pt shape(f)
}
eval key_panel(0.02, 0.14)
set key samplen 1 maxcols 4 font ',12'
plot for [i = 1:2] for [m = 1:2] NaN with points lc rgb pale(i) pt m lw 2 \
        title mode_title(m).(i == 2 ? ', rounded input' : ''), \
    for [f in forms] NaN with points lc rgb colour(f) pt shape(f) title f, \
    NaN with points lc rgb faint pt 11 ps 0.5 title 'none wrong: at 1/N'
unset multiplot
