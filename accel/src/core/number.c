/* SPDX-License-Identifier: Apache-2.0 */
#include "number.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A double is told from all its neighbours' midpoints by 767 digits, and one more that is not zero
 * if any digit left out is not. */
enum { MOST_DIGITS = NUMBER_REWRITTEN - 32 };

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
    char *digit; /* the significant ones, MOST_DIGITS at most */
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

static void put_exponent(char *to, int exponent)
{
    *to++ = 'e';
    if (exponent < 0)
        *to++ = '-';
    int unit = 1;
    while (unit <= FAR / 10 && abs(exponent) / unit >= 10)
        unit *= 10;
    for (; unit > 0; unit /= 10)
        *to++ = (char)('0' + abs(exponent) / unit % 10);
    *to = '\0';
}

bool accel_number_rewrite(const char *at, size_t size, char out[NUMBER_REWRITTEN])
{
    char *to = out;
    struct reader r = {.at = at, .end = at + size};
    if (read_minus(&r))
        *to++ = '-';
    r.digit = to;
    bool any = read_digits(&r, false);
    if (accept(&r, '.', '.'))
        any |= read_digits(&r, true);
    if (!any || (accept(&r, 'e', 'E') && !read_exponent(&r)) || r.at != r.end)
        return false;
    const int exponent = r.exponent < -FAR ? -FAR : r.exponent > FAR ? FAR : (int)r.exponent;
    to += r.count;
    if (r.count == 0)
        *to++ = '0';
    put_exponent(to, exponent);
    return true;
}

/* Digits that fit into a word, times a power of ten. */
struct short_number {
    uint64_t digits;
    int count, exponent;
};

/* Returns behind what it took: digits, with a point among them or none. */
static const char *scan_digits(const char *at, const char *end, struct short_number *n)
{
    bool point = false;
    for (; at < end && n->count <= 19; at++) {
        const unsigned digit = (unsigned char)*at - (unsigned)'0';
        if (digit < 10) {
            n->digits = 10 * n->digits + digit;
            n->count++;
            n->exponent -= point;
        } else if (*at == '.' && !point) {
            point = true;
        } else {
            break;
        }
    }
    return at;
}

/* The same of an exponent of up to three digits, or none; NULL where it has no digit. */
static const char *scan_exponent(const char *at, const char *end, struct short_number *n)
{
    if (at == end || (*at != 'e' && *at != 'E'))
        return at;
    const char *const sign = at + 1;
    const bool minus = sign < end && *sign == '-';
    const char *const first = sign + (sign < end && (*sign == '-' || *sign == '+'));
    int exponent = 0;
    for (at = first; at < end && at < first + 3 && *at >= '0' && *at <= '9'; at++)
        exponent = 10 * exponent + (*at - '0');
    n->exponent += minus ? -exponent : exponent;
    return at > first ? at : NULL;
}

/* Only where one operation on exact operands gives the number, which then rounds once: up to 2^53,
 * times or over a power of ten that is exact (Clinger, "How to Read Floating Point Numbers
 * Accurately", PLDI 1990). */
static bool parse_short(const char *at, size_t size, double *out)
{
    static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                    1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                    1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    const char *const end = at + size;
    const bool minus = size > 0 && *at == '-';
    struct short_number n = {0, 0, 0};
    at = scan_digits(at + (size > 0 && (*at == '-' || *at == '+')), end, &n);
    if (n.count == 0 || scan_exponent(at, end, &n) != end)
        return false;
    if (n.count > 19 || n.digits > UINT64_C(1) << 53 || n.exponent < -22 || n.exponent > 22 ||
        FLT_EVAL_METHOD != 0)
        return false;
    const double digits = (double)n.digits;
    const double x = n.exponent < 0 ? digits / powers[-n.exponent] : digits * powers[n.exponent];
    *out = minus ? -x : x;
    return true;
}

bool accel_number_parse(const char *at, size_t size, double *out)
{
    char text[NUMBER_REWRITTEN];
    if (parse_short(at, size, out))
        return true;
    if (!accel_number_rewrite(at, size, text))
        return false;
    *out = strtod(text, NULL);
    return true;
}
