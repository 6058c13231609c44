/* One scene, from its shapes to its numbers. */
#include "scene_run.h"

#include "../clock.h"
#include "../interrupt.h"
#include "../report.h"
#include "picture_error.h"

#include "scenes/families.h"

#include <dapple/tonemap.h>
#include <math.h>
#include <string.h>

#define TRY(call)                                                                                            \
    do {                                                                                                     \
        dpl_status status_ = (call);                                                                         \
        if (status_ != DPL_OK)                                                                               \
            return status_;                                                                                  \
    } while (0)

static size_t pixel_count(const dpl_study_stage *stage) {
    return (size_t)stage->plan->size * (size_t)stage->plan->size;
}

static dpl_status solve(dpl_study_stage *stage, dpl_study_profile profile, dpl_solver *solver, float *picture,
                        dpl_solver_stats *stats) {
    const int32_t size = stage->plan->size;
    const dpl_output output = {.data = picture, .width = size, .height = size, .channels = 3};
    dpl_study_pace_solve(&stage->pace);
    TRY(dpl_solver_solve(solver, stage->fields[profile], &output));
    dpl_solver_read_stats(solver, stats);
    dpl_study_pace_next(&stage->pace);
    return DPL_OK;
}

static dpl_status tonemap(dpl_study_stage *stage, const float *picture, uint8_t *display) {
    const int32_t size = stage->plan->size;
    const dpl_pixels pixels = {
        .data = picture, .format = DPL_FORMAT_F32, .width = size, .height = size, .channels = 3};
    return dpl_tonemap(stage->context, &pixels, display, 0);
}

static dpl_status compare_with_off(dpl_study_stage *stage, dpl_study_mode_record *record) {
    const size_t pixels = pixel_count(stage);
    TRY(tonemap(stage, stage->test, stage->test_display));
    const dpl_study_linear_error error =
        dpl_study_compare_linear(stage->test, stage->off, stage->opaque, pixels);
    record->display_off = dpl_study_psnr_display(stage->test_display, stage->off_display, 3 * pixels);
    record->linear_off = dpl_study_psnr_linear(&error, dpl_study_peak(stage->off, 3 * pixels));
    return DPL_OK;
}

static dpl_status compare_with_truth(dpl_study_stage *stage, const float *picture,
                                     dpl_study_mode_record *record) {
    const dpl_study_truth *truth = &stage->truth;
    const size_t count = (size_t)truth->count;
    dpl_study_truth_gather(truth, picture, stage->plan->size, stage->sampled);
    TRY(dpl_study_tonemap_values(stage->context, (const float(*)[3])stage->sampled, truth->count,
                                 stage->sampled_display));
    const dpl_study_linear_error error =
        dpl_study_compare_linear(stage->sampled[0], truth->rgb[0], NULL, count);
    record->display_truth = dpl_study_psnr_display(stage->sampled_display, truth->display, 3 * count);
    record->linear_truth = dpl_study_psnr_linear(&error, 1.0);
    record->rel_rmse_truth = dpl_study_rel_rmse(&error);
    return DPL_OK;
}

static void record_counts(const dpl_solver_stats *stats, dpl_study_mode_record *record) {
    record->used = (int32_t)stats->skip.mode;
    record->full = stats->rays_full;
    record->traced = stats->rays_traced;
    record->signal_rays = stats->skip.signal_rays;
    record->dropped = record->same = -1;
    record->ms = stats->solve_ms;
}

/* The same mode without its dead rays: the picture must not change by a bit. */
static dpl_status run_dropped(dpl_study_stage *stage, dpl_study_profile profile, dpl_skip_mode mode,
                              const float *picture, dpl_study_mode_record *record) {
    dpl_solver_stats stats;
    if (!dpl_study_has_dropped(profile))
        return DPL_OK;
    TRY(solve(stage, profile, stage->solvers[profile][mode][1], stage->dropped, &stats));
    record->dropped = stats.rays_traced;
    record->dropped_ms = stats.solve_ms;
    record->same = memcmp(picture, stage->dropped, pixel_count(stage) * 3 * sizeof(float)) == 0;
    return DPL_OK;
}

