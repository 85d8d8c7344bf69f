# SPDX-License-Identifier: Apache-2.0
# What all plots share. Columns of the figures are called by their names.
# Before it is given: forms, what is drawn: kinds and their forms, separated by blanks.
#
# Colours: Okabe and Ito's, which the colour-blind tell apart; each kind has a shape of its own too, full
# for the kind as it comes, hollow for another form of it.

canvas(w, h) = sprintf("set terminal svg size %d,%d dynamic enhanced " . \
    "font 'Helvetica,Arial,sans-serif,13' background rgb 'white'", w, h)
set encoding utf8
set datafile separator ','
set datafile missing NaN
set datafile columnheaders
set border 3 lc rgb '#555555'
set tics nomirror out scale 0.6 textcolor rgb '#333333'
set grid lc rgb '#dddddd' lt 1 lw 0.6
set key noautotitle textcolor rgb '#222222'
set pointsize 0.75
set samples 2
none = '#888888'
faint = '#999999'

kind(f) = strstrt(f, ':') ? f[1:strstrt(f, ':') - 1] : f
colour(f) = kind(f) eq 'linear' ? '#777777' : kind(f) eq 'grid' ? '#E69F00' : kind(f) eq 'hug' ? '#D55E00' : \
    kind(f) eq 'octree' ? '#56B4E9' : kind(f) eq 'hoo' ? '#0072B2' : kind(f) eq 'bsp' ? '#009E73' : \
    kind(f) eq 'bvh' ? '#CC79A7' : kind(f) eq 'auto' ? '#000000' : '#AA4499'
full(f) = kind(f) eq 'linear' ? 1 : kind(f) eq 'grid' ? 5 : kind(f) eq 'hug' ? 13 : kind(f) eq 'octree' ? 9 : \
    kind(f) eq 'hoo' ? 7 : kind(f) eq 'bsp' ? 11 : kind(f) eq 'bvh' ? 15 : kind(f) eq 'auto' ? 3 : 2
shape(f) = full(f) > 3 && strstrt(f, ':') ? full(f) - 1 : full(f)

# Embree's modes: its name in the figures ends with one of them.
mode(i) = i == 1 ? ' medium' : ' medium robust'
mode_title(i) = i == 1 ? 'Embree fast' : 'Embree robust'
ends(s, t) = strlen(s) >= strlen(t) && s[strlen(s) - strlen(t) + 1:] eq t

# Panels of a plot: they touch nothing, and an empty one at the bottom is the key.
panels = "set multiplot; unset mxtics; unset mytics; set tmargin 0; set bmargin 0; set lmargin 0; set rmargin 0"
key_panel(x, h) = sprintf("unset title; unset xlabel; unset ylabel; unset border; unset tics; unset grid; " . \
    "unset logscale; set xrange [0:1]; set yrange [0:1]; set origin %g,0; set size %g,%g; " . \
    "set key horizontal Left reverse center center samplen 2", x, 1 - 2 * x, h)
