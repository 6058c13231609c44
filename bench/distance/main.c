/* bench_distance: the exact distance transform on pictures of every kind, by every instruction set, one
 * thread. Run by hand as docs/benchmarks.md says, by bench/peers/distance.py, and in small by ctest. */
#include "../../image/file.h"
#include "../common/clock.h"
#include "../common/folder.h"
#include "../common/machine.h"
#include "../common/options.h"
#include "../common/progress.h"
#include "../common/summary.h"
#include "pictures.h"

#include <stdlib.h>
#include <string.h>

static const char program[] = "bench_distance";

static const char help[] =
    "Usage: bench_distance [OPTIONS]\n"
    "\n"
    "Times dpl_field_read_distance() on fields that have just been drawn: the exact distance transform,\n"
    "and a copy of its result. Writes NAME.csv and NAME.md.\n"
    "\n"
    "  --smallest PX    first size (default 512)\n"
    "  --largest PX     last size, four times as wide each (default 2048)\n"
    "  --rounds N       samples of each, the instruction sets in turns (default 40)\n"
    "  --pictures       also writes PICTURE-PX.u8, the walls (0 or 255), and PICTURE-PX.f32, the distances\n"
    "  --name NAME      of the results (default distance)\n"
    "  --out DIR        where results go (default bench/results/MACHINE)\n"
    "  --help           print this text\n";

static const dpl_isa isas[] = {DPL_ISA_SCALAR, DPL_ISA_SSE2, DPL_ISA_AVX2, DPL_ISA_AVX512};
enum { ISAS = sizeof isas / sizeof isas[0], MOST_ROUNDS = 1000, MOST_ROWS = 256 };

typedef struct settings {
    int32_t smallest, largest, rounds;
    bool pictures;
    const char *name;
    const char *out;
} settings;

/* One instruction set at work. */
typedef struct runner {
    dpl_isa isa;
    dpl_context *context;
    dpl_field *field;
    double ms[MOST_ROUNDS];
} runner;

/* One picture at one size. */
typedef struct rig {
    const dpl_bench_walls *walls;
    int32_t size;
    uint8_t *opacity; /* [size][size] */
    float *distance;  /* [size][size] */
    runner runners[ISAS];
} rig;

typedef struct row {
    const dpl_bench_walls *walls;
    int32_t size;
    dpl_isa isa;
    dpl_bench_summary ms;
} row;

typedef struct findings {
    row rows[MOST_ROWS];
    int32_t count;
} findings;

/* ---- timing --------------------------------------------------------------------------------------- */

static bool rig_make(rig *r, dpl_error *error) {
    size_t pixels = (size_t)r->size * (size_t)r->size;
    r->opacity = malloc(pixels);
    r->distance = malloc(pixels * sizeof *r->distance);
    if (!r->opacity || !r->distance)
        return dpl_error_set(error, "%s", dpl_status_text(DPL_ERROR_MEMORY));
    for (int i = 0; i < ISAS; i++) {
        dpl_context_desc desc = dpl_context_desc_default();
        dpl_field_desc size = dpl_field_desc_default();
        runner *run = &r->runners[i];
        if (!(dpl_isa_available() & (uint32_t)isas[i]))
            continue;
        run->isa = isas[i];
        desc.thread_count = 1;
        desc.isa_mask = (uint32_t)isas[i];
        size.width = size.height = r->size;
        dpl_status status = dpl_context_create(&desc, &run->context);
        if (status == DPL_OK)
            status = dpl_field_create(run->context, &size, &run->field);
        if (status != DPL_OK)
            return dpl_error_set(error, "%s", dpl_status_text(status));
    }
    return r->walls->draw(r->size, r->opacity, error);
}

static void rig_free(rig *r) {
    for (int i = 0; i < ISAS; i++) {
        dpl_field_destroy(r->runners[i].field);
        dpl_context_destroy(r->runners[i].context);
    }
    free(r->opacity);
    free(r->distance);
}

static bool sample(rig *r, runner *run, int32_t round, dpl_error *error) {
    dpl_layer layer = dpl_layer_default();
    layer.extinction = (dpl_pixels){
        .data = r->opacity, .format = DPL_FORMAT_UNORM8, .width = r->size, .height = r->size, .channels = 1};
    dpl_status status = dpl_field_draw_layer(run->field, &layer);
    dpl_bench_time start = dpl_bench_now();
    if (status == DPL_OK)
        status = dpl_field_read_distance(run->field, r->distance, 0);
    if (round >= 0)
        run->ms[round] = dpl_bench_since(start).cpu_ms;
    return status == DPL_OK || dpl_error_set(error, "%s", dpl_context_message(run->context));
}

static bool write_plane(const rig *r, const char *ending, const void *plane, size_t element,
                        dpl_error *error) {
    char path[64];
    snprintf(path, sizeof path, "%s-%d.%s", r->walls->name, (int)r->size, ending);
    return dpl_file_write(path, plane, (size_t)r->size * (size_t)r->size * element, error);
}

static bool measure(const settings *s, rig *r, findings *f, dpl_error *error) {
    for (int32_t round = -1; round < s->rounds; round++) /* the first is not counted: planes are allocated */
        for (int i = 0; i < ISAS; i++)
            if (r->runners[i].context && !sample(r, &r->runners[i], round, error))
                return false;
    for (int i = 0; i < ISAS && f->count < MOST_ROWS; i++)
        if (r->runners[i].context)
            f->rows[f->count++] =
                (row){r->walls, r->size, r->runners[i].isa, dpl_bench_summarise(r->runners[i].ms, s->rounds)};
    return !s->pictures || (write_plane(r, "u8", r->opacity, 1, error) &&
                            write_plane(r, "f32", r->distance, sizeof(float), error));
}

