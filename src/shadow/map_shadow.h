/* The map term with what a blend wants to know about it. Used by map_shadow.c and blend.c. */
#ifndef DPL_SHADOW_MAP_SHADOW_H
#define DPL_SHADOW_MAP_SHADOW_H

#include "shadow/shadow.h"

typedef struct dpl_map_term {
    double visibility;
    double penumbra; /* its width at the receiver [px]; 0: no blocker was found */
} dpl_map_term;

dpl_map_term dpl_map_soft_term(const dpl_shadow_view *view, const dpl_receiver *r, dpl_shadow_counts *counts);
dpl_map_term dpl_map_pcss_term(const dpl_shadow_view *view, const dpl_receiver *r, dpl_shadow_counts *counts);

#endif
