/* SPDX-License-Identifier: Apache-2.0
 *
 * The accel command: the table of subcommands. A new one is one file and one line here.
 *
 * Exit codes: 0 fine, 1 a difference was found, 2 bad usage or input.
 */
#include "commands.h"
#include "tool/words.h"

#include <accel/accel.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const struct command *const commands[] = {
    &command_kinds,    &command_info,    &command_check,  &command_trace,
    &command_diff,     &command_export,  &command_bench,  &command_lazy,
    &command_clusters, &command_photons, &command_tables, &command_report,
};

enum { COMMANDS = sizeof commands / sizeof commands[0] };

static int print_overview(void)
{
    printf("usage: accel COMMAND [ARGUMENT]...\n\n"
           "Exact ray-tracing acceleration structures, version " ACCEL_VERSION ".\n\n");
    for (size_t i = 0; i < COMMANDS; i++) {
        printf("  %-8s %s\n", commands[i]->name, commands[i]->summary);
    }
    printf(
        "\n'accel COMMAND --help' explains each. SCENE is a mesh file or a built-in scene, which\n"
        "'accel kinds' lists. OBJ, PLY, STL, OFF and glTF 2.0 (.gltf, .glb) are read strictly: "
        "what\n"
        "is wrong in them is refused with its line. Other formats (3MF, AMF, DAE, X3D, ...) are "
        "left\n"
        "to assimp, unchecked. 'accel info --help' says what of each is read and what is not.\n"
        "Exit codes: 0 fine, 1 a difference was found, 2 bad usage or input.\n");
    return EXIT_FINE;
}

static int complain_of_command(const char *name)
{
    struct nearest likely = {.found = {name, strlen(name)}};
    for (size_t i = 0; i < COMMANDS; i++) {
        accel_nearest_offer(&likely, commands[i]->name);
    }
    fprintf(stderr, "accel: unknown command '%.60s'%s%s; 'accel --help' lists all\n", name,
            likely.word == NULL ? "" : "; nearest is ", likely.word == NULL ? "" : likely.word);
    return EXIT_BAD;
}

static int run(int argc, char **argv)
{
    if (argc < 2) {
        fprintf(stderr, "usage: accel COMMAND [ARGUMENT]...; 'accel --help' lists the commands\n");
        return EXIT_BAD;
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0) {
        return print_overview();
    }
    if (strcmp(argv[1], "--version") == 0) {
        printf("accel %s\n", accel_version());
        return EXIT_FINE;
    }
    for (size_t i = 0; i < COMMANDS; i++) {
        if (strcmp(argv[1], commands[i]->name) == 0) {
            return commands[i]->run(commands[i], argc - 1, argv + 1);
        }
    }
    return complain_of_command(argv[1]);
}

/* Where the shell closed one of them, the next file to be opened would take its place, and get what
 * is printed. What is printed to these fails. */
static void occupy_standard_files(void)
{
    int file = 0;
    while (file >= 0 && file <= STDERR_FILENO) {
        file = open("/dev/null", O_RDONLY);
    }
    close(file);
}

/* Where it failed before the end, stdio no longer knows why: the same is tried once more. */
static bool all_printed(void)
{
    errno = 0;
    if (fflush(stdout) == 0 && !ferror(stdout)) {
        return true;
    }
    if (errno == 0) {
        putchar('\n');
        fflush(stdout);
    }
    fprintf(stderr, "accel: cannot write the output: %s\n",
            errno == EBADF ? "it is closed"
            : errno == 0   ? "a part of it is lost"
                           : strerror(errno));
    return false;
}

int main(int argc, char **argv)
{
    occupy_standard_files();
    const int code = run(argc, argv);
    return all_printed() ? code : EXIT_BAD;
}
