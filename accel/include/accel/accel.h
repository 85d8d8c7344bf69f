/* SPDX-License-Identifier: Apache-2.0
 *
 * accel: exact ray-tracing acceleration structures behind one C interface.
 *
 *     accel_geometry mesh = {.type = ACCEL_TRIANGLES,
 *                            .triangles = {.vertices = xyz, .vertex_count = n,
 *                                          .indices = abc, .count = m}};
 *     accel_scene scene = {&mesh, 1};
 *     accel *a;
 *     accel_error error;
 *     if (accel_build(&a, &scene, "hoo:leaf=8", NULL, &error) != ACCEL_OK)
 *         return complain(error.text);
 *     accel_ray ray = accel_ray_from(eye, direction);
 *     accel_hit hit;
 *     if (accel_closest(a, &ray, &hit, NULL))
 *         printf("triangle %u at t = %.17g\n", hit.prim, hit.t);
 *     accel_free(a);
 *
 * The contract: every kind of structure returns the answer of the kind "linear", which tests every
 * primitive in order, bit for bit. Hits are ordered by (t, geometry, primitive), so ties go to the
 * lowest geometry, then to the lowest primitive. The interval is open: tmin < t < tmax. There is no
 * epsilon: a ray that leaves a surface names the primitive that it leaves in ray.skip, also where
 * it goes on into glass. Examples stand with accel_intersect and accel_closest; all of them are
 * compiled and run by the tests.
 *
 * Lengths are in the caller's units, in double; t is in units of |dir|, which need not be 1.
 *
 * Threads: a built accel is immutable. Any number of threads may query it at the same time, each
 * with its own accel_query. Builds of different structures are independent.
 *
 * Lazy structures (hoo:lazy=on) are built where rays go: the query that first enters a part builds
 * it, in the floating-point environment of accel_build. Answers, errors and what is built are the
 * same whichever query comes first and however many threads there are; no query waits for another.
 * Three rules differ. Memory: queries allocate, by accel_hooks.resize, which several threads then
 * call at the same time; threads that enter a part together each build it, and all but one free
 * theirs. Errors: a query that gets no memory tests the part's primitives one by one, so its answer
 * is the same, and later queries try to build again. Hooks: accel_build's progress and cancellation
 * do not cover what queries build. No callback of the scene is called by building, only by testing;
 * boxes were copied.
 *
 * The library never prints, exits or aborts, and has no global state. The host's locale has no say:
 * numbers are read and written as in the C locale.
 *
 * Floating point: accel_build, accel_validate and what the queries of a lazy structure build run in
 * the default environment (to nearest, nothing flushed to zero, no traps), whatever the caller's,
 * which is restored with its flags. So a scene and a config make the same structure in every mode,
 * and it is sound in every mode. The other functions run in the caller's environment: under another
 * rounding mode or flush-to-zero answers may differ from those of another mode, but every kind
 * still equals "linear" in that mode. Exceptions must not trap there: infinities and NaN are used
 * as values.
 *
 * A NULL where something has to be is told as an error where there is an accel_error or a status to
 * tell it by. A query without a structure, ray, point or visitor is refused as a ray that is not
 * valid: it finds nothing and is counted in accel_query.refused. What describes nothing says
 * nothing: accel_padded_box returns false, accel_describe fills in zeros and "" as the kind. All
 * other pointers must be valid; none of a structure that was freed is.
 */
#ifndef ACCEL_H
#define ACCEL_H

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Of this header; accel_version tells that of the library. While MAJOR is 0, each MINOR may break
 * the one before. */
#define ACCEL_VERSION_MAJOR                      0
#define ACCEL_VERSION_MINOR                      1
#define ACCEL_VERSION_PATCH                      0
#define ACCEL_VERSION_TEXT_(major, minor, patch) #major "." #minor "." #patch
#define ACCEL_VERSION_TEXT(major, minor, patch)  ACCEL_VERSION_TEXT_(major, minor, patch)
#define ACCEL_VERSION                                                                              \
    ACCEL_VERSION_TEXT(ACCEL_VERSION_MAJOR, ACCEL_VERSION_MINOR, ACCEL_VERSION_PATCH)

#if defined(__GNUC__)
#define ACCEL_API __attribute__((visibility("default")))
#else
#define ACCEL_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* The version of the library that is linked, such as "0.1.0". */
ACCEL_API const char *accel_version(void);

