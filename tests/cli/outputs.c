/* SPDX-License-Identifier: Apache-2.0
 *
 * What output.h and report_folder.h promise, with every system call that they make failing in turn,
 * interrupted in turn by a signal, and ended in turn by SIGKILL: the old content is there, or the
 * new one, whole. tests/cli/output.sh has the same from outside, through the command.
 */
#include "tool/output.h"
#include "report/report_folder.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <cmocka.h>

/* ------------------------------------------------------------------ faults ---- */

/* What happens at one call. */
enum fault { NOTHING, FAILS, SIGNALLED, KILLED };

static struct {
    enum fault fault;
    int at; /* the number of the call, from 1 on; 0: never */
    int calls;
    const char *struck; /* the name of that call */
} plan;

/* Does this call fail? */
static bool strike(const char *name)
{
    if (plan.at == 0 || ++plan.calls != plan.at) {
        return false;
    }
    plan.struck = name;
    switch (plan.fault) {
    case SIGNALLED:
        raise(SIGTERM);
        return false;
    case KILLED:
        raise(SIGKILL);
        return false;
    default:
        errno = ENOSPC;
        return true;
    }
}

/* The linker sends the calls of the library here (-Wl,--wrap). */
#define WRAP(type, name, parameters, arguments)                                                    \
    type __real_##name parameters;                                                                 \
    type __wrap_##name parameters;                                                                 \
    type __wrap_##name parameters                                                                  \
    {                                                                                              \
        return strike(#name) ? -1 : __real_##name arguments;                                       \
    }

WRAP(ssize_t, write, (int file, const void *bytes, size_t count), (file, bytes, count))
WRAP(int, fsync, (int file), (file))
WRAP(int, rename, (const char *from, const char *to), (from, to))

/* What somebody else puts there in the last moment; NULL: nobody does. */
static const char *intruder;
static void store(const char *name, const char *text);

int __real_renameat2(int in, const char *from, int at, const char *to, unsigned how);
int __wrap_renameat2(int in, const char *from, int at, const char *to, unsigned how);
int __wrap_renameat2(int in, const char *from, int at, const char *to, unsigned how)
{
    if (intruder != NULL) {
        store(to, intruder);
        chmod(to, 0640);
        intruder = NULL;
    }
    return strike("renameat2") ? -1 : __real_renameat2(in, from, at, to, how);
}

WRAP(int, fchmod, (int file, mode_t mode), (file, mode))
WRAP(int, ftruncate, (int file, off_t size), (file, size))
WRAP(int, fallocate, (int file, int mode, off_t at, off_t size), (file, mode, at, size))
WRAP(int, memfd_create, (const char *name, unsigned flags), (name, flags))
WRAP(int, mkdir, (const char *name, mode_t mode), (name, mode))

/* ------------------------------------------------------------------- files ---- */

enum { MOST = 300000 };

static char folder[64];

static int make_folder(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/accel-outputs.XXXXXX");
    return mkdtemp(folder) == NULL || chdir(folder) != 0;
}

static int remove_folder(void **state)
{
    (void)state;
    char command[100];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return chdir("/") != 0 || system(command) != 0;
}

/* Text that differs by `what`, of `size` bytes. */
static const char *text_of(char what, size_t size)
{
    static char text[MOST + 1];
    for (size_t i = 0; i < size; i++) {
        text[i] = (char)(i % 64 == 63 ? '\n' : i % 64 == 0 ? what : 'a' + (int)(i * i % 23));
    }
    text[size] = '\0';
    return text;
}

static void store(const char *name, const char *text)
{
    FILE *file = fopen(name, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static bool holds(const char *name, const char *text)
{
    static char found[2 * MOST + 2];
    FILE *file = fopen(name, "r");
    if (file == NULL) {
        return false;
    }
    const size_t size = fread(found, 1, sizeof found - 1, file);
    fclose(file);
    found[size] = '\0';
    return strcmp(found, text) == 0;
}

/* The one name in `where` that has six letters behind a dot, or NULL. */
static const char *temporary_in(const char *where)
{
    static char name[400];
    DIR *at = opendir(where);
    bool found = false;
    for (struct dirent *e = readdir(at); e != NULL && !found; e = readdir(at)) {
        const char *dot = strrchr(e->d_name, '.');
        found = dot != NULL && strlen(dot) == 7;
        snprintf(name, sizeof name, "%s/%s", where, e->d_name);
    }
    closedir(at);
    return found ? name : NULL;
}

/* ------------------------------------------------------- one file, every way ---- */

enum way { NEW, PLAIN, LINKED, SYMBOLIC, DANGLING, APPENDED, WAYS };

/* One way of writing, with the sizes of the two contents. */
typedef struct trial {
    enum way way;
    size_t old_size, new_size;
    enum fault fault;
    int at;
} trial;

static void prepare(const trial *t)
{
    assert_int_equal(system("rm -rf ./*"), 0);
    if (t->way != NEW && t->way != DANGLING) {
        store("out", text_of('O', t->old_size));
    }
    if (t->way == LINKED) {
        assert_int_equal(link("out", "other"), 0);
    }
    if (t->way == SYMBOLIC || t->way == DANGLING) {
        assert_int_equal(symlink("out", "link"), 0);
    }
}

/* In the child: 0 it was said to be written, 1 not, and why is in the file "said". */
static int write_out(const trial *t)
{
    struct output output;
    accel_error error;
    const char *name = t->way == SYMBOLIC || t->way == DANGLING ? "link" : "out";
    char descriptor[40];
    if (t->way == APPENDED) {
        const int out = open("out", O_WRONLY | O_APPEND);
        snprintf(descriptor, sizeof descriptor, "/dev/fd/%d", out);
        name = descriptor;
    }
    plan.fault = t->fault;
    plan.at = t->at;
    plan.calls = 0;
    bool fine = output_open(&output, name, &error);
    if (fine) {
        fputs(text_of('N', t->new_size), output.file);
        fine = output_commit(&output, &error);
    }
    const bool through = plan.calls < plan.at;
    plan.at = 0;
    if (!fine) {
        store("said", error.text);
    }
    /* bytes that did not arrive, or not on the disk, are never passed over */
    const bool lost = !through && t->fault == FAILS &&
                      (strcmp(plan.struck, "write") == 0 || strcmp(plan.struck, "fsync") == 0);
    return through ? 2 : !fine ? 1 : lost ? 3 : 0;
}

static int run_child(const trial *t)
{
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        alarm(60);
        _exit(write_out(t));
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    return status;
}

static const char *whole_new(const trial *t)
{
    static char both[2 * MOST + 1];
    strcpy(both, t->way == APPENDED ? text_of('O', t->old_size) : "");
    strcat(both, text_of('N', t->new_size));
    return both;
}

static bool is_old(const trial *t)
{
    return t->way == NEW || t->way == DANGLING ? access("out", F_OK) != 0
                                               : holds("out", text_of('O', t->old_size));
}

/* Whatever happened: what the head of output.h says. */
static void check(const trial *t, int status)
{
    char text[600] = "";
    const char *left = temporary_in(".");
    const bool old = is_old(t), new = holds("out", whole_new(t));
    const bool kept = left != NULL && holds(left, text_of('N', t->new_size));
    FILE *said = fopen("said", "r");
    if (said != NULL) {
        text[fread(text, 1, sizeof text - 1, said)] = '\0';
        fclose(said);
    }
    if (t->fault == KILLED && WIFSIGNALED(status)) {
        assert_int_equal(WTERMSIG(status), SIGKILL);
        /* of appending SIGKILL may leave a part */
        assert_true(old || new || (kept && t->way == LINKED) || t->way == APPENDED);
        return;
    }
    if (t->fault == SIGNALLED && WIFSIGNALED(status)) {
        assert_int_equal(WTERMSIG(status), SIGTERM);
        assert_true((old || new) && left == NULL);
        return;
    }
    assert_true(WIFEXITED(status));
    assert_int_not_equal(WEXITSTATUS(status), 3);
    if (WEXITSTATUS(status) != 1) {
        assert_true(new &&left == NULL);
    } else if (strstr(text, "nothing was written") != NULL) {
        assert_non_null(strstr(text, "No space left on device"));
        assert_true(old && left == NULL);
    } else {
        assert_true(t->way == LINKED && kept);
        assert_non_null(strstr(text, left + 2));
    }
    if (t->way == LINKED) {
        assert_true(holds("other", whole_new(t)) == new);
    }
    struct stat link;
    if (t->way == SYMBOLIC || t->way == DANGLING) {
        assert_true(lstat("link", &link) == 0 && S_ISLNK(link.st_mode));
    }
}

static void every_call(enum fault fault)
{
    static const size_t sizes[][2] = {{150000, 250000}, {250000, 150000}, {0, 200000}, {200000, 0}};
    for (int way = 0; way < WAYS; way++) {
        for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
            trial t = {(enum way)way, sizes[s][0], sizes[s][1], fault, 0};
            int status = 0;
            do {
                t.at++;
                prepare(&t);
                status = run_child(&t);
                check(&t, status);
            } while (!WIFEXITED(status) || WEXITSTATUS(status) != 2);
            assert_true(t.at > 2);
        }
    }
}

static void every_call_may_fail(void **state)
{
    (void)state;
    every_call(FAILS);
}

static void every_call_may_be_interrupted(void **state)
{
    (void)state;
    every_call(SIGNALLED);
}

static void every_call_may_be_the_last(void **state)
{
    (void)state;
    every_call(KILLED);
}

/* ------------------------------------------------------------- what is kept ---- */

static void write_new(const char *name)
{
    struct output output;
    accel_error error;
    assert_true(output_open(&output, name, &error));
    fputs("new\n", output.file);
    assert_true(output_commit(&output, &error));
    assert_true(holds(name, "new\n"));
}

static void attributes_are_kept(void **state)
{
    (void)state;
    char value[10] = "";
    store("tagged", "old\n");
    if (setxattr("tagged", "user.mine", "yes", 4, 0) != 0) {
        skip(); /* this file system has none */
    }
    write_new("tagged");
    assert_int_equal(getxattr("tagged", "user.mine", value, sizeof value), 4);
    assert_string_equal(value, "yes");
}

static void modes_are_kept(void **state)
{
    (void)state;
    struct stat status;
    static const mode_t modes[] = {0600, 0640, 0644, 0666, 0755, 0200};
    for (size_t i = 0; i < sizeof modes / sizeof modes[0]; i++) {
        store("moded", "old\n");
        assert_int_equal(chmod("moded", modes[i]), 0);
        struct output output;
        accel_error error;
        assert_true(output_open(&output, "moded", &error));
        assert_int_equal(fstat(output.descriptor, &status), 0);
        assert_int_equal(status.st_mode & 077, 0); /* nobody else reads what is not finished */
        assert_true(output_commit(&output, &error));
        assert_int_equal(stat("moded", &status), 0);
        assert_int_equal(status.st_mode & 07777, modes[i]);
        assert_int_equal(unlink("moded"), 0);
    }
}

/* A file that appears while ours is written is one that was there: it keeps its mode and its links.
 */
static void what_appears_is_kept(void **state)
{
    (void)state;
    struct stat status;
    intruder = "somebody's\n";
    write_new("appeared");
    assert_null(intruder);
    assert_int_equal(stat("appeared", &status), 0);
    assert_int_equal(status.st_mode & 07777, 0640);
}

static bool is_harmless(int number)
{
    static const int harmless[] = {SIGCHLD, SIGCONT,  SIGTSTP, SIGTTIN, SIGTTOU,
                                   SIGURG,  SIGWINCH, SIGKILL, SIGSTOP};
    for (size_t i = 0; i < sizeof harmless / sizeof harmless[0]; i++) {
        if (number == harmless[i]) {
            return true;
        }
    }
    /* what the threads library keeps for itself */
    return number > 31 && number < SIGRTMIN;
}

/* Every signal that ends a process, a fault of its own as well, leaves the old file and no other.
 * Before all that writes in this process: only children may watch for what cmocka catches. */
static void every_signal_cleans_up(void **state)
{
    (void)state;
    for (int number = 1; number <= SIGRTMAX; number++) {
        if (is_harmless(number)) {
            continue;
        }
        store("signalled", "old\n");
        fflush(NULL);
        const pid_t child = fork();
        if (child == 0) {
            struct output output;
            accel_error error;
            const struct rlimit none = {0, 0};
            setrlimit(RLIMIT_CORE, &none);
            signal(number, SIG_DFL);
            if (output_open(&output, "signalled", &error)) {
                fputs("new\n", output.file);
                fflush(output.file);
                raise(number);
            }
            _exit(0);
        }
        int status;
        assert_int_equal(waitpid(child, &status, 0), child);
        if (!WIFSIGNALED(status) || WTERMSIG(status) != number) {
            fail_msg("signal %d did not end it", number);
        }
        assert_true(holds("signalled", "old\n"));
        assert_null(temporary_in("."));
    }
}

/* A reader of a mesh that is ended takes nothing with it: it has the handlers but owns nothing. By
 * signals that cmocka leaves alone: those that it catches would let the child go on. */
static void children_remove_nothing(void **state)
{
    (void)state;
    static const int signals[] = {SIGTERM, SIGQUIT, SIGXCPU};
    struct output output;
    accel_error error;
    assert_true(output_open(&output, "parents", &error));
    for (size_t i = 0; i < sizeof signals / sizeof signals[0]; i++) {
        fflush(NULL);
        const pid_t child = fork();
        if (child == 0) {
            raise(signals[i]);
            _exit(0);
        }
        int status;
        assert_int_equal(waitpid(child, &status, 0), child);
        assert_true(WIFSIGNALED(status) && WTERMSIG(status) == signals[i]);
        assert_int_equal(access(output.temporary, F_OK), 0);
    }
    fputs("new\n", output.file);
    assert_true(output_commit(&output, &error) && holds("parents", "new\n"));
}

/* The name must not become too long by what is put behind it. */
static void long_names_are_names(void **state)
{
    (void)state;
    char name[256];
    memset(name, 'n', 255);
    name[255] = '\0';
    write_new(name);
}

/* ------------------------------------------------------------------ folders ---- */

static const char *const report_files[] = {"figures.csv", "plot.svg"};

enum { FILES = 2 };

/* Writes a report of which all files hold `what`; the page names them. */
static bool write_report(const char *name, char what, int count, accel_error *error)
{
    struct folder report;
    bool fine = folder_open(&report, name, error);
    if (!fine) {
        return false;
    }
    snprintf(error->text, sizeof error->text,
             "a file: No space left on device; nothing was written");
    for (int i = 0; i <= count && fine; i++) {
        FILE *file = folder_write(&report, i == count ? "index.html" : report_files[i]);
        fine = file != NULL;
        if (fine && i == count) {
            fputs("<!DOCTYPE html><!-- accel report -->\n", file);
            folder_list(&report, file);
        }
        if (fine) {
            fputs(text_of(what, 3000), file);
            fine = folder_close(&report, file) == NULL;
        }
    }
    if (!fine) {
        folder_abandon(&report);
        return false;
    }
    return folder_commit(&report, error);
}

/* Does a file of a report end with the text of `what`? */
static bool made_by(const char *name, char what)
{
    static char found[MOST];
    FILE *file = fopen(name, "r");
    if (file == NULL) {
        return false;
    }
    found[fread(found, 1, sizeof found - 1, file)] = '\0';
    fclose(file);
    const char *text = text_of(what, 3000), *at = strstr(found, text);
    return at != NULL && at[3000] == '\0';
}

static bool all_made_by(char what)
{
    return made_by("page/index.html", what) && made_by("page/figures.csv", what) &&
           made_by("page/plot.svg", what);
}

static int report_in_child(enum fault fault, int at)
{
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        accel_error error = {.text = ""};
        alarm(60);
        plan.fault = fault;
        plan.at = at;
        plan.calls = 0;
        const bool fine = write_report("page", 'N', FILES, &error);
        const bool through = plan.calls < plan.at;
        plan.at = 0;
        store("said", error.text);
        _exit(through ? 2 : fine ? 0 : 1);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    return status;
}

/* Every file is of one report, and whole; the page is new only where all is. */
static void check_report(enum fault fault, bool former, int status)
{
    const bool old = former ? all_made_by('O') : access("page", F_OK) != 0;
    const bool new = all_made_by('N');
    const char *inside = access("page", F_OK) == 0 ? temporary_in("page") : NULL;
    if (WIFSIGNALED(status)) {
        assert_int_equal(WTERMSIG(status), fault == KILLED ? SIGKILL : SIGTERM);
    }
    if (fault == KILLED && WIFSIGNALED(status)) {
        for (int i = 0; former && i < FILES; i++) {
            char name[40];
            snprintf(name, sizeof name, "page/%s", report_files[i]);
            assert_true(made_by(name, 'O') || made_by(name, 'N'));
        }
        assert_true(old || new || (former && made_by("page/index.html", 'O')));
        return;
    }
    assert_null(inside);
    assert_null(temporary_in("."));
    if (WIFSIGNALED(status)) {
        assert_true(old || new);
    } else if (WEXITSTATUS(status) != 1) {
        assert_true(new);
    } else if (!old) {
        assert_true(former && made_by("page/index.html", 'O'));
        assert_true(holds("said",
                          "cannot write page: No space left on device; it holds files of two "
                          "reports"));
    } else {
        char text[600] = "";
        FILE *said = fopen("said", "r");
        assert_non_null(said);
        text[fread(text, 1, sizeof text - 1, said)] = '\0';
        fclose(said);
        assert_non_null(strstr(text, "No space left on device; nothing was written"));
    }
}

static void a_report_is_of_one_piece(void **state)
{
    (void)state;
    static const enum fault faults[] = {FAILS, SIGNALLED, KILLED};
    for (int i = 0; i < 6; i++) {
        int status = 0, at = 0;
        do {
            accel_error error;
            assert_int_equal(system("rm -rf ./*"), 0);
            assert_true(i % 2 == 0 || write_report("page", 'O', FILES, &error));
            status = report_in_child(faults[i / 2], ++at);
            check_report(faults[i / 2], i % 2 != 0, status);
        } while (!WIFEXITED(status) || WEXITSTATUS(status) != 2);
        assert_true(at > 5);
    }
}

static void refuse_report(const char *words)
{
    accel_error error;
    assert_false(write_report("page", 'N', FILES, &error));
    if (strstr(error.text, words) == NULL) {
        fail_msg("'%s' instead of '%s'", error.text, words);
    }
    assert_null(temporary_in("page"));
}

static void a_report_takes_nothing_of_the_users(void **state)
{
    (void)state;
    accel_error error;
    struct stat before, after;
    assert_int_equal(system("rm -rf ./*; mkdir page; chmod 700 page; ln -s page link"), 0);
    assert_int_equal(stat("page", &before), 0);
    assert_true(write_report("link", 'O', FILES, &error));
    assert_int_equal(system("chmod 600 page/figures.csv; cp -al page copy; mkdir page/more"), 0);
    refuse_report("holds 'more', which no report has made");
    assert_int_equal(system("rmdir page/more; rm page/plot.svg; mkdir page/plot.svg"), 0);
    refuse_report("holds 'plot.svg', which no report has made");
    assert_int_equal(system("rmdir page/plot.svg; ln -s ../mine page/plot.svg; echo me >mine"), 0);
    refuse_report("holds 'plot.svg', which no report has made");
    assert_int_equal(system("rm page/plot.svg; ln copy/plot.svg page"), 0);
    /* the next one has no plot: that of the former one goes */
    assert_true(write_report("link/", 'N', 1, &error));
    assert_true(made_by("page/figures.csv", 'N') && made_by("page/index.html", 'N'));
    assert_int_not_equal(access("page/plot.svg", F_OK), 0);
    assert_true(made_by("copy/figures.csv", 'O') && made_by("copy/plot.svg", 'O'));
    assert_int_equal(stat("page", &after), 0);
    assert_true(before.st_ino == after.st_ino && (after.st_mode & 07777) == 0700);
    assert_int_equal(stat("page/figures.csv", &after), 0);
    assert_int_equal(after.st_mode & 07777, 0600);
    assert_int_equal(lstat("link", &after), 0);
    assert_true(S_ISLNK(after.st_mode) && holds("mine", "me\n"));
    /* a link to nothing is filled */
    assert_int_equal(symlink("made", "dangling"), 0);
    assert_true(write_report("dangling", 'N', 1, &error));
    assert_true(made_by("made/index.html", 'N') && lstat("dangling", &after) == 0);
    assert_true(S_ISLNK(after.st_mode));
}

/* What a report has written and removed again belongs to the user if it is there later. */
static void what_was_removed_is_not_listed(void **state)
{
    (void)state;
    struct folder report;
    accel_error error;
    assert_int_equal(system("rm -rf ./*"), 0);
    assert_true(folder_open(&report, "page", &error));
    FILE *scratch = folder_write(&report, "scratch.txt");
    assert_null(folder_close(&report, scratch));
    folder_remove(&report, "scratch.txt");
    FILE *page = folder_write(&report, "index.html");
    fputs("<!DOCTYPE html><!-- accel report -->\n", page);
    folder_list(&report, page);
    assert_null(folder_close(&report, page));
    assert_true(folder_commit(&report, &error));
    store("page/scratch.txt", "mine\n");
    refuse_report("holds 'scratch.txt', which no report has made");
    assert_true(holds("page/scratch.txt", "mine\n"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_signal_cleans_up),
        cmocka_unit_test(every_call_may_fail),
        cmocka_unit_test(every_call_may_be_interrupted),
        cmocka_unit_test(every_call_may_be_the_last),
        cmocka_unit_test(attributes_are_kept),
        cmocka_unit_test(modes_are_kept),
        cmocka_unit_test(what_appears_is_kept),
        cmocka_unit_test(children_remove_nothing),
        cmocka_unit_test(long_names_are_names),
        cmocka_unit_test(a_report_is_of_one_piece),
        cmocka_unit_test(a_report_takes_nothing_of_the_users),
        cmocka_unit_test(what_was_removed_is_not_listed),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
