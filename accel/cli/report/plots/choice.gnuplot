# SPDX-License-Identifier: Apache-2.0
# Options against time per ray, in two scenes, and against the share of wrong answers.
# Given, each an array of a text for each panel: titles; values, separated by blanks; curves, the same of its kinds.

csv = 'choice.csv'
scenes = "teapots cubes:gap=4"
array rows[3] = ["ns per ray\nnine teapots", "ns per ray\ntwo clusters of cubes", "share\nwrong"]
here(s, p, c) = strcol('scene') eq word(scenes, s) && strcol('panel') eq titles[p] && c ? column('position') : NaN
is(s, p, k, auto) = here(s, p, strcol('kind') eq k && (column('position') == 0) == auto)

array chosen[2]
do for [s = 1:2] {
    stats csv using (strcol('scene') eq word(scenes, s) && strcol('kind') eq 'auto' ? column('ns_per_ray') : NaN) \
        name 'S' nooutput
    chosen[s] = S_max
}

eval canvas(980, 780)
eval panels
set logscale y
do for [row = 1:3] {
    errors = row == 3
    scene = errors ? 1 : row
    do for [p = 1:4] {
        n = words(values[p])
        set origin 0.095 + 0.232 * (p - 1), row == 1 ? 0.68 : row == 2 ? 0.39 : 0.19
        set size 0.2, errors ? 0.1 : 0.23
        set xtics ('auto' 0) rotate by -45
        set for [i = 1:n] xtics add (word(values[p], i) i)
        set xrange [-0.5:n + 0.5]
        set title row == 1 ? titles[p] : '' offset 0,-0.5
        set ylabel p == 1 ? rows[row] : '' offset -1,0
        set xlabel errors ? titles[p] : '' offset 0,0.4
        set format y p == 1 ? '10^{%T}' : ''
        set format x errors ? "%g" : ''
        if (errors) {
            set yrange [1e-7:1]
            set ytics 1e3
            figure = 'shown'
        } else {
            set yrange [*:3e4]
            set ytics autofreq
            figure = 'ns_per_ray'
        }
        # above: what auto takes; below: an arrow down where none is wrong
        plot [-0.5:n + 0.5] errors ? NaN : chosen[scene] with lines lc rgb '#000000' dt 2, \
            csv using (errors ? here(1, p, column('wrong') == 0) : NaN):'shown':(0):(-0.9 * column('shown')) \
                with vectors filled size graph 0.02,25 lc rgb faint, \
            for [k in curves[p]] csv using (is(scene, p, k, 0)):figure \
                with linespoints lw 1.3 lc rgb colour(k) pt shape(k), \
            for [k in curves[p]] csv using (is(scene, p, k, 1)):figure \
                with points ps 1.3 lc rgb colour(k) pt shape(k)
    }
}
eval key_panel(0.05, 0.08)
plot for [k in "octree hoo bsp bvh grid hug"] NaN with linespoints lw 1.3 lc rgb colour(k) pt shape(k) title k, \
    NaN with lines lc rgb '#000000' dt 2 title 'kind auto'
unset multiplot
