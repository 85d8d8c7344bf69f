/* SPDX-License-Identifier: Apache-2.0
 *
 * Photons and irradiance against closed forms, with fixed seeds. Every bound is BOUND standard
 * errors of what is compared, from the binomial law where the trials are independent, from the
 * spread over seeds where they are not; each test also demands that the error itself is small, so
 * that a wide bound cannot hide a miss.
 */
#include "photons/photons.h"
#include "photons/plates.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define PI 3.141592653589793

/* A right answer is outside with a chance of 6e-5 for each comparison; seeds are fixed. */
#define BOUND 4.0

enum { SEEDS = 32, DISCS = 60 };

/* A box of unit faces or parts of it, two triangles each. */
typedef struct room {
    accel_geometry geometry;
    accel_scene scene;
    double vertices[8][3]; /* bit k of the number: side along axis k */
    uint32_t indices[36];
} room;

/* The corner and the two edges of each face, whose normal edge[0] x edge[1] points inside. */
static const int faces[6][3] = {{0, 2, 4}, {1, 5, 3}, {0, 4, 1}, {2, 3, 6}, {0, 1, 2}, {4, 6, 5}};

/* The faces from `first` to `last` of the unit cube. */
static void make_room(room *r, int first, int last)
{
    for (int i = 0; i < 8; i++) {
        for (int k = 0; k < 3; k++) {
            r->vertices[i][k] = i >> k & 1;
        }
    }
    uint32_t count = 0;
    for (int f = first; f <= last; f++) {
        const uint32_t a = (uint32_t)faces[f][0], b = (uint32_t)faces[f][1];
        const uint32_t c = (uint32_t)faces[f][2], d = b + c - a;
        const uint32_t both[6] = {a, b, d, a, d, c};
        memcpy(r->indices + 3 * count, both, sizeof both);
        count += 2;
    }
    r->geometry = (accel_geometry){
        .type = ACCEL_TRIANGLES,
        .triangles = {
            .vertices = r->vertices, .vertex_count = 8, .indices = r->indices, .count = count}};
    r->scene = (accel_scene){&r->geometry, 1};
}

/* The face as a light of power 1, `away` inside the room. */
static struct light face_light(const room *r, int face, double away)
{
    struct light light = {.power = 1.0};
    const double *corner = r->vertices[faces[face][0]];
    for (int k = 0; k < 3; k++) {
        light.edge[0][k] = r->vertices[faces[face][1]][k] - corner[k];
        light.edge[1][k] = r->vertices[faces[face][2]][k] - corner[k];
    }
    for (int k = 0; k < 3; k++) {
        const double normal = light.edge[0][(k + 1) % 3] * light.edge[1][(k + 2) % 3] -
                              light.edge[0][(k + 2) % 3] * light.edge[1][(k + 1) % 3];
        light.corner[k] = corner[k] + away * normal;
    }
    return light;
}

static accel *build(const accel_scene *scene, const char *config)
{
    accel *a;
    accel_error error = {.text = ""};
    if (accel_build(&a, scene, config, NULL, &error) != ACCEL_OK) {
        fail_msg("%s: %s", config, error.text);
    }
    return a;
}

static struct photons trace(const accel *a, const accel_scene *scene, const struct photon_run *run)
{
    struct photons photons;
    assert_true(trace_photons(&photons, a, scene, run));
    assert_int_equal(photons.query.refused, 0);
    return photons;
}

/* `got` is right if it is within BOUND standard errors, which are below `sharp` of `right`. */
static void assert_statistic(const char *what, double got, double right, double error, double sharp)
{
    print_message("%s: %.6f, exact %.6f, %.2f standard errors of %.2g\n", what, got, right,
                  (got - right) / error, error);
    assert_true(error > 0.0 && error < sharp * right);
    assert_true(fabs(got - right) < BOUND * error);
}

/* The same for the mean over seeds. */
static void assert_mean(const char *what, const double *got, double right, double sharp)
{
    double mean = 0.0, square = 0.0;
    for (int i = 0; i < SEEDS; i++) {
        mean += got[i] / SEEDS;
    }
    for (int i = 0; i < SEEDS; i++) {
        square += (got[i] - mean) * (got[i] - mean) / (SEEDS - 1);
    }
    assert_statistic(what, mean, right, sqrt(square / SEEDS), sharp);
}

/* ------------------------------------------------------------ closed forms ---- */

