# SPDX-License-Identifier: Apache-2.0
# Fits what kinds cost (accel/src/core/cost.h) to figures of `accel bench --csv`. For costs.sh.
#
# For each kind  ns = slow (ray + node nodes + test tests)  by least squares of relative errors, no cost below 0.
# slow: of a scene and a kind of rays, the same for all kinds, whose turns are interleaved: what else the machine
# did, and how much the scene strains its caches; 1 in the mean.
# build = seconds / (n log2(n + 2)), the lower quartile over the scenes: what else the machine does only adds to it.
# Given by -v: seen (the file of cost.h, for what is not fitted: how nodes grow).

function quoted(line, at,   i, c, out, inside, column) {
    # the field number `at` of a line of CSV
    column = 1
    for (i = 1; i <= length(line); i++) {
        c = substr(line, i, 1)
        if (c == "\"") inside = !inside
        else if (c == "," && !inside) column++
        else if (column == at) out = out c
    }
    return out
}

function field(name) { return quoted($0, place[name]) }

/^#/ { next }
/^scene,/ {
    count = split($0, names, ",")
    for (i = 1; i <= count; i++) place[names[i]] = i
    next
}
{
    kind = field("contender"); scene = field("scene"); n = field("primitives")
    rows++
    of[rows] = kind; t[rows] = field("ns_median"); on[rows] = scene " " field("rays")
    nodes[rows] = field("nodes"); tests[rows] = field("tests")
    flat[rows] = n > 0 ? field("triangles") / n : 1
    if (!(kind in kinds)) { kinds[kind] = 1; order[++kind_count] = kind }
    if (n > 1 && !((kind, scene) in built)) {
        built[kind, scene] = 1
        builds[kind, ++build_count[kind]] = 1e9 * field("build_seconds") / (n * log(n + 2) / log(2))
    }
}

# The least squares of one kind into cost[kind, 1..4]: ray, node, triangle, other.
function fit(kind,   r, i, j, turn, rest, a, b, f) {
    for (i = 1; i <= 4; i++) { b[i] = 0; for (j = 1; j <= 4; j++) a[i, j] = 0 }
    for (r = 1; r <= rows; r++) {
        if (of[r] != kind) continue
        f[1] = slow[on[r]] / t[r]; f[2] = nodes[r] * f[1]
        f[3] = flat[r] * tests[r] * f[1]; f[4] = (1 - flat[r]) * tests[r] * f[1]
        for (i = 1; i <= 4; i++) { b[i] += f[i]; for (j = 1; j <= 4; j++) a[i, j] += f[i] * f[j] }
    }
    # Gauss and Seidel's steps, each cut off at 0
    for (turn = 0; turn < 100; turn++)
        for (i = 1; i <= 4; i++) {
            rest = b[i]
            for (j = 1; j <= 4; j++) if (j != i) rest -= a[i, j] * cost[kind, j]
            cost[kind, i] = a[i, i] > 0 && rest > 0 ? rest / a[i, i] : 0
        }
}

function predicted(r,   test) {
    test = flat[r] * cost[of[r], 3] + (1 - flat[r]) * cost[of[r], 4]
    return cost[of[r], 1] + cost[of[r], 2] * nodes[r] + test * tests[r]
}

# All kinds, in turn with what slows all of them down.
function fit_all(   k, r, s, round, sum, count, all) {
    for (r = 1; r <= rows; r++) slow[on[r]] = 1
    for (round = 0; round < 100; round++) {
        for (k = 1; k <= kind_count; k++) fit(order[k])
        for (s in slow) { sum[s] = 0; count[s] = 0 }
        for (r = 1; r <= rows; r++) { sum[on[r]] += log(t[r] / predicted(r)); count[on[r]]++ }
        all = 0; k = 0
        for (s in slow) if (count[s] > 2) { all += sum[s] / count[s]; k++ }
        for (s in slow) slow[s] = count[s] > 2 ? exp(sum[s] / count[s] - all / k) : 1
    }
    for (r = 1; r <= rows; r++) {
        all = slow[on[r]] * predicted(r) / t[r] - 1
        off[of[r]] += all * all; share[of[r]]++
    }
}

function low_build(kind,   i, j, x, n, list) {
    n = build_count[kind]
    for (i = 1; i <= n; i++) {
        x = builds[kind, i]
        for (j = i - 1; j > 0 && list[j] > x; j--) list[j + 1] = list[j]
        list[j + 1] = x
    }
    return list[int((n + 3) / 4)]
}

END {
    while ((getline line < seen) > 0)
        if (match(line, /^#define COST_[A-Z]+ +\{/)) {
            split(line, part, /[ {},]+/)
            old[tolower(substr(part[2], 6))] = line
            growth[tolower(substr(part[2], 6))] = part[8]
        }
    fit_all()
    for (k = 1; k <= kind_count; k++) {
        kind = order[k]
        printf "%s  is\n", old[kind]
        printf "#define COST_%-6s {%3.0f, %3.0f, %2.0f, %4.1f, %4.1f, %s}  fits: off by %.0f %%\n", toupper(kind),
            kind == "linear" ? 0 : low_build(kind), cost[kind, 1], cost[kind, 2], cost[kind, 3], cost[kind, 4],
            growth[kind], 100 * sqrt(off[kind] / share[kind])
    }
}
