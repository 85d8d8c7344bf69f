/* SPDX-License-Identifier: Apache-2.0
 *
 * Options of the subcommands: one table serves parser, help and "nearest".
 *
 * Written as -x VALUE, -xVALUE, --name VALUE or --name=VALUE; "--" ends the options. --help and
 * --quiet are understood everywhere.
 */
#ifndef ACCEL_CLI_OPTIONS_H
#define ACCEL_CLI_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* One option. */
struct flag {
    const char *name; /* without the dashes */
    char letter;      /* of the short form, or 0 */
    const char
        *argument;    /* the name of its value in the help, or NULL if it has none; in brackets
                         if it may be left out: "[FILE.csv]" takes a next word in .csv, or "-" */
    const char *help; /* one or more lines */
};

/* A subcommand. */
struct command {
    const char *name;         /* first word after "accel" */
    const char *arguments;    /* for the usage line */
    const char *summary;      /* one line */
    const char *details;      /* paragraphs for --help, or NULL */
    const struct flag *flags; /* `flag_count` of them, --help and --quiet not among them */
    size_t flag_count;
    bool takes_objects; /* scenes may hold objects of a host */
    uint64_t many;      /* a bit for each flag that may be given more than once */
    /* Runs it: argv[1] is the first argument. Returns the exit code. */
    int (*run)(const struct command *command, int argc, char **argv);
};

/* Exit codes. */
enum { EXIT_FINE = 0, EXIT_DIFFERENT = 1, EXIT_BAD = 2 };

/* What next_argument found, apart from the index of a flag. */
enum { ARGUMENT_WORD = -1, ARGUMENT_END = -2, ARGUMENT_STOP = -3 };

/* A walk over the arguments. */
struct arguments {
    const struct command *command;
    char **argv;
    int argc;
    int at;            /* of the next argument */
    uint64_t seen;     /* a bit for each flag with a value that has been given */
    bool words_only;   /* "--" has been seen */
    bool quiet;        /* --quiet has been seen */
    int exit_code;     /* after ARGUMENT_STOP */
    bool bare;         /* the flag before was given without the value that it may have */
    bool declined;     /* that word could have been the value of the flag before it */
    const char *value; /* of the flag, or the word */
};

/* Starts a walk. */
struct arguments arguments_start(const struct command *command, int argc, char **argv);

/* The index of the next flag in command->flags with its value in a->value, or one of the above.
 * ARGUMENT_STOP: help or an error has been printed; return a->exit_code. */
int next_argument(struct arguments *a);

/* Takes one argument: `found` is what next_argument returned. False: it was bad, and that has
 * been said. */
typedef bool take_argument(struct arguments *a, int found, void *request);

/* Hands every argument to `take`. False: the command ends here, with a->exit_code. */
bool take_arguments(struct arguments *a, take_argument *take, void *request);

/* Prints "accel NAME: TEXT" to stderr and returns EXIT_BAD. */
int complain(const struct command *command, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Prints "accel NAME: note: TEXT" to stderr. */
void note(const struct command *command, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Reads a->value as a whole number in min..max, or complains and returns false. */
bool whole_argument(const struct arguments *a, int flag, uint64_t min, uint64_t max, uint64_t *out);

/* Takes the one SCENE argument, or complains and returns false. */
bool one_word(const struct arguments *a, const char *what, const char **word);

#endif
