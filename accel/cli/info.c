/* SPDX-License-Identifier: Apache-2.0
 *
 * accel info: what was built, how large it is, how long it took, what was left out.
 */
#include "commands.h"
#include "structure.h"

#include <inttypes.h>
#include <stdio.h>

enum { FLAG_CONFIG };

static const struct flag flags[] = {
    {"accelerator", 'a', "CONFIG",
     "structure to build, may be repeated (default: " ACCEL_DEFAULT_CONFIG ")"},
};

static void print_skipped(const accel_info *info)
{
    printf("  skipped       %" PRIu64 " invalid primitives", info->skipped);
    const uint64_t shown = info->skipped < ACCEL_INFO_IDS ? info->skipped : ACCEL_INFO_IDS;
    for (uint64_t i = 0; i < shown; i++) {
        printf("%s%" PRIu32 "/%" PRIu32, i == 0 ? ", first (geometry/primitive) " : " ",
               info->skipped_ids[i].geom, info->skipped_ids[i].prim);
    }
    printf("\n");
    printf("  degenerate    %" PRIu64 " triangles that no ray can hit\n", info->degenerate);
    printf("  unbounded     %" PRIu64 " objects, tested for every ray\n", info->unbounded);
}

static void print_structure(const accel_info *info)
{
    if (info->size_classes != 0) {
        printf("  size classes  %" PRIu32 "\n", info->size_classes);
    }
    if (info->clusters != 0) {
        printf("  clusters      %" PRIu32 "\n", info->clusters);
    }
    printf("  nodes         %" PRIu64 " inner\n", info->nodes);
    printf("  leaves        %" PRIu64 " with something in them\n", info->leaves);
    const uint64_t kept = info->primitives - info->skipped - info->degenerate;
    printf("  references    %" PRIu64, info->references);
    if (kept != 0) {
        printf(", %.2f per primitive", (double)info->references / (double)kept);
    }
    printf("\n  depth         %" PRIu32 "\n", info->depth);
    printf("  memory        %" PRIu64 " bytes", info->bytes);
    if (kept != 0) {
        printf(", %.1f per primitive", (double)info->bytes / (double)kept);
    }
    printf("; %" PRIu64 " at most during the build\n", info->peak_bytes);
}

static double percent_above(uint64_t told, uint64_t is)
{
    return is > 0 ? 100.0 * ((double)told / (double)is - 1.0) : 0.0;
}

static void print_estimate(const accel_info *info, const accel_size *size)
{
    printf("  estimated     %" PRIu64 " bytes (%+.1f %%), %" PRIu64 " at most (%+.1f %%)%s\n",
           size->bytes, percent_above(size->bytes, info->bytes), size->peak_bytes,
           percent_above(size->peak_bytes, info->peak_bytes),
           size->exact ? ", by building it" : "");
}

static void print_time(const accel_info *info)
{
    printf("  build time    %.6f s", info->seconds);
    for (uint32_t i = 0; i < info->phase_count; i++) {
        printf("%s%s %.6f", i == 0 ? ": " : ", ", info->phases[i].name, info->phases[i].seconds);
    }
    printf("\n");
    for (uint32_t i = 0; i < info->left_out_count; i++) {
        printf("  left out      %s: %" PRIu64 " bytes, %.2g s\n", info->left_out[i].what,
               info->left_out[i].bytes, info->left_out[i].seconds);
    }
    for (uint32_t i = 0; i < info->note_count; i++) {
        printf("  note          %s\n", info->notes[i]);
    }
}

static void print_info(const accel *a, const accel_size *size)
{
    accel_info info;
    accel_describe(a, &info);
    printf("%s\n", info.config);
    print_skipped(&info);
    print_structure(&info);
    print_estimate(&info, size);
    print_time(&info);
}

static void print_scene(const char *name, const struct loaded *loaded)
{
    accel_box box;
    printf("%s: %" PRIu64 " primitives in %" PRIu32 " geometries", name,
           scene_primitives(&loaded->scene), loaded->scene.count);
    if (scene_box(&loaded->scene, &box)) {
        /* Of 0 and -0 either may be the least: adding 0 makes both 0. */
        printf(", box (%.9g %.9g %.9g) to (%.9g %.9g %.9g)", box.lo[0] + 0.0, box.lo[1] + 0.0,
               box.lo[2] + 0.0, box.hi[0] + 0.0, box.hi[1] + 0.0, box.hi[2] + 0.0);
    }
    if (loaded->left_out != 0) {
        printf("; %" PRIu64 " points and lines left out", loaded->left_out);
    }
    printf("\n");
}

