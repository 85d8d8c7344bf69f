/* SPDX-License-Identifier: Apache-2.0 */
#include "decode.h"

#include <stdlib.h>
#include <string.h>

struct decoder decode_start(const uint8_t *bytes, size_t size)
{
    return (struct decoder){.bytes = {bytes, size}, .step = 1.0, .dir = {0.0, 0.0, 1.0}};
}

/* ---------------------------------------------------------------- numbers ---- */

static uint16_t take_two(struct bytes *b)
{
    const uint16_t low = take(b);
    return (uint16_t)(low | take(b) << 8);
}

double step_bits(double x, int n)
{
    for (; n > 0; n--)
        x = nextafter(x, (double)INFINITY);
    for (; n < 0; n++)
        x = nextafter(x, -(double)INFINITY);
    return x;
}

static double any_bits(struct bytes *b)
{
    uint8_t raw[8];
    double x;
    for (int i = 0; i < 8; i++)
        raw[i] = take(b);
    memcpy(&x, raw, sizeof x);
    return x;
}

static double special(struct bytes *b)
{
    static const double numbers[] = {0.0,
                                     1.0,
                                     DBL_TRUE_MIN,
                                     DBL_MIN,
                                     0x1p-500,
                                     DBL_EPSILON,
                                     1e300,
                                     ACCEL_MAX_COORDINATE,
                                     0x1.fffffffffffffp999,
                                     0x1.0000000000001p1000,
                                     DBL_MAX,
                                     (double)FLT_MAX,
                                     0x1p53,
                                     (double)INFINITY,
                                     (double)NAN,
                                     1.0 / 3.0};
    const uint8_t i = take(b);
    return copysign(numbers[i % 16], i & 0x80 ? -1.0 : 1.0);
}

static double power(struct bytes *b)
{
    const uint16_t i = take_two(b);
    return copysign(ldexp(1.0, i % 2098 - 1074), i & 0x8000 ? -1.0 : 1.0);
}

static double known(const struct decoder *d, uint8_t back)
{
    const uint32_t there = d->numbers < KNOWN ? d->numbers : KNOWN;
    return there ? d->number[(d->numbers - 1 - back % there) % KNOWN] : 0.0;
}

static double lattice(const struct decoder *d, int i)
{
    return d->offset + i * d->step;
}

/* A number of the lattice takes one byte, which gives 16 of them eight ways. */
static double decode_number(struct decoder *d)
{
    struct bytes *b = &d->bytes;
    const uint8_t how = take(b);
    const int high = (how >> 4) - 7;
    switch (how & 15) {
    case 8:
        return step_bits(lattice(d, high), (int8_t)take(b));
    case 9:
        return known(d, take(b));
    case 10:
        return step_bits(known(d, take(b)), high);
    case 11:
        return special(b);
    case 12:
        return any_bits(b);
    case 13:
        return d->offset + d->step * (double)(int16_t)take_two(b) / 256.0;
    case 14:
        return power(b);
    case 15:
        return lattice(d, high) / 3.0;
    default:
        return lattice(d, high);
    }
}

static double next_number(struct decoder *d)
{
    const double x = decode_number(d);
    d->number[d->numbers++ % KNOWN] = x;
    return x;
}

static void know_point(struct decoder *d, const double p[3])
{
    memcpy(d->point[d->points++ % KNOWN], p, sizeof d->point[0]);
}

static const double *known_point(const struct decoder *d, uint8_t back)
{
    static const double origin[3] = {0.0, 0.0, 0.0};
    const uint32_t there = d->points < KNOWN ? d->points : KNOWN;
    return there ? d->point[(d->points - 1 - back % there) % KNOWN] : origin;
}

static void decode_three(struct decoder *d, double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = next_number(d);
}

/* A point is new, or one that was there, also with one coordinate changed, or between two. */
static void decode_point(struct decoder *d, double out[3])
{
    const uint8_t how = take(&d->bytes);
    const double *old = known_point(d, how >> 3), *other;
    switch (how & 7) {
    case 4:
        memcpy(out, old, 3 * sizeof *out);
        break;
    case 5:
        memcpy(out, old, 3 * sizeof *out);
        out[take_below(&d->bytes, 3)] = next_number(d);
        break;
    case 6:
        other = known_point(d, take(&d->bytes));
        for (int k = 0; k < 3; k++)
            out[k] = 0.5 * old[k] + 0.5 * other[k];
        break;
    case 7:
        other = known_point(d, take(&d->bytes));
        for (int k = 0; k < 3; k++)
            out[k] = old[k] + (other[k] - old[k]) * (double)(int8_t)take(&d->bytes) / 64.0;
        break;
    default:
        decode_three(d, out);
    }
    know_point(d, out);
}

