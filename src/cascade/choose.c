/* Which rays a frame leaves out: measures signals, picks the mode, sets the steps. Called by cascades.c
 * before the first level.
 *
 * The default profile looks at a grid of points all over the picture and traces their rings of directions
 * itself: a few thousand rays, of unskipped light. The paper profile does what the paper's benchmark does:
 * light all levels down to level 1 without skipping and read rings of that, at probes whose number is a
 * multiple of probes / 16. In its 128 x 128 grid those all lie on the left edge. */
#include "cascade/cascades.h"

#include <dapple/signal.h>
#include <dapple/skip.h>
#include <math.h>

/* A ring has 16 samples, each the mean of 4 rays: what level 1 stores in the paper's geometry, for which the
 * thresholds were made. */
#define RING_SAMPLES 16
#define RING_RAYS (RING_SAMPLES * DPL_BRANCHING)

#define DEFAULT_PROBES 64
#define PAPER_PROBES 16
static const double PI = 3.14159265358979323846;

/* Sums of signals over probes, to become means. */
typedef struct signal_sums {
    dpl_signals sums;
    int32_t probes;
} signal_sums;

static dpl_status add_ring(dpl_cascades *c, signal_sums *s, const double *samples, int32_t count) {
    dpl_signals ring;
    dpl_status status = dpl_signals_of_ring(samples, count, &ring);
    if (status != DPL_OK)
        return dpl_fail(c->head.context, status, "the light at a signal probe is not finite");
    s->sums.mean += ring.mean;
    s->sums.stddev += ring.stddev;
    s->sums.score += ring.score;
    s->sums.non_zero += ring.non_zero;
    s->sums.peak_to_average += ring.peak_to_average;
    s->sums.bandwidth90 += ring.bandwidth90;
    s->probes++;
    return DPL_OK;
}

static dpl_signals means_of(const signal_sums *s) {
    dpl_signals means = {.peak_to_average = 1.0, .bandwidth90 = 1.0};
    if (s->probes == 0) /* every probe stands in a wall: as dark as a black ring */
        return means;
    means.mean = s->sums.mean / s->probes;
    means.stddev = s->sums.stddev / s->probes;
    means.score = s->sums.score / s->probes;
    means.non_zero = s->sums.non_zero / s->probes;
    means.peak_to_average = s->sums.peak_to_average / s->probes;
    means.bandwidth90 = s->sums.bandwidth90 / s->probes;
    return means;
}

/* ---- default profile: trace rings all over the picture -------------------------------------------- */

/* Radiance from where level 1 begins to the end of the world, r + g + b, in RING_SAMPLES directions. */
static void trace_ring(const dpl_cascades *c, const dpl_field *field, double x, double y,
                       double samples[RING_SAMPLES]) {
    float x0[RING_RAYS], y0[RING_RAYS], x1[RING_RAYS], y1[RING_RAYS], out[6][RING_RAYS];
    double from = c->schedule.levels[0].t1, to = from + hypot(field->width, field->height);
    for (int k = 0; k < RING_RAYS; k++) {
        double angle = 2.0 * PI * (k + 0.5) / RING_RAYS, dx = cos(angle), dy = sin(angle);
        x0[k] = (float)(x + dx * from);
        y0[k] = (float)(y + dy * from);
        x1[k] = (float)(x + dx * to);
        y1[k] = (float)(y + dy * to);
    }
    dpl_grid grid = dpl_field_grid(field);
    dpl_segments segments = {RING_RAYS, x0, y0, x1, y1};
    dpl_intervals intervals = {{out[0], out[1], out[2]}, {out[3], out[4], out[5]}};
    c->head.context->kernels->march(&grid, &segments, &intervals);
    for (int k = 0; k < RING_RAYS; k++) {
        double sum = 0.0, slot = 2.0 * PI / RING_RAYS;
        float sky[3];
        dpl_field_sky_mean(field, k * slot, (k + 1) * slot, sky);
        for (int p = 0; p < 3; p++)
            sum += (double)out[p][k] + (double)out[3 + p][k] * (double)sky[p];
        samples[k / DPL_BRANCHING] =
            (k % DPL_BRANCHING ? samples[k / DPL_BRANCHING] : 0.0) + sum / DPL_BRANCHING;
    }
}

