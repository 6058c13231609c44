/* Finished JSON documents on their way out. Used by everything that prints or stores JSON. */
#ifndef DPL_TOOL_JSON_H
#define DPL_TOOL_JSON_H

#include "image/error.h"

#include <jansson.h>

/* Prints a document to standard output, or reports why not. Takes the document; NULL means that there was no
 * memory to build it. Returns an exit status. */
int dpl_json_print(json_t *document);

/* The text of a document with a newline at its end, malloc'ed. Takes the document as above. */
char *dpl_json_text(json_t *document, dpl_error *error);

/* A number, or null where JSON has none (infinite, not a number). */
json_t *dpl_json_real(double value);

/* Milliseconds with microseconds as their last digit. */
json_t *dpl_json_ms(double ms);

#endif
