# SPDX-License-Identifier: Apache-2.0
# Build, photons and estimate of the largest run, one on the other. Given: forms, the structures.

csv = 'light.csv'
scenes = "plates teapots"
array titles[2] = ["lit square over a black floor", "nine teapots and a floor"]
array layers[3] = ["estimate", "photons", "build"]
shade(i) = word("#E69F00 #0072B2 #444444", i)
upto(i) = column('build_seconds') + (i < 3 ? column('photon_seconds') : 0) + (i < 2 ? column('estimate_seconds') : 0)

array smallest[2]
array most[2]
do for [s = 1:2] {
    stats csv using (strcol('scene') eq word(scenes, s) ? column('radius') : NaN) name 'S' nooutput
    smallest[s] = S_min
    stats csv using (strcol('scene') eq word(scenes, s) ? column('photons') : NaN) name 'S' nooutput
    most[s] = S_max
}
at(f) = sum [i = 1:words(forms)] (word(forms, i) eq f ? i : 0)
is(s) = strcol('scene') eq word(scenes, s) && strcol('estimator') eq 'paths' && column('photons') == most[s] && \
    int(floor(log(column('radius') / smallest[s]) / log(4) + 0.5)) == 1

eval canvas(900, 360)
eval panels
set style fill solid 1.0 noborder
set boxwidth 0.7
set size 0.4,0.66
set xrange [0.3:words(forms) + 0.7]
set yrange [0:*]
set xtics ('' 1)
set for [i = 1:words(forms)] xtics add (word(forms, i) i)
set grid noxtics
do for [s = 1:2] {
    set origin 0.08 + 0.48 * (s - 1), 0.2
    set title sprintf('%s, %.0e photons', titles[s], most[s])
    set ylabel s == 1 ? 'seconds' : '' offset 1,0
    plot for [i = 1:3] csv using (is(s) ? at(strcol('structure')) : NaN):(upto(i)) with boxes lc rgb shade(i)
}
eval key_panel(0.05, 0.12)
set key font ',12'
plot for [i = 1:3] NaN with boxes lc rgb shade(i) title layers[i]
unset multiplot
