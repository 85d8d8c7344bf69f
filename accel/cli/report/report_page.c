/* SPDX-License-Identifier: Apache-2.0
 *
 * The page: page.html with its gaps filled, plain HTML with its plots inside, so that one file can
 * be passed on.
 *
 * A gap is {{KEY}}, which becomes the value of the key, or {{svg NAME}}, the plot NAME.svg. What is
 * between {{if KEY}}, or {{unless KEY}}, and its {{end}} is there where the key has a value, or
 * none.
 */
#include "report.h"

#include "report_text.h"
#include "tool/machine.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

void page_escaped(FILE *to, const char *text)
{
    for (; *text != '\0'; text++) {
        switch (*text) {
        case '&':
            fputs("&amp;", to);
            break;
        case '<':
            fputs("&lt;", to);
            break;
        case '>':
            fputs("&gt;", to);
            break;
        default:
            fputc(*text, to);
        }
    }
}

/* ------------------------------------------------------------------- values ---- */

FILE *page_value(struct reporting *r, const char *key)
{
    struct page *p = &r->page;
    if (p->count == PAGE_VALUES) {
        return NULL;
    }
    struct page_value *v = &p->values[p->count];
    *v = (struct page_value){.key = key};
    FILE *stream = open_memstream(&v->text, &v->length);
    p->count += stream != NULL;
    return stream;
}

bool page_value_end(struct reporting *r, FILE *value)
{
    if (value != NULL && fclose(value) == 0) {
        return true;
    }
    complain(r->command, "no memory for the page; nothing was written");
    return false;
}

bool page_set(struct reporting *r, const char *key, const char *format, ...)
{
    FILE *value = page_value(r, key);
    if (value != NULL) {
        va_list list;
        va_start(list, format);
        vfprintf(value, format, list);
        va_end(list);
    }
    return page_value_end(r, value);
}

static const char *find_value(const struct reporting *r, const char *key, size_t length)
{
    for (size_t i = 0; i < r->page.count; i++) {
        const struct page_value *v = &r->page.values[i];
        if (strlen(v->key) == length && memcmp(v->key, key, length) == 0) {
            return v->text;
        }
    }
    return NULL;
}

/* --------------------------------------------------------------------- page ---- */

/* The SVG element of a file, without what stands before it. */
static bool copy_svg(struct reporting *r, const char *name, size_t length)
{
    char file[64], line[4096];
    snprintf(file, sizeof file, "%.*s.svg", (int)length, name);
    FILE *svg = folder_read(&r->folder, file);
    bool inside = false;
    while (svg != NULL && fgets(line, sizeof line, svg) != NULL) {
        const char *start = inside ? line : strstr(line, "<svg");
        if (start != NULL) {
            inside = true;
            fputs(start, r->page.file);
        }
    }
    if (svg != NULL) {
        fclose(svg);
    }
    if (!inside) {
        complain(r->command, "gnuplot made no %s; nothing was written", file);
    }
    return inside;
}

static bool begins(const char *text, const char *word)
{
    return strncmp(text, word, strlen(word)) == 0;
}

/* Writes the template from *at on, to its end or behind the {{end}} of this part; where it is not
 * `shown` only moves *at. */
static bool fill(struct reporting *r, const char **at, bool shown)
{
    bool fine = true;
    for (const char *gap; fine && (gap = strstr(*at, "{{")) != NULL;) {
        const char *key = gap + 2, *end = strstr(key, "}}");
        if (shown) {
            fwrite(*at, 1, (size_t)(gap - *at), r->page.file);
        }
        *at = end + 2;
        if (begins(key, "end")) {
            return true;
        }
        if (begins(key, "if ") || begins(key, "unless ")) {
            const char *name = strchr(key, ' ') + 1;
            const bool there = find_value(r, name, (size_t)(end - name)) != NULL;
            fine = fill(r, at, shown && there == begins(key, "if "));
        } else if (shown && begins(key, "svg ")) {
            fine = copy_svg(r, key + 4, (size_t)(end - key - 4));
        } else if (shown) {
            const char *value = find_value(r, key, (size_t)(end - key));
            fputs(value != NULL ? value : "", r->page.file);
        }
    }
    return fine;
}

static bool describe_run(struct reporting *r)
{
    char processor[256], day[40];
    const time_t now = time(NULL);
    struct tm parts;
    machine_processor(processor, sizeof processor);
    strftime(day, sizeof day, "%Y-%m-%d %H:%M UTC", gmtime_r(&now, &parts));
    FILE *value = page_value(r, "processor");
    if (value != NULL) {
        page_escaped(value, processor);
    }
    if (!page_value_end(r, value)) {
        return false;
    }
    value = page_value(r, "build");
    if (value != NULL) {
        page_escaped(value, machine_build());
    }
    return page_value_end(r, value) && page_set(r, "day", "%s", day) &&
           page_set(r, "seconds", "%.0f", r->seconds);
}

bool page_open(struct reporting *r)
{
    r->page.file = folder_write(&r->folder, "index.html");
    if (r->page.file == NULL) {
        complain(r->command, "cannot write index.html: %s; nothing was written", strerror(errno));
    }
    return r->page.file != NULL;
}

bool page_write(struct reporting *r)
{
    const char *at = report_text("page.html");
    if (!describe_run(r) || !fill(r, &at, true)) {
        return false;
    }
    fputs(at, r->page.file);
    folder_list(&r->folder, r->page.file);
    const char *trouble = folder_close(&r->folder, r->page.file);
    r->page.file = NULL;
    if (trouble != NULL) {
        complain(r->command, "cannot write index.html: %s; nothing was written", trouble);
    }
    return trouble == NULL;
}

void page_free(struct reporting *r)
{
    if (r->page.file != NULL) {
        fclose(r->page.file);
    }
    for (size_t i = 0; i < r->page.count; i++) {
        free(r->page.values[i].text);
    }
    r->page = (struct page){.file = NULL};
}
