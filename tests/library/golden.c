/* SPDX-License-Identifier: Apache-2.0
 *
 * The same input gives the same bits on every platform and with every compiler: a hash of all
 * answers on some scenes, stored here. `golden print` prints the table. The rays of a hash are
 * always as many; below intensity 1 each kind but linear, and each form, takes its share of scenes.
 */
#include <stdlib.h>
#include <string.h>

#include "cmocka_all.h"
#include "compare.h"

struct golden {
    const char *scene, *rays;
    uint64_t hash;
};

static const struct golden table[] = {
    {"shards", "mix", 0x91bd0ad3180aa30e},
    {"sizes", "mix", 0xf67aa48744fc0eb1},
    {"scale-1e-310", "mix", 0xbeefd95fa2899f86},
    {"scale-1e-150", "mix", 0x6097ee9d1804fbff},
    {"scale-1e150", "mix", 0xb1e91f1ca1b2baa6},
    {"scale-1e300", "mix", 0x5e5a418d3434a7de},
    {"shift-1e6", "mix", 0x3e4c811068c8b05f},
    {"shift-1e15", "mix", 0x5713c90cd7106f56},
    {"shift-odd", "mix", 0xafaa2fa9cd14fe73},
    {"slivers", "mix", 0x9b6fb6434ba05545},
    {"degenerate", "mix", 0x1544c855467933bb},
    {"nested-spheres", "mix", 0x560956b0772ea36f},
    {"series", "mix", 0x5e35339dc0030fe3},
    {"lattice", "lattice-lines", 0xf261267de932d592},
    {"ball-mesh", "origin-on", 0x9d395e6e38468244},
    {"split-1024", "mix", 0x051d6e2ce67ef2ac},
    {"terrain", "mix", 0x478c3b30de6e6b2c},
    {"fan", "mix", 0xca4cd2247656bac0},
    {"huge-and-tiny", "mix", 0xa206e53ccfb2fbcd},
    {"stack", "mix", 0xcd4a8329e1f6641d},
    {"twins", "ends", 0x2dd49c6edc74ecf5},
    {"exotic", "mix", 0x99101bba52a3c09a},
    {"mixed-key", "special", 0x3df84729b120d889},
    {"mixed-key", "secondary", 0x97b0d6b1978b1e8e},
    {"ball-mesh", "secondary", 0xc6c50c3f920a737b},
    {"slivers", "secondary", 0x930d4307ed568b97},
    {"nested-spheres", "secondary", 0x6fa3916e5a2ec88d},
};

enum { RAYS = 1500, SEED = 1 };

static uint64_t hash_answers(const char *config, const struct golden *g)
{
    struct test_scene s;
    scene_make(&s, scene_maker_find(g->scene), SEED);
    accel *a = must_build(&s, config), *judge = must_build(&s, "linear");
    struct rng d = rng_from(SEED, 71);
    uint64_t hash = HASH_START;
    for (uint64_t i = 0; i < RAYS; i++) {
        const accel_ray ray = ray_family_find(g->rays)->make(&s.target, judge, &d, i);
        const struct answer answer = ask(a, &ray, i % 4 == 0);
        if (answer.illegal)
            fail_msg("%s on %s: %s", config, g->scene, answer.illegal);
        hash = answer_hash(hash, &answer);
    }
    accel_free(a);
    accel_free(judge);
    scene_free(&s);
    return hash;
}

static void test_hashes(void **state)
{
    (void)state;
    uint32_t wrong = 0;
    struct tested *list;
    const size_t count = tested_configs(&list);
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        for (size_t k = 0; k < count; k++) {
            if (!list[k].form || (k > 0 && !takes_turn(i + 7 * k)))
                continue;
            const uint64_t hash = hash_answers(list[k].config, &table[i]);
            if (hash == table[i].hash)
                continue;
            wrong++;
            print_error("%s on %s, rays %s: hash %016llx, not %016llx\n", list[k].config,
                        table[i].scene, table[i].rays, (unsigned long long)hash,
                        (unsigned long long)table[i].hash);
        }
    }
    free(list);
    assert_int_equal(wrong, 0);
}

static int print_table(void)
{
    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        printf("    {\"%s\", \"%s\", 0x%016llx},\n", table[i].scene, table[i].rays,
               (unsigned long long)hash_answers("linear", &table[i]));
    return 0;
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_hashes)};
    if (argc == 2 && strcmp(argv[1], "print") == 0)
        return print_table();
    return cmocka_run_group_tests_name("golden", tests, NULL, NULL);
}
