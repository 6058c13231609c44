/* Prints rows and tables. */
#include "report.h"

#include "../../image/file.h"

#include <inttypes.h>

#define MEBIBYTE 1048576.0

bool dpl_bench_choosing_write_csv(const char *path, const dpl_bench_choosing_results *r, dpl_error *error) {
    dpl_file_writer writer;
    if (!dpl_file_writer_open(&writer, path, error))
        return false;
    fputs("family,scene,method,rel_rmse,psnr_display,scale,prepare_ms,cpu_ms_min,cpu_ms_median,cpu_ms_max,"
          "bytes\n",
          writer.stream);
    for (int32_t s = 0; s < r->scene_count; s++)
        for (int m = 0; m < DPL_BENCH_CHOOSING_METHODS; m++) {
            const dpl_bench_choosing_score *score = &r->scores[s][m];
            if (score->there)
                fprintf(writer.stream, "%s,%d,%s,%.6f,%.4f,%.6g,%.3f,%.3f,%.3f,%.3f,%" PRId64 "\n",
                        r->scenes[s].family, (int)r->scenes[s].index, dpl_bench_choosing_methods[m].name,
                        score->rel_rmse, score->psnr_display, score->scale, score->prepare_ms,
                        score->cpu_ms.min, score->cpu_ms.median, score->cpu_ms.max, score->bytes);
        }
    return dpl_file_writer_close(&writer, true, error);
}

static void write_head(FILE *stream, const dpl_bench_choosing_results *r) {
    const dpl_bench_choosing_plan *p = r->plan;
    fprintf(stream,
            "# The same scenes by every method\n\n- command: `bench_choosing --seed %" PRIu64
            " --size %d --pixels %d --directions %d --truth %d --rounds %d --threads %d`\n",
            p->seed, (int)p->size, (int)p->pixels, (int)p->directions, (int)p->truth, (int)p->rounds,
            (int)p->threads);
    dpl_bench_machine_write(r->machine, r->context, stream);
    fprintf(
        stream,
        "- error: against %d directions per pixel, at up to %d free pixels of each scene drawn by chance\n"
        "- time: processor time of one picture, summed over threads: median (min .. max); the field and its "
        "distances not\n  in it. prepare: making the method and handing the scene over, once\n"
        "- memory: what the method holds at most besides the field\n"
        "- rays: %d directions per pixel. flood fill: round, range of the picture's width; it has no unit "
        "of light, so its\n  picture is scaled by the one factor that fits the truth best (least squares): "
        "its error is what no scale mends\n"
        "- a disc light is an opaque disc that emits; shadow methods have it as their light\n",
        (int)p->truth, (int)p->pixels, (int)p->directions);
}

static void write_scene(FILE *stream, const dpl_bench_choosing_results *r, int32_t s) {
    fprintf(stream,
            "\n## %s %d: %s\n\n| method | rel_rmse | psnr_display [dB] | time [ms] | prepare [ms] | memory "
            "[MiB] |\n|---|---|---|---|---|---|\n",
            r->scenes[s].family, (int)r->scenes[s].index, r->scenes[s].what);
    for (int m = 0; m < DPL_BENCH_CHOOSING_METHODS; m++) {
        const dpl_bench_choosing_score *score = &r->scores[s][m];
        if (score->there)
            fprintf(stream, "| %s | %.4f | %.1f | %.1f (%.1f .. %.1f) | %.2f | %.2f |\n",
                    dpl_bench_choosing_methods[m].name, score->rel_rmse, score->psnr_display,
                    score->cpu_ms.median, score->cpu_ms.min, score->cpu_ms.max, score->prepare_ms,
                    (double)score->bytes / MEBIBYTE);
    }
}

bool dpl_bench_choosing_write_markdown(const char *path, const dpl_bench_choosing_results *r,
                                       dpl_error *error) {
    dpl_file_writer writer;
    if (!dpl_file_writer_open(&writer, path, error))
        return false;
    write_head(writer.stream, r);
    for (int32_t s = 0; s < r->scene_count; s++)
        write_scene(writer.stream, r, s);
    return dpl_file_writer_close(&writer, true, error);
}
