/* How bright a picture will be, from a few rays: the tone map is steep where it is dark, so the same error of
 * radiance is worth more decibels there. Called by survey.c for --skip bounded. */
#include "cascade/guess.h"

#include "job/jobs.h"

#include <math.h>

/* Points along either axis, and rays from each. */
#define POINTS 16
#define POINT_RAYS 16

static const double PI = 3.14159265358979323846;

/* d/dm of 1 - (1 + 2 pi m)^-2.5 */
static double tonemap_slope(double mean) {
    return 5.0 * PI * pow(1.0 + 2.0 * PI * mean, -3.5);
}

/* Mean radiance at a point, per channel. */
static void light_at(const dpl_survey_task *t, double x, double y, double mean[3]) {
    float ends[4][POINT_RAYS], found[6][POINT_RAYS];
    double length = hypot(t->grid.width, t->grid.height);
    for (int k = 0; k < POINT_RAYS; k++) {
        double angle = 2.0 * PI * (k + 0.5) / POINT_RAYS;
        ends[0][k] = (float)x;
        ends[1][k] = (float)y;
        ends[2][k] = (float)(x + length * cos(angle));
        ends[3][k] = (float)(y + length * sin(angle));
    }
    dpl_segments segments = {POINT_RAYS, ends[0], ends[1], ends[2], ends[3]};
    dpl_intervals intervals = {{found[0], found[1], found[2]}, {found[3], found[4], found[5]}};
    t->kernels->march(&t->grid, &segments, &intervals);
    mean[0] = mean[1] = mean[2] = 0.0;
    for (int k = 0; k < POINT_RAYS; k++) {
        const float *sky = dpl_field_sky_at(t->field, 2.0 * PI * (k + 0.5) / POINT_RAYS);
        for (int c = 0; c < 3; c++)
            mean[c] += ((double)found[c][k] + (double)found[3 + c][k] * (double)sky[c]) / POINT_RAYS;
    }
}

/* Points are looked at in any order, and added up in theirs. */
typedef struct points {
    const dpl_survey_task *survey;
    double squares[POINTS * POINTS][3]; /* by channel */
    bool is_open[POINTS * POINTS];
} points;

static void look_at_points(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    points *p = task;
    const dpl_survey_task *t = p->survey;
    for (int32_t i = begin; i < end; i++) {
        double x = (i % POINTS + 0.5) * t->grid.width / POINTS,
               y = (i / POINTS + 0.5) * t->grid.height / POINTS;
        double mean[3];
        /* walls show themselves: no error there, so the picture's is less */
        p->is_open[i] = !dpl_field_is_opaque(t->field, (int32_t)x, (int32_t)y);
        if (!p->is_open[i])
            continue;
        light_at(t, x, y, mean);
        for (int c = 0; c < 3; c++)
            p->squares[i][c] = tonemap_slope(mean[c]) * tonemap_slope(mean[c]) / 3.0;
    }
}

dpl_status dpl_guess_slope(dpl_context *context, const dpl_survey_task *t, double *slope) {
    points p = {.survey = t};
    double squares = 0.0;
    DPL_TRY(dpl_jobs_run(context, look_at_points, POINTS * POINTS, 4, &p));
    for (int32_t i = 0; i < POINTS * POINTS; i++)
        if (p.is_open[i]) {
            for (int c = 0; c < 3; c++)
                squares += p.squares[i][c];
            t->counters[0].rays += POINT_RAYS;
        }
    *slope = sqrt(squares / (POINTS * POINTS));
    return DPL_OK;
}
