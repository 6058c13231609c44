/* Small pieces of HTML. Used by the pages of study and complexity. */
#ifndef DPL_STUDY_HTML_H
#define DPL_STUDY_HTML_H

#include <stdio.h>

/* Everything before the content: head, style, title. */
void dpl_html_begin(FILE *page, const char *title);
void dpl_html_end(FILE *page);

/* Text with <, > and & made harmless. */
void dpl_html_text(FILE *page, const char *text);

/* <NAME>TEXT</NAME>, the text made harmless. */
void dpl_html_element(FILE *page, const char *name, const char *text);

/* A table that scrolls sideways on narrow screens, with a caption and a head of `count` columns. */
void dpl_html_table_begin(FILE *page, const char *caption, const char *const *columns, int count);
void dpl_html_table_end(FILE *page);

/* The <svg> element of an SVG file's text, its ids made unique by a prefix. */
void dpl_html_svg(FILE *page, const char *svg, const char *prefix, const char *label);

/* The plot FOLDER/NAME.svg with a caption; nothing where there is no such file. */
void dpl_html_figure(FILE *page, const char *folder, const char *name, const char *caption);

#endif
