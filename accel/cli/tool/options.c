/* SPDX-License-Identifier: Apache-2.0
 *
 * The walk over the arguments of a subcommand, its help, and its complaints.
 */
#include "options.h"

#include "words.h"

#include <locale.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <wchar.h>
#include <wctype.h>

static const struct flag common[] = {
    {"quiet", 'q', NULL, "no progress: results and errors only"},
    {"help", 'h', NULL, "print this and end"},
};

enum { COMMON = sizeof common / sizeof common[0], COMMON_FIRST = 1000 };

struct arguments arguments_start(const struct command *command, int argc, char **argv)
{
    return (struct arguments){.command = command, .argv = argv, .argc = argc, .at = 1};
}

/* Characters that end a line or turn the direction of writing. */
static bool is_layout(wchar_t c)
{
    return c == 0x200e || c == 0x200f || (c >= 0x2028 && c <= 0x202e) ||
           (c >= 0x2066 && c <= 0x2069);
}

/* What a terminal would obey, and what is no UTF-8 or was cut in two, becomes '?'. */
static void make_printable(char *text)
{
    const locale_t utf8 = newlocale(LC_CTYPE_MASK, "C.UTF-8", (locale_t)0);
    const locale_t before = utf8 == (locale_t)0 ? utf8 : uselocale(utf8);
    char *to = text;
    for (const char *from = text; *from != '\0';) {
        wchar_t c;
        const size_t bytes = mbrtowc(&c, from, strlen(from), &(mbstate_t){0});
        const bool valid = bytes <= strlen(from), shown = valid && iswprint((wint_t)c) != 0;
        if (shown && !is_layout(c)) {
            memmove(to, from, bytes);
            to += bytes;
        } else {
            *to++ = '?';
        }
        from += valid ? bytes : 1;
    }
    *to = '\0';
    if (utf8 != (locale_t)0) {
        uselocale(before);
        freelocale(utf8);
    }
}

/* Prints one line, whatever is in a file or its name. */
__attribute__((format(printf, 3, 0))) static void
say(const struct command *command, const char *what, const char *format, va_list list)
{
    char text[1000];
    vsnprintf(text, sizeof text, format, list);
    make_printable(text);
    fprintf(stderr, "accel %s: %s%s\n", command->name, what, text);
}

int complain(const struct command *command, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    say(command, "", format, list);
    va_end(list);
    return EXIT_BAD;
}

void note(const struct command *command, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    say(command, "note: ", format, list);
    va_end(list);
}

static void print_flag(const struct flag *flag)
{
    char left[60];
    int length = flag->letter == 0
                     ? snprintf(left, sizeof left, "      --%s", flag->name)
                     : snprintf(left, sizeof left, "  -%c, --%s", flag->letter, flag->name);
    if (flag->argument != NULL) {
        length += snprintf(left + length, sizeof left - (size_t)length, " %s", flag->argument);
    }
    printf("%-26s", left);
    if (length > 25) {
        printf("\n%26s", "");
    }
    for (const char *c = flag->help; *c != '\0'; c++) {
        putchar(*c);
        if (*c == '\n') {
            printf("%26s", "");
        }
    }
    putchar('\n');
}

static void print_help(const struct command *command)
{
    printf("usage: accel %s%s%s\n\n%s\n", command->name, *command->arguments == '\0' ? "" : " ",
           command->arguments, command->summary);
    if (command->details != NULL) {
        printf("\n%s\n", command->details);
    }
    printf("\n");
    for (size_t i = 0; i < command->flag_count; i++) {
        print_flag(&command->flags[i]);
    }
    for (size_t i = 0; i < COMMON; i++) {
        print_flag(&common[i]);
    }
}

static const struct flag *flag_at(const struct command *command, int index)
{
    return index >= COMMON_FIRST ? &common[index - COMMON_FIRST] : &command->flags[index];
}

static int find_letter(const struct command *command, char letter)
{
    for (size_t i = 0; i < command->flag_count; i++) {
        if (command->flags[i].letter == letter) {
            return (int)i;
        }
    }
    for (int i = 0; i < COMMON; i++) {
        if (common[i].letter == letter) {
            return COMMON_FIRST + i;
        }
    }
    return -1;
}

static int find_name(const struct command *command, const char *name, size_t length,
                     const char **nearest)
{
    struct nearest likely = {.found = {name, length}};
    for (int i = 0; i < (int)command->flag_count + COMMON; i++) {
        const int index =
            i < (int)command->flag_count ? i : COMMON_FIRST + i - (int)command->flag_count;
        const char *legal = flag_at(command, index)->name;
        if (strlen(legal) == length && memcmp(legal, name, length) == 0) {
            return index;
        }
        accel_nearest_offer(&likely, legal);
    }
    *nearest = likely.word;
    return -1;
}

