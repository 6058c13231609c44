/* One line that says what went wrong: what readers and writers of files hand back beside `false`. */
#ifndef DPL_IMAGE_ERROR_H
#define DPL_IMAGE_ERROR_H

#include <stdbool.h>

/* No newline at the end, no program name at the start: "FILE: what" or "FILE:LINE:COL: what". */
typedef struct dpl_error {
    char text[1024];
} dpl_error;

/* Fills the text (printf-like) and returns false, so that a failing function can `return` it. Control
 * characters become question marks: an error is one line, whatever names it holds. `error` may be NULL. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
bool dpl_error_set(dpl_error *error, const char *format, ...);

#endif
