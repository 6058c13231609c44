/* Memory where the user of a context gives no allocator. Used by src/api/. */
#ifndef DPL_OS_MEMORY_H
#define DPL_OS_MEMORY_H

#include <dapple/context.h>

/* The C library behind dpl_allocator. */
dpl_allocator dpl_allocator_default(void);

#endif
