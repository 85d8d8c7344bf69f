/* SPDX-License-Identifier: Apache-2.0 */
#include "machine.h"

#include <accel/accel.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

void accel_machine_processor(char *text, size_t size)
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

const char *accel_machine_build(void)
{
    return "compiled by " ACCEL_COMPILER ", version " ACCEL_VERSION " at " ACCEL_COMMIT;
}

double accel_machine_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
