/** @file
 * Visibility, calling and must-check marks for every public name. Included by every public header.
 */
#ifndef DAPPLE_EXPORT_H
#define DAPPLE_EXPORT_H

/** Marks a function as part of the library's public interface. */
#if defined(DPL_BUILD_SHARED) && defined(__GNUC__)
#define DPL_API __attribute__((visibility("default")))
#else
#define DPL_API
#endif

/** Marks a function whose result must not be ignored. */
#if defined(__GNUC__)
#define DPL_MUST_CHECK __attribute__((warn_unused_result))
#else
#define DPL_MUST_CHECK
#endif

/** Stamped into every desc by its default function; a desc without it is refused. */
#define DPL_DESC_COOKIE 0x44504c31u

#endif
