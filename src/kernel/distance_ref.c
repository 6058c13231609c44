/* The row pass of the distance transform, in integers: Meijster, Roerdink, Hesselink 2000, "A General
 * Algorithm for Computing Distance Transforms in Linear Time". A column's distance puts up a parabola over
 * its row; the lower envelope of all of them is the squared distance. Called through ref.c's table, and by
 * vector_distance.h where its own search does not pay. */
#include "kernel/distance_ref.h"

#include <math.h>

/* Every number below fits: widths and heights are at most 16384. */
typedef struct envelope {
    int32_t *square; /* of each column's distance */
    int32_t *owner;  /* owner[k]: the column whose parabola is lowest from start[k] on */
    int32_t *start;
    int32_t top; /* the last k */
} envelope;

/* Parabolas i < u meet where 2 x (u - i) = height(u) - height(i). */
static inline int32_t height_of(const envelope *e, int32_t u) {
    return e->square[u] + u * u;
}

static void find_owners(envelope *e, int32_t width) {
    int32_t i = 0, start = 0, height = height_of(e, 0); /* of the last owner */
    e->top = e->owner[0] = e->start[0] = 0;
    for (int32_t u = 1; u < width; u++) {
        int32_t rise = height_of(e, u) - height;
        if (rise >= 2 * (width - 1) * (u - i)) /* they meet behind the row */
            continue;
        while (rise < 2 * start * (u - i) && e->top > 0) {
            e->top--;
            i = e->owner[e->top];
            start = e->start[e->top];
            height = height_of(e, i);
            rise = height_of(e, u) - height;
        }
        if (rise < 2 * start * (u - i)) { /* lower than the first owner from the beginning on */
            i = e->owner[0] = u;
            height = height_of(e, u);
            continue;
        }
        int32_t meet = 1 + rise / (2 * (u - i));
        if (meet >= width)
            continue;
        e->top++;
        i = e->owner[e->top] = u;
        start = e->start[e->top] = meet;
        height = height_of(e, u);
    }
}

void dpl_distance_envelope(const dpl_distance_rows *rows, int32_t y, void *scratch) {
    int32_t width = rows->width;
    size_t row = (size_t)y * (size_t)width;
    const int32_t *run = rows->runs + row;
    float *squared = rows->clearance + row;
    envelope e = {.square = scratch};
    e.owner = e.square + width;
    e.start = e.owner + width;
    for (int32_t x = 0; x < width; x++) {
        int32_t known = run[x] < rows->nowhere ? run[x] : rows->nowhere;
        e.square[x] = known * known;
    }
    find_owners(&e, width);
    for (int32_t end = width; e.top >= 0; e.top--) {
        int32_t i = e.owner[e.top], start = e.start[e.top], square = e.square[i];
        for (int32_t x = start; x < end; x++)
            squared[x] = (float)((x - i) * (x - i) + square);
        end = start;
    }
}

void dpl_distance_along_ref(const dpl_distance_rows *rows, void *scratch) {
    for (int32_t y = 0; y < rows->height; y++) {
        float *clearance = rows->clearance + (size_t)y * (size_t)rows->width;
        const uint8_t *kind = rows->kind + (size_t)y * (size_t)rows->width;
        dpl_distance_envelope(rows, y, scratch);
        for (int32_t x = 0; x < rows->width; x++)
            clearance[x] = kind[x] == 2 ? -1.0f : sqrtf(clearance[x]);
    }
}