/* A built structure. Made by accel_build, ended by accel_free. */
typedef struct accel accel;

/* No geometry, no primitive: see accel_id. */
#define ACCEL_NONE UINT32_MAX

/* Coordinates beyond this magnitude (2^1000) are out of range: see accel_build. In the box of an
 * object they count as infinite. */
#define ACCEL_MAX_COORDINATE 0x1p1000

/* ---------------------------------------------------------------- errors ---- */

typedef enum accel_status {
    ACCEL_OK = 0,
    ACCEL_BAD_ARGUMENT, /* a NULL, a bad stride, an index past its vertices */
    ACCEL_BAD_CONFIG,   /* the config string: unknown kind or key, repeat, range, trailing text */
    ACCEL_NO_MEMORY,    /* the allocator said no, or accel_hooks.memory_limit */
    ACCEL_TOO_LARGE,    /* over 2^32 - 2 primitives (2^24 - 2 with 32 bits), 2^32 - 1 references */
    ACCEL_CANCELLED,    /* the progress hook said stop */
    ACCEL_BROKEN /* accel_validate found what must not be: a bug in the library, or memory that
                  * was overwritten; accel_build found the library compiled so that answers
                  * are wrong: see there */
} accel_status;

/* One line of printable UTF-8: where, what was found, what is allowed, what happened. Of a config
 * that is quoted, what is not printable is shown as '?'. */
typedef struct accel_error {
    accel_status status;
    char text[500];
} accel_error;

/* ----------------------------------------------------------------- scene ---- */

/* A closed axis-aligned box. lo[k] <= hi[k]; infinite sides are allowed for objects. */
typedef struct accel_box {
    double lo[3], hi[3];
} accel_box;

/* Names a primitive: the index of its geometry in the scene, and its index in the geometry. */
typedef struct accel_id {
    uint32_t geom, prim;
} accel_id;

/* A ray: the points org + t * dir with tmin < t < tmax.
 *
 * A ray that goes on from a hit starts where the hit is, but for rounding, and names in `skip` what
 * it leaves, which it would hit again otherwise. A triangle is left out as a whole. Of a sphere one
 * crossing is left out, the one nearest to t = 0 on either side, whatever the interval: a ray that
 * goes on into the sphere meets its far side, and one that goes outward does not meet it again. One
 * that hardly goes inward may pass by a sphere that its origin was rounded out of: keep no account
 * of what a ray is in, see by the normal from which side it hits. An object's callback is called,
 * and leaves out the same: see accel_intersect.
 *
 * A ray whose org or dir is not finite, whose dir is zero, or whose tmin or tmax is NaN hits
 * nothing and is counted in accel_query.refused. Make one with accel_ray_from. */
typedef struct accel_ray {
    double org[3]; /* origin */
    double dir[3]; /* direction, any length but zero */
    double tmin;   /* exclusive; may be negative or -INFINITY */
    double tmax;   /* exclusive; may be INFINITY */
    accel_id skip; /* the primitive that the ray leaves; {ACCEL_NONE, ACCEL_NONE} for none */
} accel_ray;

/* The ray from org along dir, 0 < t < infinity, skipping nothing. */
static inline accel_ray accel_ray_from(const double *org, const double *dir)
{
    accel_ray ray;
    for (int k = 0; k < 3; k++) {
        ray.org[k] = org[k];
        ray.dir[k] = dir[k];
    }
    ray.tmin = 0.0;
    ray.tmax = (double)INFINITY;
    ray.skip.geom = ACCEL_NONE;
    ray.skip.prim = ACCEL_NONE;
    return ray;
}

/* A hit. u, v: for triangles the barycentric weights of the second and third vertex; for spheres
 * 0 and 0; for objects whatever the callback reported. */
typedef struct accel_hit {
    double t, u, v;
    uint32_t geom, prim;
} accel_hit;

/* Triangles over the caller's arrays, which are copied: they may go once accel_build returns.
 * Triangle i has the vertices indices[3i], indices[3i+1], indices[3i+2].
 * The test is the watertight shear test of Woop, Benthin and Wald (JCGT 2(1), 2013) in double,
 * redone in wider precision where an edge function is zero: closed meshes do not leak. Both sides
 * of a triangle are hit; one seen exactly edge-on is not. */
