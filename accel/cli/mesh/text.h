/* SPDX-License-Identifier: Apache-2.0
 *
 * Words, numbers and lines of text formats. A line ends with LF, CR LF or CR.
 *
 * A number is [+-] digits [. digits] [e [+-] digits] with a digit on one side of the point at
 * least: no hex, no inf, no nan. It becomes the nearest double (core/number.h).
 */
#ifndef ACCEL_CLI_MESH_TEXT_H
#define ACCEL_CLI_MESH_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A place in text. */
typedef struct mesh_text {
    const char *at;    /* the next character */
    const char *begin; /* of all */
    const char *end;   /* behind the last one */
    uint64_t line;     /* of `at`, counted from 1 */
    char comment;      /* what follows it on a line is a comment; 0: nothing is */
    bool joins;        /* a backslash at the end of a line joins it with the next one */
} mesh_text;

enum { MESH_BLANK = 1, MESH_LINE_END = 2, MESH_DIGIT = 4, MESH_NUMBER = 8 };

/* The classes of a character. */
extern const unsigned char mesh_classes[256];

static inline bool mesh_is(char c, unsigned char classes)
{
    return (mesh_classes[(unsigned char)c] & classes) != 0;
}

/* Does a backslash at `at` join lines? It must be the last on its line, blanks apart, and apart
 * from a word before it or from one behind it: otherwise readers differ on whether these are one.
 */
bool mesh_joins(const mesh_text *text, const char *at);

/* Skips blanks that are not simply blanks: comments and joined lines. */
void mesh_skip_rest(mesh_text *text);

/* Moves to the next word of the line, or to the line's end. */
static inline void mesh_skip_blanks(mesh_text *text)
{
    while (text->at < text->end && mesh_is(*text->at, MESH_BLANK)) {
        text->at++;
    }
    if (text->at < text->end && ((text->comment != 0 && *text->at == text->comment) ||
                                 (text->joins && *text->at == '\\'))) {
        mesh_skip_rest(text);
    }
}

/* Is the end of a line, or of all, at `at`? */
static inline bool mesh_at_line_end(const mesh_text *text)
{
    return text->at == text->end || mesh_is(*text->at, MESH_LINE_END);
}

/* 1.#INF is a word, by which some writers mean infinity, and no comment behind a 1. */
static inline bool mesh_follows_point(const mesh_text *text, const char *at)
{
    return at > text->begin && at[-1] == '.';
}

/* Does a word end before `at`? */
static inline bool mesh_word_ends(const mesh_text *text, const char *at)
{
    return at == text->end || mesh_is(*at, MESH_BLANK | MESH_LINE_END) ||
           (text->comment != 0 && *at == text->comment && !mesh_follows_point(text, at)) ||
           (text->joins && *at == '\\' && mesh_joins(text, at));
}

/* Takes the end of a line at `at`. */
static inline void mesh_take_line_end(mesh_text *text)
{
    if (text->at < text->end) {
        text->at += *text->at == '\r' && text->at + 1 < text->end && text->at[1] == '\n' ? 2 : 1;
        text->line++;
    }
}

/* Moves to the end of the line, over whatever it holds. */
void mesh_skip_line(mesh_text *text);

/* From the end of a line, or a word, to the next word. False: there is none. */
bool mesh_skip_lines(mesh_text *text);

/* Moves to the next word, over ends of lines. False: there is none. */
static inline bool mesh_skip_space(mesh_text *text)
{
    mesh_skip_blanks(text);
    return !mesh_at_line_end(text) || mesh_skip_lines(text);
}

/* Takes the word at `at`, which is not empty unless a line ends here. */
size_t mesh_take_word(mesh_text *text, const char **word);

/* Takes the word at `at` if it is `wanted`, in any case of its letters. Otherwise leaves `at`. */
bool mesh_take_this(mesh_text *text, const char *wanted);

/* Is it the word `wanted`, in any case of its letters? */
bool mesh_same_word(const char *word, size_t length, const char *wanted);

/* Takes the number at `at`. Otherwise returns false and leaves `at`. */
bool mesh_take_number(mesh_text *text, double *number);

/* The same, rounded once to the nearest float, as what is declared a float has no more digits. What
 * is beyond a float's normal range is left a double. */
bool mesh_take_float(mesh_text *text, double *number);

/* Takes [+-] digits at `at`, which may be followed by anything; far too large ones become about
 * 10^18. Otherwise returns false and leaves `at`. */
bool mesh_take_integer(mesh_text *text, int64_t *number);

/* Takes a word that is a whole number, of digits alone, below 10^18. Otherwise leaves `at`. */
bool mesh_take_count(mesh_text *text, uint64_t *count);

enum { MESH_FOUND_TEXT = 64 };

/* Describes what is at `at`, for messages: a word in quotes, printable, or the end of what. */
const char *mesh_found(const mesh_text *text, char found[MESH_FOUND_TEXT]);

/* The same of any word. */
const char *mesh_quote(const char *word, size_t length, char found[MESH_FOUND_TEXT]);

#endif
