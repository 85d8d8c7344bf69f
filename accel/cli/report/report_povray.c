/* SPDX-License-Identifier: Apache-2.0
 *
 * Stock POV-Ray about the same rays: its scene language has trace(), which shoots one ray at an
 * object from any origin. The object is a union of triangles and spheres, so that POV-Ray keeps
 * their numbers in double and puts its own boxes around them. The scene counts its mistakes itself
 * and writes three numbers; its picture has one pixel.
 */
#include "report_cases.h"

#include <errno.h>
#include <fcntl.h>
#include <float.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

static const char scene_name[] = "povray.pov", answer_name[] = "povray.txt",
                  log_name[] = "povray.log";

enum { MOST_SECONDS = 20 };

static _Noreturn void run_povray(const char *folder, const char *argument)
{
    const struct rlimit limit = {MOST_SECONDS, MOST_SECONDS};
    setrlimit(RLIMIT_CPU, &limit);
    const int in = open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (chdir(folder) != 0) {
        _exit(126);
    }
    const int out = open(log_name, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    if (in < 0 || out < 0 || dup2(in, STDIN_FILENO) < 0 || dup2(out, STDOUT_FILENO) < 0 ||
        dup2(out, STDERR_FILENO) < 0) {
        _exit(126);
    }
    execlp("povray", "povray", argument, "-D", "-F", "-P", "+W1", "+H1", (char *)NULL);
    _exit(127);
}

/* Did it end well? */
static bool run(struct reporting *r, const char *argument)
{
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        run_povray(r->folder.temporary, argument);
    }
    int status = 0;
    while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return child > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

const char *povray_version(struct reporting *r)
{
    static char line[120];
    FILE *log = folder_write(&r->folder, log_name);
    if (log != NULL) {
        fclose(log);
    }
    const bool fine = run(r, "--version");
    log = folder_read(&r->folder, log_name);
    line[0] = '\0';
    while (log != NULL && fgets(line, sizeof line, log) != NULL &&
           strncmp(line, "POV-Ray", 7) != 0) {
    }
    if (log != NULL) {
        fclose(log);
    }
    folder_remove(&r->folder, log_name);
    line[strcspn(line, "\n")] = '\0';
    return fine && strncmp(line, "POV-Ray", 7) == 0 ? line : NULL;
}

/* -------------------------------------------------------------------- scene ---- */

static void write_vector(FILE *f, const double *x)
{
    fprintf(f, "<%.17g,%.17g,%.17g>", x[0], x[1], x[2]);
}

static void write_object(FILE *f, const struct test_scene *s)
{
    fprintf(f, "#declare U = union {\n");
    for (uint32_t g = 0; g < s->count; g++) {
        const struct part *p = &s->part[g];
        for (uint32_t i = 0; i < p->count; i++) {
            const double *x = p->data + (p->type == ACCEL_TRIANGLES ? 9 : 4) * (size_t)i;
            fprintf(f, p->type == ACCEL_TRIANGLES ? "triangle {" : "sphere {");
            write_vector(f, x);
            fputc(',', f);
            if (p->type == ACCEL_TRIANGLES) {
                write_vector(f, x + 3);
                fputc(',', f);
                write_vector(f, x + 6);
            } else {
                fprintf(f, "%.17g", x[3]);
            }
            fprintf(f, "}\n");
        }
    }
    fprintf(f, "}\n");
}

/* What is right for ray i, as the macro below takes it; -1 if nobody says so. */
static int right_answer(const struct exam *e, size_t i, double length, double *t)
{
    const struct crossing *c = &e->exact[i].crossing;
    *t = 1.0;
    switch (e->judge) {
    case BY_HIT:
        return 1;
    case BY_INTEGERS:
        if (c->under == 0) {
            return 0;
        }
        *t = length * (double)c->over / (2.0 * (double)c->under);
        return 2;
    case BY_ORACLE:
        if (e->right[i].verdict != HIT) {
            return e->right[i].verdict == UNDECIDED ? -1 : 0;
        }
        *t = length * (double)e->right[i].hit.t;
        return 2;
    default:
        return -1;
    }
}

/* A direction of length 1, and the length that it had. */
static double unit(const double dir[3], double out[3])
{
    const double largest = fmax(fabs(dir[0]), fmax(fabs(dir[1]), fabs(dir[2])));
    double square = 0.0;
    for (int k = 0; k < 3; k++) {
        out[k] = dir[k] / largest;
        square += out[k] * out[k];
    }
    for (int k = 0; k < 3; k++) {
        out[k] /= sqrt(square);
    }
    return largest * sqrt(square);
}

/* Can POV-Ray's language express a length and divide by it? Not that of no direction. */
static bool can_be_said(double length)
{
    return length >= DBL_MIN && length <= DBL_MAX;
}

/* One call of the macro for each ray; returns how many. */
static size_t write_rays(FILE *f, const struct exam *e, size_t most)
{
    size_t asked = 0;
    for (size_t i = 0; i < e->set.count && asked < most; i++) {
        double dir[3], t;
        const double length = unit(e->set.rays[i].dir, dir);
        const int right = right_answer(e, i, length, &t);
        if (right < 0 || !can_be_said(length) || !can_be_said(t)) {
            continue;
        }
        fprintf(f, "Ask(");
        write_vector(f, e->set.rays[i].org);
        fputc(',', f);
        write_vector(f, dir);
        fprintf(f, ",%d,%.17g)\n", right, t);
        asked++;
    }
    return asked;
}

/* H: 0 for a miss, 1 for a hit, 2 for a hit at T. POV-Ray takes numbers that differ by less than
 * 1e-10 for equal, so distances are compared by their ratio. */
static const char macro[] =
    "#declare Lost = 0; #declare Found = 0; #declare Off = 0;\n"
    "#macro Ask(O, D, H, T)\n"
    "  #local N = <0,0,0>; #local P = trace(U, O, D, N);\n"
    "  #if (N.x = 0 & N.y = 0 & N.z = 0) #if (H > 0) #declare Lost = Lost + 1; #end\n"
    "  #else #if (H = 0) #declare Found = Found + 1;\n"
    "  #else #if (H = 2) #if (abs(vdot(P - O, D) / T - 1) > 0.001) #declare Off = Off + 1; #end\n"
    "  #end #end #end\n"
    "#end\n";

static bool read_answer(struct reporting *r, struct povray *out)
{
    FILE *f = folder_read(&r->folder, answer_name);
    const bool fine =
        f != NULL && fscanf(f, "%zu %zu %zu", &out->lost, &out->false_hits, &out->off) == 3;
    if (f != NULL) {
        fclose(f);
    }
    return fine;
}

bool povray_ask(struct reporting *r, const struct exam *e, size_t most, struct povray *out)
{
    *out = (struct povray){.ran = false};
    FILE *f = folder_write(&r->folder, scene_name);
    FILE *answer = folder_write(&r->folder, answer_name);
    if (answer != NULL) {
        fclose(answer);
    }
    if (f == NULL) {
        return false;
    }
    fprintf(f, "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n");
    write_object(f, e->scene);
    fputs(macro, f);
    out->asked = write_rays(f, e, most);
    fprintf(f,
            "#fopen F \"%s\" write\n#write (F, Lost, \" \", Found, \" \", Off, \"\\n\")\n"
            "#fclose F\n",
            answer_name);
    const bool written = folder_close(&r->folder, f) == NULL;
    char argument[64];
    snprintf(argument, sizeof argument, "+I%s", scene_name);
    out->ran = written && out->asked > 0 && run(r, argument) && read_answer(r, out);
    folder_remove(&r->folder, scene_name);
    folder_remove(&r->folder, answer_name);
    folder_remove(&r->folder, log_name);
    return out->ran;
}