/* Between equal parallel rectangles of sides x and y at distance 1: Howell's catalogue, C-11. */
static double plates_form_factor(double x, double y)
{
    const double x1 = sqrt(1.0 + x * x), y1 = sqrt(1.0 + y * y);
    return 2.0 / (PI * x * y) *
           (log(x1 * y1 / sqrt(1.0 + x * x + y * y)) + x * y1 * atan(x / y1) +
            y * x1 * atan(y / x1) - x * atan(x) - y * atan(y));
}

/* The form factor from a point of the floor to the ceiling of the unit cube, in the mean over a
 * disc: the midpoint rule in r^2 and angle, converged to 1e-6. */
static double mean_over_disc(double x, double z, double radius)
{
    enum { RINGS = 64, SPOKES = 64 };
    double sum = 0.0;
    for (int i = 0; i < RINGS; i++) {
        for (int j = 0; j < SPOKES; j++) {
            const double r = radius * sqrt((i + 0.5) / RINGS), angle = 2.0 * PI * j / SPOKES;
            sum += ceiling_form_factor(x + r * cos(angle), z + r * sin(angle));
        }
    }
    return sum / (RINGS * SPOKES);
}

/* ------------------------------------------------------------------- tests ---- */

/* A lit ceiling over a black floor. */
static void plates(void **state)
{
    (void)state;
    room r;
    make_room(&r, 2, 2);
    const struct light light = face_light(&r, 3, 0.0);
    const struct photon_run run = {
        .lights = {&light, 1}, .photons = 1000000, .seed = 1, .threads = 2};
    accel *a = build(&r.scene, "linear");
    struct photons photons = trace(a, &r.scene, &run);
    const double n = run.photons, right = plates_form_factor(1.0, 1.0);
    assert_statistic("form factor of opposite faces of a cube", (double)photons.count / n, right,
                     sqrt(right * (1.0 - right) / n), 0.01);
    assert_true(photons.count == photons.absorbed);

    const double radius = 0.15;
    const struct receiver points[3] = {
        {{0.5, 0.0, 0.5}, {0, 1, 0}}, {{0.2, 0.0, 0.5}, {0, 1, 0}}, {{0.8, 0.0, 0.2}, {0, 1, 0}}};
    const struct receivers receivers = {points, 3};
    double by_paths[3], by_nearest[3];
    accel_query query = {.user = NULL};
    accel_error error;
    assert_true(
        irradiance_paths(&photons, &run, receivers, radius, "linear", by_paths, &query, &error));
    assert_true(irradiance_nearest(&photons, &run, receivers, radius, 1000000, by_nearest));
    for (int i = 0; i < 3; i++) {
        const double mean = mean_over_disc(points[i].at[0], points[i].at[2], radius);
        const double chance = mean * PI * radius * radius;
        const double spread = sqrt(chance * (1.0 - chance) / n) / (PI * radius * radius);
        assert_statistic("irradiance by paths", by_paths[i], mean, spread, 0.02);
        assert_statistic("irradiance by all photons near", by_nearest[i], mean, spread, 0.02);
    }
    photons_free(&photons);
    accel_free(a);
}

/* A closed box whose faces emit 1 per area and reflect: E = 1 / (1 - reflectance) everywhere. The
 * lights stand 2^-30 inside, which takes that part of the light off a strip of that width.
 *
 * What the extension of paths by one radius R does shows in two places. On the edge between floor
 * and wall the half disc behind the wall gets, at the depth x = R cos(a), the part
 * (a - sin a cos a) / pi of E, from directions within a of the wall's normal; integrated over the
 * half disc that is 1/8, so the estimate is 1/2 + 1/8 of E. And h < R below the floor the paths
 * within acos(h / R) of its normal still arrive: 1 - (h / R)^2 of E leaks through. */
