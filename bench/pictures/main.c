/* bench_pictures: one scene by every method beside the truth, and what each differs from it, eight times
 * enlarged. To be looked at: a number can be good where a picture is not. */
#include "../common/options.h"
#include "../common/progress.h"
#include "where.h"

#include "../../image/picture.h"
#include "../../scenes/families.h"

#include <dapple/dapple.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PROGRAM "bench_pictures"

static const char help[] =
    "Usage: bench_pictures [options]\n"
    "\n"
    "Lights one scene by brute force and by every method, and writes a sheet: above the pictures, the truth\n"
    "first; below each its difference from the truth after the tone map, grey where there is none. Prints\n"
    "errors, and how much of the squared error lies within 8 px of lamps, on edges (where light changes by\n"
    "5 % from a pixel to the next), and elsewhere.\n"
    "\n"
    "Options:\n"
    "  --family NAME     scene family (default arc)\n"
    "  --seed N          (default 1)\n"
    "  --index N         scene of the family (default 20)\n"
    "  --size PX         width and height (default 512)\n"
    "  --directions N    of the truth (default 1024)\n"
    "  --enlarge N       factor on differences (default 8)\n"
    "  --only METHOD     that method alone: its picture, and beside it the difference\n"
    "  --out FILE        PNG to write (default sheet.png)\n";

typedef struct sheet_options {
    const char *family;
    uint64_t seed;
    int32_t index;
    int32_t size;
    int32_t directions;
    int32_t enlarge;
    const char *only; /* NULL: every method */
    const char *out;
} sheet_options;

/* A column of the sheet. The first is the truth. */
typedef struct column {
    const char *name;
    dpl_solver_kind kind;
    dpl_cascades_desc cascades;
    dpl_holographic_desc holographic;
} column;

static const column columns[] = {
    {.name = "truth", .kind = DPL_SOLVER_REFERENCE},
    {.name = "holographic", .kind = DPL_SOLVER_HOLOGRAPHIC},
    {.name = "bilinear", .kind = DPL_SOLVER_CASCADES, .cascades = {.merge = DPL_MERGE_BILINEAR}},
    {.name = "bilinear-fix", .kind = DPL_SOLVER_CASCADES, .cascades = {.merge = DPL_MERGE_BILINEAR_FIX}},
};
enum { COLUMN_COUNT = sizeof columns / sizeof columns[0] };

typedef struct sheet {
    const sheet_options *options;
    int only; /* column of the method that is asked for; 0: all */
    dpl_context *context;
    dpl_scene scene;
    dpl_field *field;
    dpl_picture pictures[COLUMN_COUNT];
    uint8_t *display[COLUMN_COUNT]; /* tone-mapped RGB */
    uint8_t *opaque;
    uint8_t *pixels; /* of the sheet */
} sheet;

static bool check(const sheet *s, dpl_status status, dpl_error *error) {
    return status == DPL_OK || dpl_error_set(error, "%s: %s", dpl_status_text(status),
                                             s->context ? dpl_context_message(s->context) : "no context");
}

static int show_progress(double done, void *user) {
    dpl_bench_progress("%s: %.0f %%", (const char *)user, 100.0 * done);
    return 1;
}

static bool light(sheet *s, int c, dpl_error *error) {
    dpl_solver_desc desc = dpl_solver_desc_default();
    dpl_solver *solver = NULL;
    desc.kind = columns[c].kind;
    desc.cascades = columns[c].cascades;
    desc.holographic = columns[c].holographic;
    desc.reference.directions = s->options->directions;
    desc.progress = show_progress;
    desc.progress_user = (void *)(uintptr_t)columns[c].name;
    size_t bytes = (size_t)s->scene.width * (size_t)s->scene.height * 3;
    if (!dpl_picture_create(&s->pictures[c], s->scene.width, s->scene.height, 3, error))
        return false;
    s->display[c] = malloc(bytes);
    if (!s->display[c])
        return dpl_error_set(error, "out of memory");
    dpl_output output = dpl_picture_output(&s->pictures[c]);
    dpl_pixels linear = dpl_picture_pixels(&s->pictures[c]);
    bool good = check(s, dpl_solver_create(s->context, &desc, &solver), error) &&
                check(s, dpl_solver_solve(solver, s->field, &output), error) &&
                check(s, dpl_tonemap(s->context, &linear, s->display[c], 0), error);
    dpl_solver_destroy(solver);
    dpl_bench_progress_end();
    return good;
}

static bool print_where(sheet *s, int c, dpl_error *error) {
    dpl_bench_where w;
    if (!dpl_bench_find_error(&s->pictures[c], &s->pictures[0], s->opaque, &w))
        return dpl_error_set(error, "out of memory");
    printf(
        "%-14s squared error (pixels): near lamps %.0f %% (%.1f %%), on edges %.0f %% (%.1f %%), elsewhere "
        "%.0f %% (%.1f %%)\n",
        "", 100 * w.lamps.error, 100 * w.lamps.pixels, 100 * w.edges.error, 100 * w.edges.pixels,
        100 * w.elsewhere.error, 100 * w.elsewhere.pixels);
    return true;
}

static bool print_errors(sheet *s, int c, dpl_error *error) {
    dpl_metrics_desc desc = dpl_metrics_desc_default();
    dpl_metrics m;
    desc.test = dpl_picture_pixels(&s->pictures[c]);
    desc.reference = dpl_picture_pixels(&s->pictures[0]);
    desc.mask = s->opaque;
    if (!check(s, dpl_metrics_compare(s->context, &desc, &m), error))
        return false;
    printf("%-14s psnr_display %6.2f dB  rel_rmse %.4f  ssim %.4f  flip %.4f\n", columns[c].name,
           m.psnr_display, m.rel_rmse, m.ssim, m.flip);
    return print_where(s, c, error);
}

