/* FLIP's colour spaces and error maps for one pixel. Called by flip.c.
 *
 * Source: Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", 2020: section 4.1 and
 * equations 4 to 8; the numbers of sRGB and D65 are those of the authors' published program. */
#include "metric/flip_color.h"

#include "kernel/srgb.h"

#include <math.h>

/* Exponents of colour and feature differences, and where colour errors bend: differences below 0.4 of the
 * largest take up 0.95 of the range. */
#define COLOR_EXPONENT 0.7
#define FEATURE_EXPONENT 0.5
#define BEND_DIFFERENCE 0.4
#define BEND_ERROR 0.95

/* Linear sRGB to CIE XYZ in units of the white point D65: every row sums to 1. */
static const double xyz_from_rgb[3][3] = {
    {10135552.0 / 23359437.0, 8788810.0 / 23359437.0, 4435075.0 / 23359437.0},
    {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
    {1425312.0 / 80288307.0, 8788810.0 / 80288307.0, 70074185.0 / 80288307.0},
};

/* Its inverse. */
static const double rgb_from_xyz[3][3] = {
    {3.080341988280461, -1.5373989694887855, -0.5429430187916751},
    {-0.9211783961651236, 1.875929983695176, 0.04524841246994758},
    {0.05288129287554325, -0.20401120612390997, 1.1511299132483668},
};

static void transform(const double matrix[3][3], const double in[3], double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = matrix[i][0] * in[0] + matrix[i][1] * in[1] + matrix[i][2] * in[2];
}

/* The form that YCxCz and CIELab share: lightness, red against green, blue against yellow. */
static void opponent_from_xyz(const double xyz[3], double opponent[3]) {
    opponent[0] = 116.0 * xyz[1] - 16.0;
    opponent[1] = 500.0 * (xyz[0] - xyz[1]);
    opponent[2] = 200.0 * (xyz[1] - xyz[2]);
}

static void xyz_from_opponent(const double opponent[3], double xyz[3]) {
    xyz[1] = (opponent[0] + 16.0) / 116.0;
    xyz[0] = xyz[1] + opponent[1] / 500.0;
    xyz[2] = xyz[1] - opponent[2] / 200.0;
}

/* CIELab's cube root with its straight piece near black. */
static double lab_curve(double v) {
    const double bend = 6.0 / 29.0;
    return v > bend * bend * bend ? cbrt(v) : v / (3.0 * bend * bend) + 4.0 / 29.0;
}

void dpl_flip_fill_linear(double linear[256]) {
    for (int i = 0; i < 256; i++)
        linear[i] = dpl_srgb_decode(i / 255.0);
}

void dpl_flip_opponent(const double linear[256], const uint8_t rgb[3], double opponent[3]) {
    const double color[3] = {linear[rgb[0]], linear[rgb[1]], linear[rgb[2]]};
    double xyz[3];
    transform(xyz_from_rgb, color, xyz);
    opponent_from_xyz(xyz, opponent);
}

static void hunt_lab_from_rgb(const double rgb[3], double lab[3]) {
    double xyz[3];
    transform(xyz_from_rgb, rgb, xyz);
    for (int i = 0; i < 3; i++)
        xyz[i] = lab_curve(xyz[i]);
    opponent_from_xyz(xyz, lab);
    /* Colours lose saturation where it is dark. */
    lab[1] *= 0.01 * lab[0];
    lab[2] *= 0.01 * lab[0];
}

void dpl_flip_perceptual(const double opponent[3], double lab[3]) {
    double xyz[3], rgb[3];
    xyz_from_opponent(opponent, xyz);
    transform(rgb_from_xyz, xyz, rgb);
    for (int i = 0; i < 3; i++)
        rgb[i] = rgb[i] > 0.0 ? rgb[i] < 1.0 ? rgb[i] : 1.0 : 0.0;
    hunt_lab_from_rgb(rgb, lab);
}

/* HyAB: city block between lightness and colour, Euclidean within colour. */
static double color_difference(const double a[3], const double b[3]) {
    const double red_green = a[1] - b[1], blue_yellow = a[2] - b[2];
    const double distance = fabs(a[0] - b[0]) + sqrt(red_green * red_green + blue_yellow * blue_yellow);
    return pow(distance, COLOR_EXPONENT);
}

double dpl_flip_difference_max(void) {
    double green[3], blue[3];
    hunt_lab_from_rgb((const double[3]){0.0, 1.0, 0.0}, green);
    hunt_lab_from_rgb((const double[3]){0.0, 0.0, 1.0}, blue);
    return color_difference(green, blue);
}

double dpl_flip_color_error(const double a[3], const double b[3], double max) {
    const double difference = color_difference(a, b);
    const double bend = BEND_DIFFERENCE * max;
    if (difference < bend)
        return BEND_ERROR / bend * difference;
    return BEND_ERROR + (difference - bend) / (max - bend) * (1.0 - BEND_ERROR);
}

double dpl_flip_feature_error(dpl_flip_features a, dpl_flip_features b) {
    const double edge = fabs(a.edge - b.edge), point = fabs(a.point - b.point);
    return pow((edge > point ? edge : point) * sqrt(0.5), FEATURE_EXPONENT);
}

double dpl_flip_error(double color_error, double feature_error) {
    return pow(color_error, 1.0 - (feature_error < 1.0 ? feature_error : 1.0));
}
