/* A union of intervals, see cover.h. */
#include "shadow/cover.h"

#include <math.h>
#include <string.h>

/* Makes `gone` entries from `at` on into one, or makes room for one where `gone` is 0. */
static void replace(dpl_cover *c, int at, int gone, double low, double high) {
    int tail = c->count - at - gone;
    memmove(c->low + at + 1, c->low + at + gone, (size_t)tail * sizeof *c->low);
    memmove(c->high + at + 1, c->high + at + gone, (size_t)tail * sizeof *c->high);
    c->low[at] = low;
    c->high[at] = high;
    c->count += 1 - gone;
}

void dpl_cover_add(dpl_cover *c, double low, double high) {
    low = fmax(low, -c->limit);
    high = fmin(high, c->limit);
    if (!(low < high))
        return;
    int first = 0;
    while (first < c->count && c->high[first] < low)
        first++;
    int end = first;
    while (end < c->count && c->low[end] <= high)
        end++;
    if (end == first && c->count == DPL_COVER_MOST) { /* no room: close the gap to a neighbour */
        if (first == c->count)
            first--;
        end = first + 1;
    }
    if (end > first) {
        low = fmin(low, c->low[first]);
        high = fmax(high, c->high[end - 1]);
    }
    replace(c, first, end - first, low, high);
}
