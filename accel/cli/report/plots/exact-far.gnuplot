# SPDX-License-Identifier: Apache-2.0
# The share of wrong answers over the distance to the origin. Given: ours, what to say of our kinds.

csv = 'exact.csv'
far(s) = s[1:6] eq 'shift-' ? 10**real(s[9:]) : NaN
at(c) = c ? far(strcol('scene')) : NaN
is(m, input) = ends(strcol('contender'), mode(m)) && strcol('input') eq input

eval canvas(760, 380)
set logscale xy
set xrange [3e2:1e19]
set yrange [5e-6:2]
set format xy '10^{%T}'
set xtics 1e3,1e3,1e15
unset mxtics
unset mytics
set xlabel 'distance of the scene from the origin, in sizes of the scene'
set ylabel 'share of wrong answers'
set label 1 "Embree, judged by\nthe scene as given" at 2e15,0.8 tc rgb '#882255'
set label 2 "Embree, judged by\nthe scene rounded" at 2e15,2.5e-2 tc rgb '#b56a93'
set label 3 ours at 2e15,3e-4 tc rgb colour('hoo')
plot csv using (at(column('wrong') == 0)):(0.5 * column('shown')) with points pt 11 ps 0.6 lc rgb faint, \
    for [m = 1:2] csv using (at(is(m, 'given'))):'shown' with linespoints lc rgb '#882255' pt m lw 2, \
    for [m = 1:2] csv using (at(is(m, 'rounded'))):'shown' with points lc rgb '#d59fbd' pt m lw 2, \
    csv using (at(strcol('contender') eq 'hoo')):'shown' with points ps 1 lc rgb colour('hoo') pt shape('hoo')
