/* FLIP's colours, one pixel at a time: into the opponent space that is filtered, on to a perceptual space,
 * and from two colours and feature strengths to an error. Used by flip.c. */
#ifndef DPL_METRIC_FLIP_COLOR_H
#define DPL_METRIC_FLIP_COLOR_H

#include <stdint.h>

/* Linear light of each 8-bit sRGB value. */
void dpl_flip_fill_linear(double linear[256]);

/* YCxCz, the linearised CIELab, of an 8-bit sRGB colour. */
void dpl_flip_opponent(const double linear[256], const uint8_t rgb[3], double opponent[3]);

/* CIELab with Hunt's adjustment of a filtered colour, after clamping it to what a display can show. */
void dpl_flip_perceptual(const double opponent[3], double lab[3]);

/* The largest colour difference, that of pure green and pure blue, to the power that errors are in. */
double dpl_flip_difference_max(void);

/* The colour error of two perceptual colours, 0 .. 1; `max` is dpl_flip_difference_max(). */
double dpl_flip_color_error(const double a[3], const double b[3], double max);

/* How strong an edge and a point a picture has at a pixel: lengths of its derivatives. */
typedef struct dpl_flip_features {
    double edge;
    double point;
} dpl_flip_features;

/* The feature error, 0 .. 1. */
double dpl_flip_feature_error(dpl_flip_features a, dpl_flip_features b);

/* The error of a pixel, 0 .. 1: features that differ make a colour error worse. */
double dpl_flip_error(double color_error, double feature_error);

#endif
