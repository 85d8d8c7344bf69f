/* SPDX-License-Identifier: Apache-2.0
 *
 * accel diff: do two OpenEXR files of hits agree in every bit of every channel?
 */
#include "commands.h"
#include "tool/image.h"
#include "structure.h"
#include "tool/words.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

enum { FLAG_OUTPUT };

enum { SHOWN = 10 };

static const struct flag flags[] = {
    {"output", 'o', "FILE.png", "difference image: white where a pixel differs, else dark"},
};

/* Why the two cannot be compared, or NULL. */
static const char *why_not_comparable(const struct image *a, const struct image *b)
{
    if (a->width != b->width || a->height != b->height) {
        return "differ in size";
    }
    if (a->channel_count != b->channel_count) {
        return "differ in the number of channels";
    }
    for (uint32_t i = 0; i < a->channel_count; i++) {
        if (strcmp(a->channels[i].name, b->channels[i].name) != 0 ||
            a->channels[i].is_float != b->channels[i].is_float) {
            return "differ in the names or types of channels";
        }
    }
    return NULL;
}

static bool pixel_differs(const struct image *a, const struct image *b, size_t pixel)
{
    for (uint32_t i = 0; i < a->channel_count; i++) {
        if (a->channels[i].bits[pixel] != b->channels[i].bits[pixel]) {
            return true;
        }
    }
    return false;
}

static void print_value(const struct image_channel *channel, size_t pixel)
{
    float value;
    if (channel->is_float) {
        memcpy(&value, &channel->bits[pixel], sizeof value);
        printf("%.9g", (double)value);
    } else {
        printf("%" PRIu32, channel->bits[pixel]);
    }
}

static double join_halves(const struct image_channel *hi, size_t pixel)
{
    const uint64_t bits = (uint64_t)hi[0].bits[pixel] << 32 | hi[1].bits[pixel];
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Is channel i the upper half of a double, and the next one its lower half? */
static bool is_double(const struct image *image, uint32_t i)
{
    const struct image_channel *hi = &image->channels[i];
    const size_t length = strlen(hi->name);
    return i + 1 < image->channel_count && length > 3 && !hi->is_float &&
           strcmp(hi->name + length - 3, ".hi") == 0 &&
           strncmp(hi->name, hi[1].name, length - 2) == 0 &&
           strcmp(hi[1].name + length - 3, ".lo") == 0;
}

static void print_pixel(const struct image *a, const struct image *b, size_t pixel)
{
    printf("pixel (%zu, %zu):", pixel % a->width, pixel / a->width);
    for (uint32_t i = 0; i < a->channel_count; i++) {
        const struct image_channel *ca = &a->channels[i], *cb = &b->channels[i];
        const bool whole = is_double(a, i);
        const bool differs = ca[0].bits[pixel] != cb[0].bits[pixel] ||
                             (whole && ca[1].bits[pixel] != cb[1].bits[pixel]);
        if (differs && whole) {
            printf("  %.*s %.17g / %.17g", (int)strlen(ca->name) - 3, ca->name,
                   join_halves(ca, pixel), join_halves(cb, pixel));
        } else if (differs) {
            printf("  %s ", ca->name);
            print_value(ca, pixel);
            printf(" / ");
            print_value(cb, pixel);
        }
        i += whole;
    }
    printf("\n");
}

static uint64_t compare(const struct image *a, const struct image *b, unsigned char *picture)
{
    uint64_t different = 0;
    const size_t pixels = (size_t)a->width * a->height;
    for (size_t pixel = 0; pixel < pixels; pixel++) {
        const bool differs = pixel_differs(a, b, pixel);
        memset(picture + 3 * pixel, differs ? 255 : 24, 3);
        if (differs && different++ < SHOWN) {
            print_pixel(a, b, pixel);
        }
    }
    printf("%zu pixels, %" PRIu32 " channels: %" PRIu64 " pixels differ\n", pixels,
           a->channel_count, different);
    return different;
}

static int diff_images(const struct command *command, char *const names[2], const struct image *a,
                       const struct image *b, struct output *output)
{
    const char *trouble = why_not_comparable(a, b);
    if (trouble != NULL) {
        return complain(command, "%.100s and %.100s %s and cannot be compared", names[0], names[1],
                        trouble);
    }
    unsigned char *picture = malloc((size_t)a->width * a->height * 3);
    if (picture == NULL) {
        return complain(command, "out of memory; nothing was compared");
    }
    const uint64_t different = compare(a, b, picture);
    accel_error error;
    const bool written = output == NULL || png_write(picture, a->width, a->height, output, &error);
    free(picture);
    if (!written) {
        return complain(command, "%s", error.text);
    }
    return different == 0 ? EXIT_FINE : EXIT_DIFFERENT;
}

/* `output` is NULL where no picture is asked for. */
static int diff_files(const struct command *command, char *const names[2], struct output *output)
{
    static struct image a, b;
    accel_error error;
    if (!image_read_exr(&a, names[0], &error)) {
        return complain(command, "%s", error.text);
    }
    int code = EXIT_BAD;
    if (image_read_exr(&b, names[1], &error)) {
        code = diff_images(command, names, &a, &b, output);
        image_free(&b);
    } else {
        complain(command, "%s", error.text);
    }
    image_free(&a);
    return code;
}

static int diff_into_file(const struct command *command, char *const names[2], const char *path)
{
    struct output output;
    accel_error error;
    if (path == NULL) {
        return diff_files(command, names, NULL);
    }
    if (!output_open(&output, path, &error)) {
        return complain(command, "%s", error.text);
    }
    return end_output(&output, diff_files(command, names, &output), EXIT_DIFFERENT, command);
}

static int run(const struct command *command, int argc, char **argv)
{
    struct arguments arguments = arguments_start(command, argc, argv);
    char *names[2] = {NULL, NULL};
    const char *output = NULL;
    size_t count = 0;
    for (;;) {
        switch (next_argument(&arguments)) {
        case ARGUMENT_STOP:
            return arguments.exit_code;
        case FLAG_OUTPUT:
            output = arguments.value;
            break;
        case ARGUMENT_WORD:
            if (count == 2) {
                return complain(command, "unexpected '%.60s': two files are enough",
                                arguments.value);
            }
            names[count++] = argv[arguments.at - 1];
            break;
        default:
            if (count < 2) {
                return complain(command, "two files are needed; usage: accel %s %s", command->name,
                                command->arguments);
            }
            if (output != NULL && !ends_with(output, ".png")) {
                return complain(command, "-o '%.100s' does not end in .png; nothing was written",
                                output);
            }
            return diff_into_file(command, names, output);
        }
    }
}

const struct command command_diff = {
    .name = "diff",
    .arguments = "A.exr B.exr [-o FILE.png]",
    .summary = "compare two OpenEXR files of hits, bit for bit",
    .details =
        "Counts the pixels of which any channel differs in any bit, prints the first ten, and\n"
        "exits with 1 where there is any. Pairs NAME.hi and NAME.lo are shown as a double.\n"
        "Any scan line file without lossy compression can be compared.",
    .flags = flags,
    .flag_count = sizeof flags / sizeof flags[0],
    .run = run,
};
