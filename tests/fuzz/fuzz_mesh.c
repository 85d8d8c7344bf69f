/* SPDX-License-Identifier: Apache-2.0
 *
 * The readers of mesh files on any bytes: they end, in memory that the size of the file bounds; a
 * refusal is one printable line; what is accepted refers to vertices that are there, is the same
 * each time, and written as OBJ, OFF or PLY it is read as the same mesh.
 */
#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jansson.h>

#include "fuzz.h"
#include "mesh/mesh.h"

/* Bytes that placed meshes may take; and that each byte of a file may take besides. */
enum { MOST_PLACED = 1 << 20, MOST_A_BYTE = 128, MOST_FIXED = 1 << 16 };

/* ----------------------------------------------------------------- memory ---- */

/* What is held, of all blocks that the linker sends here. */
static size_t held, peak;

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);
void __real_free(void *block);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *old, size_t size);
void __wrap_free(void *block);

static void *counted(void *block)
{
    held += block ? malloc_usable_size(block) : 0;
    peak = held > peak ? held : peak;
    return block;
}

void *__wrap_malloc(size_t size)
{
    return counted(__real_malloc(size));
}

void *__wrap_calloc(size_t count, size_t size)
{
    return counted(__real_calloc(count, size));
}

/* While it moves, a block is there twice. */
void *__wrap_realloc(void *old, size_t size)
{
    const size_t before = old ? malloc_usable_size(old) : 0;
    void *block = counted(__real_realloc(old, size));
    held -= block ? before : 0;
    return block;
}

void __wrap_free(void *block)
{
    held -= block ? malloc_usable_size(block) : 0;
    __real_free(block);
}

/* ---------------------------------------------------------------- reading ---- */

/* Every other file that is asked for is this one. */
static bool read_same(void *user, struct file *file, const char *name, accel_error *error)
{
    const struct mesh_source *source = user;
    (void)error;
    *file = (struct file){.path = name, .bytes = malloc(source->size + 1), .size = source->size};
    if (!file->bytes)
        return false;
    memcpy(file->bytes, source->bytes, source->size);
    file->bytes[source->size] = '\0';
    return true;
}

static void check_memory(const struct mesh_source *source, size_t before)
{
    const size_t most = MOST_PLACED + MOST_FIXED + MOST_A_BYTE * source->size;
    if (peak - before > most)
        broken("%s: %zu bytes of a file take %zu bytes of memory", source->name, source->size,
               peak - before);
}

static bool read_mesh(struct loaded *out, const char *name, const char *bytes, size_t size)
{
    struct mesh_source source = {
        .name = name, .bytes = bytes, .size = size, .memory = MOST_PLACED, .beside = read_same};
    accel_error error = {ACCEL_OK, ""};
    const size_t before = held;
    source.user = &source;
    *out = (struct loaded){0};
    peak = held;
    const bool fine = mesh_load(out, &source, &error);
    check_memory(&source, before);
    if (!fine) {
        check_text(error.text);
        unload_scene(out);
    }
    return fine;
}

/* ----------------------------------------------------------------- meshes ---- */

static bool all_finite(const accel_triangles *mesh)
{
    bool finite = true;
    for (uint32_t i = 0; i < mesh->count; i++)
        for (int corner = 0; corner < 3; corner++) {
            double v[3];
            scene_vertex(mesh, i, corner, v);
            finite = finite && isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
        }
    return finite;
}

static void check_mesh(const struct loaded *loaded)
{
    if (scene_primitives(&loaded->scene) == 0)
        broken("a mesh without triangles is accepted");
    for (uint32_t g = 0; g < loaded->scene.count; g++) {
        const accel_geometry *geometry = &loaded->scene.geometries[g];
        const accel_triangles *mesh = &geometry->triangles;
        if (geometry->type != ACCEL_TRIANGLES)
            broken("geometry %u is no mesh", g);
        for (size_t i = 0; i < 3 * (size_t)mesh->count; i++)
            if (mesh->indices[i] >= mesh->vertex_count)
                broken("geometry %u has %u vertices, but uses vertex %u", g, mesh->vertex_count,
                       mesh->indices[i]);
    }
    if (loaded->note[0] != '\0')
        check_text(loaded->note);
}

