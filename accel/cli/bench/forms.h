/* SPDX-License-Identifier: Apache-2.0
 *
 * The forms of structures: every kind as it comes, and every kind with each word of its options
 * that is not the default. What commands try where no CONFIG is given.
 */
#ifndef ACCEL_CLI_FORMS_H
#define ACCEL_CLI_FORMS_H

#include <accel/accel.h>

enum { MOST_FORMS = 64 };

struct forms {
    char at[MOST_FORMS][80]; /* CONFIGs */
    size_t count;
};

/* Is a word of this option a form to be listed? */
typedef bool form_wanted(const accel_option *option);

/* In the order of accel_kinds: linear first, auto last. wanted: NULL for every option. */
struct forms forms_of_kinds(form_wanted *wanted);

#endif
