/* SPDX-License-Identifier: Apache-2.0
 *
 * The floating-point environment of builds and checks: the default one, whatever the caller's. So
 * one scene and config make one structure, and what was sound when it was built is so when it is
 * checked. Queries run in the caller's (query.h).
 *
 * What runs between must not be inlined where these are called: compilers take fesetenv for a
 * function like any other and may move arithmetic across it.
 */
#ifndef ACCEL_ENVIRONMENT_H
#define ACCEL_ENVIRONMENT_H

#include <fenv.h>

/* Goes into the default environment; returns the caller's, with its flags. */
static inline fenv_t environment_enter(void)
{
    fenv_t callers;
    fegetenv(&callers);
    fesetenv(FE_DFL_ENV);
    return callers;
}

static inline void environment_leave(const fenv_t *callers)
{
    fesetenv(callers);
}

#endif