typedef struct accel_triangles {
    const void *vertices;    /* x, y, z of vertex j start at byte j * vertex_stride */
    bool vertices_are_float; /* x, y, z are float, otherwise double */
    size_t vertex_stride;    /* bytes; 0 stands for tightly packed */
    uint32_t vertex_count;
    const uint32_t *indices; /* 3 * count of them, each < vertex_count */
    uint32_t count;          /* triangles */
} accel_triangles;

/* Spheres, copied. Both crossings are hits. Roots after Hearn and Baker as in Haines et al.,
 * "Precision improvements for ray/sphere intersection", Ray Tracing Gems, 2019. */
typedef struct accel_spheres {
    const double *spheres; /* x, y, z, radius of sphere i start at byte i * stride; radius > 0 */
    size_t stride;         /* bytes; 0 stands for tightly packed */
    uint32_t count;
} accel_spheres;

/* How the hits that a callback reports are ordered. */
typedef enum accel_order {
    /* By t clamped into the interval in which the ray is inside the object's padded box. hit.t is
     * the t as reported. Every kind agrees by construction, whatever the callback reports. */
    ACCEL_ORDER_KEY = 0,
    /* By t as reported. Every kind agrees as long as no t lies before the ray enters the object's
     * box; each one that does is counted in accel_query.outside. Pad the boxes by what your solver
     * can be wrong. */
    ACCEL_ORDER_RAW
} accel_order;

typedef struct accel_query accel_query;

/* What an object's callback sees of one query, and where it reports its hits. It may be copied;
 * copies end with the original, when the callback returns. */
typedef struct accel_probe {
    const accel_ray *ray; /* the caller's ray */
    void *user;           /* accel_objects.user */
    accel_query *query;   /* the caller's accel_query, or NULL */
    uint32_t prim;        /* index of the object in its geometry */
    bool skip;            /* the ray leaves this object: leave out its crossing nearest to t = 0 */
    double limit;         /* a hit with t > limit cannot matter; one with t == limit may */
    void *library;        /* the library's: how accel_report finds the query */
} accel_probe;

/* Tests one object: calls accel_report for each hit in the ray's interval, in any order. It may
 * run queries on this or any other structure, and may leave by a C++ exception: the library holds
 * nothing across the call.
 *
 * In one query an object may be tested more than once, and objects are tested in another order by
 * each kind, or not at all: so what a callback keeps may depend only on what accel_report returns,
 * and is written over, never added to.
 *
 * Of an object that the ray leaves (probe->skip) the crossing nearest to t = 0 is not reported. How
 * small a t is does not tell which one that is, but the way that the ray goes does: of a convex
 * object, where the ray enters it if it goes inward, else where it comes out. An open object that
 * has but one crossing reports none.
 *
 * Example, a ball of the host's, with what is needed to shade it:
 *
 *     struct ball {
 *         double centre[3], radius;
 *         double index; // of refraction; 0: a mirror
 *     };
 *
 *     struct shading {
 *         double normal[3];
 *     };
 *
 *     static void intersect_ball(accel_probe *probe)
 *     {
 *         const struct ball *ball = (const struct ball *)probe->user + probe->prim;
 *         const double *org = probe->ray->org, *dir = probe->ray->dir;
 *         const double square = ball->radius * ball->radius;
 *         double f[3], a = 0, b = 0, c = -square, discriminant = square;
 *         for (int k = 0; k < 3; k++) {
 *             f[k] = org[k] - ball->centre[k];
 *             a += dir[k] * dir[k];
 *             b -= f[k] * dir[k];
 *             c += f[k] * f[k];
 *         }
 *         for (int k = 0; k < 3; k++) {
 *             const double nearest = f[k] + b / a * dir[k];
 *             discriminant -= nearest * nearest;
 *         }
 *         if (!(discriminant >= 0))
 *             return;
 *         const double side = sqrt(a * discriminant), root = b > 0 ? b + side : b - side;
 *         const double t[2] = {root != 0 ? c / root : 0, root / a}; // the nearer to 0 first
 *         for (int i = probe->skip ? 1 : 0; i < 2; i++) {
 *             if (t[i] > probe->limit || !accel_report(probe, t[i], 0, 0))
 *                 continue;
 *             // A closest query: the best so far. Others have no use for it.
 *             struct shading *s = (struct shading *)(probe->query ? probe->query->user : NULL);
 *             for (int k = 0; s && k < 3; k++)
 *                 s->normal[k] = (f[k] + t[i] * dir[k]) / ball->radius;
 *         }
 *     }
 */
