/* SPDX-License-Identifier: Apache-2.0
 *
 * Making gnuplot's SVG smaller, to about a third: it opens a group of style for every stroke.
 * Groups that only carry a name are left out, so are empty ones and styles that SVG takes for
 * granted; neighbours of one style become one.
 *
 * Only tags of groups are understood; all other bytes are copied. Bad at: SVG that gnuplot did not
 * write.
 */
#include "report_svg.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_DEPTH = 64, MOST_TAG = 400 };

/* What is being written. */
typedef struct writer {
    char *out;
    size_t used;
    size_t opened[MOST_DEPTH]; /* where in `out` the open groups begin */
    bool written[MOST_DEPTH];  /* false: its tags are left out */
    int depth;
    size_t last_open,
        last_close; /* the group that was closed last: where its tag and its end are */
} writer;

static void put(writer *w, const char *text, size_t length)
{
    memcpy(w->out + w->used, text, length);
    w->used += length;
}

/* Is there anything but spaces from here on? */
static bool is_blank(const writer *w, size_t from)
{
    return strspn(w->out + from, " \t\r\n") == w->used - from;
}

/* The length of the tag at `text`, with its brackets. */
static size_t tag_length(const char *text)
{
    const char *end = strchr(text, '>');
    return end == NULL ? strlen(text) : (size_t)(end - text) + 1;
}

/* The group that begins here goes on where one of the same tag has just been closed. */
static bool join(writer *w, const char *tag, size_t length)
{
    w->out[w->used] = '\0';
    const bool same = w->last_close > 0 && is_blank(w, w->last_close + 4) &&
                      strncmp(w->out + w->last_open, tag, length) == 0;
    if (same) {
        w->used = w->last_close;
        w->opened[w->depth] = w->last_open;
        w->written[w->depth++] = true;
        w->last_close = 0;
    }
    return same;
}

/* Cuts `what` out of the tag; returns its new length. */
static size_t cut(char *tag, size_t length, const char *what)
{
    char *at = strstr(tag, what);
    if (at == NULL) {
        return length;
    }
    const size_t gone = strlen(what);
    memmove(at, at + gone, strlen(at + gone) + 1);
    return length - gone;
}

static void open_group(writer *w, const char *tag, size_t length)
{
    const bool named = strncmp(tag, "<g id=", 6) == 0;
    if (w->depth == MOST_DEPTH || (!named && join(w, tag, length))) {
        return;
    }
    w->opened[w->depth] = w->used;
    w->written[w->depth++] = !named;
    if (!named) {
        put(w, tag, length);
        w->last_close = 0;
    }
}

static void close_group(writer *w)
{
    if (w->depth == 0) {
        return;
    }
    w->depth--;
    if (!w->written[w->depth]) {
        return;
    }
    const size_t open = w->opened[w->depth];
    w->out[w->used] = '\0';
    if (is_blank(w, open + tag_length(w->out + open))) {
        w->used = open;
        return;
    }
    w->last_open = open;
    w->last_close = w->used;
    put(w, "</g>", 4);
}

/* Copies what is no tag of a group, without titles, tabs and repeated spaces; returns where it
 * ends. */
static const char *copy(writer *w, const char *text)
{
    if (strncmp(text, "<title>gnuplot_plot_", 20) == 0) {
        const char *end = strstr(text, "</title>");
        return end == NULL ? text + strlen(text) : end + 8;
    }
    if (strncmp(text, "<text></text>", 13) == 0) {
        return text + 13;
    }
    const bool again =
        (*text == '\n' || *text == ' ') && w->used > 0 && w->out[w->used - 1] == *text;
    if (*text != '\t' && !again) {
        put(w, text, 1);
    }
    return text + 1;
}

void svg_shrink(char *svg)
{
    writer w = {.out = malloc(strlen(svg) + 1)};
    if (w.out == NULL) {
        return;
    }
    for (const char *at = svg; *at != '\0';) {
        if (strncmp(at, "</g>", 4) == 0) {
            close_group(&w);
            at += 4;
        } else if (strncmp(at, "<g ", 3) == 0) {
            char tag[MOST_TAG];
            size_t length = tag_length(at);
            const char *next = at + length;
            if (length < sizeof tag) {
                memcpy(tag, at, length);
                tag[length] = '\0';
                length = cut(tag, length, " stroke-linecap=\"butt\"");
                length = cut(tag, length, " stroke-linejoin=\"miter\"");
                at = tag;
            }
            open_group(&w, at, length);
            at = next;
        } else {
            at = copy(&w, at);
        }
    }
    w.out[w.used] = '\0';
    if (w.depth == 0) {
        memcpy(svg, w.out, w.used + 1);
    }
    free(w.out);
}
