/* SPDX-License-Identifier: Apache-2.0
 *
 * accel kinds: every kind of structure and every built-in scene with its options, straight from the
 * tables that their parsers use.
 */
#include "commands.h"
#include "catalogue.h"
#include "generator.h"

#include <math.h>
#include <stdio.h>

static void print_range(const accel_option *option)
{
    if (option->words != NULL) {
        for (size_t i = 0; option->words[i] != NULL; i++) {
            printf("%s%s", i == 0 ? "" : "|", option->words[i]);
        }
    } else {
        printf("%.12g..%.12g%s", option->min, option->max, option->whole ? " whole" : "");
    }
}

static void print_standard(const accel_option *option)
{
    if (isnan(option->standard)) {
        printf("auto");
    } else if (option->words != NULL) {
        printf("%s", option->words[(size_t)option->standard]);
    } else {
        printf("%.12g", option->standard);
    }
}

static void print_kind(const accel_kind_info *kind)
{
    printf("%-10s %s\n", kind->name, kind->summary);
    for (size_t i = 0; i < kind->option_count; i++) {
        const accel_option *option = &kind->options[i];
        printf("    %s=", option->key);
        print_range(option);
        printf("  (default ");
        print_standard(option);
        printf(")\n        %s\n", option->meaning);
    }
}

static int run(const struct command *command, int argc, char **argv)
{
    struct arguments arguments = arguments_start(command, argc, argv);
    switch (next_argument(&arguments)) {
    case ARGUMENT_END:
        break;
    case ARGUMENT_STOP:
        return arguments.exit_code;
    default:
        return complain(command, "unexpected '%.60s': it takes no argument", arguments.value);
    }
    size_t count;
    const accel_kind_info *const *kinds = accel_kinds(&count);
    printf("Kinds of structure, CONFIG = kind[:key=value[,key=value]...], default %s:\n\n",
           ACCEL_DEFAULT_CONFIG);
    for (size_t i = 0; i < count; i++) {
        print_kind(kinds[i]);
    }
    printf("\nBuilt-in scenes, SCENE = name[:key=value[,key=value]...]:\n\n");
    for (size_t i = 0; generators[i] != NULL; i++) {
        print_kind(&generators[i]->info);
    }
    printf("\nStiff and extreme scenes, SCENE = name[:seed=number] (host objects: info and check "
           "only):\n\n");
    for (const struct scene_maker *maker = scene_makers; maker->name != NULL; maker++) {
        printf("%-16s %s\n", maker->name, maker->meaning);
    }
    return EXIT_FINE;
}

const struct command command_kinds = {
    .name = "kinds",
    .arguments = "",
    .summary = "list the kinds of structure and the built-in scenes with their options",
    .run = run,
};
