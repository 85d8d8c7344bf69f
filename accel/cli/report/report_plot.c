/* SPDX-License-Identifier: Apache-2.0
 *
 * Plots by gnuplot, which runs in the report's folder to read the figures there. Its program, the
 * plot and what it complains of are in memory: of the files of the folder none is written by
 * others, so that each knows what became of it.
 *
 * Colours: Okabe and Ito's, which the colour-blind tell apart; each kind has a shape of its own
 * too.
 */
#include "report.h"
#include "report_svg.h"

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

static void write_style(const struct plot *plot, int width, int height)
{
    fprintf(plot->script,
            "set terminal svg size %d,%d dynamic enhanced font 'Helvetica,Arial,sans-serif,13' "
            "background rgb 'white'\n"
            "set encoding utf8\n"
            "set datafile separator ','\n"
            "set datafile missing NaN\n"
            "set border 3 lc rgb '#555555'\n"
            "set tics nomirror out scale 0.6 textcolor rgb '#333333'\n"
            "set grid lc rgb '#dddddd' lt 1 lw 0.6\n"
            "set key noautotitle textcolor rgb '#222222'\n"
            "set pointsize 0.75\n"
            "set samples 2\n"
            "none = '#888888'\n",
            width, height);
}

bool plot_open(struct reporting *r, struct plot *plot, const char *name, int width, int height)
{
    *plot = (struct plot){.script = NULL};
    snprintf(plot->name, sizeof plot->name, "%s", name);
    const int memory = memfd_create("script", MFD_CLOEXEC);
    plot->script = memory < 0 ? NULL : fdopen(memory, "w+");
    if (plot->script == NULL) {
        complain(r->command, "no memory for %s.svg: %s; nothing was written", name,
                 strerror(errno));
        close(memory);
        return false;
    }
    write_style(plot, width, height);
    return true;
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

/* Writes the plot, smaller than gnuplot made it. */
static bool write_svg(struct reporting *r, const struct plot *plot, char *svg)
{
    char name[48];
    snprintf(name, sizeof name, "%s.svg", plot->name);
    svg_shrink(svg);
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

bool plot_close(struct reporting *r, struct plot *plot)
{
    const streams s = {{fileno(plot->script), memfd_create("plot", MFD_CLOEXEC),
                        memfd_create("complaints", MFD_CLOEXEC)}};
    bool fine = fflush(plot->script) == 0 && lseek(s.of[0], 0, SEEK_SET) == 0 &&
                gnuplot(r->folder.temporary, &s, "-") == 0;
    char *svg = read_memory(s.of[1]), *complaints = read_memory(s.of[2]);
    fine = fine && svg != NULL && is_whole(svg);
    if (fine) {
        fine = write_svg(r, plot, svg);
    } else {
        char line[300];
        first_complaint(complaints, line);
        complain(r->command, "gnuplot failed at %s.svg: %s; nothing was written", plot->name, line);
    }
    free(svg);
    free(complaints);
    fclose(plot->script);
    close(s.of[1]);
    close(s.of[2]);
    return fine;
}

/* Full for a kind as it comes, hollow for another form of it. */
static const struct style {
    const char *name, *full, *hollow;
} styles[] = {
    {"linear", "lc rgb '#777777' pt 1", "lc rgb '#777777' pt 1"},
    {"grid", "lc rgb '#E69F00' pt 5", "lc rgb '#E69F00' pt 4"},
    {"hug", "lc rgb '#D55E00' pt 13", "lc rgb '#D55E00' pt 12"},
    {"octree", "lc rgb '#56B4E9' pt 9", "lc rgb '#56B4E9' pt 8"},
    {"hoo", "lc rgb '#0072B2' pt 7", "lc rgb '#0072B2' pt 6"},
    {"bsp", "lc rgb '#009E73' pt 11", "lc rgb '#009E73' pt 10"},
    {"bvh", "lc rgb '#CC79A7' pt 15", "lc rgb '#CC79A7' pt 14"},
    {"auto", "lc rgb '#000000' pt 3", "lc rgb '#000000' pt 3"},
};

const char *plot_style(const char *name)
{
    const size_t length = strcspn(name, ":");
    for (size_t i = 0; i < sizeof styles / sizeof styles[0]; i++) {
        if (strlen(styles[i].name) == length && strncmp(name, styles[i].name, length) == 0) {
            return name[length] == ':' ? styles[i].hollow : styles[i].full;
        }
    }
    return strstr(name, "robust") != NULL ? "lc rgb '#882255' pt 2" : "lc rgb '#AA4499' pt 2";
}
