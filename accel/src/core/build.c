/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L /* clock_gettime */
#include "build.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

double accel_seconds_since(const struct timespec *start)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)(now.tv_sec - start->tv_sec) + 1e-9 * (double)(now.tv_nsec - start->tv_nsec);
}

static void end_phase(struct build *build)
{
    accel_info *info = build->info;
    if (build->phase && info->phase_count < ACCEL_INFO_PHASES) {
        info->phases[info->phase_count].name = build->phase;
        info->phases[info->phase_count].seconds = accel_seconds_since(&build->phase_start);
        info->phase_count++;
    }
    build->phase = NULL;
}

void accel_build_phase(struct build *build, const char *name)
{
    end_phase(build);
    build->phase = name;
    build->done = 0.0;
    clock_gettime(CLOCK_MONOTONIC, &build->phase_start);
}

bool accel_build_tick(struct build *build, double done)
{
    const double seconds_between = 0.005;
    if (done > build->done)
        build->done = done < 1.0 ? done : 1.0;
    if (!build->hooks->progress || accel_seconds_since(&build->last_tick) < seconds_between)
        return true;
    clock_gettime(CLOCK_MONOTONIC, &build->last_tick);
    if (build->hooks->progress(build->hooks->user, build->phase, build->done))
        return true;
    accel_error_set(build->error, ACCEL_CANCELLED,
                    "build %s: cancelled in phase '%s'; nothing was built", build->kind,
                    build->phase);
    return false;
}

bool accel_build_no_memory(struct build *build)
{
    const struct memory *m = build->memory;
    if (m->wanted > 0)
        return accel_error_set(build->error, ACCEL_NO_MEMORY,
                               "build %s: hooks.memory_limit allows %zu bytes, but %zu are needed "
                               "in phase '%s', a block of %zu among them; nothing was built",
                               build->kind, m->limit, m->wanted, build->phase, m->refused),
               false;
    accel_error_set(
        build->error, ACCEL_NO_MEMORY,
        "build %s: no memory for a block of %zu bytes in phase '%s', %zu bytes were held; "
        "nothing was built",
        build->kind, m->refused, build->phase, m->bytes);
    return false;
}

void accel_build_left_out(struct build *build, size_t bytes, size_t made, const char *format, ...)
{
    accel_info *info = build->info;
    if (info->left_out_count == ACCEL_INFO_LEFT_OUT)
        return;
    const double per_byte =
        made > 0 ? accel_seconds_since(&build->phase_start) / (double)made : 0.0;
    const uint32_t i = info->left_out_count++;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(info->left_out[i].what, sizeof info->left_out[i].what, format, arguments);
    va_end(arguments);
    info->left_out[i].bytes = bytes;
    info->left_out[i].seconds = per_byte * (double)bytes;
}

__attribute__((format(printf, 2, 0))) static void add_note(accel_info *info, const char *format,
                                                           va_list arguments)
{
    if (info->note_count == ACCEL_INFO_NOTES)
        return;
    vsnprintf(info->notes[info->note_count], sizeof info->notes[0], format, arguments);
    for (uint32_t i = 0; i < info->note_count; i++)
        if (strcmp(info->notes[i], info->notes[info->note_count]) == 0)
            return;
    info->note_count++;
}

void accel_build_note(struct build *build, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    add_note(build->info, format, arguments);
    va_end(arguments);
}

void accel_info_note(accel_info *info, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    add_note(info, format, arguments);
    va_end(arguments);
}
