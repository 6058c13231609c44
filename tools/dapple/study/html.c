/* Prints HTML. One style for light and dark, wide and narrow. */
#include "html.h"

#include "folder_file.h"

#include "image/file.h"

#include <stdlib.h>
#include <string.h>

#define SVG_LIMIT ((size_t)64 << 20)

static const char style[] =
    ":root{color-scheme:light dark;--ink:#1b1d21;--soft:#5c626b;--paper:#fff;--line:#d9dce1;--band:#f4f5f7;"
    "--yes:#13713a;--part:#8a5a00;--no:#b3261e}\n"
    "@media(prefers-color-scheme:dark){:root{--ink:#e6e8eb;--soft:#a0a7b1;--paper:#15171a;--line:#353a41;"
    "--band:#1d2024;--yes:#5fd08a;--part:#e9b44c;--no:#ff8a80}}\n"
    "*{box-sizing:border-box}\n"
    "body{margin:0 auto;max-width:62rem;padding:1rem;font:16px/1.5 system-ui,sans-serif;color:var(--ink);"
    "background:var(--paper)}\n"
    "h1{font-size:1.6rem;line-height:1.2}h2{font-size:1.2rem;margin:2.2rem 0 .5rem}\n"
    "p,li{max-width:46rem}code{font-size:.9em;overflow-wrap:anywhere}\n"
    ".scroll{overflow-x:auto;margin:1rem 0}\n"
    "table{border-collapse:collapse;width:100%;font-size:.92rem;font-variant-numeric:tabular-nums}\n"
    "caption{text-align:left;color:var(--soft);padding:.3rem 0}\n"
    "th,td{text-align:left;vertical-align:top;padding:.4rem .5rem;border-bottom:1px solid var(--line)}\n"
    "thead th{background:var(--band);border-bottom:2px solid var(--line)}\n"
    "tbody th{font-weight:500;width:40%}\n"
    ".v{display:block;font-size:.85em;font-weight:600}\n"
    ".reproduced{color:var(--yes)}.partly{color:var(--part)}.not{color:var(--no)}\n"
    ".rule,.note{display:block;font-size:.85em;font-weight:400;color:var(--soft)}\n"
    "figure{margin:1.2rem 0}figcaption{color:var(--soft);font-size:.92rem}\n"
    "svg{display:block;width:100%;max-width:46rem;height:auto}\n"
    "svg g[color=black]{color:inherit}svg [fill=black]{fill:currentColor}svg [stroke=black]{stroke:"
    "currentColor}\n"
    "@media(max-width:34rem){body{padding:.7rem}table{font-size:.82rem}th,td{padding:.35rem .3rem}}\n";

void dpl_html_begin(FILE *page, const char *title) {
    fputs("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
          "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n",
          page);
    dpl_html_element(page, "title", title);
    fprintf(page, "<style>\n%s</style>\n</head>\n<body>\n", style);
    dpl_html_element(page, "h1", title);
}

void dpl_html_end(FILE *page) {
    fputs("</body>\n</html>\n", page);
}

void dpl_html_text(FILE *page, const char *text) {
    for (; *text; text++)
        switch (*text) {
        case '<':
            fputs("&lt;", page);
            break;
        case '>':
            fputs("&gt;", page);
            break;
        case '&':
            fputs("&amp;", page);
            break;
        default:
            fputc(*text, page);
        }
}

void dpl_html_element(FILE *page, const char *name, const char *text) {
    fprintf(page, "<%s>", name);
    dpl_html_text(page, text);
    fprintf(page, "</%s>\n", name);
}

void dpl_html_table_begin(FILE *page, const char *caption, const char *const *columns, int count) {
    fputs("<div class=\"scroll\"><table>\n", page);
    dpl_html_element(page, "caption", caption);
    fputs("<thead><tr>", page);
    for (int i = 0; i < count; i++) {
        fputs("<th scope=\"col\">", page);
        dpl_html_text(page, columns[i]);
        fputs("</th>", page);
    }
    fputs("</tr></thead>\n<tbody>\n", page);
}

void dpl_html_table_end(FILE *page) {
    fputs("</tbody>\n</table></div>\n", page);
}

/* Length of what introduces an id at `text`, or 0. */
static size_t id_opening(const char *text) {
    static const char *const openings[] = {" id='", " id=\"", "href='#", "href=\"#", "url(#"};
    for (size_t i = 0; i < sizeof openings / sizeof openings[0]; i++)
        if (strncmp(text, openings[i], strlen(openings[i])) == 0)
            return strlen(openings[i]);
    return 0;
}

void dpl_html_svg(FILE *page, const char *svg, const char *prefix, const char *label) {
    const char *at = strstr(svg, "<svg");
    if (!at)
        return;
    fputs("<svg role=\"img\" aria-label=\"", page);
    dpl_html_text(page, label);
    fputc('"', page);
    for (at += strlen("<svg"); *at;) {
        size_t opening = id_opening(at);
        if (opening == 0) {
            fputc(*at++, page);
            continue;
        }
        fprintf(page, "%.*s%s-", (int)opening, at, prefix);
        at += opening;
    }
}

void dpl_html_figure(FILE *page, const char *folder, const char *name, const char *caption) {
    char file[64];
    char *svg = NULL;
    size_t size;
    snprintf(file, sizeof file, "%s.svg", name);
    char *path = dpl_study_path(folder, file);
    if (path && dpl_file_read(path, SVG_LIMIT, &svg, &size, NULL)) {
        fputs("<figure>\n", page);
        dpl_html_svg(page, svg, name, caption);
        dpl_html_element(page, "figcaption", caption);
        fputs("</figure>\n", page);
    }
    free(svg);
    free(path);
}
