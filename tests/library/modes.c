/* SPDX-License-Identifier: Apache-2.0 */
#include "modes.h"

#include <fenv.h>

enum { FLUSH_RESULTS = 0x8000, FLUSH_OPERANDS = 0x0040, FLUSH = FLUSH_RESULTS | FLUSH_OPERANDS };

#if defined(__SSE2__)
#include <xmmintrin.h>
static unsigned flush_get(void)
{
    return _mm_getcsr() & FLUSH;
}
static void flush_set(unsigned bits)
{
    _mm_setcsr((_mm_getcsr() & ~(unsigned)FLUSH) | bits);
}
#else
static unsigned flushing;
static unsigned flush_get(void)
{
    return flushing;
}
static void flush_set(unsigned bits)
{
    flushing = bits;
}
#endif

const struct mode modes[MODES] = {
    {"to nearest", FE_TONEAREST, 0},
    {"up", FE_UPWARD, 0},
    {"down", FE_DOWNWARD, 0},
    {"to zero", FE_TOWARDZERO, 0},
    {"to nearest, flushing", FE_TONEAREST, FLUSH},
    {"up, flushing", FE_UPWARD, FLUSH},
    {"to nearest, results flushed", FE_TONEAREST, FLUSH_RESULTS},
    {"to nearest, operands flushed", FE_TONEAREST, FLUSH_OPERANDS},
};

void mode_enter(const struct mode *m)
{
    fesetround(m->rounding);
    flush_set(m->flush);
}

void mode_leave(void)
{
    fesetround(FE_TONEAREST);
    flush_set(0);
}

bool mode_leave_kept(const struct mode *m)
{
    const bool kept = fegetround() == m->rounding && flush_get() == m->flush;
    mode_leave();
    return kept;
}