static dpl_status run_off(dpl_study_stage *stage, dpl_study_profile profile,
                          dpl_study_profile_record *record) {
    dpl_study_mode_record *off = &record->modes[DPL_SKIP_OFF];
    dpl_solver_stats stats;
    TRY(solve(stage, profile, stage->solvers[profile][DPL_SKIP_OFF][0], stage->off, &stats));
    TRY(tonemap(stage, stage->off, stage->off_display));
    record_counts(&stats, off);
    record->levels = stats.level_count;
    record->signals = stats.skip.signals;
    off->display_off = off->linear_off = (double)INFINITY;
    TRY(compare_with_truth(stage, stage->off, off));
    return run_dropped(stage, profile, DPL_SKIP_OFF, stage->off, off);
}

static dpl_status run_mode(dpl_study_stage *stage, dpl_study_profile profile, dpl_skip_mode mode,
                           dpl_study_profile_record *profile_record) {
    dpl_study_mode_record *record = &profile_record->modes[mode];
    dpl_solver_stats stats;
    TRY(solve(stage, profile, stage->solvers[profile][mode][0], stage->test, &stats));
    record_counts(&stats, record);
    if (mode == DPL_SKIP_AUTO)
        profile_record->auto_signals = stats.skip.signals;
    TRY(compare_with_off(stage, record));
    TRY(compare_with_truth(stage, stage->test, record));
    return run_dropped(stage, profile, mode, stage->test, record);
}

static dpl_status run_profiles(dpl_study_stage *stage, dpl_study_scene_record *record) {
    for (int p = 0; p < DPL_STUDY_PROFILES; p++) {
        const dpl_study_profile profile = (dpl_study_profile)p;
        TRY(run_off(stage, profile, &record->profiles[p]));
        for (int m = DPL_SKIP_OFF + 1; m < DPL_STUDY_MODES; m++)
            TRY(run_mode(stage, profile, (dpl_skip_mode)m, &record->profiles[p]));
    }
    return DPL_OK;
}

/* The truth and the mask of free pixels belong to the pixel world, the corrected profile's field. */
static dpl_status run_truth(dpl_study_stage *stage, dpl_study_scene_record *record) {
    dpl_field *world = stage->fields[DPL_STUDY_CORRECTED];
    const double start = dpl_tool_clock_ms();
    dpl_study_pace_truth(&stage->pace);
    TRY(dpl_field_read_opaque(world, stage->opaque, 0));
    TRY(dpl_study_truth_trace(&stage->truth, stage->context, world, stage->opaque, stage->plan->size,
                              record->seed, record->index));
    dpl_study_pace_next(&stage->pace);
    record->truth_pixels = stage->truth.count;
    record->truth_ms = dpl_tool_clock_ms() - start;
    return DPL_OK;
}

static bool draw(dpl_study_stage *stage, dpl_study_scene_record *record, dpl_error *error) {
    const double start = dpl_tool_clock_ms();
    dpl_scene scene = {0};
    if (!dpl_scene_family_find("arc")->make(record->seed, record->index, stage->plan->size, &scene, error))
        return false;
    bool good = true;
    for (int p = 0; p < DPL_STUDY_PROFILES && good; p++)
        good = dpl_scene_draw(&scene, stage->context, stage->fields[p], error);
    dpl_scene_free(&scene);
    record->draw_ms = dpl_tool_clock_ms() - start;
    return good;
}

int dpl_study_scene_run(dpl_study_stage *stage, uint64_t seed, int32_t index,
                        dpl_study_scene_record *record) {
    dpl_error error;
    const double start = dpl_tool_clock_ms();
    memset(record, 0, sizeof *record);
    record->seed = seed;
    record->index = index;
    record->threads = dpl_context_thread_count(stage->context);
    dpl_scene_arc_configuration(index, &record->lights, &record->occluders);
    if (!draw(stage, record, &error))
        return dpl_report_failure("%s", error.text);
    dpl_status status = run_truth(stage, record);
    if (status == DPL_OK)
        status = run_profiles(stage, record);
    record->total_ms = dpl_tool_clock_ms() - start;
    if (dpl_interrupt_status())
        return dpl_interrupt_status();
    return status == DPL_OK ? DPL_EXIT_DONE : dpl_report_status(stage->context, status);
}
