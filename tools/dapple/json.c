/* JSON through jansson. */
#include "json.h"

#include "report.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Enough for every measurement, and short for round numbers. */
#define JSON_STYLE (JSON_INDENT(2) | JSON_REAL_PRECISION(12))

char *dpl_json_text(json_t *document, dpl_error *error) {
    char *dumped = document ? json_dumps(document, JSON_STYLE) : NULL;
    json_decref(document);
    if (!dumped) {
        dpl_error_set(error, "out of memory");
        return NULL;
    }
    size_t length = strlen(dumped);
    char *text = realloc(dumped, length + 2);
    if (!text) {
        free(dumped);
        dpl_error_set(error, "out of memory");
        return NULL;
    }
    text[length] = '\n';
    text[length + 1] = 0;
    return text;
}

int dpl_json_print(json_t *document) {
    dpl_error error;
    char *text = dpl_json_text(document, &error);
    if (!text)
        return dpl_report_failure("%s", error.text);
    fputs(text, stdout);
    free(text);
    return DPL_EXIT_DONE;
}

json_t *dpl_json_real(double value) {
    return isfinite(value) ? json_real(value) : json_null();
}

json_t *dpl_json_ms(double ms) {
    return json_real(round(ms * 1e3) / 1e3);
}
