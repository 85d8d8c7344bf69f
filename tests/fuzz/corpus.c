/* SPDX-License-Identifier: Apache-2.0
 *
 * Runs a fuzz target without a fuzzer, as an ordinary test: on each file that is named, or lies in
 * a folder that is named, and on some beginnings of it and some copies with one bit flipped.
 */
#define _POSIX_C_SOURCE 200809L
#include "fuzz.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Beginnings and flips that are tried of each file. */
enum { CUTS = 8, FLIPS = 8 };

static _Noreturn void give_up(const char *path)
{
    perror(path);
    exit(2);
}

/* In a block of its own size, so that a byte too far is noticed. */
static void run(const uint8_t *bytes, size_t size)
{
    uint8_t *copy = malloc(size ? size : 1);
    if (!copy)
        give_up("memory");
    if (size > 0)
        memcpy(copy, bytes, size);
    LLVMFuzzerTestOneInput(copy, size);
    free(copy);
}

static void run_all(uint8_t *bytes, size_t size)
{
    run(bytes, size);
    for (size_t i = 0; i < CUTS && size > 0; i++)
        run(bytes, size * i / CUTS);
    for (size_t i = 0; i < FLIPS && size > 0; i++) {
        const size_t bit = (8 * size * i / FLIPS + 3 * i) % (8 * size);
        bytes[bit / 8] ^= (uint8_t)(1u << bit % 8);
        run(bytes, size);
        bytes[bit / 8] ^= (uint8_t)(1u << bit % 8);
    }
}

/* The name comes first: it is the last word of a run that crashes. */
static void run_file(const char *path, size_t size)
{
    printf("%s\n", path);
    fflush(stdout);
    FILE *f = fopen(path, "rb");
    uint8_t *bytes = malloc(size + 1);
    if (!f || !bytes || fread(bytes, 1, size, f) != size)
        give_up(path);
    fclose(f);
    run_all(bytes, size);
    free(bytes);
}

static int run_path(const char *path);

static int run_folder(const char *path)
{
    struct dirent **entry;
    const int entries = scandir(path, &entry, NULL, alphasort);
    int files = 0;
    if (entries < 0)
        give_up(path);
    for (int i = 0; i < entries; i++) {
        char name[1000];
        snprintf(name, sizeof name, "%s/%s", path, entry[i]->d_name);
        if (entry[i]->d_name[0] != '.')
            files += run_path(name);
        free(entry[i]);
    }
    free(entry);
    return files;
}

/* Returns how many files there were. */
static int run_path(const char *path)
{
    struct stat status;
    if (stat(path, &status) != 0)
        give_up(path);
    if (S_ISDIR(status.st_mode))
        return run_folder(path);
    run_file(path, (size_t)status.st_size);
    return 1;
}

int main(int argc, char **argv)
{
    int files = 0;
    for (int i = 1; i < argc; i++)
        files += run_path(argv[i]);
    if (files == 0) {
        fprintf(stderr, "usage: %s FILE|FOLDER..., with at least one file\n", argv[0]);
        return 2;
    }
    printf("%d files, each with up to %d beginnings and %d flipped bits\n", files, CUTS, FLIPS);
    return 0;
}
