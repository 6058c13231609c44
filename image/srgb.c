/* The sRGB transfer curve (IEC 61966-2-1). Called by the PNG reader. */
#include "srgb.h"

#include <math.h>

double dpl_picture_srgb_decode(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}
