/* CSV, and Markdown with the fitted growth. Called by main.c at the end of a run. */
#include "report.h"

#include "../../image/file.h"
#include "../common/fit.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

bool dpl_bench_flood_write_csv(const char *path, const dpl_bench_flood_table *table, dpl_error *error) {
    dpl_file_writer writer;
    if (!dpl_file_writer_open(&writer, path, error))
        return false;
    fputs("what,falloff,width,height,depth,blocks_percent,unit,min,median,max,visits,pushes\n",
          writer.stream);
    for (int32_t i = 0; i < table->count; i++) {
        const dpl_bench_flood_row *r = &table->rows[i];
        fprintf(writer.stream, "%s,%s,%d,%d,%d,%d,%s,%.4f,%.4f,%.4f,%" PRId64 ",%" PRId64 "\n", r->what,
                dpl_flood_falloff_name(r->falloff), (int)r->size[0], (int)r->size[1], (int)r->size[2],
                (int)r->blocks, r->unit, r->value.min, r->value.median, r->value.max, r->visits, r->pushes);
    }
    return dpl_file_writer_close(&writer, true, error);
}

/* ---- growth --------------------------------------------------------------------------------------- */

static bool is_point(const dpl_bench_flood_row *r, int32_t largest) {
    return strcmp(r->what, "solve") == 0 && r->falloff == DPL_FLOOD_SUBTRACTIVE && r->blocks == 0 &&
           r->size[0] <= largest;
}

/* How log(time) grows with log(cells), from the least time of each size up to `largest`. */
static void write_growth(FILE *stream, const dpl_bench_flood_table *table, int32_t largest) {
    double x[DPL_BENCH_FLOOD_ROWS], y[DPL_BENCH_FLOOD_ROWS];
    int32_t points = 0;
    for (int32_t i = 0; i < table->count; i++) {
        const dpl_bench_flood_row *r = &table->rows[i];
        if (!is_point(r, largest))
            continue;
        x[points] = log((double)r->size[0] * r->size[1]);
        y[points] = x[points] + log(r->value.min);
        points++;
    }
    if (points < 3)
        return;
    dpl_bench_fit line = dpl_bench_fit_line(x, y, points);
    fprintf(stream, "- 64^2 to %d^2: time grows as cells^**%.3f** (95 %% interval %.3f .. %.3f, %d sizes)\n",
            (int)largest, line.slope, line.slope - line.half_width, line.slope + line.half_width,
            (int)points);
}

/* ---- Markdown ------------------------------------------------------------------------------------- */

static void write_rows(FILE *stream, const dpl_bench_flood_table *table) {
    fputs("| what | falloff | world [cell] | blocks [%] | unit | median (min .. max) | visits | pushes |\n"
          "|---|---|---|---|---|---|---|---|\n",
          stream);
    for (int32_t i = 0; i < table->count; i++) {
        const dpl_bench_flood_row *r = &table->rows[i];
        fprintf(stream,
                "| %s | %s | %d x %d x %d | %d | %s | %.2f (%.2f .. %.2f) | %" PRId64 " | %" PRId64 " |\n",
                r->what, dpl_flood_falloff_name(r->falloff), (int)r->size[0], (int)r->size[1],
                (int)r->size[2], (int)r->blocks, r->unit, r->value.median, r->value.min, r->value.max,
                r->visits, r->pushes);
    }
}

bool dpl_bench_flood_write_markdown(const char *path, const dpl_bench_flood_plan *plan,
                                    const dpl_bench_machine *machine, const dpl_bench_flood_table *table,
                                    dpl_error *error) {
    dpl_file_writer writer;
    if (!dpl_file_writer_open(&writer, path, error))
        return false;
    FILE *stream = writer.stream;
    fprintf(stream, "# Tile light\n\n- command: `bench_flood --largest %d --side %d --frames %d`\n",
            (int)plan->largest, (int)plan->side, (int)plan->frames);
    dpl_bench_machine_write(machine, plan->context, stream);
    fputs(
        "- processor time of one thread; three channels; visits and pushes are those of the last sample\n"
        "- solve: one lamp in the middle lights the whole world. place, remove: a level-14 torch in an open\n"
        "  world, with its update. edit: a block placed or broken by chance, with its update, in a world "
        "with\n"
        "  sun and a torch in every 24th cell each way\n\n",
        stream);
    write_rows(stream, table);
    fputs("\n## Growth of a solve\n\nLeast times, subtractive, no blocks:\n\n", stream);
    if (plan->largest > 1024)
        write_growth(stream, table, 1024);
    write_growth(stream, table, plan->largest);
    return dpl_file_writer_close(&writer, true, error);
}
