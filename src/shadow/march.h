/* The field term with what a blend wants to know about it. Used by march.c and blend.c. */
#ifndef DPL_SHADOW_MARCH_H
#define DPL_SHADOW_MARCH_H

#include "shadow/shadow.h"

typedef struct dpl_field_term {
    double visibility;
    double gap; /* from the receiver to where the march came nearest to a blocker [px]; 0: to none */
} dpl_field_term;

/* By one of DPL_SHADOW_DISTANCE_*. */
dpl_field_term dpl_field_term_of(const dpl_shadow_view *view, const dpl_receiver *r, dpl_shadow_method method,
                                 dpl_shadow_counts *counts);

#endif
