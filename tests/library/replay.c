/* SPDX-License-Identifier: Apache-2.0
 *
 * Runs a failure of the tests again from the file that it left: a config, a ray and a scene.
 * Exit code 0: the answers agree; 1: they differ; 2: the file is not readable.
 */
#include "compare.h"

static bool read_ray(FILE *f, accel_ray *r)
{
    return fscanf(f, " ray %lf %lf %lf %lf %lf %lf %lf %lf %u %u", &r->org[0], &r->org[1],
                  &r->org[2], &r->dir[0], &r->dir[1], &r->dir[2], &r->tmin, &r->tmax, &r->skip.geom,
                  &r->skip.prim) == 10;
}

static bool build(accel **a, const struct test_scene *s, const char *config)
{
    accel_error error;
    if (accel_build(a, &s->scene, config, NULL, &error) == ACCEL_OK)
        return true;
    fprintf(stderr, "replay: %s: %s\n", config, error.text);
    return false;
}

int main(int argc, char **argv)
{
    char config[120];
    accel_ray ray;
    struct test_scene scene;
    accel *judge, *tested;
    FILE *f = argc == 2 ? fopen(argv[1], "r") : NULL;
    if (!f) {
        fprintf(stderr, "usage: replay FILE, one that a failed test left\n");
        return 2;
    }
    if (fscanf(f, "config %119s", config) != 1 || !read_ray(f, &ray) || !scene_read(f, &scene)) {
        fprintf(stderr, "replay: %s: not a file that a failed test left\n", argv[1]);
        fclose(f);
        return 2;
    }
    fclose(f);
    if (!build(&judge, &scene, "linear") || !build(&tested, &scene, config))
        return 2;
    const struct answer expected = ask(judge, &ray, true), found = ask(tested, &ray, true);
    print_answer(stdout, "linear", &expected);
    print_answer(stdout, config, &found);
    accel_free(judge);
    accel_free(tested);
    scene_free(&scene);
    const bool same = same_answer(&expected, &found);
    puts(same ? "the same" : "DIFFERENT");
    return same ? 0 : 1;
}