static void furnace(void **state)
{
    (void)state;
    room r;
    make_room(&r, 0, 5);
    struct light lights[6];
    for (int f = 0; f < 6; f++) {
        lights[f] = face_light(&r, f, 0x1p-30);
    }
    struct photon_run run = {
        .lights = {lights, 6}, .photons = 10000, .reflectance = 0.5, .threads = 2};
    const struct receiver points[4] = {{{0.5, 0.0, 0.5}, {0, 1, 0}},
                                       {{0.0, 0.3, 0.6}, {1, 0, 0}},
                                       {{0.0, 0.0, 0.5}, {0, 1, 0}},
                                       {{0.5, -0.1, 0.5}, {0, 1, 0}}};
    static const double right[4] = {2.0, 2.0, 2.0 * (0.5 + 0.125), 2.0 * (1.0 - 0.25)};
    accel *a = build(&r.scene, "linear");
    /* few photons each, over the whole floor: a bias of 1/20 would show */
    struct receiver floor[64];
    for (int i = 0; i < 64; i++) {
        floor[i] = (struct receiver){{(i % 8 + 0.5) / 8, 0, (i / 8 + 0.5) / 8}, {0, 1, 0}};
    }
    double mean[SEEDS], few[SEEDS], paths[4][SEEDS], nearest[2][SEEDS];
    for (int i = 0; i < SEEDS; i++) {
        run.seed = (uint64_t)i;
        struct photons photons = trace(a, &r.scene, &run);
        double by_paths[4], by_nearest[2];
        accel_query query = {.user = NULL};
        accel_error error;
        assert_int_equal(photons.escaped, 0); /* the box is closed */
        mean[i] = (double)photons.count * photon_power(&run, 0) / 6.0;
        assert_true(irradiance_paths(&photons, &run, (struct receivers){points, 4}, 0.2, "linear",
                                     by_paths, &query, &error));
        assert_true(irradiance_nearest(&photons, &run, (struct receivers){points, 2}, 0.3, 1500,
                                       by_nearest));
        double by_few[64];
        assert_true(
            irradiance_nearest(&photons, &run, (struct receivers){floor, 64}, 0.05, 20, by_few));
        few[i] = 0.0;
        for (int k = 0; k < 64; k++) {
            few[i] += by_few[k] / 64;
        }
        for (int k = 0; k < 4; k++) {
            paths[k][i] = by_paths[k];
        }
        nearest[0][i] = by_nearest[0];
        nearest[1][i] = by_nearest[1];
        photons_free(&photons);
    }
    assert_mean("furnace, mean of all walls", mean, 2.0, 0.01);
    assert_mean("furnace, by 20 photons", few, 2.0, 0.01);
    for (int k = 0; k < 4; k++) {
        assert_mean("furnace, by paths", paths[k], right[k], 0.01);
    }
    assert_mean("furnace, by nearest photons", nearest[0], 2.0, 0.01);
    assert_mean("furnace, by nearest photons", nearest[1], 2.0, 0.01);
    accel_free(a);
}

/* Within a sphere nothing escapes, and reflected light falls evenly on it whatever the source. */
static void integrating_sphere(void **state)
{
    (void)state;
    const double ball[4] = {1.0, 2.0, 3.0, 2.0};
    const accel_geometry geometry = {.type = ACCEL_SPHERES,
                                     .spheres = {.spheres = ball, .count = 1}};
    const accel_scene scene = {&geometry, 1};
    const struct light light = {{1.5, 2.0, 3.0}, {{0.5, 0, 0}, {0, 0.5, 0}}, 1.0};
    const struct photon_run run = {
        .lights = {&light, 1}, .photons = 100000, .reflectance = 0.8, .seed = 3, .threads = 2};
    accel *a = build(&scene, "linear");
    struct photons photons = trace(a, &scene, &run);
    double sum[3] = {0.0, 0.0, 0.0};
    size_t count = 0;
    for (size_t i = 0; i < photons.count; i++) {
        count += photons.at[i].bounce > 0;
        for (int k = 0; k < 3 && photons.at[i].bounce > 0; k++) {
            sum[k] += photons.at[i].at[k];
        }
    }
    assert_int_equal(photons.escaped, 0);
    /* a coordinate of an even point has the variance radius^2 / 3, and points are independent */
    for (int k = 0; k < 3; k++) {
        assert_statistic("mean coordinate", sum[k] / (double)count, ball[k],
                         sqrt(4.0 / 3.0 / (double)count), 0.01);
    }
    photons_free(&photons);
    accel_free(a);
}

