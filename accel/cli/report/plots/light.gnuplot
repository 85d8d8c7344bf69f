# SPDX-License-Identifier: Apache-2.0
# Seconds against RMSE, above, and bias, below. Given: forms, the structures; one, of them; by_structure: a curve
# for each at the middle radius, or for each radius through that one.

csv = 'light.csv'
scenes = "plates teapots"
array titles[2] = ["lit square over a black floor", "nine teapots and a floor"]
array labels[2] = ["RMSE / mean irradiance", "bias / mean irradiance"]
array radii[4] = ["discs, small radius", "discs, middle radius (4 times)", "discs, large radius (16 times)", \
    "100 nearest photons in the middle radius"]

count = by_structure ? words(forms) : 4
estimator(i) = by_structure ? 'paths' : word("paths paths paths nearest", i)
step(i) = by_structure ? 1 : int(word("0 1 2 1", i))
structure(i) = by_structure ? word(forms, i) : one
shade(i) = by_structure ? colour(word(forms, i)) : word("#56B4E9 #0072B2 #000000 #E69F00", i)
mark(i) = by_structure ? shape(word(forms, i)) : int(word("9 7 5 13", i))
name(i) = by_structure ? word(forms, i) : radii[i]

array smallest[2]
array wrong[2]
do for [s = 1:2] {
    stats csv using (strcol('scene') eq word(scenes, s) ? column('radius') : NaN) name 'S' nooutput
    smallest[s] = S_min
    stats csv using (strcol('scene') eq word(scenes, s) ? column('floor') : NaN) name 'S' nooutput
    wrong[s] = S_max > 0 ? S_max : NaN
}

inside(s) = strcol('scene') eq word(scenes, s)
# the radius, by its value relative to the smallest, which is a power of 4
radius(s) = int(floor(log(column('radius') / smallest[s]) / log(4) + 0.5))
is(s, i) = inside(s) && strcol('estimator') eq estimator(i) && radius(s) == step(i) && strcol('structure') eq structure(i)
hidden(d) = column('bias') < column('bias_seen')
# bias that noise hides stands at the noise
figure(row) = row == 1 ? column('rmse') : hidden(0) ? column('bias_seen') : column('bias')
# arrows down, where it does
drawn(s) = by_structure ? strcol('estimator') eq 'paths' && radius(s) == 1 : strcol('structure') eq one
arrow(s, row) = row == 2 && inside(s) && hidden(0) && drawn(s) ? column('seconds') : NaN

eval canvas(900, 700)
eval panels
set logscale xy
set size 0.41,0.32
set yrange [1e-3:6]
set xrange [4e-3:2e2]
do for [row = 1:2] {
    do for [s = 1:2] {
        set origin 0.08 + 0.48 * (s - 1), row == 1 ? 0.61 : 0.24
        set title row == 1 ? titles[s] : '' offset 0,-0.5
        set ylabel s == 1 ? labels[row] : '' offset 1,0
        set xlabel row == 2 ? 'seconds: build, photons and estimate' : '' offset 0,0.5
        set format x row == 2 ? '10^{%T}' : ''
        set format y s == 1 ? '10^{%T}' : ''
        # guides: the error of the reference, the slope of noise
        plot wrong[s] with lines lc rgb faint dt 2, \
            row == 1 ? 0.03 / sqrt(x) : NaN with lines lc rgb faint dt 3, \
            csv using (arrow(s, row)):'bias_seen':(0):(-0.4 * column('bias_seen')) \
                with vectors filled size graph 0.01,25 lc rgb faint, \
            for [i = 1:count] csv using (is(s, i) ? column('seconds') : NaN):(figure(row)) \
                with linespoints lw 1.3 lc rgb shade(i) pt mark(i)
    }
}
eval key_panel(0.05, 0.12)
set key font ',12'
plot for [i = 1:count] NaN with linespoints lw 1.3 lc rgb shade(i) pt mark(i) title name(i), \
    NaN with lines lc rgb faint dt 2 title 'error of the reference', NaN with lines lc rgb faint dt 3 title 'slope of noise'
unset multiplot
