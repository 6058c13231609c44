/* Prints the times of all solves, and a summary with the machine. */
#define _POSIX_C_SOURCE 200809L
#include "times.h"

#include "folder_file.h"

#include <dapple/version.h>
#include <inttypes.h>
#include <string.h>
#include <sys/utsname.h>
#include <unistd.h>

typedef struct time_report {
    const dpl_study_results *results;
    dpl_isa isa;
} time_report;

static void print_scene(FILE *stream, const dpl_study_scene_record *scene) {
    char head[64];
    snprintf(head, sizeof head, "%" PRIu64 ",%d,%d", scene->seed, (int)scene->index, (int)scene->threads);
    fprintf(stream, "%s,draw,,,%.3f\n", head, scene->draw_ms);
    fprintf(stream, "%s,truth,,,%.3f\n", head, scene->truth_ms);
    for (int p = 0; p < DPL_STUDY_PROFILES; p++)
        for (int m = 0; m < DPL_STUDY_MODES; m++) {
            const dpl_study_mode_record *mode = &scene->profiles[p].modes[m];
            const char *profile = dpl_study_profile_name((dpl_study_profile)p);
            const char *name = dpl_skip_mode_name((dpl_skip_mode)m);
            fprintf(stream, "%s,solve,%s,%s,%.3f\n", head, profile, name, mode->ms);
            if (mode->dropped >= 0)
                fprintf(stream, "%s,solve_dead_dropped,%s,%s,%.3f\n", head, profile, name, mode->dropped_ms);
        }
    fprintf(stream, "%s,total,,,%.3f\n", head, scene->total_ms);
}

static void print_table(FILE *stream, const void *user) {
    const dpl_study_results *results = ((const time_report *)user)->results;
    fputs("seed,scene,threads,what,profile,mode,ms\n", stream);
    for (int32_t i = 0; i < dpl_study_scene_count(results->plan); i++)
        print_scene(stream, &results->records[i]);
}

/* The processor's name where the system tells it, else "". */
static void read_processor(char *name, size_t size) {
    char line[256];
    FILE *stream = fopen("/proc/cpuinfo", "r");
    name[0] = 0;
    if (!stream)
        return;
    while (!name[0] && fgets(line, sizeof line, stream)) {
        const char *colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) == 0 && colon)
            snprintf(name, size, "%.*s", (int)strcspn(colon + 2, "\n"), colon + 2);
    }
    fclose(stream);
}

static void print_machine(FILE *stream, const time_report *report) {
    struct utsname system;
    char processor[128];
    const dpl_study_results *results = report->results;
    const int32_t scenes = dpl_study_scene_count(results->plan);
    double total = 0;
    read_processor(processor, sizeof processor);
    for (int32_t i = 0; i < scenes; i++)
        total += results->records[i].total_ms;
    fprintf(stream, "# Times of the study\n\n- processor: %s, %ld of them\n",
            processor[0] ? processor : "unknown", sysconf(_SC_NPROCESSORS_ONLN));
    if (uname(&system) >= 0)
        fprintf(stream, "- system: %s %s %s\n", system.sysname, system.release, system.machine);
    fprintf(stream, "- dapple %s, instruction set %s, %s\n", dpl_version(), dpl_isa_name(report->isa),
            DPL_BUILD_TYPE);
    fprintf(stream, "- threads: %d (of the last scene; times.csv has those of each)\n",
            (int)results->records[scenes - 1].threads);
    fprintf(stream, "- scenes: %d of %d x %d pixels, in %.1f s altogether\n", (int)scenes,
            (int)results->plan->size, (int)results->plan->size, total / 1e3);
    fputs("\nWall times, means over scenes. They are of this machine and whatever else it was doing.\n\n",
          stream);
}

/* A frame with nothing skipped and nothing measured. */
static double frame_ms(const dpl_study_mode_record *off) {
    return off->dropped >= 0 ? off->dropped_ms : off->ms;
}

static void print_mode(FILE *stream, const dpl_study_results *results, int profile, int mode, double off) {
    const int32_t scenes = dpl_study_scene_count(results->plan);
    double ms = 0, dropped = 0;
    for (int32_t i = 0; i < scenes; i++) {
        ms += results->records[i].profiles[profile].modes[mode].ms / scenes;
        dropped += results->records[i].profiles[profile].modes[mode].dropped_ms / scenes;
    }
    fprintf(stream, "| %s | %s | %.1f | %.2f |", dpl_study_profile_name((dpl_study_profile)profile),
            dpl_skip_mode_name((dpl_skip_mode)mode), ms, ms / off);
    if (dpl_study_has_dropped((dpl_study_profile)profile))
        fprintf(stream, " %.1f | %.2f |\n", dropped, dropped / off);
    else
        fputs(" | |\n", stream);
}

static void print_summary(FILE *stream, const void *user) {
    const time_report *report = user;
    const dpl_study_results *results = report->results;
    const int32_t scenes = dpl_study_scene_count(results->plan);
    print_machine(stream, report);
    fputs("| profile | mode | ms | of off | dead rays dropped, ms | of off |\n|---|---|---|---|---|---|\n",
          stream);
    for (int p = 0; p < DPL_STUDY_PROFILES; p++) {
        double off = 0;
        for (int32_t i = 0; i < scenes; i++)
            off += frame_ms(&results->records[i].profiles[p].modes[DPL_SKIP_OFF]) / scenes;
        for (int m = 0; m < DPL_STUDY_MODES; m++)
            print_mode(stream, results, p, m, off);
    }
    double truth = 0;
    for (int32_t i = 0; i < scenes; i++)
        truth += results->records[i].truth_ms / scenes;
    fprintf(stream,
            "\nSignals are measured in `auto`, which picks its mode by them, and in `off`, for the "
            "correlations.\nIn the paper's profile that takes four of five levels once more, so there its "
            "`off` is timed without\nmeasuring: in the column of dead rays, of which `off` has none.\n"
            "The truth took %.1f ms a scene.\n",
            truth);
}

bool dpl_study_write_times(const dpl_study_results *results, dpl_isa isa, dpl_error *error) {
    const time_report report = {results, isa};
    const char *folder = results->plan->folder;
    return dpl_study_write_file(folder, "times.csv", print_table, &report, error) &&
           dpl_study_write_file(folder, "times.md", print_summary, &report, error);
}
