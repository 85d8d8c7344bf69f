/* SPDX-License-Identifier: Apache-2.0
 *
 * Prints a scene of random objects for POV-Ray, decided by its arguments alone: object number I of
 * seed S is the same whatever else is written.
 *
 * All objects are transparent, so that a ray goes on through what it hits, and glow each in its own
 * colour, so that another hit shows. Declare=View=N chooses the camera: 0 rays that are meant for
 * the objects, from all sides; 1 perspective, amid them; 2 orthographic, along an axis.
 *
 * The last lines are comments: how many objects POV-Ray may have without bounds at most, and how
 * often each shape was written.
 */
#include "shapes.h"
#include "tree.h"
#include "world.h"

#include <stdlib.h>
#include <string.h>

/* An object has BUDGET shapes, or a few more. */
enum { DEPTH = 3, BUDGET = 7, RAYS_STREAM = 1000000 };

struct request {
    uint64_t seed;
    int count, rays;
    int only; /* -1: all objects */
    int type; /* of all objects; -1: each in turn */
};

static void write_flags(struct writer *w)
{
    static const char *const flags[] = {
        " no_shadow",        " no_image", " no_reflection", " hollow", " interior { ior 1.3 }",
        " double_illuminate"};

    for (size_t i = 0; i < sizeof flags / sizeof flags[0]; i++) {
        if (rng_chance(&w->rng, i == 4 ? 0.15 : 0.05)) {
            write_text(w, "%s", flags[i]);
        }
    }
}

static void write_texture(struct writer *w)
{
    write_pattern(w, " pigment { rgb @c transmit 0.65 } finish { ambient 0 emission 0.3");
    write_text(w, rng_chance(&w->rng, 0.3) ? " diffuse 0.4" : " diffuse 0");
    write_text(w, rng_chance(&w->rng, 0.05) ? " reflection 0.2 }" : " }");
}

/* Objects that send photons on; only where the world has photons at all. */
static void write_target(struct writer *w, bool wanted)
{
    if (wanted) {
        write_text(w, " photons { target reflection on refraction on }");
    }
}

static void write_small_lamp(struct writer *w)
{
    write_pattern(w, "light_source { @p rgb 0.02 looks_like { sphere { 0, @r / 2 "
                     "pigment { rgb @c transmit 0.65 } } [rotate @a] } }");
}

/* What stands at the top of a scene besides plain objects. */
enum form { PLAIN, COPIES, LAMPS, LAMP_IN_UNION, LIGHT_GROUP, TARGET };

static enum form draw_form(struct writer *w, const struct world *world)
{
    const double kind = rng_unit(&w->rng);

    if (world->dark) {
        return kind < 0.75 ? PLAIN : COPIES;
    }
    if (world->photons && kind < 0.1) {
        return TARGET;
    }
    return kind < 0.65   ? PLAIN
           : kind < 0.85 ? COPIES
           : kind < 0.91 ? LAMPS
           : kind < 0.95 ? LAMP_IN_UNION
                         : LIGHT_GROUP;
}

static int write_copies(struct writer *w, const struct world *world, int number, int depth,
                        int wanted, struct placement *p)
{
    int unbounded = 0;

    write_text(w, "#declare Object_%d = ", number);
    const struct reach reach = write_tree(w, depth, wanted, false);
    write_text(w, " }\n");
    for (int i = 0; i < 2; i++) {
        struct reach copied = reach;
        write_text(w, "object { Object_%d", number);
        write_modifiers(w, &copied, 1);
        *p = write_placement(w, world);
        write_texture(w);
        write_flags(w);
        write_text(w, " }\n");
        unbounded += unbounded_objects(&copied);
    }
    return unbounded;
}

static int write_lamp(struct writer *w, const struct world *world, int depth, int wanted,
                      struct placement *p)
{
    write_pattern(w, "light_source { @p / 3 rgb 0.02 looks_like { ");
    struct reach reach = write_tree(w, depth, wanted, false);
    write_texture(w);
    write_text(w, " }");
    write_modifiers(w, &reach, 0);
    write_text(w, " }");
    *p = write_placement(w, world);
    write_text(w, " }\n");
    return !reach.own.surface;
}

