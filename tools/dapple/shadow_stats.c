/* What a shadow did, as JSON: the file behind `shadow --stats`. */
#include "json.h"
#include "shadow.h"

static json_t *times_json(const dpl_shadow_job *job) {
    return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o}", "read", dpl_json_ms(job->read_ms), "field",
                     dpl_json_ms(job->stats.field_ms), "map", dpl_json_ms(job->stats.map_ms), "solve",
                     dpl_json_ms(job->stats.solve_ms), "write", dpl_json_ms(job->write_ms), "total",
                     dpl_json_ms(job->total_ms));
}

static json_t *pixels_json(const dpl_shadow_stats *s) {
    return json_pack("{s:I, s:I, s:I, s:I, s:I, s:I}", "all", (json_int_t)s->pixels, "lit",
                     (json_int_t)s->lit, "dark", (json_int_t)s->dark, "worked", (json_int_t)s->worked,
                     "map_only", (json_int_t)s->map_only, "field_only", (json_int_t)s->field_only);
}

char *dpl_shadow_stats_text(const dpl_shadow_job *job, dpl_error *error) {
    const dpl_shadow_desc *desc = &job->order->shadow;
    const char *weight = desc->method == DPL_SHADOW_MRMA ? dpl_shadow_weight_name(desc->weight) : NULL;
    json_t *light = job->order->light < 0 ? json_null() : json_integer(job->order->light);
    return dpl_json_text(
        json_pack("{s:s, s:s?, s:o, s:i, s:[i,i], s:i, s:o, s:o, s:I, s:I, s:I}", "method",
                  dpl_shadow_method_name(desc->method), "weight", weight, "light", light, "lights",
                  (int)job->stats.lights, "size", (int)job->scene.width, (int)job->scene.height, "threads",
                  (int)dpl_context_thread_count(job->context), "ms", times_json(job), "pixels",
                  pixels_json(&job->stats), "steps", (json_int_t)job->stats.steps, "fetches",
                  (json_int_t)job->stats.fetches, "memory_bytes", (json_int_t)job->stats.memory_bytes),
        error);
}
