/* SPDX-License-Identifier: Apache-2.0
 *
 * The forms of structures: every kind as it comes, and every kind with each word of its options
 * that is not the default. What commands try where no CONFIG is given.
 */
#ifndef ACCEL_CLI_FORMS_H
#define ACCEL_CLI_FORMS_H

#include <accel/accel.h>

enum { ACCEL_MOST_FORMS = 64 };

typedef struct accel_forms {
    char at[ACCEL_MOST_FORMS][80]; /* CONFIGs */
    size_t count;
} accel_forms;

/* Is a word of this option a form to be listed? */
typedef bool accel_form_wanted(const accel_option *option);

/* In the order of accel_kinds: linear first, auto last. wanted: NULL for every option. */
accel_forms accel_forms_of_kinds(accel_form_wanted *wanted);

#endif
