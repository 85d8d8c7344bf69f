/* SPDX-License-Identifier: Apache-2.0
 *
 * accel report: its arguments, the sections in their order, the folder at the end.
 */
#include "commands.h"
#include "report/report.h"
#include "tool/words.h"

#include <string.h>

enum { FLAG_OUTPUT, FLAG_QUICK, FLAG_MINUTES, FLAG_ONLY };

static const struct flag flags[] = {
    [FLAG_OUTPUT] = {"output", 'o', "DIR",
                     "folder to make or to fill; a former report there is replaced, nothing else"},
    [FLAG_QUICK] = {"quick", 0, NULL, "fewer rays, photons and sizes: less than two minutes"},
    [FLAG_MINUTES] = {"minutes", 0, "M",
                      "at most about as long, 0..1440 (default: 60); 0: the least counts"},
    [FLAG_ONLY] = {"only", 0, "PART", "of exact, cases, light, choice, size (default: all)"},
};

/* What --quick gives the sections: the least counts of some take longer than their share, and two
 * minutes must do on a slower machine too. */
#define QUICK_MINUTES 1.2

/* The sections in the order of the page, with their shares of the time. */
static const struct part {
    const char *name;
    report_section *run;
    double share;
} parts[] = {
    {"exact", report_exact, 0.15},   {"cases", report_cases, 0.2}, {"light", report_light, 0.3},
    {"choice", report_choice, 0.15}, {"size", report_size, 0.2},
};

enum { PARTS = sizeof parts / sizeof parts[0] };

/* What was asked for. */
typedef struct request {
    const char *output;
    double minutes;
    const char *only; /* a part, or NULL */
} request;

static bool is_asked(const request *q, size_t i)
{
    return q->only == NULL || strcmp(q->only, parts[i].name) == 0;
}

/* Each part gets its share of the time that is left, so that one that took longer shortens the
 * others. */
static bool run_parts(struct reporting *r, const request *q)
{
    const double end = r->progress.start + r->seconds;
    for (size_t i = 0; i < PARTS; i++) {
        double shares = 0.0;
        for (size_t k = i; k < PARTS; k++) {
            shares += is_asked(q, k) ? parts[k].share : 0.0;
        }
        if (!is_asked(q, i)) {
            continue;
        }
        r->progress.what = parts[i].name;
        const double left = fmax(0.0, end - seconds_now());
        if (!parts[i].run(r, left * parts[i].share / shares)) {
            return false;
        }
    }
    return true;
}

static bool make_report(struct reporting *r, const request *q)
{
    bool fine = page_open(r) && run_parts(r, q);
    progress_clear(&r->progress);
    fine = fine && page_write(r);
    page_free(r);
    return fine;
}

static int run_request(const struct command *command, const request *q, bool quiet)
{
    struct reporting r = {
        .command = command, .progress = progress_start(quiet), .seconds = 60.0 * q->minutes};
    const char *missing = plot_missing();
    if (missing != NULL) {
        return complain(command, "%s; nothing was written", missing);
    }
    accel_error error;
    if (!folder_open(&r.folder, q->output, &error)) {
        return complain(command, "%s", error.text);
    }
    if (q->minutes > 0.0) {
        printf("at most about %.0f %s; %s/index.html appears at the end\n",
               q->minutes < 2.0 ? 60.0 * q->minutes : q->minutes,
               q->minutes < 2.0 ? "seconds" : "minutes", q->output);
        fflush(stdout);
    }
    if (!make_report(&r, q)) {
        folder_abandon(&r.folder);
        return EXIT_BAD;
    }
    if (!folder_commit(&r.folder, &error)) {
        return complain(command, "%s", error.text);
    }
    printf("%s/index.html: %llu answers of ours judged, %llu wrong; %.0f s\n", q->output,
           (unsigned long long)r.judged, (unsigned long long)r.wrong,
           seconds_now() - r.progress.start);
    return r.wrong == 0 ? EXIT_FINE : EXIT_DIFFERENT;
}

/* ---------------------------------------------------------------- arguments ---- */

static bool read_minutes(const struct arguments *a, request *q)
{
    double value;
    if (read_number(a->value, strlen(a->value), &value) && value >= 0.0 && value <= 1440.0) {
        q->minutes = value;
        return true;
    }
    complain(a->command, "--minutes is '%.60s'; allowed is a number from 0 to 1440", a->value);
    return false;
}

static bool read_part(const struct arguments *a, request *q)
{
    for (size_t i = 0; i < PARTS; i++) {
        if (strcmp(a->value, parts[i].name) == 0) {
            q->only = parts[i].name;
            return true;
        }
    }
    complain(a->command, "--only is '%.60s'; allowed are exact, cases, light, choice, size",
             a->value);
    return false;
}

static bool read_flag(const struct arguments *a, int flag, request *q)
{
    switch (flag) {
    case FLAG_OUTPUT:
        q->output = a->value;
        return true;
    case FLAG_QUICK:
        q->minutes = QUICK_MINUTES;
        return true;
    case FLAG_MINUTES:
        return read_minutes(a, q);
    case FLAG_ONLY:
        return read_part(a, q);
    default:
        complain(a->command, "unexpected '%.60s'", a->value);
        return false;
    }
}

static int run(const struct command *command, int argc, char **argv)
{
    request q = {.minutes = 60.0};
    struct arguments arguments = arguments_start(command, argc, argv);
    int flag;
    while ((flag = next_argument(&arguments)) != ARGUMENT_END) {
        if (flag == ARGUMENT_STOP) {
            return arguments.exit_code;
        }
        if (!read_flag(&arguments, flag, &q)) {
            return EXIT_BAD;
        }
    }
    if (q.output == NULL) {
        return complain(command, "no -o DIR is given; usage: accel %s %s", command->name,
                        command->arguments);
    }
    return run_request(command, &q, arguments.quiet);
}

const struct command command_report = {
    .name = "report",
    .arguments = "-o DIR [OPTION]...",
    .summary = "error against run time: a page with plots, and the figures behind them",
    .details =
        "Wrong answers of every kind, and of Embree, against time per ray; stiff and extreme\n"
        "cases; error of photon illumination against time; what a choice of options costs; work\n"
        "against the size of a scene. Counts follow from the time: the page says which were\n"
        "used. Needs gnuplot; compares with POV-Ray where 'povray' is installed. DIR/index.html\n"
        "appears whole or not at all. Exit code 1 if an answer of ours is wrong.",
    .flags = flags,
    .flag_count = sizeof flags / sizeof flags[0],
    .run = run,
};
