/* SPDX-License-Identifier: Apache-2.0
 *
 * Plots by gnuplot, which runs in the report's folder to read the figures there. Its program, the
 * plot and what it complains of are in memory: of the files of the folder none is written by
 * others, so that each knows what became of it. Programs: plots/style.gnuplot, what the section
 * gives, and one of plots/.
 */
#include "report.h"

#include "report_text.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* Standard input, output and error of gnuplot. */
typedef struct streams {
    int of[3];
} streams;

static _Noreturn void run_gnuplot(const char *folder, const streams *s, const char *argument)
{
    if (folder != NULL && chdir(folder) != 0) {
        _exit(126);
    }
    for (int i = 0; i < 3; i++) {
        if (dup2(s->of[i], i) < 0) {
            _exit(126);
        }
    }
    execlp("gnuplot", "gnuplot", "--default-settings", argument, (char *)NULL);
    _exit(127);
}

/* Runs it to its end; its exit code. */
static int gnuplot(const char *folder, const streams *s, const char *argument)
{
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        run_gnuplot(folder, s, argument);
    }
    int status = 0;
    while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return child > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

const char *plot_missing(void)
{
    const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
    const streams s = {{nowhere, nowhere, nowhere}};
    const bool fine = nowhere >= 0 && gnuplot(NULL, &s, "--version") == 0;
    close(nowhere);
    return fine ? NULL : "gnuplot cannot be run, which draws the plots (Debian: gnuplot-nox)";
}

const char *report_text(const char *name)
{
    const struct report_text *t = report_texts;
    while (strcmp(t->name, name) != 0) {
        t++;
    }
    return (const char *)t->text;
}

/* The names of what is drawn, with blanks between. */
static void write_forms(FILE *script, enum plot_forms which)
{
    const struct forms forms = forms_of_kinds(NULL);
    size_t kinds;
    const accel_kind_info *const *kind = accel_kinds(&kinds);
    fprintf(script, "forms = \"");
    for (size_t i = 0; which == PLOT_FORMS && i < forms.count; i++) {
        fprintf(script, "%s ", forms.at[i]);
    }
    for (size_t k = 0; which == PLOT_KINDS && k < kinds; k++) {
        if (strcmp(kind[k]->name, "linear") != 0) {
            fprintf(script, "%s ", kind[k]->name);
        }
    }
    fprintf(script, "\"\n");
}

/* gnuplot's program; NULL: no memory. */
static FILE *write_script(const char *program, enum plot_forms forms, const char *given)
{
    char file[64];
    const int memory = memfd_create("script", MFD_CLOEXEC);
    FILE *script = memory < 0 ? NULL : fdopen(memory, "w+");
    if (script == NULL) {
        close(memory);
        return NULL;
    }
    snprintf(file, sizeof file, "%s.gnuplot", program);
    write_forms(script, forms);
    fprintf(script, "%s%s\n%s", report_text("style.gnuplot"), given, report_text(file));
    if (fflush(script) != 0 || lseek(memory, 0, SEEK_SET) != 0) {
        fclose(script);
        return NULL;
    }
    return script;
}

/* All that is in a file of memory, ended by a zero; NULL where that does not fit. To be freed. */
static char *read_memory(int memory)
{
    struct stat status;
    char *text = fstat(memory, &status) == 0 ? calloc((size_t)status.st_size + 1, 1) : NULL;
    for (off_t at = 0; text != NULL && at < status.st_size;) {
        const ssize_t got = pread(memory, text + at, (size_t)(status.st_size - at), at);
        if (got <= 0 && errno != EINTR) {
            free(text);
            return NULL;
        }
        at += got > 0 ? got : 0;
    }
    return text;
}

/* The first line that tells of a mistake. */
static void first_complaint(char *text, char line[300])
{
    snprintf(line, 300, "no reason given");
    char *rest = text;
    for (char *at = text; at != NULL && (at = strsep(&rest, "\n")) != NULL;) {
        if (strstr(at, "line ") != NULL || strstr(at, "rror") != NULL) {
            snprintf(line, 300, "%.290s", at);
            return;
        }
    }
}

static bool is_whole(const char *svg)
{
    const char *end = strstr(svg, "</svg>");
    return end != NULL && end[6 + strspn(end + 6, "\n")] == '\0';
}

static bool write_svg(struct reporting *r, const char *plot, const char *svg)
{
    char name[48];
    snprintf(name, sizeof name, "%s.svg", plot);
    FILE *file = folder_write(&r->folder, name);
    const char *trouble = strerror(errno);
    if (file != NULL) {
        fputs(svg, file);
        trouble = folder_close(&r->folder, file);
    }
    if (trouble != NULL) {
        complain(r->command, "cannot write %s: %s; nothing was written", name, trouble);
    }
    return trouble == NULL;
}

bool plot_draw(struct reporting *r, const char *name, const char *program, enum plot_forms forms,
               const char *given)
{
    FILE *script = write_script(program, forms, given);
    if (script == NULL) {
        complain(r->command, "no memory for %s.svg: %s; nothing was written", name,
                 strerror(errno));
        return false;
    }
    const streams s = {{fileno(script), memfd_create("plot", MFD_CLOEXEC),
                        memfd_create("complaints", MFD_CLOEXEC)}};
    bool fine = gnuplot(r->folder.temporary, &s, "-") == 0;
    char *svg = read_memory(s.of[1]), *complaints = read_memory(s.of[2]);
    fine = fine && svg != NULL && is_whole(svg);
    if (fine) {
        fine = write_svg(r, name, svg);
    } else {
        char line[300];
        first_complaint(complaints, line);
        complain(r->command, "gnuplot failed at %s.svg: %s; nothing was written", name, line);
    }
    free(svg);
    free(complaints);
    fclose(script);
    close(s.of[1]);
    close(s.of[2]);
    return fine;
}