typedef void accel_intersect(accel_probe *probe);

/* Reports a hit of the probed object. Returns true if the hit counts for now: for a closest query
 * it is the best so far (the last for which it is true is the answer: keep what you need to shade
 * it), for others it is accepted. A t outside the ray's interval or NaN is ignored. Only inside
 * accel_intersect; to NULL nothing is reported. */
ACCEL_API bool accel_report(accel_probe *probe, double t, double u, double v);

/* Host objects: the library knows their boxes (copied) and asks back for the hits. */
typedef struct accel_objects {
    const accel_box *boxes; /* infinite sides: tested for every ray; an inverted box is invalid */
    uint32_t count;
    accel_order order;
    accel_intersect *intersect;
    void *user;  /* handed to intersect */
    double cost; /* nanoseconds of one call of intersect, about; 0: not known. For "auto" */
} accel_objects;

typedef enum accel_type { ACCEL_TRIANGLES = 0, ACCEL_SPHERES, ACCEL_OBJECTS } accel_type;

typedef struct accel_geometry {
    accel_type type;
    union {
        accel_triangles triangles;
        accel_spheres spheres;
        accel_objects objects;
    };
} accel_geometry;

typedef struct accel_scene {
    const accel_geometry *geometries;
    uint32_t count;
} accel_scene;

/* ----------------------------------------------------------------- build ---- */

/* All hooks are optional; set what is not used to zero. Functions must return normally (no
 * exceptions, no longjmp), and run in the default floating-point environment while the library
 * builds. */
typedef struct accel_hooks {
    void *user; /* handed to both functions */
    /* Lua's allocator in one function: to == 0 frees and returns NULL; old == NULL allocates;
     * otherwise resizes. Returns NULL if it cannot, leaving the old block alone. Blocks are aligned
     * as malloc's are. NULL: realloc.
     * Called from the thread that runs accel_build or accel_free; kept until accel_free. Of a
     * lazy structure called by queries too, from many threads at the same time: it must be
     * thread-safe, and may not query that structure. */
    void *(*resize)(void *user, void *old, size_t from, size_t to);
    /* Called about every 10 ms of a build, or once in each pass over the primitives of a large cell
     * where that takes longer (a tenth of a second at 2 million), with the name of the phase and
     * its done part in 0..1, which never falls within a phase; the next phase, of another name,
     * starts at 0 again. Return false to cancel. Never called by queries. */
    bool (*progress)(void *user, const char *phase, double done);
    /* First rays that will come, such as every so many-th of a camera, `pilot_count` of them; of
     * more than 64, or then 256, every so many-th is taken. The kind "auto" counts what they, and rays that go
     * on from what they hit, would visit before it chooses; they decide no answer. Read during
     * accel_build only. */
    const accel_ray *pilot;
    size_t pilot_count;
    /* Most bytes that the build may hold at a time, by the sizes that `resize` is asked for, what
     * accel_build returns among them; 0: no limit. A build that needs more ends with
     * ACCEL_NO_MEMORY, and the error says how much it needed and in which phase: accel_estimate
     * tells before. What queries of a lazy structure build is not counted. */
    size_t memory_limit;
    /* Threads that a build may use, the calling one among them; 0: one for each processor. They end
     * with the build, call no hook, and change no byte of what is built. */
    unsigned threads;
} accel_hooks;

