/* SPDX-License-Identifier: Apache-2.0
 *
 * How much memory is there? By /proc (proc(5)), control groups of version 2 and getrlimit. Large
 * pages by madvise.
 */
#include "memory.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

/* Reads a file's first number. */
static bool read_number(const char *path, uint64_t *number)
{
    unsigned long long value;
    FILE *file = fopen(path, "r");
    const bool fine = file != NULL && fscanf(file, "%llu", &value) == 1;
    *number = fine ? value : 0;
    if (file != NULL) {
        fclose(file);
    }
    return fine;
}

/* Reads the number behind `name` at the beginning of a line. */
static bool read_named(const char *path, const char *name, uint64_t *number)
{
    char line[200];
    unsigned long long value;
    bool found = false;
    FILE *file = fopen(path, "r");
    while (file != NULL && !found && fgets(line, sizeof line, file) != NULL) {
        found = strncmp(line, name, strlen(name)) == 0 &&
                sscanf(line + strlen(name), "%llu", &value) == 1;
    }
    if (file != NULL) {
        fclose(file);
    }
    *number = found ? value : 0;
    return found;
}

static uint64_t free_of_machine(void)
{
    uint64_t kilobytes;
    return read_named("/proc/meminfo", "MemAvailable:", &kilobytes) ? 1024 * kilobytes : UINT64_MAX;
}

/* As seen from within a container: its group is the root. Pages of files that were not used lately
 * count as used, but make room. */
static uint64_t free_of_group(void)
{
    uint64_t most, used, files;
    if (!read_number("/sys/fs/cgroup/memory.max", &most) ||
        !read_number("/sys/fs/cgroup/memory.current", &used)) {
        return UINT64_MAX;
    }
    read_named("/sys/fs/cgroup/memory.stat", "inactive_file ", &files);
    used -= files < used ? files : used;
    return used < most ? most - used : 0;
}

static uint64_t free_of_process(void)
{
    struct rlimit limit;
    uint64_t pages;
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY ||
        !read_number("/proc/self/statm", &pages)) {
        return UINT64_MAX;
    }
    const uint64_t used = pages * (uint64_t)sysconf(_SC_PAGESIZE);
    return used < limit.rlim_cur ? limit.rlim_cur - used : 0;
}

uint64_t memory_free(void)
{
    const uint64_t machine = free_of_machine(), group = free_of_group(), own = free_of_process();
    const uint64_t least = machine < group ? machine : group;
    return least < own ? least : own;
}
