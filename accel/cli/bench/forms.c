/* SPDX-License-Identifier: Apache-2.0
 *
 * Listing the forms of structures, from the table of options that the parser uses.
 */
#include "forms.h"

#include <stdio.h>

/* KIND, or KIND:key=word for an option. */
static void add(struct forms *f, const char *kind, const char *key, const char *word)
{
    if (f->count == MOST_FORMS) {
        return;
    }
    snprintf(f->at[f->count++], sizeof f->at[0], key == NULL ? "%s" : "%s:%s=%s", kind, key, word);
}

static void add_words(struct forms *f, const char *kind, const accel_option *option)
{
    for (size_t w = 0; option->words != NULL && option->words[w] != NULL; w++) {
        if ((double)w != option->standard) {
            add(f, kind, option->key, option->words[w]);
        }
    }
}

struct forms forms_of_kinds(form_wanted *wanted)
{
    struct forms f = {.count = 0};
    size_t kinds;
    const accel_kind_info *const *kind = accel_kinds(&kinds);
    for (size_t i = 0; i < kinds; i++) {
        add(&f, kind[i]->name, NULL, NULL);
        for (size_t o = 0; o < kind[i]->option_count; o++) {
            if (wanted == NULL || wanted(&kind[i]->options[o])) {
                add_words(&f, kind[i]->name, &kind[i]->options[o]);
            }
        }
    }
    return f;
}
