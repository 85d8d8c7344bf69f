/* SPDX-License-Identifier: Apache-2.0 */
#if defined(__linux__)
#define _GNU_SOURCE
#include <sched.h>
#else
#define _POSIX_C_SOURCE 200809L
#endif

#include "team.h"

#include <signal.h>
#include <time.h>
#include <unistd.h>

/* Processors that this process may use. */
static int processors(void)
{
#if defined(__linux__)
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0)
        return CPU_COUNT(&set);
#endif
    return (int)sysconf(_SC_NPROCESSORS_ONLN);
}

void accel_team_make(struct team *t, unsigned threads)
{
    enum { MOST = 1024 };
    const int all = threads == 0 ? processors() : threads < MOST ? (int)threads : MOST;
    atomic_init(&t->spare, all - 1);
    atomic_init(&t->stopped, false);
}

static void *run(void *argument)
{
    struct team_branch *b = argument;
    b->work(b->user);
    atomic_fetch_add(&b->team->spare, 1);
    atomic_store(&b->ended, true);
    return NULL;
}

static bool take_spare(struct team *t)
{
    int spare = atomic_load(&t->spare);
    while (spare > 0)
        if (atomic_compare_exchange_weak(&t->spare, &spare, spare - 1))
            return true;
    return false;
}

bool accel_team_start(struct team *t, struct team_branch *branch)
{
    sigset_t all, before;
    if (!take_spare(t))
        return false;
    branch->team = t;
    atomic_init(&branch->ended, false);
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const bool started = pthread_create(&branch->thread, NULL, run, branch) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    if (!started)
        atomic_fetch_add(&t->spare, 1);
    return started;
}

/* Who waits leaves its processor to the others. */
void accel_team_wait(struct team_branch *branch, void (*watch)(void *user), void *user)
{
    const struct timespec moment = {0, 500000};
    atomic_fetch_add(&branch->team->spare, 1);
    while (watch && !atomic_load(&branch->ended)) {
        nanosleep(&moment, NULL);
        watch(user);
    }
    pthread_join(branch->thread, NULL);
    atomic_fetch_sub(&branch->team->spare, 1);
}
