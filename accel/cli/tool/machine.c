/* SPDX-License-Identifier: Apache-2.0 */
#include "machine.h"
#include "commit.h"

#include <accel/accel.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

void machine_processor(char *text, size_t size)
{
    char line[256];
    snprintf(text, size, "unknown processor");
    FILE *file = fopen("/proc/cpuinfo", "r");
    while (file != NULL && fgets(line, sizeof line, file) != NULL) {
        const char *colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) == 0 && colon != NULL) {
            line[strcspn(line, "\n")] = '\0';
            snprintf(text, size, "%s", colon + 1 + strspn(colon + 1, " "));
            break;
        }
    }
    if (file != NULL) {
        fclose(file);
    }
}

const char *machine_build(void)
{
    return "compiled by " ACCEL_COMPILER ", version " ACCEL_VERSION " at " ACCEL_COMMIT;
}

static double seconds_of(clockid_t clock)
{
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double machine_seconds(void)
{
    return seconds_of(CLOCK_THREAD_CPUTIME_ID);
}

double machine_seconds_of_all(void)
{
    return seconds_of(CLOCK_PROCESS_CPUTIME_ID);
}