/* ----------------------------------------------------------------- config ---- */

/* The ends, what lies between by ratio, or a number that other numbers need not have. */
static double decode_value(struct decoder *d, const accel_option *o)
{
    const uint8_t how = take(&d->bytes);
    const double part = (double)(how >> 2) / 63.0;
    double x = o->min + part * (o->max - o->min);
    if ((how & 3) == 0)
        x = fmin(o->min + (how >> 2), o->max);
    else if ((how & 3) == 1)
        x = pow(o->min + 1.0, 1.0 - part) * pow(o->max + 1.0, part) - 1.0;
    else if ((how & 3) == 2)
        x = fabs(next_number(d));
    x = x >= o->min ? x : o->min;
    x = x <= o->max ? x : o->max;
    return o->whole ? floor(x) : x;
}

static void decode_option(struct decoder *d, const accel_option *o, char *text, size_t room)
{
    uint32_t words = 0;
    while (o->words && o->words[words])
        words++;
    if (o->words)
        snprintf(text, room, "%s=%s", o->key, o->words[take_below(&d->bytes, words)]);
    else
        snprintf(text, room, "%s=%.17g", o->key, decode_value(d, o));
}

void decode_config(struct decoder *d, char config[CONFIG_ROOM])
{
    size_t kinds;
    const accel_kind_info *const *kind = accel_kinds(&kinds);
    const accel_kind_info *k = kind[take_below(&d->bytes, (uint32_t)kinds)];
    const uint8_t given = take(&d->bytes);
    size_t used = (size_t)snprintf(config, CONFIG_ROOM, "%s", k->name);
    char separator = ':';
    for (size_t i = 0; i < k->option_count; i++) {
        if (!(given >> i % 8 & 1))
            continue;
        config[used++] = separator;
        decode_option(d, &k->options[i], config + used, CONFIG_ROOM - used);
        used += strlen(config + used);
        separator = ',';
    }
}

/* ------------------------------------------------------------------ scene ---- */

static struct part *part_for(struct test_scene *s, accel_type type)
{
    struct part *p = s->count ? &s->part[s->count - 1] : NULL;
    if (p && p->type == type)
        return p;
    return s->count < MOST_PARTS ? scene_part(s, type) : NULL;
}

/* Of a strip, it shares the last two points. */
static void add_triangle(struct decoder *d, struct test_scene *s, bool strip)
{
    double corner[3][3];
    for (int i = 0; i < 3; i++) {
        if (strip && i < 2)
            memcpy(corner[i], known_point(d, (uint8_t)(1 - i)), sizeof corner[i]);
        else
            decode_point(d, corner[i]);
    }
    struct part *p = part_for(s, ACCEL_TRIANGLES);
    if (p)
        part_triangle(p, corner[0], corner[1], corner[2]);
}

static void add_sphere(struct decoder *d, struct test_scene *s)
{
    double centre[3];
    decode_point(d, centre);
    const double radius = fabs(next_number(d));
    struct part *p = part_for(s, ACCEL_SPHERES);
    if (p)
        part_sphere(p, centre, radius);
}

/* The box of what the object is, if it has one. */
static void fit_box(enum behaviour behaviour, const double *p, accel_box *box)
{
    for (int k = 0; k < 3; k++) {
        if (behaviour == BALL || behaviour == FILTER) {
            box->lo[k] = p[k] - p[3];
            box->hi[k] = p[k] + p[3];
        } else {
            box->lo[k] = fmin(p[k], p[3 + k]);
            box->hi[k] = fmax(p[k], p[3 + k]);
        }
    }
}

/* An object that lies, if its box is not what it is. */
static void add_object(struct decoder *d, struct test_scene *s)
{
    const uint8_t how = take(&d->bytes);
    const enum behaviour behaviour = (enum behaviour)((how & 15) % BEHAVIOURS);
    double data[6];
    accel_box box;
    decode_point(d, data);
    decode_point(d, data + 3);
    if (behaviour == COMB)
        data[0] = take_below(&d->bytes, 70);
    fit_box(behaviour, data, &box);
    if (how & 16) {
        decode_point(d, box.lo);
        decode_point(d, box.hi);
    }
    const accel_order order = how & 32 ? ACCEL_ORDER_RAW : ACCEL_ORDER_KEY;
    struct part *p = part_for(s, ACCEL_OBJECTS);
    if (p && p->count > 0 && p->order != order)
        p = s->count < MOST_PARTS ? scene_part(s, ACCEL_OBJECTS) : NULL;
    if (!p)
        return;
    p->order = order;
    part_object(p, &box, behaviour, data);
}