static int describe(const struct command *command, const char *scene, const struct configs *configs,
                    bool quiet)
{
    struct progress progress = progress_start(quiet);
    struct loaded loaded;
    if (!open_scene(&loaded, scene, command, &progress)) {
        return EXIT_BAD;
    }
    int code = EXIT_FINE;
    for (size_t i = 0; i < configs->count && code == EXIT_FINE; i++) {
        accel_size size;
        accel_estimate(&loaded.scene, configs->items[i], NULL, &size, NULL);
        accel *a = open_structure(&loaded, configs->items[i], command, &progress);
        if (a == NULL) {
            code = EXIT_BAD;
        } else {
            if (i == 0) {
                print_scene(scene, &loaded);
            }
            print_info(a, &size);
        }
        accel_free(a);
    }
    unload_scene(&loaded);
    return code;
}

static int run(const struct command *command, int argc, char **argv)
{
    struct arguments arguments = arguments_start(command, argc, argv);
    struct configs configs = {0};
    const char *scene = NULL;
    for (;;) {
        switch (next_argument(&arguments)) {
        case ARGUMENT_STOP:
            return arguments.exit_code;
        case FLAG_CONFIG:
            if (!configs_add(&configs, arguments.value, command)) {
                return EXIT_BAD;
            }
            break;
        case ARGUMENT_WORD:
            if (!one_word(&arguments, "SCENE", &scene)) {
                return EXIT_BAD;
            }
            break;
        default:
            if (scene == NULL) {
                return complain(command, "no SCENE is given; usage: accel %s %s", command->name,
                                command->arguments);
            }
            if (configs.count == 0) {
                configs.items[configs.count++] = ACCEL_DEFAULT_CONFIG;
            }
            return describe(command, scene, &configs, arguments.quiet);
        }
    }
}

const struct command command_info = {
    .name = "info",
    .takes_objects = true,
    .arguments = "SCENE [-a CONFIG]...",
    .summary = "build structures over a scene and describe them",
    .details =
        "What a scene has no need of is left out; its bytes are counted, the seconds of building "
        "it\n"
        "predicted: those that the same phase of this build took for each byte that it made.\n"
        "\n"
        "SCENE is a built-in scene (see accel kinds) or a mesh file. Its bytes say which format "
        "it\n"
        "is, and its name where they do not. Triangles keep the file's order, faces of more "
        "corners\n"
        "are cut in place, vertices are neither joined nor moved; coordinates of text become the\n"
        "nearest double, those of binary files keep their value. Points and lines are left out "
        "and\n"
        "counted, materials passed over; whatever else cannot be read is refused with its line.\n"
        "  OBJ   faces and all that may stand beside them, lines joined by '\\'; a geometry for "
        "each\n"
        "        object or group. Not: free-form surfaces, call and csh.\n"
        "  PLY   1.0, text and binary of either byte order; face and tristrips of vertex_indices "
        "or\n"
        "        vertex_index; one geometry.\n"
        "  STL   text and binary; a geometry for each solid.\n"
        "  OFF   [ST][C][N][4]OFF, and nOFF of 3 dimensions; text and binary; one geometry.\n"
        "  glTF  2.0, .gltf with data or files in the same folder, .glb; the default scene at "
        "rest,\n"
        "        with sparse and quantized numbers, morph targets and skins; a geometry for each\n"
        "        primitive of a node's mesh, nodes depth first, their matrices applied in double.\n"
        "        Not: Draco and other extensions that the file requires and that change "
        "triangles.\n"
        "Words such as nan and 0x1p3 are no numbers here; a binary NaN is loaded, and its "
        "triangles\n"
        "are skipped. Other formats are read by assimp, unchecked and as float, which is said.",
    .flags = flags,
    .flag_count = sizeof flags / sizeof flags[0],
    .many = 1u << FLAG_CONFIG,
    .run = run,
};
