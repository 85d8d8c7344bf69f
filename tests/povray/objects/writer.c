/* SPDX-License-Identifier: Apache-2.0 */
#include "writer.h"

#include <stdarg.h>

void write_text(struct writer *w, const char *format, ...)
{
    if (w->out == NULL) {
        return;
    }
    va_list arguments;
    va_start(arguments, format);
    vfprintf(w->out, format, arguments);
    va_end(arguments);
}

void write_number(struct writer *w, double x)
{
    write_text(w, "%.9g", x);
}

void write_vector(struct writer *w, const double v[3])
{
    write_text(w, "<%.9g, %.9g, %.9g>", v[0], v[1], v[2]);
}

double draw_number(struct writer *w, double lo, double hi)
{
    const double x = rng_range(&w->rng, lo, hi);
    const double rounded = round(x * 4.0) / 4.0;
    const bool round = rng_chance(&w->rng, 0.25);

    return round && rounded >= lo && rounded <= hi ? rounded : x;
}

void draw_point(struct writer *w, double half_side, double point[3])
{
    for (int i = 0; i < 3; i++) {
        point[i] = draw_number(w, -half_side, half_side);
    }
}

void draw_direction(struct writer *w, double direction[3])
{
    const bool axis = rng_chance(&w->rng, 0.25);
    const uint32_t which = rng_below(&w->rng, 3);
    const double sign = rng_chance(&w->rng, 0.5) ? 1.0 : -1.0;
    double square;

    do {
        square = 0.0;
        for (int i = 0; i < 3; i++) {
            direction[i] = rng_range(&w->rng, -1.0, 1.0);
            square += direction[i] * direction[i];
        }
    } while (square > 1.0 || square < 0.01);
    for (uint32_t i = 0; axis && i < 3; i++) {
        direction[i] = i == which ? sign : 0.0;
    }
}

void draw_rotation(struct writer *w, double degrees[3])
{
    const bool right = rng_chance(&w->rng, 0.4);

    for (int i = 0; i < 3; i++) {
        const double turn = rng_range(&w->rng, -2.0, 2.0);
        degrees[i] = 90.0 * (right ? round(turn) : turn);
    }
}

static void write_drawn(struct writer *w, char code, double last[3])
{
    double v[3] = {0.0, 0.0, 0.0};

    switch (code) {
    case 'p':
        draw_point(w, 0.8, last);
        write_vector(w, last);
        break;
    case 'o':
        draw_point(w, 0.5, v);
        v[0] += v[0] == 0.0 && v[1] == 0.0 && v[2] == 0.0 ? 0.375 : 0.0;
        for (int i = 0; i < 3; i++) {
            last[i] += v[i];
        }
        write_vector(w, last);
        break;
    case 'd':
        draw_direction(w, v);
        write_vector(w, v);
        break;
    case 'a':
        draw_rotation(w, v);
        write_vector(w, v);
        break;
    case 'c':
        for (int i = 0; i < 3; i++) {
            v[i] = rng_range(&w->rng, 0.1, 1.0);
        }
        write_vector(w, v);
        break;
    case 'r':
        write_number(w, draw_number(w, 0.15, 0.9));
        break;
    case 's':
        write_number(w, draw_number(w, -1.0, 1.0));
        break;
    default:
        write_number(w, draw_number(w, 0.0, 1.0));
        break;
    }
}

void write_pattern(struct writer *w, const char *pattern)
{
    FILE *out = w->out;
    double last[3] = {0.0, 0.0, 0.0};

    for (const char *c = pattern; *c != '\0'; c++) {
        if (*c == '[') {
            w->out = rng_chance(&w->rng, 0.5) ? out : NULL;
        } else if (*c == ']') {
            w->out = out;
        } else if (*c == '@') {
            write_drawn(w, *++c, last);
        } else {
            write_text(w, "%c", *c);
        }
    }
    w->out = out;
}