/* An axis-parallel rectangle of two triangles: its boxes are flat and coincide. */
static void add_rectangle(struct decoder *d, struct test_scene *s)
{
    double a[3], c[3];
    decode_point(d, a);
    decode_point(d, c);
    const uint32_t axis = take_below(&d->bytes, 3);
    c[axis] = a[axis];
    double b[3] = {a[0], a[1], a[2]}, e[3] = {c[0], c[1], c[2]};
    b[(axis + 1) % 3] = c[(axis + 1) % 3];
    e[(axis + 1) % 3] = a[(axis + 1) % 3];
    struct part *p = part_for(s, ACCEL_TRIANGLES);
    if (!p)
        return;
    part_triangle(p, a, b, c);
    part_triangle(p, a, c, e);
    know_point(d, b);
    know_point(d, e);
}

static void repeat_once(struct part *p, uint32_t from, const double by[3])
{
    double x[9];
    accel_box box;
    struct test_object object;
    switch (p->type) {
    case ACCEL_TRIANGLES:
        for (size_t i = 0; i < 9; i++)
            x[i] = p->data[9 * (size_t)from + i] + by[i % 3];
        part_triangle(p, x, x + 3, x + 6);
        break;
    case ACCEL_SPHERES:
        for (size_t i = 0; i < 4; i++)
            x[i] = p->data[4 * (size_t)from + i] + (i < 3 ? by[i] : 0.0);
        part_sphere(p, x, x[3]);
        break;
    case ACCEL_OBJECTS:
        box = p->boxes[from];
        object = p->objects[from];
        for (int k = 0; k < 3; k++) {
            box.lo[k] += by[k];
            box.hi[k] += by[k];
            object.p[k] += object.behaviour == COMB ? 0.0 : by[k];
            object.p[3 + k] += object.behaviour == CRATE ? by[k] : 0.0;
        }
        part_object(p, &box, object.behaviour, object.p);
        break;
    }
}

/* Rows, blocks and piles of the last primitives, a step or none apart. */
static void add_copies(struct decoder *d, struct test_scene *s)
{
    const uint8_t how = take(&d->bytes);
    const uint32_t copies = 1 + how % 32, of = 1 + (how >> 5);
    double by[3];
    for (int k = 0; k < 3; k++) {
        const uint8_t steps = take(&d->bytes);
        by[k] = d->step * (double)(int8_t)steps / 16.0;
    }
    struct part *p = s->count ? &s->part[s->count - 1] : NULL;
    for (uint32_t i = 0; p && i < copies && p->count >= of; i++)
        for (uint32_t k = 0; k < of && scene_size(s) < MOST_PRIMITIVES; k++)
            repeat_once(p, p->count - of, by);
}

static void decode_lattice(struct decoder *d)
{
    static const int steps[] = {0,     0,   0,   0,    -3,  30, -30, -1070,
                                -1022, 990, 300, -300, -52, 8,  1,   -60};
    static const double offsets[] = {0.0,     0.0,    0.0,    0.0,     1e6,    0x1p52,
                                     -0x1p30, 1e-300, 0x1p-3, -1000.0, 0x1p20, 0x1p999,
                                     -1e300,  0.1,    1e9,    -7.0};
    const uint8_t how = take(&d->bytes);
    d->step = ldexp(1.0, steps[how & 15]);
    d->offset = offsets[how >> 4];
}

static void decode_part(struct decoder *d, struct test_scene *s, uint8_t how)
{
    switch (how & 7) {
    case 0:
    case 1:
        add_triangle(d, s, false);
        break;
    case 2:
        add_triangle(d, s, true);
        break;
    case 3:
        add_sphere(d, s);
        break;
    case 4:
        add_object(d, s);
        break;
    case 5:
        add_rectangle(d, s);
        break;
    case 6:
        add_copies(d, s);
        break;
    default: /* also an empty geometry, if another one follows */
        if (s->count < MOST_PARTS)
            scene_part(s, (accel_type)(how >> 3 & 1));
    }
}

