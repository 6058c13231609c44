/* Was a desc made by its default function? Used by every public function that takes one. */
#ifndef DPL_BASE_DESC_H
#define DPL_BASE_DESC_H

#include <dapple/export.h>

#define DPL_DESC_IS_GOOD(desc) ((desc)->struct_size == sizeof *(desc) && (desc)->cookie == DPL_DESC_COOKIE)

#endif
