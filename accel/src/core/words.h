/* SPDX-License-Identifier: Apache-2.0
 *
 * Words that somebody typed: which legal one is meant, and "name[:key=value[,key=value]...]" cut
 * into them. For config strings, and for whatever else has an accel_kind_info as its table: the
 * command reads its words and its scenes by the same rules.
 */
#ifndef ACCEL_WORDS_H
#define ACCEL_WORDS_H

#include "accel/accel.h"

/* A part of a text. */
struct word {
    const char *at;
    size_t size;
};

bool accel_word_is(struct word word, const char *text);

/* The legal word that is most like the one that was found. */
struct nearest {
    struct word found;
    const char *word; /* NULL: none is near */
    size_t distance;  /* of it */
};

/* Offers a legal word. By edit distance, upper and lower case alike; one that begins with what was
 * found is nearest of all, and one of which more than a third is wrong is not near. */
void accel_nearest_offer(struct nearest *nearest, const char *legal);

/* The name before the settings; moves *at behind it. */
struct word accel_settings_name(const char **at);

enum setting_fault { SETTING_FINE, SETTING_UNKNOWN, SETTING_TWICE, SETTING_EMPTY, SETTING_VALUE };

/* One "key=value". */
struct setting {
    struct word key, value;
    size_t option;         /* which option of the table it is; the count of all: none */
    struct nearest likely; /* of the table's keys, where it is none; of its words, where it has some
                              and the value is none of them */
};

/* What was given so far; starts as zero. */
struct settings {
    unsigned given; /* a bit for each option */
};

/* Takes the setting at *at, which is behind a ':' or ',' or the end of the text, and moves *at to
 * the end of it; its value goes to values[option]. SETTING_UNKNOWN: no such key. SETTING_EMPTY: no
 * '='. SETTING_VALUE: not one of the option's words, not a number, or outside of its range. */
enum setting_fault accel_settings_take(struct settings *settings, const accel_kind_info *table,
                                       const char **at, double *values, struct setting *out);

#endif
