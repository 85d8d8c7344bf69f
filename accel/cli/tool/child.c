/* SPDX-License-Identifier: Apache-2.0
 *
 * A child process with limits: fork, setrlimit, a pipe back.
 */
#include "child.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

/* AddressSanitizer reserves terabytes of addresses. */
#if defined(__SANITIZE_ADDRESS__)
enum { LIMIT_ADDRESSES = 0 };
#else
enum { LIMIT_ADDRESSES = 1 };
#endif

/* Addresses that this process has in use now, in bytes. */
static uint64_t addresses_in_use(void)
{
    unsigned long long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (file != NULL) {
        if (fscanf(file, "%llu", &pages) != 1) {
            pages = 0;
        }
        fclose(file);
    }
    return pages * (uint64_t)sysconf(_SC_PAGESIZE);
}

static void limit(int resource, uint64_t most)
{
    const struct rlimit limits = {most, most};
    setrlimit((__rlimit_resource_t)resource, &limits);
}

/* Foreign libraries may print: a child has no terminal. */
static void silence(void)
{
    const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
    if (nowhere >= 0) {
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
    }
}

static _Noreturn void run_child(const struct child_limits *limits, child_work *work, void *user,
                                int pipe)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    signal(SIGPIPE, SIG_DFL);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, limits->seconds);
    if (LIMIT_ADDRESSES) {
        limit(RLIMIT_AS, addresses_in_use() + limits->memory);
    }
    silence();
    FILE *out = fdopen(pipe, "wb");
    if (out == NULL) {
        _exit(1);
    }
    work(user, out);
    _exit(fclose(out) == 0 ? 0 : 1);
}

bool child_start(struct child *child, struct child_limits limits, child_work *work, void *user)
{
    int ends[2];
    if (pipe(ends) != 0) {
        return false;
    }
    *child = (struct child){.limits = limits, .pipe = ends[0]};
    fflush(NULL);
    child->pid = fork();
    if (child->pid == 0) {
        close(ends[0]);
        run_child(&limits, work, user, ends[1]);
    }
    close(ends[1]);
    if (child->pid < 0) {
        close(ends[0]);
        return false;
    }
    return true;
}

void child_write(FILE *pipe, const void *bytes, size_t count)
{
    if (fwrite(bytes, 1, count, pipe) != count) {
        _exit(1);
    }
}

static void wait_for_bytes(struct child *child)
{
    struct pollfd pipe = {.fd = child->pipe, .events = POLLIN};
    while (poll(&pipe, 1, 100) == 0) {
        if (child->tick != NULL) {
            child->tick(child->user, "reading");
        }
    }
}

bool child_read(struct child *child, void *bytes, size_t count)
{
    char *at = bytes;
    while (count > 0) {
        wait_for_bytes(child);
        const ssize_t got = read(child->pipe, at, count);
        if (got == 0 || (got < 0 && errno != EINTR)) {
            return false;
        }
        if (got > 0) {
            at += got;
            count -= (size_t)got;
        }
    }
    return true;
}

const char *child_end(struct child *child)
{
    close(child->pipe);
    int status = 0;
    while (waitpid(child->pid, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFEXITED(status)) {
        return WEXITSTATUS(status) == 0 ? NULL : "its reader gave up";
    }
    switch (WTERMSIG(status)) {
    case SIGXCPU:
    case SIGKILL:
        return "its reader took too long";
    case SIGPIPE:
        return NULL;
    default:
        return "its reader crashed";
    }
}
