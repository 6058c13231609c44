/* A render's statistics as JSON. */
#include "stats.h"

#include "json.h"

static json_t *rays_json(const dpl_solver_stats *counts) {
    double full = (double)counts->rays_full;
    double reduction = counts->rays_full > 0 ? 1 - (double)counts->rays_traced / full : 0;
    return json_pack("{s:I, s:I, s:f}", "full", (json_int_t)counts->rays_full, "traced",
                     (json_int_t)counts->rays_traced, "reduction", reduction);
}

/* What ray skipping measured and chose; null where it did not look. */
static json_t *signals_json(const dpl_skip_report *skip) {
    const dpl_signals *s = &skip->signals;
    if (!skip->measured)
        return json_null();
    return json_pack("{s:s, s:f, s:f, s:f, s:f, s:f, s:f, s:I}", "chosen", dpl_skip_mode_name(skip->mode),
                     "score", s->score, "mean", s->mean, "stddev", s->stddev, "non_zero", s->non_zero,
                     "peak_to_average", s->peak_to_average, "bandwidth90", s->bandwidth90, "rays",
                     (json_int_t)skip->signal_rays);
}

/* What bounded skipping guessed and checked; null in other modes. */
static json_t *guesses_json(const dpl_skip_report *skip) {
    if (skip->mode != DPL_SKIP_BOUNDED)
        return json_null();
    return json_pack("{s:I, s:I, s:I}", "rays", (json_int_t)skip->guessed, "checked",
                     (json_int_t)skip->checked, "wrong", (json_int_t)skip->wrong);
}

static json_t *level_json(int32_t index, const dpl_level_stats *level) {
    return json_pack("{s:i, s:I, s:i, s:I, s:I}", "level", (int)index, "probes", (json_int_t)level->probes,
                     "directions", (int)level->directions, "full", (json_int_t)level->full, "traced",
                     (json_int_t)level->traced);
}

static json_t *levels_json(const dpl_solver_stats *counts) {
    json_t *levels = json_array();
    for (int32_t i = 0; i < counts->level_count; i++)
        levels = dpl_json_append(levels, level_json(i, &counts->levels[i]));
    return levels;
}

static json_t *times_json(const dpl_render_stats *stats) {
    return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o}", "read", dpl_json_ms(stats->read_ms), "field",
                     dpl_json_ms(stats->field_ms), "solve", dpl_json_ms(stats->solve_ms), "lights",
                     dpl_json_ms(stats->lights_ms), "write", dpl_json_ms(stats->write_ms), "total",
                     dpl_json_ms(stats->total_ms));
}

char *dpl_render_stats_text(const dpl_render_stats *stats, dpl_error *error) {
    /* json_pack takes each "o" even when it fails, and fails when one of them is NULL. */
    return dpl_json_text(
        json_pack("{s:s, s:s?, s:s?, s:s?, s:s, s:o, s:o, s:i, s:s?, s:[i,i], s:i, s:s, s:I, s:o, s:o, s:o}",
                  "solver", stats->solver, "merge", stats->merge, "storage", stats->storage, "resolution",
                  stats->resolution, "skip", stats->skip, "signals", signals_json(&stats->counts.skip),
                  "guesses", guesses_json(&stats->counts.skip), "lights", (int)stats->lights, "shadow",
                  stats->shadow, "size", (int)stats->width, (int)stats->height, "threads",
                  (int)stats->threads, "isa", stats->isa, "memory_bytes",
                  (json_int_t)stats->counts.memory_bytes, "ms", times_json(stats), "rays",
                  rays_json(&stats->counts), "levels", levels_json(&stats->counts)),
        error);
}