/* What is emitted is absorbed or escapes: by number, by power, and by what the list itself says. */
static void energy_balance(void **state)
{
    (void)state;
    room r;
    make_room(&r, 0, 3); /* open in front and behind */
    const struct light lights[2] = {face_light(&r, 4, 0.0), face_light(&r, 5, 0.0)};
    const struct photon_run run = {
        .lights = {lights, 2}, .photons = 50000, .reflectance = 0.7, .seed = 5, .threads = 2};
    accel *a = build(&r.scene, "linear");
    struct photons photons = trace(a, &r.scene, &run);
    uint64_t paths = 0;
    double first = 0.0, reflected = 0.0;
    for (size_t i = 0; i < photons.count; i++) {
        const struct photon *p = &photons.at[i];
        const double power = photon_power(&run, p->light);
        paths += p->bounce == 0;
        first += p->bounce == 0 ? power : 0.0;
        reflected += p->bounce == 0 ? 0.0 : power;
        if (p->bounce > 0) {
            assert_true(i > 0 && p[-1].number == p->number && p[-1].light == p->light &&
                        p[-1].bounce == p->bounce - 1);
        }
    }
    assert_true(photons.escaped > 0 && photons.absorbed > 0);
    assert_int_equal(photons.emitted, photons.absorbed + photons.escaped);
    assert_int_equal(photons.rays, photons.count + photons.escaped);
    assert_int_equal(photons.rays - photons.emitted, photons.count - photons.absorbed);
    /* arrived = absorbed + sent on; each of up to 2^18 additions rounds by 2^-53 */
    const double absorbed = (double)photons.absorbed * photon_power(&run, 0);
    const double sent_on = (double)(photons.rays - photons.emitted) * photon_power(&run, 0);
    assert_true(paths <= photons.emitted);
    assert_true(fabs(first + reflected - absorbed - sent_on) <
                (first + reflected) * 0x1p18 * 0x1p-53);
    photons_free(&photons);
    accel_free(a);
}

/* Discs on the faces of a corner cube of the first cluster, many of them across each other. */
static void make_discs(struct receiver discs[DISCS])
{
    for (int i = 0; i < DISCS; i++) {
        const double along = (i / 3) * 0.1;
        discs[i] = (struct receiver){.at = {along, 14.0 + along, along}};
        discs[i].at[i % 3] = i % 3 == 1 ? 15.0 : 0.0;
        discs[i].normal[i % 3] = i % 3 == 1 ? 1.0 : -1.0;
    }
}

/* Every kind, and any number of threads, stores the same bits and finds the same irradiance. */
static void same_bits(void **state)
{
    (void)state;
    struct loaded loaded;
    accel_error error;
    assert_true(load_scene(&loaded, "cubes:gap=4", NULL, NULL, &error));
    struct light lights[MOST_LIGHTS];
    struct photon_run run = {.lights = {lights, 0}, .photons = 3000, .reflectance = 0.8, .seed = 7};
    run.lights.count = scene_lights("cubes:gap=4", &loaded.scene, lights);
    assert_int_equal(run.lights.count, 2);
    struct receiver discs[DISCS];
    make_discs(discs);
    double first[DISCS], again[DISCS], sum = 0.0;
    size_t kinds;
    const accel_kind_info *const *kind = accel_kinds(&kinds);
    uint64_t hash = 0;
    for (size_t i = 0; i < kinds; i++) {
        accel *a = build(&loaded.scene, kind[i]->name);
        for (unsigned threads = 1; threads <= 7; threads += 3) {
            run.threads = threads;
            struct photons photons = trace(a, &loaded.scene, &run);
            hash = hash == 0 ? photons_hash(&photons) : hash;
            assert_true(photons.count > 3000);
            assert_true(hash == photons_hash(&photons));
            accel_query query = {.user = NULL};
            assert_true(irradiance_paths(&photons, &run, (struct receivers){discs, DISCS}, 1.5,
                                         kind[i]->name, again, &query, &error));
            if (i == 0 && threads == 1) {
                memcpy(first, again, sizeof first);
            }
            assert_memory_equal(first, again, sizeof first);
            photons_free(&photons);
        }
        accel_free(a);
    }
    for (int i = 0; i < DISCS; i++) {
        sum += first[i] > 0.0;
    }
    assert_true(sum >= DISCS / 4); /* those that face the light are lit */
    unload_scene(&loaded);
}

/* The irradiance that one path of power 1 leaves on a disc of radius 1 around the origin, facing
 * up, times pi: the number of crossings counted. */
static double crossings(double x, double y, double z, double dx, double dy, double dz,
                        double length)
{
    struct photon photon = {.dir = {dx, dy, dz}, .length = length};
    const double org[3] = {x, y, z};
    for (int k = 0; k < 3; k++) {
        photon.at[k] = org[k] + length * photon.dir[k];
    }
    const struct light light = {.power = 1.0};
    const struct photons photons = {.at = &photon, .count = 1};
    const struct photon_run run = {.lights = {&light, 1}, .photons = 1, .threads = 1};
    const struct receiver receiver = {{0, 0, 0}, {0, 1, 0}};
    double irradiance;
    accel_query query = {.user = NULL};
    accel_error error;
    assert_true(irradiance_paths(&photons, &run, (struct receivers){&receiver, 1}, 1.0, "linear",
                                 &irradiance, &query, &error));
    return irradiance * acos(-1.0);
}

