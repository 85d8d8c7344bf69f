/* SPDX-License-Identifier: Apache-2.0
 *
 * One scene of a table: tuning what is to be tuned, taking turns, printing lines.
 */
#include "tables.h"

#include <inttypes.h>
#include <string.h>

/* Is the kind of `config` compiled into this library? */
static bool has_kind(const char *config)
{
    size_t count;
    const accel_kind_info *const *kinds = accel_kinds(&count);
    const size_t length = strcspn(config, ":");
    for (size_t i = 0; i < count; i++) {
        if (strlen(kinds[i]->name) == length && memcmp(kinds[i]->name, config, length) == 0) {
            return true;
        }
    }
    return false;
}

/* The values that are tried for '?'. */
static const double values[] = {1, 2, 4, 8, 16, 32, 64};
static const double densities[] = {0.0625, 0.125, 0.25, 0.5, 1, 2, 4};

enum { VALUES = sizeof values / sizeof values[0], MOST_TUNED = 5, CONFIG_LENGTH = 80 };

/* A row under way. */
typedef struct line {
    char config[CONFIG_LENGTH]; /* the row's, tuned */
    struct trial *trial;        /* NULL: left out */
} line;

static void fill_in(char config[CONFIG_LENGTH], const char *pattern, size_t value)
{
    const size_t length = strcspn(pattern, "?");
    const bool density = length > 8 && memcmp(pattern + length - 8, "density=", 8) == 0;
    snprintf(config, CONFIG_LENGTH, "%.*s%g", (int)length, pattern,
             density ? densities[value] : values[value]);
}

/* Replaces the '?' of each line's config by the value that is fastest with a tenth of the photons
 * of `full`, all of them taking turns. Returns the exit code. */
static int tune(struct trials full, line *lines, size_t count, const struct command *command,
                struct progress *progress)
{
    char configs[MOST_TUNED * VALUES][CONFIG_LENGTH];
    struct trial tried[MOST_TUNED * VALUES];
    line *tuned[MOST_TUNED];
    size_t tuned_count = 0;
    for (size_t i = 0; i < count; i++) {
        if (strchr(lines[i].config, '?') == NULL || !has_kind(lines[i].config)) {
            continue;
        }
        for (size_t v = 0; v < VALUES; v++) {
            const size_t at = tuned_count * VALUES + v;
            fill_in(configs[at], lines[i].config, v);
            tried[at] = (struct trial){.config = configs[at]};
        }
        tuned[tuned_count++] = &lines[i];
    }
    if (tuned_count == 0) {
        return EXIT_FINE;
    }
    full.at = tried;
    full.count = tuned_count * VALUES;
    full.repeats = 3;
    full.run.photons = full.run.photons / 10 + 1;
    const int code = trials_run(&full, command, progress);
    for (size_t i = 0; i < tuned_count && code != EXIT_BAD; i++) {
        size_t best = i * VALUES;
        for (size_t v = 1; v < VALUES; v++) {
            best = tried[i * VALUES + v].median < tried[best].median ? i * VALUES + v : best;
        }
        memcpy(tuned[i]->config, configs[best], CONFIG_LENGTH);
    }
    return code;
}

/* Gives a trial to each line whose kind is there; returns their number. */
static size_t choose(line *lines, size_t count, struct trial *trials)
{
    size_t left = 0;
    for (size_t i = 0; i < count; i++) {
        if (has_kind(lines[i].config)) {
            lines[i].trial = &trials[left++];
            *lines[i].trial = (struct trial){.config = lines[i].config};
        }
    }
    return left;
}

void table_missing(const struct table_row *rows, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (!has_kind(rows[i].config)) {
            printf("Left out, its kind is not compiled in: %s\n", rows[i].config);
        }
    }
}

static void print_ratio(const struct table_row *rows, size_t i, const struct trial *trial,
                        const struct trial *base)
{
    const struct table_row *r = &rows[i];
    char ratio[20] = "-", gain[20] = "-", paper[20] = "-", paper_gain[20] = "-";
    if (base != NULL) {
        snprintf(ratio, sizeof ratio, "%.2f", trial->median / base->median);
        snprintf(gain, sizeof gain, "%.0f %%", 100.0 * (1.0 - base->median / trial->median));
    }
    if (r->paper > 0.0) {
        const double seconds = rows[r->base].paper;
        snprintf(paper, sizeof paper, "%.2f", r->paper / seconds);
        snprintf(paper_gain, sizeof paper_gain, "%.0f %%", 100.0 * (1.0 - seconds / r->paper));
    }
    printf("%-35s %6s %6s %6s %6s", trial->config, ratio, paper, gain, paper_gain);
}

