/* SPDX-License-Identifier: Apache-2.0 */
#include "threads.h"

#include <pthread.h>
#include <sched.h>
#include <stdlib.h>

/* A thread that was started. */
typedef struct member {
    pthread_t thread;
    thread_work *work;
    void *user;
    unsigned number;
} member;

static void *run_member(void *argument)
{
    member *m = argument;
    m->work(m->user, m->number);
    return NULL;
}

void threads_run(unsigned threads, thread_work *work, void *user)
{
    member *members = calloc(threads, sizeof *members);
    unsigned started = 1;
    while (members != NULL && started < threads) {
        member *m = &members[started];
        *m = (member){.work = work, .user = user, .number = started};
        if (pthread_create(&m->thread, NULL, run_member, m) != 0) {
            break;
        }
        started++;
    }
    work(user, 0);
    for (unsigned i = 1; i < started; i++) {
        pthread_join(members[i].thread, NULL);
    }
    free(members);
}

unsigned threads_available(void)
{
    cpu_set_t set;
    const int count = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
    return count > 0 ? (unsigned)count : 1;
}
