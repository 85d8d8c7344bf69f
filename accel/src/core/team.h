/* SPDX-License-Identifier: Apache-2.0
 *
 * The threads of a build: a part of the work runs beside another where a processor is free, else
 * after it. What is computed does not depend on it, so a builder that shares nothing between the
 * two makes the same bytes with any number of threads.
 */
#ifndef ACCEL_TEAM_H
#define ACCEL_TEAM_H

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>

struct team {
    atomic_int spare;    /* threads that may be started now */
    atomic_bool stopped; /* the build is cancelled: everybody returns soon */
};

/* A part of the work that may run in a thread of its own. */
struct team_branch {
    void (*work)(void *user);
    void *user;
    struct team *team;
    pthread_t thread;
    atomic_bool ended;
};

/* A team of `threads`, of which one is the calling thread; 0: one for each processor. */
void accel_team_make(struct team *t, unsigned threads);

/* Starts branch->work(branch->user) in a thread, which has the floating-point environment of this
 * one and takes no signals. False: it was not started, do it yourself. */
bool accel_team_start(struct team *t, struct team_branch *branch);

/* Waits for a branch that was started, and meanwhile calls watch(user), if given, now and then. */
void accel_team_wait(struct team_branch *branch, void (*watch)(void *user), void *user);

#endif