static dpl_status measure_everywhere(dpl_cascades *c, const dpl_field *field, int32_t probes,
                                     signal_sums *s) {
    int32_t columns = (int32_t)sqrt(probes), rows = probes / columns;
    for (int32_t i = 0; i < columns * rows; i++) {
        double samples[RING_SAMPLES];
        double x = (i % columns + 0.5) * field->width / columns,
               y = (i / columns + 0.5) * field->height / rows;
        if (dpl_field_is_opaque(field, (int32_t)x, (int32_t)y))
            continue;
        trace_ring(c, field, x, y, samples);
        c->head.stats.skip.signal_rays += RING_RAYS;
        DPL_TRY(add_ring(c, s, samples, RING_SAMPLES));
    }
    return DPL_OK;
}

/* ---- paper profile: read rings of level 1 of an unskipped frame ----------------------------------- */

static dpl_status measure_level_one(dpl_cascades *c, const dpl_field *field, int32_t probes, signal_sums *s) {
    if (c->schedule.level_count < 2)
        return dpl_fail(c->head.context, DPL_ERROR_ARGUMENT,
                        "the paper's signals are read from level 1: it takes two");
    for (int32_t n = 0; n < c->schedule.level_count; n++)
        c->steps[n] = 1; /* all before the first level: which rays are dead is asked of the levels below */
    for (int32_t n = c->schedule.level_count - 1; n >= 1; n--) {
        int64_t rays;
        DPL_TRY(dpl_cascades_solve_level(c, field, n, 0.0, 0.0, &rays));
        c->head.stats.skip.signal_rays += rays;
    }
    const dpl_schedule_level *plan = &c->schedule.levels[1];
    const float *radiance = dpl_cascades_radiance(c, 1);
    int32_t count = plan->probes_x * plan->probes_y;
    if (probes > count)
        probes = count;
    for (int32_t p = 0; p < probes; p++) {
        double samples[DPL_MOST_SLOTS_AT_ONE];
        int32_t probe = p * (count / probes);
        for (int32_t slot = 0; slot < plan->slots; slot++) {
            samples[slot] = 0.0;
            for (int channel = 0; channel < 3; channel++)
                samples[slot] += (double)radiance[dpl_level_row(plan, slot, channel, probe / plan->probes_x) +
                                                  (size_t)(probe % plan->probes_x)];
        }
        DPL_TRY(add_ring(c, s, samples, plan->slots));
    }
    return DPL_OK;
}

/* ---- the choice ----------------------------------------------------------------------------------- */

static dpl_status measure(dpl_cascades *c, const dpl_field *field) {
    const dpl_cascades_desc *desc = &c->head.desc.cascades;
    bool paper = desc->profile == DPL_PROFILE_PAPER;
    int32_t probes = desc->skip.signal_probes ? desc->skip.signal_probes
                     : paper                  ? PAPER_PROBES
                                              : DEFAULT_PROBES;
    signal_sums s = {0};
    DPL_TRY(paper ? measure_level_one(c, field, probes, &s) : measure_everywhere(c, field, probes, &s));
    c->head.stats.skip.signals = means_of(&s);
    c->head.stats.skip.measured = 1;
    return DPL_OK;
}

dpl_status dpl_cascades_choose(dpl_cascades *c, const dpl_field *field) {
    const dpl_skip_desc *desc = &c->head.desc.cascades.skip;
    dpl_skip_report *report = &c->head.stats.skip;
    *report = (dpl_skip_report){.mode = desc->mode};
    if (desc->measure || desc->mode == DPL_SKIP_AUTO)
        DPL_TRY(measure(c, field));
    if (desc->mode == DPL_SKIP_AUTO)
        report->mode = dpl_skip_choose(report->signals.score, desc->thresholds);
    if (desc->mode == DPL_SKIP_CUSTOM)
        report->rule = desc->custom;
    else if (desc->mode != DPL_SKIP_EXACT && desc->mode != DPL_SKIP_BOUNDED)
        DPL_TRY(dpl_skip_rule_of(report->mode, &report->rule));
    for (int32_t n = 0; n < c->schedule.level_count; n++)
        c->steps[n] = dpl_skip_factor(report->rule, n);
    return DPL_OK;
}