/* Vertices as float or double, some bytes apart; no byte behind the last one is there. */
static void lay_out(struct decoder *d, struct host_scene *s, uint32_t g)
{
    accel_triangles *t = &s->made.geometry[g].triangles;
    const uint8_t how = take(&d->bytes);
    const bool floats = how & 1;
    const size_t size = 3 * (floats ? sizeof(float) : sizeof(double)),
                 stride = size + (how >> 1) % 9;
    char *to = must_resize(NULL, t->vertex_count ? stride * (t->vertex_count - 1) + size : 0);
    for (uint32_t i = 0; i < t->vertex_count; i++) {
        const double *from = (const double *)t->vertices + 3 * (size_t)i;
        const float narrow[3] = {(float)from[0], (float)from[1], (float)from[2]};
        memcpy(to + i * stride, floats ? (const void *)narrow : (const void *)from, size);
    }
    s->vertices[g] = to;
    t->vertices = to;
    t->vertices_are_float = floats;
    t->vertex_stride = stride == size && how & 0x80 ? 0 : stride;
}

void decode_scene(struct decoder *d, struct host_scene *s)
{
    memset(s->vertices, 0, sizeof s->vertices);
    scene_open(&s->made);
    decode_lattice(d);
    uint32_t parts = take_below(&d->bytes, 64);
    for (; parts > 0 && d->bytes.left > 0 && scene_size(&s->made) < MOST_PRIMITIVES; parts--)
        decode_part(d, &s->made, take(&d->bytes));
    scene_close(&s->made);
    for (uint32_t g = 0; g < s->made.count; g++)
        if (s->made.part[g].type == ACCEL_TRIANGLES)
            lay_out(d, s, g);
}

void host_scene_free(struct host_scene *s)
{
    for (uint32_t g = 0; g < s->made.count; g++)
        free(s->vertices[g]);
    scene_free(&s->made);
}

/* ------------------------------------------------------------------- rays ---- */

static void decode_axis(struct decoder *d, double out[3])
{
    const uint8_t how = take(&d->bytes);
    for (int k = 0; k < 3; k++)
        out[k] = how >> (2 + k) & 1 ? -0.0 : 0.0;
    out[(how & 3) % 3] = how & 32 ? -1.0 : 1.0;
    if (how & 64)
        out[((how & 3) + 1) % 3] = how & 128 ? -1.0 : 1.0;
}

static void decode_direction(struct decoder *d, uint8_t how, const double org[3], double out[3])
{
    const double *to = known_point(d, how % 3 == 0 ? take(&d->bytes) : how), *from = org;
    switch (how & 7) {
    case 0:
    case 1:
        decode_axis(d, out);
        return;
    case 2:
        from = known_point(d, take(&d->bytes));
        break;
    case 3:
        for (int k = 0; k < 3; k++)
            out[k] = (double)((int)take(&d->bytes) % 7 - 3);
        return;
    case 4:
        decode_three(d, out);
        return;
    case 5:
        for (int k = 0; k < 3; k++)
            out[k] = how & 0x80 ? -d->dir[k] : d->dir[k];
        return;
    default:
        break;
    }
    for (int k = 0; k < 3; k++)
        out[k] = to[k] - from[k];
}

/* An end of an interval: often just where the last hit was. */
static double decode_end(struct decoder *d, double usual, const accel_hit *last)
{
    const uint8_t how = take(&d->bytes);
    const double t = last ? last->t : 1.0;
    switch (how & 7) {
    case 0:
        return -(double)INFINITY;
    case 1:
        return t;
    case 2:
        return step_bits(t, (how >> 3) - 15);
    case 3:
        return next_number(d);
    case 4:
        return -t;
    case 5:
        return (double)(how >> 3) / 8.0;
    case 6:
        return copysign(0.0, how & 8 ? -1.0 : 1.0);
    default:
        return usual;
    }
}

static void start_at_hit(const accel_ray *ray, const accel_hit *hit, double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = ray->org[k] + hit->t * ray->dir[k];
}

accel_ray decode_ray(struct decoder *d, const accel_ray *last_ray, const accel_hit *last)
{
    const uint8_t how = take(&d->bytes), way = take(&d->bytes);
    double org[3], dir[3];
    if ((how & 3) == 3 && last)
        start_at_hit(last_ray, last, org);
    else
        decode_point(d, org);
    decode_direction(d, way, org, dir);
    if (how & 4) {
        const int scale = 8 * (int8_t)take(&d->bytes);
        for (int k = 0; k < 3; k++)
            dir[k] = ldexp(dir[k], scale);
    }
    memcpy(d->dir, dir, sizeof d->dir);
    accel_ray ray = accel_ray_from(org, dir);
    if (how & 8)
        ray.tmin = decode_end(d, 0.0, last);
    if (how & 16)
        ray.tmax = decode_end(d, (double)INFINITY, last);
    if (how & 32 && last)
        ray.skip = (accel_id){last->geom, last->prim};
    else if (how & 64)
        ray.skip = (accel_id){take_below(&d->bytes, 8), take(&d->bytes)};
    return ray;
}