static int write_group(struct writer *w, const struct world *world, int depth, int wanted,
                       struct placement *p)
{
    write_text(w, "light_group { light_source { 2 * y rgb 0.1 } ");
    const struct reach reach = write_tree(w, depth, wanted, false);
    write_texture(w);
    write_text(w, " } global_lights on");
    *p = write_placement(w, world);
    write_text(w, " }\n");
    return unbounded_objects(&reach);
}

/* Returns how many objects without bounds it makes at most. */
static int write_object(struct writer *w, const struct world *world, int number, int wanted,
                        struct placement *p)
{
    const enum form form = draw_form(w, world);
    const int depth = (int)rng_below(&w->rng, DEPTH + 1);

    write_text(w, "// object %d, %s\n", number, shapes[wanted].name);
    if (form == COPIES) {
        return write_copies(w, world, number, depth, wanted, p);
    }
    if (form == LAMPS) {
        return write_lamp(w, world, depth, wanted, p);
    }
    if (form == LIGHT_GROUP) {
        return write_group(w, world, depth, wanted, p);
    }
    if (form == LAMP_IN_UNION) {
        write_text(w, "union { ");
        write_small_lamp(w);
    }
    struct reach reach = write_tree(w, depth, wanted, false);
    if (form == LAMP_IN_UNION) {
        write_text(w, " }");
        reach = (struct reach){.own.surface = reach.own.surface,
                               .unbounded_parts = unbounded_objects(&reach),
                               .takes_apart = true};
        write_modifiers(w, &reach, 1);
    }
    *p = write_placement(w, world);
    write_texture(w);
    write_flags(w);
    write_target(w, form == TARGET && reach.own.surface);
    write_text(w, " }\n");
    return unbounded_objects(&reach);
}

/* The cameras: each pixel of the first is a ray of the list. */
static void write_cameras(struct writer *w, const struct world *world, const struct ray_list *rays)
{
    const double s = world->scale;
    double from[3], to[3], aside[3];

    for (int i = 0; i < 3; i++) {
        from[i] = world->offset[i] + s * rng_range(&w->rng, -3.0, 3.0);
        to[i] = world->offset[i] + s * rng_range(&w->rng, -2.0, 2.0);
        aside[i] = world->offset[i] - (i == 2 ? 8.0 * s : 0.0);
    }
    write_rays(w, rays);
    write_text(w, "#ifndef (View) #declare View = 0; #end\n#switch (View)\n#case (1)\n"
                  "camera { perspective location ");
    write_vector(w, from);
    write_text(w, " look_at ");
    write_vector(w, to);
    write_text(w, " angle 90 }\n#break\n#case (2)\ncamera { orthographic location ");
    write_vector(w, aside);
    write_text(w, " direction z right %.9g * x up %.9g * y }\n#break\n", 8.0 * s, 8.0 * s);
    write_text(w, "#else camera { mesh_camera { 1 0 mesh { Rays } } location 0 }\n#end\n");
}

static void write_head(struct writer *w, const struct world *world, const struct ray_list *rays)
{
    double light[3];

    write_text(w,
               "#version 3.7;\nglobal_settings { assumed_gamma 1 max_trace_level 12 "
               "adc_bailout 0.03%s }\nbackground { rgb <0.1, 0.2, 0.3> }\n",
               world->photons ? " photons { count 500 autostop 0 }" : "");
    write_cameras(w, world, rays);
    for (int i = 0; i < 3; i++) {
        light[i] = world->offset[i] + 9.0 * world->scale * rng_range(&w->rng, -1.0, 1.0);
    }
    if (!world->dark) {
        write_text(w, "light_source { ");
        write_vector(w, light);
        write_text(w, " rgb 0.6 }\n\n");
    }
}

