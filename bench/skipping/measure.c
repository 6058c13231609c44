/* One scene under a stopwatch. Called by main.c. */
#include "measure.h"

#include "../common/clock.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What an equal picture counts as [dB]: a mean of decibels wants numbers. */
#define EQUAL_DB 120.0

typedef struct rig {
    dpl_solver *solver[DPL_BENCH_MODES];
    float *rgb[DPL_BENCH_MODES];
} rig;

static const dpl_skip_mode modes[DPL_BENCH_MODES] = {DPL_SKIP_OFF, DPL_SKIP_EXACT, DPL_SKIP_BOUNDED};

static dpl_status set_up(const dpl_bench_plan *plan, dpl_context *context, const dpl_field *field, rig *r) {
    size_t floats = 3 * (size_t)dpl_field_width(field) * (size_t)dpl_field_height(field);
    for (int m = 0; m < DPL_BENCH_MODES; m++) {
        dpl_solver_desc desc = dpl_solver_desc_default();
        desc.kind = DPL_SOLVER_CASCADES;
        desc.cascades = plan->cascades;
        desc.cascades.skip.mode = modes[m];
        dpl_status status = dpl_solver_create(context, &desc, &r->solver[m]);
        if (status != DPL_OK)
            return status;
        r->rgb[m] = malloc(floats * sizeof(float));
        if (!r->rgb[m])
            return DPL_ERROR_MEMORY;
    }
    return DPL_OK;
}

static dpl_status compare(const rig *r, dpl_context *context, const dpl_field *field, int m,
                          dpl_bench_row *row) {
    int32_t width = dpl_field_width(field), height = dpl_field_height(field);
    size_t bytes = 3 * (size_t)width * (size_t)height * sizeof(float);
    dpl_metrics_desc desc = dpl_metrics_desc_default();
    dpl_metrics metrics;
    desc.test = (dpl_pixels){r->rgb[m], DPL_FORMAT_F32, width, height, 3, 0};
    desc.reference = (dpl_pixels){r->rgb[DPL_BENCH_OFF], DPL_FORMAT_F32, width, height, 3, 0};
    dpl_status status = dpl_metrics_compare(context, &desc, &metrics);
    if (status != DPL_OK)
        return status;
    row->equal[m] = memcmp(r->rgb[m], r->rgb[DPL_BENCH_OFF], bytes) == 0;
    row->psnr_display[m] = fmin(metrics.psnr_display, EQUAL_DB);
    row->rel_rmse[m] = row->equal[m] ? 0.0 : metrics.rel_rmse;
    return DPL_OK;
}

static dpl_status solve(const rig *r, dpl_field *field, int m, int32_t frame, dpl_bench_row *row) {
    dpl_output output = {
        .data = r->rgb[m], .width = dpl_field_width(field), .height = dpl_field_height(field), .channels = 3};
    dpl_bench_time start = dpl_bench_now();
    dpl_status status = dpl_solver_solve(r->solver[m], field, &output);
    double took = dpl_bench_since(start).cpu_ms;
    if (frame <= 1 || took < row->cpu_ms[m]) /* frame 0 allocates: it does not count */
        row->cpu_ms[m] = took;
    return status;
}

static dpl_status run(const dpl_bench_plan *plan, const rig *r, dpl_context *context, dpl_field *field,
                      dpl_bench_row *row) {
    for (int32_t frame = 0; frame <= plan->frames; frame++)
        for (int m = 0; m < DPL_BENCH_MODES; m++) {
            dpl_status status = solve(r, field, m, frame, row);
            if (status != DPL_OK)
                return status;
        }
    for (int m = 0; m < DPL_BENCH_MODES; m++) {
        dpl_solver_stats stats;
        dpl_solver_read_stats(r->solver[m], &stats);
        row->saved[m] = 1.0 - (double)stats.rays_traced / (double)stats.rays_full;
        row->guessed = (double)stats.skip.guessed / (double)stats.rays_full;
        row->checked = stats.skip.checked;
        row->wrong = stats.skip.wrong;
        dpl_status status = compare(r, context, field, m, row);
        if (status != DPL_OK)
            return status;
    }
    return DPL_OK;
}

bool dpl_bench_measure(const dpl_bench_plan *plan, dpl_context *context, dpl_field *field, dpl_bench_row *row,
                       dpl_error *error) {
    rig r = {0};
    dpl_status status = set_up(plan, context, field, &r);
    if (status == DPL_OK)
        status = run(plan, &r, context, field, row);
    for (int m = 0; m < DPL_BENCH_MODES; m++) {
        dpl_solver_destroy(r.solver[m]);
        free(r.rgb[m]);
    }
    return status == DPL_OK || dpl_error_set(error, "%s", dpl_status_text(status));
}
