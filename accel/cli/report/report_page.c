/* SPDX-License-Identifier: Apache-2.0
 *
 * The page: plain HTML with its plots inside, so that one file can be passed on.
 */
#include "report.h"

#include "tool/machine.h"

#include <stdarg.h>
#include <string.h>
#include <time.h>

/* The first bytes are what report_folder.c knows a report by. */
static const char head[] =
    "<!DOCTYPE html><!-- accel report -->\n<html lang=\"en\"><head><meta charset=\"utf-8\"/>\n"
    "<title>accel: error against run time</title>\n<style>\n"
    "body{font:16px/1.5 system-ui,sans-serif;color:#222;max-width:62rem;margin:2rem auto;"
    "padding:0 1rem}\n"
    "h1{font-size:1.7rem}h2{font-size:1.25rem;margin-top:2.5rem;border-top:1px solid #ddd;"
    "padding-top:1rem}\n"
    "figure{margin:1.2rem 0}figure svg{max-width:100%;height:auto}figcaption{color:#444}\n"
    "table{border-collapse:collapse;font-size:.85rem}td,th{border-bottom:1px solid #ddd;"
    "padding:.25rem .5rem;text-align:left;vertical-align:top}td.n,th.n{text-align:right}\n"
    "td.bad{background:#f6dfe6}td.good{background:#e2f0ea}code{background:#f4f4f4}\n"
    ".told{color:#777;font-style:italic}small{color:#555}\n"
    "</style></head><body>\n";

void page_escaped(struct reporting *r, const char *text)
{
    for (; *text != '\0'; text++) {
        switch (*text) {
        case '&':
            fputs("&amp;", r->page);
            break;
        case '<':
            fputs("&lt;", r->page);
            break;
        case '>':
            fputs("&gt;", r->page);
            break;
        default:
            fputc(*text, r->page);
        }
    }
}

void page_open(struct reporting *r)
{
    char processor[256], day[40];
    const time_t now = time(NULL);
    struct tm parts;
    machine_processor(processor, sizeof processor);
    strftime(day, sizeof day, "%Y-%m-%d %H:%M UTC", gmtime_r(&now, &parts));
    fputs(head, r->page);
    fprintf(r->page, "<h1>accel: error against run time</h1>\n<p><small>");
    page_escaped(r, processor);
    fprintf(r->page, "<br/>");
    page_escaped(r, machine_build());
    fprintf(r->page,
            "<br/>%s; time for the whole: about %.0f seconds; made by <code>accel report</code>"
            "</small></p>\n",
            day, r->seconds);
    page_text(
        r, "A ray tracer asks one question again and again: <em>which object does this ray hit "
           "first?</em> An acceleration structure answers it without testing every object. "
           "<code>accel</code> is a library of such structures: a uniform <b>grid</b>, a hierarchy "
           "of grids (<b>hug</b>), one <b>octree</b>, a hierarchy of octrees over clusters "
           "(<b>hoo</b>), a kd-tree (<b>bsp</b>), a hierarchy of boxes (<b>bvh</b>), and "
           "<b>auto</b>, which picks one. It claims that all give the answer of a search through "
           "every object (<b>linear</b>), bit for bit, whatever the scene. This page measures what "
           "is wrong, and what being right costs. Times are processor time of one thread.");
}

bool page_close(struct reporting *r)
{
    fprintf(r->page, "</body></html>\n");
    folder_list(&r->folder, r->page);
    const char *trouble = folder_close(&r->folder, r->page);
    r->page = NULL;
    if (trouble != NULL) {
        complain(r->command, "cannot write index.html: %s; nothing was written", trouble);
    }
    return trouble == NULL;
}

void page_title(struct reporting *r, const char *id, const char *title)
{
    fprintf(r->page, "<h2 id=\"%s\">%s</h2>\n", id, title);
}

void page_text(struct reporting *r, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    fprintf(r->page, "<p>");
    vfprintf(r->page, format, list);
    fprintf(r->page, "</p>\n");
    va_end(list);
}

/* The SVG element of a file, without what stands before it. */
static bool copy_svg(struct reporting *r, FILE *svg)
{
    char line[4096];
    bool inside = false;
    while (fgets(line, sizeof line, svg) != NULL) {
        const char *start = inside ? line : strstr(line, "<svg");
        if (start != NULL) {
            inside = true;
            fputs(start, r->page);
        }
    }
    return inside;
}

bool page_plot(struct reporting *r, const char *name, const char *csv, const char *caption)
{
    char file[64];
    snprintf(file, sizeof file, "%s.svg", name);
    FILE *svg = folder_read(&r->folder, file);
    fprintf(r->page, "<figure id=\"%s\">\n", name);
    const bool fine = svg != NULL && copy_svg(r, svg);
    if (svg != NULL) {
        fclose(svg);
    }
    fprintf(r->page,
            "<figcaption>%s <small>(<a href=\"%s.svg\">plot</a>, <a href=\"%s\">figures</a>)"
            "</small></figcaption></figure>\n",
            caption, name, csv);
    if (!fine) {
        complain(r->command, "gnuplot made no %s; nothing was written", file);
    }
    return fine;
}