static void print_counts(const struct trial *trial)
{
    const struct photons *p = &trial->photons;
    const double rays = (double)p->rays;
    printf(" %7.0f %4.0f%% %7.2f %7.2f %8" PRIu64 " %8" PRIu64 " %8.0f\n",
           1e9 * trial->median / rays,
           50.0 * (trial->quartiles[1] - trial->quartiles[0]) / trial->median,
           (double)p->query.nodes / rays, (double)p->query.tests / rays,
           trial->info.nodes + trial->info.leaves, trial->info.references,
           (double)trial->info.bytes / 1024.0);
}

static void write_csv(FILE *csv, const char *scene, const struct table_row *r,
                      const struct trial *trial)
{
    const struct photons *p = &trial->photons;
    fprintf(csv,
            "%s,\"%s\",%.9g,%.9g,%.9g,%.9g,%.9g,%" PRIu64 ",%zu,%" PRIu64 ",%" PRIu64 ",%" PRIu64
            ",%" PRIu64 ",%" PRIu64 ",%" PRIu64 ",%" PRIu32 "\n",
            scene, trial->config, trial->median, trial->quartiles[0], trial->quartiles[1],
            trial->info.seconds, r->paper, p->rays, p->count, p->query.nodes, p->query.tests,
            trial->info.nodes, trial->info.leaves, trial->info.references, trial->info.bytes,
            trial->info.depth);
}

static void print_head(const struct trials *t)
{
    printf("\n%s: %" PRIu32 " lights, %" PRIu32 " photons for each, %u turns, %u threads\n",
           t->scene, t->run.lights.count, t->run.photons, t->repeats, t->run.threads);
    printf("%-35s %6s %6s %6s %6s %7s %5s %7s %7s %8s %8s %8s\n", "structure", "T/hoo", "paper",
           "gain", "paper", "ns/ray", "+-", "nodes/r", "tests/r", "cells", "refs", "KiB");
}

static void print_lines(const struct table_request *r, const struct trials *t,
                        const struct table_row *rows, const line *lines, size_t count)
{
    print_head(t);
    for (size_t i = 0; i < count; i++) {
        const struct trial *trial = lines[i].trial;
        if (trial != NULL) {
            print_ratio(rows, i, trial, lines[rows[i].base].trial);
            print_counts(trial);
            if (r->csv != NULL) {
                write_csv(r->csv, t->scene, &rows[i], trial);
            }
        }
    }
    printf("hits of all: %zu, hash %016" PRIx64 "\n", t->at[0].photons.count, t->hash);
    fflush(stdout);
}

int table_run(const struct command *command, const struct table_request *r, const char *scene,
              const struct table_row *rows, size_t count, uint64_t photons,
              struct table_result *results)
{
    struct trial trials[MOST_ROWS];
    line lines[MOST_ROWS];
    for (size_t i = 0; i < count; i++) {
        snprintf(lines[i].config, CONFIG_LENGTH, "%s", rows[i].config);
        lines[i].trial = NULL;
        results[i] = (struct table_result){.seconds = 0.0};
    }
    struct progress progress = progress_start(r->quiet);
    struct trials t = {.scene = scene,
                       .at = trials,
                       .repeats = r->repeats != 0 ? (unsigned)r->repeats
                                  : r->quick      ? 3
                                                  : 11};
    t.run = (struct photon_run){.photons = (uint32_t)(r->photons != 0 ? r->photons : photons),
                                .reflectance = 0.5,
                                .seed = 1,
                                .threads = (unsigned)r->threads};
    int code = tune(t, lines, count, command, &progress);
    t.count = choose(lines, count, trials);
    if (code != EXIT_FINE || t.count == 0) {
        return code;
    }
    code = trials_run(&t, command, &progress);
    if (code == EXIT_BAD) {
        return code;
    }
    print_lines(r, &t, rows, lines, count);
    for (size_t i = 0; i < count; i++) {
        const struct trial *trial = lines[i].trial;
        if (trial != NULL) {
            const struct photons *p = &trial->photons;
            results[i] =
                (struct table_result){trial->median, (double)p->query.nodes / (double)p->rays,
                                      (double)p->query.tests / (double)p->rays};
        }
    }
    return code;
}
