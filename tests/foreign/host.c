/* SPDX-License-Identifier: Apache-2.0
 *
 * A stranger's program, in what C and C++ have in common: prints the version of the library and for
 * each kind a hash of all answers over a small scene. Its own arithmetic is exact, so that it may be
 * compiled with any flags. Exit code 1 and the library's line where a build is refused.
 */
#include <accel/accel.h>
#include <stdio.h>
#include <string.h>

enum { TRIANGLES = 400, SPHERES = 60, RAYS = 2000 };

static uint64_t state = 1;

/* A multiple of 2^-20 in [0, 1). */
static double random_part(void)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 44) / 1048576.0;
}

static uint64_t hash_of(uint64_t hash, const void *bytes, size_t size)
{
    const unsigned char *at = (const unsigned char *)bytes;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ at[i]) * 0x100000001b3u;
    return hash;
}

static uint64_t hash_of_hit(uint64_t hash, const accel_hit *hit)
{
    hash = hash_of(hash, &hit->t, sizeof hit->t);
    hash = hash_of(hash, &hit->u, sizeof hit->u);
    hash = hash_of(hash, &hit->v, sizeof hit->v);
    hash = hash_of(hash, &hit->geom, sizeof hit->geom);
    return hash_of(hash, &hit->prim, sizeof hit->prim);
}

static bool visit(void *user, const accel_hit *hit)
{
    uint64_t *hash = (uint64_t *)user;
    *hash = hash_of_hit(*hash, hit);
    return true;
}

/* All hits of every ray, and for every other one the nearest by itself. */
static uint64_t hash_of_answers(const accel *a)
{
    uint64_t hash = 0xcbf29ce484222325u;
    state = 2;
    for (int i = 0; i < RAYS; i++) {
        double org[3], dir[3];
        for (int k = 0; k < 3; k++) {
            org[k] = random_part() - 0.5;
            dir[k] = random_part() - 0.5;
        }
        const accel_ray ray = accel_ray_from(org, dir);
        accel_hit hit;
        if (i % 2 == 0 && accel_closest(a, &ray, &hit, NULL))
            hash = hash_of_hit(hash, &hit);
        accel_all(a, &ray, visit, &hash, NULL);
    }
    return hash;
}

static double corners[9 * TRIANGLES], spheres[4 * SPHERES];
static uint32_t indices[3 * TRIANGLES];

static void fill(accel_geometry geometry[2])
{
    for (int i = 0; i < 3 * TRIANGLES; i++)
        indices[i] = (uint32_t)i;
    for (int i = 0; i < 9 * TRIANGLES; i++)
        corners[i] = random_part();
    for (int i = 0; i < 4 * SPHERES; i++)
        spheres[i] = i % 4 < 3 ? random_part() : (random_part() + 0.125) / 8;
    memset(geometry, 0, 2 * sizeof *geometry);
    geometry[0].type = ACCEL_TRIANGLES;
    geometry[0].triangles.vertices = corners;
    geometry[0].triangles.vertex_count = 3 * TRIANGLES;
    geometry[0].triangles.indices = indices;
    geometry[0].triangles.count = TRIANGLES;
    geometry[1].type = ACCEL_SPHERES;
    geometry[1].spheres.spheres = spheres;
    geometry[1].spheres.count = SPHERES;
}

int main(void)
{
    accel_geometry geometry[2];
    fill(geometry);
    const accel_scene scene = {geometry, 2};
    size_t count;
    const accel_kind_info *const *kinds = accel_kinds(&count);
    printf("version %s\n", accel_version());
    for (size_t i = 0; i < count; i++) {
        accel *a;
        accel_error error;
        if (accel_build(&a, &scene, kinds[i]->name, NULL, &error) != ACCEL_OK) {
            fprintf(stderr, "%s\n", error.text);
            return 1;
        }
        printf("%s %016llx\n", kinds[i]->name, (unsigned long long)hash_of_answers(a));
        accel_free(a);
    }
    return 0;
}