/* The rule for crossing a disc, path by path. */
static void crossing_rule(void **state)
{
    (void)state;
    assert_true(crossings(0.5, 2, 0, 0, -1, 0, 2) == 1); /* ends on the plane */
    assert_true(crossings(0.5, 2, 0, 0, -1, 0, 9) == 1); /* goes through */
    assert_true(crossings(0.5, -2, 0, 0, 1, 0, 9) == 0); /* from behind */
    assert_true(crossings(0.5, 0, 0, 0, 1, 0, 9) == 0);  /* leaves the plane */
    assert_true(crossings(0.5, 0, 0, 0, -1, 0, 9) == 0); /* begins on the plane */
    assert_true(crossings(-3, 0.5, 0, 1, 0, 0, 9) == 0); /* along it */
    assert_true(crossings(1, 2, 0, 0, -1, 0, 2) == 0);   /* at the radius: half-open */
    assert_true(crossings(1 - 0x1p-53, 2, 0, 0, -1, 0, 2) == 1);
    assert_true(crossings(0.5, 2, 0, 0, -1, 0, 1.125) == 1);      /* stops short by less than it */
    assert_true(crossings(0.5, 2, 0, 0, -1, 0, 1) == 0);          /* by the radius */
    assert_true(crossings(-0.8, 0.6, 0, 0.8, -0.6, 0, 0.5) == 1); /* tilted */
}

/* One photon of power 1 at the height 0.6, seen from the origin: irradiance times pi times the
 * square of the distance that the estimate divides by. */
static double near_power(double dy, double radius, uint32_t nearest)
{
    struct photon photon = {.at = {0, 0.6, 0.8}, .dir = {0, dy, 0}, .length = 1};
    const struct light light = {.power = 1.0};
    const struct photons photons = {.at = &photon, .count = 1};
    const struct photon_run run = {.lights = {&light, 1}, .photons = 1, .threads = 1};
    const struct receiver receiver = {{0, 0, 0}, {0, 1, 0}};
    double irradiance;
    assert_true(irradiance_nearest(&photons, &run, (struct receivers){&receiver, 1}, radius,
                                   nearest, &irradiance));
    return irradiance * acos(-1.0);
}

/* Which photons the nearest ones are. */
static void nearest_rule(void **state)
{
    (void)state;
    assert_true(near_power(-1, 2.0, 5) == 0.25); /* fewer than 5: all within the radius */
    assert_true(near_power(1, 2.0, 5) == 0.0);   /* from behind */
    assert_true(near_power(-1, 0.99, 5) == 0.0); /* too far */
    assert_true(near_power(-1, 2.0, 1) == 0.0);  /* the last of `nearest` gives the distance only */
}

/* A light that a user types. */
static void reading_lights(void **state)
{
    (void)state;
    struct light light;
    assert_null(light_read("1,2,3:4,0,0:0,0,5", &light));
    assert_true(light.corner[2] == 3.0 && light.edge[0][0] == 4.0 && light.edge[1][2] == 5.0 &&
                light.power == 1.0);
    assert_null(light_read("1,2,3:4,0,0:0,0,5:2.5", &light));
    assert_true(light.power == 2.5);
    static const char *const wrong[] = {"",
                                        "1,2,3",
                                        "1,2,3:4,0,0",
                                        "1,2:4,0,0:0,0,5",
                                        "1,2,3:4,0,0:8,0,0",
                                        "a,b,c:d:e",
                                        "1,2,3,4:4,0,0:0",
                                        "1,2,3:4,0,0:0,0,5:0",
                                        "1,2,3:4,0,0:0,0,5:-1",
                                        "1,2,3:4,0,0:0,0,5:1:1",
                                        "1,2,3:4,0,0:0,0,nan",
                                        "1,2,3:4,0,0:0,0,5:1,1"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_non_null(light_read(wrong[i], &light));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plates),
        cmocka_unit_test(furnace),
        cmocka_unit_test(integrating_sphere),
        cmocka_unit_test(energy_balance),
        cmocka_unit_test(same_bits),
        cmocka_unit_test(crossing_rule),
        cmocka_unit_test(nearest_rule),
        cmocka_unit_test(reading_lights),
    };
    return cmocka_run_group_tests_name("photons", tests, NULL, NULL);
}