static bool measure_all(const settings *s, findings *f, dpl_error *error) {
    static rig r; /* large */
    int32_t count;
    bool good = true;
    const dpl_bench_walls *walls = dpl_bench_walls_all(&count);
    for (int32_t size = s->smallest; size <= s->largest && good; size *= 4)
        for (int32_t i = 0; i < count && good; i++) {
            dpl_bench_progress("%d px, %s", (int)size, walls[i].name);
            r = (rig){.walls = &walls[i], .size = size};
            good = rig_make(&r, error) && measure(s, &r, f, error);
            rig_free(&r);
        }
    dpl_bench_progress_end();
    return good;
}

/* ---- reports -------------------------------------------------------------------------------------- */

static bool write_csv(const char *path, const findings *f, dpl_error *error) {
    dpl_file_writer writer;
    if (!dpl_file_writer_open(&writer, path, error))
        return false;
    fputs("picture,size,isa,cpu_ms_min,cpu_ms_median\n", writer.stream);
    for (int32_t i = 0; i < f->count; i++) {
        const row *r = &f->rows[i];
        fprintf(writer.stream, "%s,%d,%s,%.4f,%.4f\n", r->walls->name, (int)r->size, dpl_isa_name(r->isa),
                r->ms.min, r->ms.median);
    }
    return dpl_file_writer_close(&writer, true, error);
}

/* A line of rows of one picture and size; returns the first row behind them. */
static int32_t write_line(FILE *stream, const findings *f, int32_t i) {
    const row *first = &f->rows[i];
    fprintf(stream, "| %s | %d |", first->walls->name, (int)first->size);
    for (int k = 0; k < ISAS; k++) {
        const row *r = &f->rows[i];
        if (i < f->count && r->walls == first->walls && r->size == first->size && r->isa == isas[k]) {
            fprintf(stream, " %.2f (%.2f) |", r->ms.min, r->ms.median);
            i++;
        } else
            fputs(" - |", stream);
    }
    fputs("\n", stream);
    return i;
}

static bool write_table(const settings *s, const char *path, const dpl_bench_machine *machine,
                        const findings *f, dpl_error *error) {
    dpl_file_writer writer;
    dpl_context *context = NULL; /* to name the kernels that are picked here */
    int32_t count;
    const dpl_bench_walls *walls = dpl_bench_walls_all(&count);
    if (dpl_context_create(NULL, &context) != DPL_OK)
        return dpl_error_set(error, "no context");
    if (!dpl_file_writer_open(&writer, path, error)) {
        dpl_context_destroy(context);
        return false;
    }
    fprintf(writer.stream,
            "# The exact distance transform\n\n- command: `%s --smallest %d --largest %d --rounds %d --name "
            "%s`\n",
            program, (int)s->smallest, (int)s->largest, (int)s->rounds, s->name);
    dpl_bench_machine_write(machine, context, writer.stream);
    dpl_context_destroy(context);
    for (int32_t i = 0; i < count; i++)
        fprintf(writer.stream, "- %s: %s\n", walls[i].name, walls[i].about);
    fputs("\nTransform and a copy of its result, one thread; processor time [ms], least (median).\n\n"
          "| walls | px | scalar | SSE2 | AVX2 | AVX-512 |\n|---|---|---|---|---|---|\n",
          writer.stream);
    for (int32_t i = 0; i < f->count;)
        i = write_line(writer.stream, f, i);
    return dpl_file_writer_close(&writer, true, error);
}

int main(int argc, char **argv) {
    settings s = {.smallest = 512, .largest = 2048, .rounds = 40, .name = "distance"};
    const dpl_bench_option options[] = {
        {"smallest", DPL_BENCH_INTEGER, &s.smallest, 1, DPL_MAX_SIZE},
        {"largest", DPL_BENCH_INTEGER, &s.largest, 1, DPL_MAX_SIZE},
        {"rounds", DPL_BENCH_INTEGER, &s.rounds, 1, MOST_ROUNDS},
        {"pictures", DPL_BENCH_FLAG, &s.pictures, 0, 0},
        {"name", DPL_BENCH_TEXT, &s.name, 0, 0},
        {"out", DPL_BENCH_TEXT, &s.out, 0, 0},
    };
    static findings f;
    dpl_bench_machine machine = dpl_bench_machine_read();
    dpl_error error = {""};
    char folder[256], csv[128], table[128];
    int status =
        dpl_bench_options_read(program, help, options, (int)(sizeof options / sizeof options[0]), argc, argv);
    if (status != DPL_BENCH_GO)
        return status;
    snprintf(folder, sizeof folder, "bench/results/%s", machine.slug);
    snprintf(csv, sizeof csv, "%s.csv", s.name);
    snprintf(table, sizeof table, "%s.md", s.name);
    if (dpl_bench_folder_enter(s.out ? s.out : folder, &error) && measure_all(&s, &f, &error) &&
        write_csv(csv, &f, &error) && write_table(&s, table, &machine, &f, &error))
        return DPL_BENCH_DONE;
    fprintf(stderr, "%s: %s\n", program, error.text);
    return DPL_BENCH_FAILED;
}
