/* A union of intervals, kept sorted: which part of a light is covered. Used by the exact method. */
#ifndef DPL_SHADOW_COVER_H
#define DPL_SHADOW_COVER_H

#include <stdbool.h>

/* Gaps beyond this many are closed, the newest first: more slits than this in one light's angle. */
#define DPL_COVER_MOST 256

typedef struct dpl_cover {
    double limit; /* intervals are cut to -limit .. limit */
    int count;
    double low[DPL_COVER_MOST];
    double high[DPL_COVER_MOST];
} dpl_cover;

static inline bool dpl_cover_is_full(const dpl_cover *cover) {
    return cover->count == 1 && cover->low[0] <= -cover->limit && cover->high[0] >= cover->limit;
}

/* Adds low .. high to the union. */
void dpl_cover_add(dpl_cover *cover, double low, double high);

#endif
