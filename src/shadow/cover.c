/* A union of intervals, see cover.h. */
#include "shadow/cover.h"

#include <string.h>

/* Moves the intervals from `from` on to where `to` is. */
static void shift(dpl_cover *c, int from, int to) {
    size_t count = (size_t)(c->count - from);
    memmove(c->low + to, c->low + from, count * sizeof *c->low);
    memmove(c->high + to, c->high + from, count * sizeof *c->high);
    c->count += to - from;
}

void dpl_cover_add(dpl_cover *c, double low, double high) {
    low = low > -c->limit ? low : -c->limit;
    high = high < c->limit ? high : c->limit;
    if (!(low < high))
        return;
    int first = 0;
    while (first < c->count && c->high[first] < low)
        first++;
    int end = first;
    while (end < c->count && c->low[end] <= high)
        end++;
    if (end == first) {
        if (c->count < DPL_COVER_MOST)
            shift(c, first, first + 1);
        else if (first == c->count) /* no room: the gap to a neighbour closes */
            low = c->low[--first];
        else
            high = c->high[first];
    } else {
        low = low < c->low[first] ? low : c->low[first];
        high = high > c->high[end - 1] ? high : c->high[end - 1];
        if (end > first + 1)
            shift(c, end, first + 1);
    }
    c->low[first] = low;
    c->high[first] = high;
}
