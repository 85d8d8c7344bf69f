/* SPDX-License-Identifier: Apache-2.0
 *
 * Plots by gnuplot, which runs in the report's folder and reads its program from a pipe.
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
#include <sys/wait.h>
#include <unistd.h>

/* What gnuplot says of a mistake goes there, in the report's folder. */
static const char complaints[] = "gnuplot.txt";

/* A plot beyond it is left as it is. */
enum { MOST_BYTES = 4 << 20 };

/* Never returns. */
static _Noreturn void run_gnuplot(const char *folder, const char *output, int input)
{
    if (folder != NULL && chdir(folder) != 0) {
        _exit(126);
    }
    const int out = open(output, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    if (input < 0 || out < 0 || dup2(input, STDIN_FILENO) < 0 || dup2(out, STDOUT_FILENO) < 0 ||
        dup2(out, STDERR_FILENO) < 0) {
        _exit(126);
    }
    execlp("gnuplot", "gnuplot", "--default-settings", input > 0 ? "-" : "--version", (char *)NULL);
    _exit(127);
}

static int exit_code(pid_t child)
{
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

const char *accel_plot_missing(void)
{
    const pid_t child = fork();
    if (child == 0) {
        run_gnuplot(NULL, "/dev/null", STDIN_FILENO);
    }
    return child > 0 && exit_code(child) == 0
               ? NULL
               : "gnuplot cannot be run, which draws the plots (Debian: gnuplot-nox)";
}

static void write_style(const accel_plot *plot, int width, int height)
{
    fprintf(plot->script,
            "set terminal svg size %d,%d dynamic enhanced font 'Helvetica,Arial,sans-serif,13' "
            "background rgb 'white'\n"
            "set output '%s.svg'\n"
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
            width, height, plot->name);
}

bool accel_plot_open(accel_reporting *r, accel_plot *plot, const char *name, int width, int height)
{
    int ends[2];
    *plot = (accel_plot){.child = -1};
    snprintf(plot->name, sizeof plot->name, "%s", name);
    char file[48];
    snprintf(file, sizeof file, "%s.svg", name);
    FILE *svg = accel_folder_file(&r->folder, file, "w");
    FILE *log = accel_folder_file(&r->folder, complaints, "w");
    if (svg != NULL) {
        fclose(svg);
    }
    if (log != NULL) {
        fclose(log);
    }
    if (svg == NULL || log == NULL || pipe2(ends, O_CLOEXEC) != 0) {
        accel_complain(r->command, "cannot write %s: %s; nothing was written", file,
                       strerror(errno));
        return false;
    }
    fflush(NULL);
    plot->child = fork();
    if (plot->child == 0) {
        run_gnuplot(r->folder.temporary, complaints, ends[0]);
    }
    close(ends[0]);
    plot->script = plot->child > 0 ? fdopen(ends[1], "w") : NULL;
    if (plot->script == NULL) {
        close(ends[1]);
        accel_complain(r->command, "no process for gnuplot: %s; nothing was written",
                       strerror(errno));
        return false;
    }
    write_style(plot, width, height);
    return true;
}

static void first_complaint(accel_reporting *r, char *line, int size)
{
    FILE *file = accel_folder_file(&r->folder, complaints, "r");
    snprintf(line, (size_t)size, "no reason given");
    while (file != NULL && fgets(line, size, file) != NULL &&
           (strstr(line, "line ") == NULL && strstr(line, "rror") == NULL)) {
    }
    line[strcspn(line, "\n")] = '\0';
    if (file != NULL) {
        fclose(file);
    }
}

/* Reads the plot back and writes it smaller. */
static bool shrink(accel_reporting *r, const accel_plot *plot)
{
    char name[48];
    char *text = calloc(MOST_BYTES, 1);
    snprintf(name, sizeof name, "%s.svg", plot->name);
    FILE *file = accel_folder_file(&r->folder, name, "r");
    const size_t read = file != NULL && text != NULL ? fread(text, 1, MOST_BYTES - 1, file) : 0;
    if (file != NULL) {
        fclose(file);
    }
    bool fine = read > 0;
    if (fine && read < MOST_BYTES - 1) {
        accel_svg_shrink(text);
        file = accel_folder_file(&r->folder, name, "w");
        fine = file != NULL && fputs(text, file) >= 0;
        fine = file != NULL && fclose(file) == 0 && fine;
    }
    free(text);
    if (!fine) {
        accel_complain(r->command, "cannot write %s; nothing was written", name);
    }
    return fine;
}

bool accel_plot_close(accel_reporting *r, accel_plot *plot)
{
    const bool sent = fclose(plot->script) == 0;
    const int code = exit_code(plot->child);
    if (!sent || code != 0) {
        char line[300];
        first_complaint(r, line, sizeof line);
        accel_complain(r->command, "gnuplot failed at %s.svg: %s; nothing was written", plot->name,
                       line);
        return false;
    }
    accel_folder_remove(&r->folder, complaints);
    return shrink(r, plot);
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

const char *accel_plot_style(const char *name)
{
    const size_t length = strcspn(name, ":");
    for (size_t i = 0; i < sizeof styles / sizeof styles[0]; i++) {
        if (strlen(styles[i].name) == length && strncmp(name, styles[i].name, length) == 0) {
            return name[length] == ':' ? styles[i].hollow : styles[i].full;
        }
    }
    return strstr(name, "robust") != NULL ? "lc rgb '#882255' pt 2" : "lc rgb '#AA4499' pt 2";
}