/* Grey where the two agree. */
static uint8_t enlarged_difference(uint8_t test, uint8_t truth, int32_t factor) {
    int v = 128 + factor * ((int)test - (int)truth);
    return (uint8_t)(v < 0 ? 0 : v > 255 ? 255 : v);
}

/* Two pictures into the sheet: rows of `row` bytes. */
static void paste(sheet *s, int c, uint8_t *shown, uint8_t *difference, size_t row) {
    size_t bytes = (size_t)s->scene.width * 3;
    for (size_t y = 0; y < (size_t)s->scene.height; y++) {
        const uint8_t *test = s->display[c] + y * bytes, *truth = s->display[0] + y * bytes;
        memcpy(shown + y * row, test, bytes);
        for (size_t i = 0; i < bytes; i++)
            difference[y * row + i] = enlarged_difference(test[i], truth[i], s->options->enlarge);
    }
}

/* Side by side: one method and its difference. Else all methods above, all differences below. */
static bool write_sheet(sheet *s, dpl_error *error) {
    size_t bytes = (size_t)s->scene.width * 3, height = (size_t)s->scene.height;
    if (s->options->only) {
        paste(s, s->only, s->pixels, s->pixels + bytes, 2 * bytes);
        return dpl_picture_write_png(s->options->out, 2 * s->scene.width, s->scene.height, 3, s->pixels,
                                     error);
    }
    size_t row = COLUMN_COUNT * bytes;
    for (int c = 0; c < COLUMN_COUNT; c++) {
        uint8_t *above = s->pixels + (size_t)c * bytes;
        paste(s, c, above, above + height * row, row);
    }
    return dpl_picture_write_png(s->options->out, COLUMN_COUNT * s->scene.width, 2 * s->scene.height, 3,
                                 s->pixels, error);
}

/* Is a column wanted? The truth always. */
static bool is_wanted(const sheet *s, int c) {
    return c == 0 || !s->options->only || c == s->only;
}

static bool light_all(sheet *s, dpl_error *error) {
    for (int c = 0; c < COLUMN_COUNT; c++)
        if (is_wanted(s, c) && !light(s, c, error))
            return false;
    return true;
}

static bool print_all(sheet *s, dpl_error *error) {
    size_t pixels = (size_t)s->scene.width * (size_t)s->scene.height;
    s->opaque = malloc(pixels);
    s->pixels = malloc(pixels * 3 * 2 * COLUMN_COUNT);
    if (!s->opaque || !s->pixels)
        return dpl_error_set(error, "out of memory");
    if (!check(s, dpl_field_read_opaque(s->field, s->opaque, 0), error))
        return false;
    for (int c = 1; c < COLUMN_COUNT; c++)
        if (is_wanted(s, c) && !print_errors(s, c, error))
            return false;
    return true;
}

static bool make_sheet(sheet *s, dpl_error *error) {
    const sheet_options *o = s->options;
    const dpl_scene_family *family = dpl_scene_family_find(o->family);
    if (!family || o->index >= family->count)
        return dpl_error_set(error, "there is no scene %d in a family '%s'", (int)o->index, o->family);
    for (int c = 1; o->only && c < COLUMN_COUNT; c++)
        if (strcmp(columns[c].name, o->only) == 0)
            s->only = c;
    if (o->only && s->only == 0)
        return dpl_error_set(error, "there is no method '%s'", o->only);
    return check(s, dpl_context_create(NULL, &s->context), error) &&
           family->make(o->seed, o->index, o->size, &s->scene, error) &&
           dpl_scene_build_field(&s->scene, s->context, false, &s->field, error) && light_all(s, error) &&
           print_all(s, error) && write_sheet(s, error);
}

static void free_sheet(sheet *s) {
    for (int c = 0; c < COLUMN_COUNT; c++) {
        dpl_picture_free(&s->pictures[c]);
        free(s->display[c]);
    }
    free(s->opaque);
    free(s->pixels);
    dpl_field_destroy(s->field);
    dpl_scene_free(&s->scene);
    dpl_context_destroy(s->context);
}

int main(int argc, char **argv) {
    sheet_options o = {"arc", 1, 20, 512, 1024, 8, NULL, "sheet.png"};
    const dpl_bench_option table[] = {
        {"family", DPL_BENCH_TEXT, &o.family, 0, 0},
        {"seed", DPL_BENCH_SEED, &o.seed, 0, 0},
        {"index", DPL_BENCH_INTEGER, &o.index, 0, 1000000},
        {"size", DPL_BENCH_INTEGER, &o.size, 1, 4096},
        {"directions", DPL_BENCH_INTEGER, &o.directions, 1, 1 << 20},
        {"enlarge", DPL_BENCH_INTEGER, &o.enlarge, 1, 255},
        {"only", DPL_BENCH_TEXT, &o.only, 0, 0},
        {"out", DPL_BENCH_TEXT, &o.out, 0, 0},
    };
    int status = dpl_bench_options_read(PROGRAM, help, table, sizeof table / sizeof table[0], argc, argv);
    if (status != DPL_BENCH_GO)
        return status;
    sheet s = {.options = &o};
    dpl_error error;
    bool good = make_sheet(&s, &error);
    free_sheet(&s);
    if (good)
        return DPL_BENCH_DONE;
    fprintf(stderr, PROGRAM ": %s\n", error.text);
    return DPL_BENCH_FAILED;
}
