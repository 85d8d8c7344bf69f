/* SPDX-License-Identifier: Apache-2.0 */
#include "number.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A double is told from all its neighbours' midpoints by 767 digits, and one more that is not zero
 * if any digit left out is not. */
enum { MOST_DIGITS = 800 };

/* Exponents that lie beyond double's range whatever the digits. */
enum { FAR = 100000 };

/* d[.ddd] * 10^exponent, without sign. */
struct decimal {
    char digit[18];
    int count, exponent;
};

/* Rounds to so many digits and drops zeros at the end. */
static struct decimal decimal_of(double x, int digits)
{
    struct decimal d = {.count = 0};
    char text[40];
    snprintf(text, sizeof text, "%.*e", digits - 1, x);
    const char *at = text;
    for (; *at != 'e'; at++)
        if (*at >= '0' && *at <= '9')
            d.digit[d.count++] = *at;
    d.exponent = atoi(at + 1);
    while (d.count > 1 && d.digit[d.count - 1] == '0')
        d.count--;
    return d;
}

static char *put_zeros(char *to, int count)
{
    for (; count > 0; count--)
        *to++ = '0';
    return to;
}

/* Digits from `first` up to before `end`, zeros where there are none. */
static char *put_digits(char *to, const struct decimal *d, int first, int end)
{
    for (int i = first; i < end; i++)
        *to++ = i < d->count ? d->digit[i] : '0';
    return to;
}

static void put_plain(char *to, const struct decimal *d)
{
    const int whole = d->exponent + 1;
    to = whole > 0 ? put_digits(to, d, 0, whole) : put_zeros(to, 1);
    if (d->count > whole) {
        *to++ = '.';
        to = put_zeros(to, -whole);
        to = put_digits(to, d, whole > 0 ? whole : 0, d->count);
    }
    *to = '\0';
}

static void put_scientific(char *to, size_t size, const struct decimal *d)
{
    snprintf(to, size, "%c%s%.*se%c%02d", d->digit[0], d->count > 1 ? "." : "", d->count - 1,
             d->digit + 1, d->exponent < 0 ? '-' : '+', abs(d->exponent));
}

struct number_text accel_number_text(double x, int digits)
{
    struct number_text text = {""};
    char *to = text.at;
    if (!isfinite(x)) {
        snprintf(to, sizeof text.at, "%s", isnan(x) ? "nan" : x < 0.0 ? "-inf" : "inf");
        return text;
    }
    const struct decimal d = decimal_of(x, digits);
    if (signbit(x))
        *to++ = '-';
    if (d.exponent < -4 || d.exponent >= digits)
        put_scientific(to, sizeof text.at - 1, &d);
    else
        put_plain(to, &d);
    return text;
}

struct number_text accel_number_text_exact(double x)
{
    struct number_text text;
    int digits = 15;
    double back;
    do
        text = accel_number_text(x, digits);
    while (++digits <= 17 && accel_number_parse(text.at, strlen(text.at), &back) && back != x);
    return text;
}

/* A number being read. */
struct reader {
    const char *at, *end;
    char digit[MOST_DIGITS + 32]; /* the significant ones, then room for an exponent */
    int count;
    int64_t exponent; /* that the digits, as a whole number, are multiplied by */
};

static bool next_is_digit(const struct reader *r)
{
    return r->at < r->end && *r->at >= '0' && *r->at <= '9';
}

static bool accept(struct reader *r, char a, char b)
{
    const bool there = r->at < r->end && (*r->at == a || *r->at == b);
    r->at += there;
    return there;
}

static bool read_minus(struct reader *r)
{
    return !accept(r, '+', '+') && accept(r, '-', '-');
}

static void keep_digit(struct reader *r, char digit)
{
    if (r->count == 0 && digit == '0')
        return;
    if (r->count < MOST_DIGITS) {
        r->digit[r->count++] = digit;
        return;
    }
    r->exponent++;
    if (digit != '0')
        r->digit[MOST_DIGITS - 1] = '1';
}

/* Returns whether there was any. */
static bool read_digits(struct reader *r, bool behind_point)
{
    const char *start = r->at;
    for (; next_is_digit(r); r->at++) {
        r->exponent -= behind_point;
        keep_digit(r, *r->at);
    }
    return r->at > start;
}

/* False if there is no digit. */
static bool read_exponent(struct reader *r)
{
    const int64_t most = INT64_MAX / 4;
    const bool minus = read_minus(r);
    int64_t exponent = 0;
    if (!next_is_digit(r))
        return false;
    for (; next_is_digit(r); r->at++)
        exponent = exponent > most / 10 - 1 ? most : 10 * exponent + (*r->at - '0');
    r->exponent += minus ? -exponent : exponent;
    return true;
}

bool accel_number_parse(const char *at, size_t size, double *out)
{
    struct reader r = {.at = at, .end = at + size, .count = 0, .exponent = 0};
    const bool minus = read_minus(&r);
    bool any = read_digits(&r, false);
    if (accept(&r, '.', '.'))
        any |= read_digits(&r, true);
    if (!any || (accept(&r, 'e', 'E') && !read_exponent(&r)) || r.at != r.end)
        return false;
    const int exponent = r.exponent < -FAR ? -FAR : r.exponent > FAR ? FAR : (int)r.exponent;
    snprintf(r.digit + r.count, sizeof r.digit - (size_t)r.count, "%se%d", r.count ? "" : "0",
             exponent);
    const double magnitude = strtod(r.digit, NULL);
    *out = minus ? -magnitude : magnitude;
    return true;
}
