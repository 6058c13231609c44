/* bench_tracers: rays against geometry, naively, through our hierarchy and through Embree's. Run by hand as
 * docs/benchmarks.md says, and in small by ctest. */
#include "../common/folder.h"
#include "../common/options.h"
#include "flat.h"
#include "frame.h"
#include "report.h"
#include "solid.h"

#include <stdio.h>
#include <string.h>

static const char program[] = "bench_tracers";

static const char help[] =
    "Usage: bench_tracers [OPTIONS]\n"
    "\n"
    "Times rays against shapes of the plane, naively and through the hierarchy, from 1 shape to many, and\n"
    "fits how that grows; against triangles in space beside Embree, if that was built in; and pictures in\n"
    "which few of many shapes move. Writes tracers.csv and tracers.md. Fails when counters of two runs\n"
    "differ, when kept static hits change a picture, or when answers are not Embree's.\n"
    "\n"
    "  --largest N       shapes in the plane, from 1 on (default 100000)\n"
    "  --rays N          in the plane, fewer for naive tracing (default 20000)\n"
    "  --solid-rays N    in space, of each kind (default 100000)\n"
    "  --rounds N        measured (default 9)\n"
    "  --small           leave the larger mesh out\n"
    "  --no-embree       leave Embree out\n"
    "  --out DIR         where results go (default bench/results/MACHINE)\n"
    "  --help            print this text\n";

typedef struct settings {
    int32_t largest;
    int32_t rays;
    int32_t solid_rays;
    int32_t rounds;
    bool small;
    bool no_embree;
    const char *out; /* NULL: by machine */
} settings;

static int read_settings(int argc, char **argv, settings *s) {
    const dpl_bench_option options[] = {
        {"largest", DPL_BENCH_INTEGER, &s->largest, 1, 1000000},
        {"rays", DPL_BENCH_INTEGER, &s->rays, 1, 10000000},
        {"solid-rays", DPL_BENCH_INTEGER, &s->solid_rays, 1, 10000000},
        {"rounds", DPL_BENCH_INTEGER, &s->rounds, 1, DPL_BENCH_MAX_ROUNDS},
        {"small", DPL_BENCH_FLAG, &s->small, 0, 0},
        {"no-embree", DPL_BENCH_FLAG, &s->no_embree, 0, 0},
        {"out", DPL_BENCH_TEXT, &s->out, 0, 0},
    };
    return dpl_bench_options_read(program, help, options, (int)(sizeof options / sizeof options[0]), argc,
                                  argv);
}

static bool check_agreement(const dpl_bench_agreement *a, dpl_error *error) {
    if ((double)a->different <= DPL_BENCH_DIFFERENT_SHARE * (double)a->rays)
        return true;
    return dpl_error_set(error, "%lld of %lld answers differ from Embree's", (long long)a->different,
                         (long long)a->rays);
}

/* All that is timed, and what it stands on. */
typedef struct benches {
    dpl_context *context;
    dpl_bench_trials trials;
    dpl_bench_flat flat;
    dpl_bench_solid solid;
    dpl_bench_frame frame;
} benches;

static bool prepare(benches *b, const settings *s, dpl_error *error) {
    dpl_context_desc desc = dpl_context_desc_default();
    desc.thread_count = 1;
    dpl_status status = dpl_context_create(&desc, &b->context);
    if (status != DPL_OK)
        return dpl_error_set(error, "%s", dpl_status_text(status));
    b->solid.context = b->frame.context = b->context;
    b->solid.ray_count = s->solid_rays;
    b->solid.embree = !s->no_embree && dpl_bench_embree_version();
    return dpl_bench_flat_prepare(&b->flat, b->context, s->largest, s->rays, s->rounds, &b->trials, error) &&
           dpl_bench_solid_prepare(&b->solid, s->small, s->rounds, &b->trials, error) &&
           dpl_bench_frame_prepare(&b->frame, &b->trials, error);
}

static bool write_all(const benches *b, const settings *s, const dpl_bench_machine *machine,
                      dpl_error *error) {
    char command[256];
    snprintf(command, sizeof command, "%s --largest %d --rays %d --solid-rays %d --rounds %d%s%s", program,
             (int)s->largest, (int)s->rays, (int)s->solid_rays, (int)s->rounds, s->small ? " --small" : "",
             s->no_embree ? " --no-embree" : "");
    dpl_bench_findings findings = {
        .command = command,
        .machine = machine,
        .context = b->context,
        .trials = &b->trials,
        .agreement = &b->solid.agreement,
        .kept_bytes = b->frame.kept_bytes,
        .rounds = s->rounds,
    };
    return dpl_bench_write_csv("tracers.csv", &findings, error) &&
           dpl_bench_write_markdown("tracers.md", &findings, error);
}

static bool run(const settings *s, const dpl_bench_machine *machine, dpl_error *error) {
    benches b = {0};
    bool good = prepare(&b, s, error) && dpl_bench_trials_run(&b.trials, s->rounds, error) &&
                check_agreement(&b.solid.agreement, error) && write_all(&b, s, machine, error);
    dpl_bench_flat_free(&b.flat);
    dpl_bench_solid_free(&b.solid);
    dpl_bench_frame_free(&b.frame);
    dpl_bench_trials_free(&b.trials);
    dpl_context_destroy(b.context);
    return good;
}

int main(int argc, char **argv) {
    settings s = {.largest = 100000, .rays = 20000, .solid_rays = 100000, .rounds = 9};
    dpl_bench_machine machine = dpl_bench_machine_read();
    dpl_error error = {""};
    char folder[256];
    int status = read_settings(argc, argv, &s);
    if (status != DPL_BENCH_GO)
        return status;
    snprintf(folder, sizeof folder, "bench/results/%s", machine.slug);
    if (dpl_bench_folder_enter(s.out ? s.out : folder, &error) && run(&s, &machine, &error))
        return DPL_BENCH_DONE;
    fprintf(stderr, "%s: %s\n", program, error.text);
    return DPL_BENCH_FAILED;
}
