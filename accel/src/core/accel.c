/* SPDX-License-Identifier: Apache-2.0
 *
 * The list of kinds, and the life of a structure: build, describe, validate, free.
 */
#include "config.h"
#include "box.h"
#include "environment.h"
#include "kind.h"
#include "seal.h"
#include "../wide/wide_isa.h"

#include <string.h>

/* A library of some kinds names a list of its own. */
#ifndef ACCEL_KINDS_FILE
#define ACCEL_KINDS_FILE "../kinds/kinds.h"
#endif

#define KIND(name, parts) extern const struct accel_kind accel_##name##_kind;
#include ACCEL_KINDS_FILE
#undef KIND

#define KIND(name, parts) &accel_##name##_kind.info,
const accel_kind_info *const accel_kind_list[] = {
#include ACCEL_KINDS_FILE
    NULL};
#undef KIND

_Static_assert(sizeof accel_kind_list / sizeof *accel_kind_list <= MAX_KINDS + 1,
               "raise MAX_KINDS in kind.h");

const char *accel_version(void)
{
    return ACCEL_VERSION;
}

const accel_kind_info *const *accel_kinds(size_t *count)
{
    if (count)
        *count = sizeof accel_kind_list / sizeof *accel_kind_list - 1;
    return accel_kind_list;
}

/* What is built moved, or is new. */
static void build_of(struct build *build, accel *a)
{
    build->a = a;
    build->memory = &a->memory;
    build->info = &a->info;
    build->kind = a->kind->info.name;
}

/* Lets a kind that stands for others pick one, and turns the structure into that, with default
 * options. */
static bool choose(struct build *build)
{
    const struct accel_kind *from = build->a->kind,
                            *to = (const struct accel_kind *)accel_kind_list[0];
    accel_build_phase(build, "choose");
    if (build->a->prims.bounded.count > 0 && !from->choose(build, &to))
        return false;
    struct memory m = build->a->memory;
    accel *a = accel_memory_resize(&m, build->a, from->size, to->size);
    if (!a) {
        build->a->memory = m;
        return accel_build_no_memory(build);
    }
    memset((char *)a + from->size, 0, to->size - from->size);
    a->memory = m;
    a->kind = to;
    build_of(build, a);
    return accel_config_parse(to->info.name, a->option, build->error) != NULL;
}

/* Copies the scene and builds the kind over it. */
static bool run(struct build *build, const accel_scene *scene)
{
    accel_build_phase(build, "copy");
    const struct timespec start = build->last_tick = build->phase_start;
    if (!accel_primitives_copy(build, &build->a->prims, scene))
        return false;
    if (build->a->kind->choose && !choose(build))
        return false;
    struct accel *a = build->a;
    if (a->prims.bounded.count > 0) {
        if (!a->kind->build(build))
            return false;
    }
    accel_build_phase(build, NULL);
    a->info.kind = a->kind->info.name;
    accel_config_print(a->kind, a->option, a->info.config, sizeof a->info.config);
    a->info.seconds = accel_seconds_since(&start);
    return true;
}

void accel_note_idle_option(struct build *build, size_t option, const char *form)
{
    const accel_option *o = &build->a->kind->info.options[option];
    const double value = build->a->option[option];
    if (value != o->standard && !(isnan(value) && isnan(o->standard)))
        accel_build_note(build, "%s has no effect with %s", o->key, form);
}

static uint64_t seal_of_base(const accel *a)
{
    return seal_bytes(a, offsetof(accel, seal));
}

static uint64_t seal_of_kind(const accel *a)
{
    return seal_bytes(a + 1, a->kind->size - sizeof *a);
}

static void seal(accel *a)
{
    accel_primitives_seal(&a->prims);
    a->seal[0] = seal_of_base(a);
    a->seal[1] = seal_of_kind(a);
}

static accel *allocate(const struct accel_kind *kind, const accel_hooks *hooks, accel_error *error)
{
    struct memory m = {.resize = hooks->resize ? hooks->resize : accel_memory_system,
                       .user = hooks->user,
                       .limit = hooks->memory_limit};
    accel *a = accel_memory_resize(&m, NULL, 0, kind->size);
    if (!a && m.wanted > 0) {
        accel_error_set(
            error, ACCEL_NO_MEMORY,
            "build %s: hooks.memory_limit allows %zu bytes, but %zu are needed in phase "
            "'start'; nothing was built",
            kind->info.name, m.limit, m.wanted);
        return NULL;
    }
    if (!a) {
        accel_error_set(error, ACCEL_NO_MEMORY,
                        "build %s: no memory for %zu bytes in phase 'start'; nothing was built",
                        kind->info.name, kind->size);
        return NULL;
    }
    memset(a, 0, kind->size);
    a->kind = kind;
    a->memory = m;
    return a;
}

