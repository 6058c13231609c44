/* What a case is called and how large it is. */
#include "case.h"

double dpl_complexity_items(const dpl_complexity_case *c) {
    return c->method == DPL_COMPLEXITY_FLOOD ? (double)c->size * c->size : (double)c->size;
}

const char *dpl_complexity_method_name(dpl_complexity_method method) {
    static const char *const names[] = {"naive", "bvh", "flood"};
    return names[method];
}
