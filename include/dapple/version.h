/** @file
 * Version of the headers and of the library that is linked.
 */
#ifndef DAPPLE_VERSION_H
#define DAPPLE_VERSION_H

#include <dapple/export.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Major version of these headers: changes when the ABI breaks. */
#define DPL_VERSION_MAJOR 0
/** Minor version of these headers. */
#define DPL_VERSION_MINOR 1
/** Patch version of these headers. */
#define DPL_VERSION_PATCH 0

/**
 * Version of the linked library.
 * @return "major.minor.patch", static. Thread-safe.
 */
DPL_API const char *dpl_version(void);

#ifdef __cplusplus
}
#endif
#endif