/* Writes object number `number`, or without a file finds its place alone. Returns as write_object.
 */
static int draw_object(FILE *out, const struct request *request, const struct world *world,
                       int number, struct placement *p)
{
    struct writer w = {.out = out,
                       .rng = rng_from(request->seed, (uint64_t)number + 1),
                       .budget = BUDGET,
                       .dark = world->dark};
    /* Shapes take turns over the seeds as well. */
    const uint64_t turn = request->seed * (uint64_t)request->count + (uint64_t)number;
    const int wanted = request->type >= 0 ? request->type : (int)(turn % (uint64_t)shape_count);

    const int unbounded = write_object(&w, world, number, wanted, p);

    return unbounded + w.thin * w.loose;
}

static bool write_scene(FILE *out, const struct request *request)
{
    const struct world world = draw_world(request->seed);
    struct writer head = {
        .out = out, .rng = rng_from(request->seed, RAYS_STREAM), .dark = world.dark};
    struct ray_list rays = {NULL, 0, 0};
    struct placement p = {{{0}}};
    int unbounded = 0;

    for (int i = 0; i < request->count; i++) {
        struct rng rng = rng_from(request->seed, RAYS_STREAM + (uint64_t)i + 1);
        draw_object(NULL, request, &world, i, &p);
        if (!add_rays(&rays, &rng, &p, request->rays)) {
            return false;
        }
    }
    write_head(&head, &world, &rays);
    free(rays.corners);
    for (int i = 0; i < request->count; i++) {
        if (request->only < 0 || request->only == i) {
            unbounded += draw_object(out, request, &world, i, &p);
        }
    }
    fprintf(out, "\n// unbounded %d\n", unbounded);
    for (int i = 0; i < shape_count; i++) {
        fprintf(out, "// wrote %s %d\n", shapes[i].name, written_shapes[i]);
    }
    return ferror(out) == 0 && fflush(out) == 0;
}

static int usage(void)
{
    fputs("usage: random_objects SEED [--count N] [--rays N] [--only NUMBER] [--type SHAPE]\n"
          "  --count N      objects (default 30)\n"
          "  --rays N       rays meant for each object (default 60)\n"
          "  --only NUMBER  writes one object alone, with the rays of all\n"
          "  --type SHAPE   of each object, where others take turns:\n  ",
          stderr);
    for (int i = 0; i < shape_count; i++) {
        fprintf(stderr, " %s", shapes[i].name);
    }
    fputc('\n', stderr);
    return 2;
}

static bool read_number(const char *text, uint64_t most, uint64_t *number)
{
    char *end;

    *number = strtoull(text, &end, 10);
    return text[0] >= '0' && text[0] <= '9' && *end == '\0' && *number <= most;
}

static bool read_request(int argc, char **argv, struct request *request)
{
    if (argc % 2 != 0 || !read_number(argv[1], UINT64_C(1) << 48, &request->seed)) {
        return false;
    }
    for (int i = 2; i < argc; i += 2) {
        uint64_t number = 0;
        const bool is_number = read_number(argv[i + 1], RAYS_STREAM - 2, &number);
        if (is_number && number > 0 && strcmp(argv[i], "--count") == 0) {
            request->count = (int)number;
        } else if (is_number && number > 0 && strcmp(argv[i], "--rays") == 0) {
            request->rays = (int)number;
        } else if (is_number && strcmp(argv[i], "--only") == 0) {
            request->only = (int)number;
        } else if (strcmp(argv[i], "--type") == 0) {
            request->type = shape_named(argv[i + 1]);
            if (request->type < 0) {
                return false;
            }
        } else {
            return false;
        }
    }
    return true;
}

int main(int argc, char **argv)
{
    struct request request = {.count = 30, .rays = 60, .only = -1, .type = -1};

    if (!read_request(argc, argv, &request)) {
        return usage();
    }
    if (!write_scene(stdout, &request)) {
        perror("random_objects");
        return 1;
    }
    return 0;
}
