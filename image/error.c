/* Fills an error. */
#include "error.h"

#include <stdarg.h>
#include <stdio.h>

bool dpl_error_set(dpl_error *error, const char *format, ...) {
    if (!error)
        return false;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error->text, sizeof error->text, format, arguments);
    va_end(arguments);
    /* Names come from files and may hold anything; an error is one line all the same. */
    for (char *c = error->text; *c; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f)
            *c = '?';
    return false;
}
