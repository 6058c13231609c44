/* Hashes the program (FNV-1a, 64 bits). The tool is linked with the library statically, so this covers every
 * kernel. */
#include "build_mark.h"

#include "image/file.h"

#include <stdlib.h>

#define PROGRAM "/proc/self/exe"
#define PROGRAM_LIMIT ((size_t)1 << 30)
#define FNV_BASIS UINT64_C(0xcbf29ce484222325)
#define FNV_PRIME UINT64_C(0x100000001b3)

uint64_t dpl_study_build_mark(void) {
    char *bytes;
    size_t size;
    dpl_error error;
    uint64_t hash = FNV_BASIS;
    if (!dpl_file_read(PROGRAM, PROGRAM_LIMIT, &bytes, &size, &error))
        return 0;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ (unsigned char)bytes[i]) * FNV_PRIME;
    free(bytes);
    return hash;
}