/* Builds the structure that `config` names over `scene`.
 *
 * config: "kind[:key=value[,key=value]...]", for example "octree:leaf=12,depth=10"; accel_kinds
 * lists what there is. NULL or "" stand for ACCEL_DEFAULT_CONFIG. No option ever has to be given.
 *
 * Triangles and spheres with a coordinate that is NaN, infinite or beyond ACCEL_MAX_COORDINATE or
 * with a radius that is not positive, and objects with a NaN in their box or an inverted one, are
 * skipped, counted and their first ids kept in accel_info; so are, counted apart, triangles with
 * two equal vertices, which no ray can hit. Ids of the others do not change.
 *
 * Returns ACCEL_OK and stores the structure in *out, which the caller ends with accel_free.
 * Otherwise returns why, sets *out to NULL, fills *error (which may be NULL) and holds nothing.
 * Errors: ACCEL_BAD_ARGUMENT, ACCEL_BAD_CONFIG, ACCEL_NO_MEMORY, ACCEL_TOO_LARGE, ACCEL_CANCELLED;
 * ACCEL_BROKEN of a library that was compiled with products and sums contracted into one rounding,
 * as gcc does by hand with -march=native: -ffp-contract=off, which the CMake build sets, mends it.
 */
ACCEL_API accel_status accel_build(accel **out, const accel_scene *scene, const char *config,
                                   const accel_hooks *hooks, accel_error *error);

#define ACCEL_DEFAULT_CONFIG "auto"

/* What a structure will take. */
typedef struct accel_size {
    uint64_t bytes;      /* accel_info.bytes, once it is built */
    uint64_t peak_bytes; /* accel_info.peak_bytes: what accel_hooks.memory_limit must allow */
    bool exact;          /* both are what the build will tell, to the byte */
} accel_size;

/* Tells what `config` over `scene` will take, before it is built.
 *
 * Of up to 32,768 primitives that is found by building it, and exact. Of more, 16 parts are built,
 * each the 2,048 primitives around one that is drawn, and what a primitive takes in them is taken
 * to be what each takes; what that is expected to be wrong by is added. So on all meshes and
 * scenes of the tests `bytes` is not below what is used, and at most 10 % above it; for grid and
 * hug, whose cells lie over the whole, up to 25 % above, for hug up to 10 % below. `peak_bytes` is
 * as good for the wide forms, and a guess for the others, whose arrays grow by half. That is no
 * proof: where a few primitives are unlike all others, draws may miss them. What holds in any case
 * is memory_limit. Of auto the largest kind is told that it chooses among.
 *
 * Takes two passes over the scene and some tens of milliseconds; allocates up to 24 MB by
 * hooks->resize, and holds nothing when it returns. hooks, the errors and *error are those of
 * accel_build, but that progress is told of the passes only, and memory_limit does not matter;
 * *size, which must not be NULL, is set to zero with an error. */
ACCEL_API accel_status accel_estimate(const accel_scene *scene, const char *config,
                                      const accel_hooks *hooks, accel_size *size,
                                      accel_error *error);

/* Ends `a` and frees all that it holds. NULL is allowed. No query may be running. */
ACCEL_API void accel_free(accel *a);

/* --------------------------------------------------------------- queries ---- */

/* One per thread, optional in every query. Set it to zero once; the library only adds to it. */
struct accel_query {
    void *user;       /* the caller's, for its callbacks */
    uint64_t nodes;   /* nodes and cells visited */
    uint64_t tests;   /* primitives tested */
    uint64_t refused; /* rays that were not valid: see accel_ray */
    uint64_t outside; /* raw hits before their object's padded box: see ACCEL_ORDER_RAW */
};

/* Finds the nearest hit. Returns true and fills *hit, which may be NULL, or returns false and
 * leaves *hit alone.
 *
 * Example, a ray that follows mirrors and glass until it leaves the scene of balls from above
 * (ray.dir has length 1); returns how often it was reflected or refracted:
 *
 *     static int follow(const accel *a, const struct ball *balls, accel_ray *ray)
 *     {
 *         struct shading s;
 *         accel_query query = {&s, 0, 0, 0, 0};
 *         accel_hit hit;
 *         int turns = 0;
 *         for (; turns < 1000 && accel_closest(a, ray, &hit, &query); turns++) {
 *             double at[3], dir[3], cosine = 0; // above 0: from outside
 *             for (int k = 0; k < 3; k++) {
 *                 at[k] = ray->org[k] + hit.t * ray->dir[k];
 *                 cosine -= ray->dir[k] * s.normal[k];
 *             }
 *             const double index = balls[hit.prim].index;
 *             const double ratio = cosine > 0 ? 1 / index : index;
 *             const double square = 1 - ratio * ratio * (1 - cosine * cosine);
 *             const bool reflected = index == 0 || square < 0; // a mirror, or total reflection
 *             const double along = reflected ? 1 : ratio;
 *             const double away =
 *                 reflected ? 2 * cosine : ratio * cosine - copysign(sqrt(square), cosine);
 *             for (int k = 0; k < 3; k++)
 *                 dir[k] = along * ray->dir[k] + away * s.normal[k];
 *             *ray = accel_ray_from(at, dir);
 *             ray->skip.geom = hit.geom; // goes on inward or outward, whichever: no epsilon
 *             ray->skip.prim = hit.prim;
 *         }
 *         return turns;
 *     }
 */
