/* SPDX-License-Identifier: Apache-2.0
 *
 * What accel check prints, and the replay of one ray.
 */
#include "check.h"

#include "scenes/ray_text.h"

#include <inttypes.h>
#include <stdio.h>

static void print_hit(const accel_hit *hit)
{
    printf("geometry %" PRIu32 " primitive %" PRIu32 " t=%a (%.17g) u=%a v=%a", hit->geom,
           hit->prim, hit->t, hit->t, hit->u, hit->v);
}

static void print_answers(const char *name, const struct answers *answers)
{
    printf("%s\n  closest ", name);
    if (answers->found) {
        print_hit(&answers->closest);
    } else {
        printf("none%s", answers->untouched ? "" : ", but the hit was written to");
    }
    printf("\n  any     %s\n  all     %" PRIu32 "\n", answers->any ? "yes" : "no",
           answers->all_count);
    for (uint32_t i = 0; i < answers->all_count; i++) {
        printf("    ");
        print_hit(&answers->all[i]);
        printf("\n");
    }
    printf("  point   %" PRIu32 ":", answers->point_count);
    for (uint32_t i = 0; i < answers->point_count; i++) {
        printf(" %" PRIu32 "/%" PRIu32, answers->point[i].geom, answers->point[i].prim);
    }
    printf("\n");
}

static void print_differences(unsigned differences)
{
    static const char *const names[] = {"closest", "any", "all", "point"};
    printf("  DIFFERS from linear in");
    for (int i = 0; i < 4; i++) {
        if ((differences >> i & 1) != 0) {
            printf(" %s", names[i]);
        }
    }
    printf("\n");
}

static struct answers expected_answers, got_answers;

int check_replay(const struct check *check, const accel_ray *ray)
{
    struct question question = {.ray = *ray, .lists = true};
    accel_hit hit = {0};
    accel_closest(check->judge, ray, &hit, NULL);
    for (int k = 0; k < 3; k++) {
        question.point[k] = ray->org[k] + hit.t * ray->dir[k];
    }
    check_ask_judge(check, &question, NULL, &expected_answers);
    print_answers("linear", &expected_answers);
    int code = EXIT_FINE;
    for (size_t i = 0; i < check->suspect_count; i++) {
        check_ask(check->suspects[i].structure, &question, NULL, &got_answers);
        print_answers(check->suspects[i].info.config, &got_answers);
        const unsigned differences = answers_differ(&question, &expected_answers, &got_answers);
        if (differences != 0) {
            print_differences(differences);
            code = EXIT_DIFFERENT;
        }
    }
    return code;
}

static void print_head(const struct check *check)
{
    printf("%s: %" PRIu64 " primitives in %" PRIu32 " geometries\n", check->scene_name,
           scene_primitives(&check->loaded.scene), check->loaded.scene.count);
    printf("rays: %" PRIu64 ", seed %" PRIu64 ", of %d families in turn; of them hit:",
           check->ray_count, check->rays.seed, FAMILIES);
    for (uint64_t i = 0; i < FAMILIES; i++) {
        const uint64_t rays = check_family_rays(check->ray_count, i);
        if (rays > 0) {
            printf(" %s %.0f%%", family_name((enum family)i),
                   100.0 * (double)check->suspects[0].family_hits[i] / (double)rays);
        }
    }
    printf("\n");
    if (check->judged_count == check->ray_count) {
        printf("judged: all by linear\n");
    } else {
        printf("judged: %" PRIu64 " by linear, the same share of each family; all %" PRIu64
               " by agreement of %zu structures\n",
               check->judged_count, check->ray_count, check->suspect_count);
    }
    printf("compared: closest and any of each ray, alone and in batches; all and point of one ray "
           "in %d\n\n",
           LISTS_EVERY);
}

static void print_suspect(const struct check *check, const struct suspect *suspect)
{
    printf("%12" PRIu64 " %12" PRIu64 " %10" PRIu64 " %12" PRIu64 " %12" PRIu64 "  %s%s\n",
           check->ray_count, suspect->hits, suspect->refused, check->judged_count,
           suspect->mismatches, suspect->info.config,
           suspect->added ? "  (added as second opinion)" : "");
    if (suspect->outside != 0) {
        printf("  of %" PRIu64
               " rays that met a raw hit before its object's box the closest is not "
               "compared\n",
               suspect->outside);
    }
    if (suspect->mismatches != 0) {
        printf("  by query: closest %" PRIu64 ", any %" PRIu64 ", all %" PRIu64 ", point %" PRIu64
               ", batches %" PRIu64 "\n",
               suspect->by_query[0], suspect->by_query[1], suspect->by_query[2],
               suspect->by_query[3], suspect->by_query[4]);
    }
}

static void print_replay(const struct check *check, const struct suspect *suspect)
{
    const accel_ray ray = rays_make(&check->rays, suspect->first);
    char text[RAY_TEXT];
    write_ray(&ray, text);
    printf("\nray %" PRIu64 " (%s) differs with %s; replay it by\n"
           "  accel check '%s' -a '%s' --ray '%s'\n",
           suspect->first, family_name((enum family)(suspect->first % FAMILIES)),
           suspect->info.config, check->scene_name, suspect->info.config, text);
}

/* Checks the invariants that the exactness proof needs. */
static bool is_valid(const struct suspect *suspect)
{
    accel_error error;
    const bool valid = accel_validate(suspect->structure, &error) == ACCEL_OK;
    if (!valid) {
        printf("BROKEN: %s: %s\n", suspect->info.config, error.text);
    }
    return valid;
}

int check_report(const struct check *check)
{
    print_head(check);
    printf("%12s %12s %10s %12s %12s  config\n", "rays", "hits", "refused", "by linear",
           "mismatches");
    uint64_t mismatches = 0;
    bool valid = true;
    for (size_t i = 0; i < check->suspect_count; i++) {
        print_suspect(check, &check->suspects[i]);
        mismatches += check->suspects[i].mismatches;
        valid = is_valid(&check->suspects[i]) && valid;
    }
    for (size_t i = 0; i < check->suspect_count; i++) {
        if (check->suspects[i].mismatches != 0) {
            print_replay(check, &check->suspects[i]);
        }
    }
    printf("\n%" PRIu64 " rays, %" PRIu64 " mismatches; structures are %s\n",
           check->ray_count * check->suspect_count, mismatches, valid ? "valid" : "BROKEN");
    return mismatches == 0 && valid ? EXIT_FINE : EXIT_DIFFERENT;
}
