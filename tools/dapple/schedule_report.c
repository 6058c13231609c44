/* Prints cascade schedules. */
#include "schedule_report.h"

#include "json.h"
#include "report.h"

#include <dapple/solver.h>
#include <stdio.h>

static int64_t total_bytes(const dpl_schedule *schedule) {
    int64_t bytes = 0;
    for (int32_t i = 0; i < schedule->level_count; i++)
        bytes += schedule->levels[i].bytes;
    return bytes;
}

static json_t *level_json(int32_t index, const dpl_schedule_level *level) {
    return json_pack("{s:i, s:[i,i], s:f, s:i, s:i, s:[f,f], s:i, s:I, s:I}", "level", (int)index, "probes",
                     (int)level->probes_x, (int)level->probes_y, "spacing", level->spacing, "directions",
                     (int)level->directions, "stored", (int)level->slots, "interval", level->t0, level->t1,
                     "aims", (int)level->aims, "rays", (json_int_t)level->rays, "bytes",
                     (json_int_t)level->bytes);
}

static json_t *levels_json(const dpl_schedule *schedule) {
    json_t *levels = json_array();
    for (int32_t i = 0; levels && i < schedule->level_count; i++) {
        json_t *level = level_json(i, &schedule->levels[i]);
        if (!level || json_array_append_new(levels, level) != 0) {
            json_decref(levels);
            return NULL;
        }
    }
    return levels;
}

static int print_json(const dpl_schedule *schedule) {
    return dpl_json_print(json_pack("{s:[i,i], s:s, s:I, s:I, s:o}", "size", (int)schedule->width,
                                    (int)schedule->height, "merge", dpl_merge_name(schedule->merge), "rays",
                                    (json_int_t)schedule->rays, "bytes", (json_int_t)total_bytes(schedule),
                                    "levels", levels_json(schedule)));
}

static int print_table(const dpl_schedule *schedule) {
    printf("%dx%d px, %s\n\n", (int)schedule->width, (int)schedule->height, dpl_merge_name(schedule->merge));
    printf("%5s  %11s  %10s  %10s  %10s  %23s  %14s  %14s\n", "level", "probes", "spacing/px", "directions",
           "stored", "interval/px", "rays", "bytes");
    for (int32_t i = 0; i < schedule->level_count; i++) {
        const dpl_schedule_level *level = &schedule->levels[i];
        char probes[32];
        char interval[64];
        snprintf(probes, sizeof probes, "%dx%d", (int)level->probes_x, (int)level->probes_y);
        snprintf(interval, sizeof interval, "%.8g .. %.8g", level->t0, level->t1);
        printf("%5d  %11s  %10.8g  %10d  %10d  %23s  %14lld  %14lld\n", (int)i, probes, level->spacing,
               (int)level->directions, (int)level->slots, interval, (long long)level->rays,
               (long long)level->bytes);
    }
    printf("%5s  %11s  %10s  %10s  %10s  %23s  %14lld  %14lld\n", "total", "", "", "", "", "",
           (long long)schedule->rays, (long long)total_bytes(schedule));
    return DPL_EXIT_DONE;
}

int dpl_schedule_report(const dpl_cascades_desc *desc, int32_t width, int32_t height, bool json) {
    dpl_schedule schedule;
    dpl_status status = dpl_schedule_compute(desc, width, height, &schedule);
    if (status != DPL_OK)
        return dpl_report_failure("the schedule of %dx%d px: %s", (int)width, (int)height,
                                  dpl_status_text(status));
    return json ? print_json(&schedule) : print_table(&schedule);
}