ACCEL_API bool accel_closest(const accel *a, const accel_ray *ray, accel_hit *hit,
                             accel_query *query);

/* Is there any hit in the ray's interval? The same as accel_closest finding one, but sooner. */
ACCEL_API bool accel_any(const accel *a, const accel_ray *ray, accel_query *query);

/* The same for `count` rays that stand side by side. Answers, counts and refusals are those of one
 * ray after the other, bit for bit; returns how many rays hit. hits[i] is of rays[i], and where
 * that hits nothing its geom and prim are ACCEL_NONE, t is INFINITY, u and v are 0; flags[i] says
 * whether it hits. Either array has room for `count`, belongs to the caller, does not overlap the rays, and
 * may be NULL; so may everything where `count` is 0.
 *
 * Where a structure of the wide form is larger than a cache, several rays are under way at a time,
 * and the memory that one waits for is fetched while the others go on: rays take 0.3 to 0.9 of the
 * time. Else they are asked one by one. A batch runs in the calling thread, allocates nothing (but
 * what a lazy structure builds) and takes up to 50 KB of stack, whatever `count` is; a few hundred
 * rays are enough.
 *
 * Callbacks: rays take turns in any order, so what a callback keeps, it keeps by the ray, whose
 * place is probe->ray - rays. Where one leaves by an exception, hits and flags are of no use. */
ACCEL_API size_t accel_closest_n(const accel *a, const accel_ray *rays, accel_hit *hits,
                                 size_t count, accel_query *query);
ACCEL_API size_t accel_any_n(const accel *a, const accel_ray *rays, bool *flags, size_t count,
                             accel_query *query);

/* Receives one hit; returns false to end the query. */
typedef bool accel_visit_hit(void *user, const accel_hit *hit);

/* Visits every hit in order of (t, geometry, primitive), each exactly once (two hits of one
 * primitive at one t are one). Returns false if the visitor ended the query.
 *
 * Allocates nothing: hits are gathered on the stack, the first 32 in one walk, then up to 512 in
 * each, which takes 22 KB of stack. So n hits that lie apart cost a few tests each, and n at one t
 * do. But of n at one t each walk looks at all ids again, n^2 / 512 looks of 0.4 to 4 ns: 30,000
 * copies of a triangle take 3 to 10 ms, 100,000 take 20 to 70 ms, 1,000,000 take 1 to 7 s, least in
 * linear and most in bvh, octree and hoo. And where n primitives are hit at as many t and every
 * part of the ray is in the boxes of most, as in spheres within spheres, each walk tests most of
 * them again, n^2 / 512 tests: 30,000 such hits take 50 ms, 300,000 some seconds. A host that needs
 * the first ones only ends the query, or gives a tmax. */
ACCEL_API bool accel_all(const accel *a, const accel_ray *ray, accel_visit_hit *visit, void *user,
                         accel_query *query);

/* Receives one primitive; returns false to end the query. */
typedef bool accel_visit_id(void *user, accel_id id);

/* Visits every primitive whose padded box holds `point`, by increasing (geometry, primitive), each
 * once. Returns false if the visitor ended the query. */
ACCEL_API bool accel_point(const accel *a, const double *point, accel_visit_id *visit, void *user,
                           accel_query *query);

/* ----------------------------------------------------------- description ---- */

/* One option of a kind. A number unless `words` is given. */
typedef struct accel_option {
    const char *key;
    const char *meaning;      /* one line, with its unit */
    const char *const *words; /* legal words, ended by NULL; NULL for a number */
    double min, max;          /* of a number, inclusive */
    double standard;          /* default: the number, the index of the word, or NAN for "auto" */
    bool whole;               /* a number without fraction */
} accel_option;