/* In the default floating-point environment: see environment.h. */
__attribute__((noinline)) static accel_status build_scene(accel **out, const accel_scene *scene,
                                                          const char *config,
                                                          const accel_hooks *hooks,
                                                          accel_error *error)
{
    double option[MAX_OPTIONS];
    const struct accel_kind *kind = accel_config_parse(config, option, error);
    accel *a = kind ? allocate(kind, hooks, error) : NULL;
    if (!a)
        return error->status;
    memcpy(a->option, option, sizeof option);
    struct build build = {.hooks = hooks, .error = error};
    build_of(&build, a);
    if (!run(&build, scene)) {
        accel_free(build.a);
        return error->status;
    }
    build.a->memory.limit = 0; /* queries of a lazy structure keep their own account */
    seal(build.a);
    *out = build.a;
    return ACCEL_OK;
}

CONTRACT_CHECK(contract_kept);

accel_status accel_build(accel **out, const accel_scene *scene, const char *config,
                         const accel_hooks *hooks, accel_error *error)
{
    static const accel_hooks no_hooks = {.user = NULL};
    accel_error ignored;
    error = error ? error : &ignored;
    hooks = hooks ? hooks : &no_hooks;
    error->status = ACCEL_OK;
    error->text[0] = '\0';
    if (out)
        *out = NULL;
    if (!out || !scene || (scene->count > 0 && !scene->geometries))
        return accel_error_set(error, ACCEL_BAD_ARGUMENT, "build: %s is NULL; nothing was built",
                               !out     ? "out"
                               : !scene ? "scene"
                                        : "scene.geometries");
    if (hooks->pilot_count > 0 && !hooks->pilot)
        return accel_error_set(
            error, ACCEL_BAD_ARGUMENT,
            "build: hooks.pilot is NULL, but hooks.pilot_count is %zu; nothing was "
            "built",
            hooks->pilot_count);
    if (!contract_kept())
        return accel_error_set(
            error, ACCEL_BROKEN,
            "build: this library was compiled so that products and sums are rounded "
            "together, which makes answers wrong; compile all of its files with "
            "-ffp-contract=off; nothing was built");
    const fenv_t callers = environment_enter();
    const accel_status status = build_scene(out, scene, config, hooks, error);
    environment_leave(&callers);
    return status;
}

void accel_free(accel *a)
{
    if (!a)
        return;
    if (a->kind->release)
        a->kind->release(a);
    accel_primitives_free(&a->memory, &a->prims);
    struct memory m = a->memory;
    accel_memory_resize(&m, a, a->kind->size, 0);
}

void accel_describe(const accel *a, accel_info *info)
{
    if (!info)
        return;
    if (!a) {
        *info = (accel_info){.kind = ""};
        return;
    }
    *info = a->info;
    info->bytes = a->memory.bytes;
    info->peak_bytes = a->memory.peak;
    if (a->kind->describe && a->prims.bounded.count > 0)
        a->kind->describe(a, info);
}

bool accel_padded_box(const accel *a, accel_id id, accel_box *box)
{
    if (!a || !box)
        return false;
    const uint32_t number = primitives_id(&a->prims, id);
    if (number == ACCEL_NONE)
        return false;
    if (!a->prims.box && a->prims.count > 0)
        return a->fast->isa->find_box(a->fast, number, box);
    *box = a->prims.box[number];
    return box->lo[0] <= box->hi[0];
}

/* The seals come first: after them every pointer and count of the struct is right. */
__attribute__((noinline)) static void check(const accel *a, accel_error *error)
{
    if (a->seal[0] != seal_of_base(a) || a->seal[1] != seal_of_kind(a))
        accel_error_set(error, ACCEL_BROKEN, "accel: overwritten since it was built, %p",
                        (const void *)a);
    else if (accel_primitives_validate(&a->prims, error) && a->prims.bounded.count > 0)
        a->kind->validate(a, error);
}

accel_status accel_validate(const accel *a, accel_error *error)
{
    accel_error ignored;
    error = error ? error : &ignored;
    error->status = ACCEL_OK;
    error->text[0] = '\0';
    if (!a)
        return accel_error_set(error, ACCEL_BAD_ARGUMENT, "validate: the structure is NULL");
    const fenv_t callers = environment_enter();
    check(a, error);
    environment_leave(&callers);
    return error->status;
}
