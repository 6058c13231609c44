/* The sRGB transfer curve (IEC 61966-2-1), decoding only: what PNG colours pass through. Internal to image/.
 */
#ifndef DPL_IMAGE_SRGB_H
#define DPL_IMAGE_SRGB_H

/* Encoded 0 .. 1 to linear 0 .. 1. */
double dpl_picture_srgb_decode(double encoded);

#endif