/* One kind of structure. */
typedef struct accel_kind_info {
    const char *name;
    const char *summary;         /* one line */
    const accel_option *options; /* `option_count` of them */
    size_t option_count;
} accel_kind_info;

/* The kinds compiled into this library, `*count` of them, then a NULL: the table that the parser
 * uses. `count` may be NULL. */
ACCEL_API const accel_kind_info *const *accel_kinds(size_t *count);

enum { ACCEL_INFO_PHASES = 8, ACCEL_INFO_IDS = 10, ACCEL_INFO_NOTES = 12, ACCEL_INFO_LEFT_OUT = 8 };

/* What was built. Strings live as long as the structure. */
typedef struct accel_info {
    const char *kind;
    char config[256]; /* the resolved config: every option with its value, `auto` where the builder
                         decides; builds the same again, in every locale and rounding mode */
    uint64_t primitives;                  /* in the scene, skipped ones included */
    uint64_t skipped;                     /* invalid: see accel_build */
    uint64_t degenerate;                  /* triangles that no ray can hit, left out */
    uint64_t unbounded;                   /* objects with an infinite side, tested for every ray */
    accel_id skipped_ids[ACCEL_INFO_IDS]; /* the first of them */
    uint32_t size_classes;                /* 0 where the kind has none, as below */
    uint32_t clusters;
    uint64_t nodes;      /* inner nodes */
    uint64_t leaves;     /* leaves or cells that hold something */
    uint64_t references; /* entries in all leaves together */
    uint32_t depth;      /* deepest leaf; the root has depth 0; hoo: deepest in its tree of boxes
                          * and deepest in an octree together */
    uint64_t bytes;      /* held now */
    uint64_t peak_bytes; /* held at most during accel_build */
    /* Of a lazy structure; 0 of others, which are built as a whole. Nodes, leaves, references,
     * depth and bytes above are those built by now. */
    uint32_t unbuilt_clusters;   /* that no query has entered */
    uint64_t unbuilt_primitives; /* in them and in other parts that none has entered */
    uint64_t lazy_bytes;         /* of bytes: built by queries */
    double seconds;              /* the whole build, wall clock */
    uint32_t phase_count;
    struct {
        const char *name;
        double seconds;
    } phases[ACCEL_INFO_PHASES];
    uint32_t left_out_count; /* what this scene has no need of, and what that saves */
    struct {
        char what[112]; /* and why */
        uint64_t bytes; /* that it would take, counted from the sizes of its parts */
        double seconds; /* to build it, predicted: those that the phase took for each byte made */
    } left_out[ACCEL_INFO_LEFT_OUT];
    uint32_t note_count; /* why auto chose; limits that were met */
    char notes[ACCEL_INFO_NOTES][160];
} accel_info;

/* Describes `a`. Any thread may ask at any time before accel_free, also while others query. */
ACCEL_API void accel_describe(const accel *a, accel_info *info);

/* The padded box that the library uses for a primitive: its box grown outward by 2^-44 of its
 * largest coordinate. Returns false for a primitive that was skipped or does not exist. */
ACCEL_API bool accel_padded_box(const accel *a, accel_id id, accel_box *box);

/* Walks the whole structure and checks every invariant that the exactness proof needs: every
 * primitive is in every cell that its box meets, boxes contain what is below them, indices are in
 * range, depth is within its cap, the copied primitives and their boxes are as they were copied; of
 * a lazy structure as much as is built, and the lists of what is not. Takes about the time of a
 * build. Others may query meanwhile.
 *
 * It is made for structures whose memory was overwritten: whatever it finds in the blocks that the
 * build or queries allocated, it ends, and it neither reads nor writes elsewhere (`a` itself must
 * still be what accel_build gave). A change of one word that could change an answer is always
 * found; of larger ones one in 2^64 may not be. A sound structure is sound in every floating-point
 * mode, locale and thread.
 *
 * Returns ACCEL_OK; ACCEL_BROKEN with the first violation in *error (which may be NULL);
 * ACCEL_NO_MEMORY if malloc, which it uses whatever the hooks are, has none for its marks; or
 * ACCEL_BAD_ARGUMENT if `a` is NULL. */
ACCEL_API accel_status accel_validate(const accel *a, accel_error *error);

#ifdef __cplusplus
}
#endif

#endif