/* Is the next word the value of an option that may do without? */
static bool is_optional_value(const struct arguments *a, const struct flag *flag)
{
    const char *ending = strrchr(flag->argument, '.');
    if (a->at >= a->argc || ending == NULL) {
        return false;
    }
    if (strcmp(a->argv[a->at], "-") == 0) {
        return true;
    }
    const size_t length = strlen(a->argv[a->at]), own = strcspn(ending, "]");
    return length > own && memcmp(a->argv[a->at] + length - own, ending, own) == 0;
}

static int stop(struct arguments *a, int code)
{
    a->exit_code = code;
    return ARGUMENT_STOP;
}

/* Of two values of one option the first would be lost without a word. */
static bool is_second(struct arguments *a, int index, const struct flag *flag)
{
    const uint64_t bit = flag->argument == NULL ? 0 : UINT64_C(1) << index;
    const bool second = (a->seen & bit & ~a->command->many) != 0;
    a->seen |= bit;
    return second;
}

/* The flag `index` has been named; `attached` is the value behind it, or NULL. */
static int take_flag(struct arguments *a, int index, const char *attached)
{
    const struct flag *flag = flag_at(a->command, index);
    a->bare = false;
    if (flag->argument == NULL && attached != NULL) {
        return stop(a, complain(a->command, "--%s takes no value", flag->name));
    }
    if (index == COMMON_FIRST) {
        a->quiet = true;
        return next_argument(a);
    }
    if (index == COMMON_FIRST + 1) {
        print_help(a->command);
        return stop(a, EXIT_FINE);
    }
    if (is_second(a, index, flag)) {
        return stop(a, complain(a->command, "--%s is given twice; once is allowed", flag->name));
    }
    a->value = attached;
    const bool optional = flag->argument != NULL && flag->argument[0] == '[';
    a->bare = optional && attached == NULL && !is_optional_value(a, flag);
    if (flag->argument != NULL && attached == NULL && !a->bare) {
        if (a->at >= a->argc) {
            return stop(a,
                        complain(a->command, "--%s needs a value: %s", flag->name, flag->argument));
        }
        a->value = a->argv[a->at++];
    }
    return index;
}

static int unknown_option(const struct command *command, const char *name, size_t length,
                          const char *nearest)
{
    const int shown = length < 60 ? (int)length : 60;
    return nearest == NULL
               ? complain(command, "unknown option --%.*s; 'accel %s --help' lists the options",
                          shown, name, command->name)
               : complain(command, "unknown option --%.*s; nearest is --%s", shown, name, nearest);
}

static int take_long(struct arguments *a, const char *name)
{
    const size_t length = strcspn(name, "=");
    const char *nearest = NULL;
    const int index = find_name(a->command, name, length, &nearest);
    if (index < 0) {
        return stop(a, unknown_option(a->command, name, length, nearest));
    }
    return take_flag(a, index, name[length] == '=' ? name + length + 1 : NULL);
}

static int take_short(struct arguments *a, const char *letters)
{
    const int index = find_letter(a->command, letters[0]);
    if (index < 0) {
        return stop(a,
                    complain(a->command, "unknown option -%c; 'accel %s --help' lists the options",
                             letters[0], a->command->name));
    }
    return take_flag(a, index, letters[1] == '\0' ? NULL : letters + 1);
}

int next_argument(struct arguments *a)
{
    if (a->at >= a->argc) {
        return ARGUMENT_END;
    }
    const char *word = a->argv[a->at++];
    if (a->words_only || word[0] != '-' || word[1] == '\0') {
        a->value = word;
        a->declined = a->bare;
        a->bare = false;
        return ARGUMENT_WORD;
    }
    if (strcmp(word, "--") == 0) {
        a->words_only = true;
        return next_argument(a);
    }
    return word[1] == '-' ? take_long(a, word + 2) : take_short(a, word + 1);
}

bool take_arguments(struct arguments *a, take_argument *take, void *request)
{
    int found;
    while ((found = next_argument(a)) != ARGUMENT_END) {
        if (found == ARGUMENT_STOP) {
            return false;
        }
        if (!take(a, found, request)) {
            a->exit_code = EXIT_BAD;
            return false;
        }
    }
    return true;
}

bool whole_argument(const struct arguments *a, int flag, uint64_t min, uint64_t max, uint64_t *out)
{
    if (read_whole(a->value, min, max, out)) {
        return true;
    }
    complain(a->command, "--%s is '%.60s'; allowed is a whole number from %llu to %llu",
             a->command->flags[flag].name, a->value, (unsigned long long)min,
             (unsigned long long)max);
    return false;
}

bool one_word(const struct arguments *a, const char *what, const char **word)
{
    if (*word != NULL) {
        complain(a->command, "unexpected '%.60s': one %s is enough", a->value, what);
        return false;
    }
    *word = a->value;
    return true;
}
