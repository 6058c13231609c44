/* Rows of the holographic solver for tests: between guard bands, filled in every way, and compared; settings
 * and shifts to try. Used by test_rows.c. */
#ifndef DPL_TEST_GUARDED_ROWS_H
#define DPL_TEST_GUARDED_ROWS_H

#include "testing.h"

#include "kernel/kernel.h"

/* One instruction set, storage, colour and length. */
typedef struct setting {
    const dpl_row_kernels *expected;
    const dpl_row_kernels *found;
    bool half;
    int t_planes;
    dpl_row_shape shape;
} setting;

/* How a row of T is filled. */
typedef enum filling { DENSE, SPARSE, EMPTY, ODD_VALUES, FILLINGS } filling;

/* A row between guard bands; `at` is element 0 of its first plane. */
typedef struct row {
    unsigned char *memory;
    size_t bytes;
    size_t element;
    void *at;
} row;

enum { SHIFTS = 32 };

/* The same numbers in every run. */
uint32_t random_below(uint32_t count);
float random_unit(void);

/* Rows of planes, of T and of R; the caller frees `memory`. */
row new_row(const setting *s, int planes, size_t mask_bytes, size_t element);
row new_segment(const setting *s);
row new_radiance(const setting *s);
row copy_of(const row *r);

/* One number, in the row's storage. */
void put(const row *r, int32_t at, float value);
float get(const row *r, int32_t at);

float radiance_value(filling how);

void fill_segment(const setting *s, const row *r, filling how);

/* Radiance: anything inside, the same light in both pads and behind the end. */
void fill_radiance(const setting *s, const row *r, filling how);

/* What faces reflect: like the radiance of a segment, with light only where `wall` has its bits. */
void fill_face(const setting *s, const row *r, const row *wall, filling how);

/* Frees both. The reference keeps no masks: those of `found` have been looked at. */
int assert_same_segment(const setting *s, row *expected, row *found);

void assert_same_radiance(row *expected, row *found);

/* Every instruction set that this processor has, storage, colour and length. */
void for_each_setting(void (*test)(const setting *s));

/* Shifts inside a row, across its ends, and far outside. */
int32_t shift_of(const setting *s, int index);

#endif