static bool same_mesh(const accel_triangles *a, const accel_triangles *b)
{
    bool same = a->count == b->count;
    for (uint32_t i = 0; same && i < a->count; i++)
        for (int corner = 0; corner < 3; corner++) {
            double v[3], w[3];
            scene_vertex(a, i, corner, v);
            scene_vertex(b, i, corner, w);
            same = same && memcmp(v, w, sizeof v) == 0;
        }
    return same;
}

static void check_same(const struct loaded *a, const struct loaded *b, const char *when)
{
    bool same = a->scene.count == b->scene.count;
    for (uint32_t g = 0; same && g < a->scene.count; g++)
        same = same_mesh(&a->scene.geometries[g].triangles, &b->scene.geometries[g].triangles);
    if (!same)
        broken("%s: another mesh", when);
}

/* ---------------------------------------------------------------- writing ---- */

static void write_head(FILE *f, const accel_triangles *mesh, const char *format)
{
    const unsigned vertices = 3 * mesh->count, faces = mesh->count;
    if (strcmp(format, "off") == 0)
        fprintf(f, "OFF\n%u %u 0\n", vertices, faces);
    else if (strcmp(format, "ply") == 0)
        fprintf(f,
                "ply\nformat ascii 1.0\nelement vertex %u\nproperty double x\nproperty double y\n"
                "property double z\nelement face %u\nproperty list uchar uint vertex_indices\n"
                "end_header\n",
                vertices, faces);
}

/* Each triangle has its own three vertices; 17 digits name a double. */
static char *write_mesh(const accel_triangles *mesh, const char *format, size_t *size)
{
    char *text = NULL;
    FILE *f = open_memstream(&text, size);
    if (!f)
        broken("no memory to write a mesh");
    const bool obj = strcmp(format, "obj") == 0;
    write_head(f, mesh, format);
    for (uint32_t i = 0; i < mesh->count; i++)
        for (int corner = 0; corner < 3; corner++) {
            double v[3];
            scene_vertex(mesh, i, corner, v);
            fprintf(f, "%s%.17g %.17g %.17g\n", obj ? "v " : "", v[0], v[1], v[2]);
        }
    for (unsigned i = 0; i < mesh->count; i++)
        fprintf(f, "%s %u %u %u\n", obj ? "f" : "3", 3 * i + obj, 3 * i + 1 + obj, 3 * i + 2 + obj);
    fclose(f);
    return text;
}

static void check_written(const struct loaded *loaded, const char *format)
{
    const accel_triangles *mesh = &loaded->scene.geometries[0].triangles;
    struct loaded again;
    size_t size;
    if (loaded->scene.count != 1 || !all_finite(mesh))
        return;
    char *text = write_mesh(mesh, format, &size);
    if (!read_mesh(&again, "written", text, size))
        broken("a mesh written as %s is refused", format);
    check_same(loaded, &again, format);
    unload_scene(&again);
    free(text);
}

static void check(const char *name, const char *bytes, size_t size)
{
    static const char *const formats[] = {"obj", "off", "ply"};
    struct loaded loaded, again;
    if (!read_mesh(&loaded, name, bytes, size))
        return;
    check_mesh(&loaded);
    if (!read_mesh(&again, name, bytes, size))
        broken("a mesh is refused the second time");
    check_same(&loaded, &again, "read again");
    check_written(&loaded, formats[size % 3]);
    unload_scene(&again);
    unload_scene(&loaded);
}

/* By each name, where the bytes leave the format open. */
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    static const char *const names[] = {"m.obj", "m.ply", "m.stl", "m.off", "m.gltf"};
    const char *text = (const char *)bytes;
    json_set_alloc_funcs(malloc, free);
    if (size == 0)
        return 0;
    if (mesh_recognise("m", text, size) != MESH_OTHER) {
        check("m", text, size);
        return 0;
    }
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        check(names[i], text, size);
    return 0;
}
