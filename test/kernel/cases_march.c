/* Cases of the kernels that follow rays through the world. */
#include "kernel/cases.h"

#include <string.h>

static dpl_segments some_of(const dpl_kernel_case *c, const dpl_case_inputs *in, int32_t first,
                            int32_t count) {
    const float(*ends)[DPL_CASE_RAYS] = in->ends[c->span];
    return (dpl_segments){count, ends[0] + first, ends[1] + first, ends[2] + first, ends[3] + first};
}

/* A run is as many calls as a level makes: chunk by chunk. */
static dpl_segments chunk_of(const dpl_kernel_case *c, const dpl_case_inputs *in, int32_t first) {
    return some_of(c, in, first, DPL_CASE_CHUNK);
}

static void march_all(void (*march)(const dpl_grid *, const dpl_segments *, const dpl_intervals *),
                      const dpl_kernel_case *c, const dpl_case_inputs *in, float *out) {
    for (int32_t first = 0; first < DPL_CASE_RAYS; first += DPL_CASE_CHUNK) {
        dpl_segments segments = chunk_of(c, in, first);
        dpl_intervals intervals;
        for (int p = 0; p < 3; p++) {
            intervals.radiance[p] = out + p * DPL_CASE_RAYS + first;
            intervals.transmittance[p] = out + (3 + p) * DPL_CASE_RAYS + first;
        }
        march(&in->grids[c->world], &segments, &intervals);
    }
}

static void march(const dpl_kernel_case *c, const dpl_kernels *kernels, const dpl_case_inputs *in,
                  void *out) {
    march_all(kernels->march, c, in, out);
}

static void march_surface(const dpl_kernel_case *c, const dpl_kernels *kernels, const dpl_case_inputs *in,
                          void *out) {
    march_all(kernels->march_surface, c, in, out);
}

/* In batches as the survey has them. */
enum { BATCH = 4096 };

static void march_to_cell(const dpl_kernel_case *c, const dpl_kernels *kernels, const dpl_case_inputs *in,
                          void *out) {
    for (int32_t first = 0; first < DPL_CASE_RAYS; first += BATCH) {
        dpl_segments segments = some_of(c, in, first, BATCH);
        kernels->march_to_cell(&in->grids[c->world], &segments, (int32_t *)out + first);
    }
}

/* As many words as a batch of the survey may have, of half their probes each. */
enum { WORDS = 32, WORD_RAYS = 32 * WORDS };

static void fill_words(int32_t first, dpl_ray_word words[WORDS], uint64_t hits[WORDS]) {
    for (int32_t i = 0; i < WORDS; i++) {
        uint64_t some = (uint64_t)(first + i / 2 + 1) * 0x9e3779b97f4a7c15u;
        words[i] = (dpl_ray_word){.rays = i % 2 ? ~some : some,
                                  .hits = &hits[i],
                                  .first = 64 * (i % 8),
                                  .start_x = 3.0f,
                                  .end_x = 4.0f,
                                  .y1 = 5.0f};
    }
}

static void aim(const dpl_kernel_case *c, const dpl_kernels *kernels, const dpl_case_inputs *in, void *out) {
    const dpl_ray_axis axis = {1.0f, 1.0f, 512};
    (void)c, (void)in;
    for (int32_t first = 0; first < DPL_CASE_RAYS; first += WORD_RAYS) {
        float ends[4][WORD_RAYS + DPL_RAY_WORDS_PAD], *to[4] = {ends[0], ends[1], ends[2], ends[3]};
        dpl_ray_word words[WORDS];
        uint64_t hits[WORDS];
        fill_words(first, words, hits);
        int32_t rays = kernels->aim(&axis, WORDS, words, to);
        for (int p = 0; p < 4; p++)
            memcpy((float *)out + p * DPL_CASE_RAYS + first, ends[p], (size_t)rays * sizeof(float));
    }
}

/* Every third ray hits nothing. */
static void list_hits(const dpl_kernel_case *c, const dpl_kernels *kernels, const dpl_case_inputs *in,
                      void *out) {
    int32_t cell[WORD_RAYS + DPL_RAY_WORDS_PAD], list[WORD_RAYS + DPL_RAY_WORDS_PAD];
    (void)c, (void)in;
    for (int32_t i = 0; i < WORD_RAYS + DPL_RAY_WORDS_PAD; i++)
        cell[i] = i % 3 ? i : -1;
    for (int32_t first = 0; first < DPL_CASE_RAYS; first += WORD_RAYS) {
        dpl_ray_word words[WORDS];
        uint64_t hits[WORDS];
        fill_words(first, words, hits);
        int32_t count = kernels->list_hits(WORDS, words, cell, list);
        memcpy((int32_t *)out + first, list, (size_t)count * sizeof *list);
        memcpy((int32_t *)out + DPL_CASE_RAYS + 2 * (first / WORD_RAYS * WORDS), hits, sizeof hits);
    }
}

/* Strips two pixels wide. */
static void sweep(const dpl_kernel_case *c, const dpl_kernels *kernels, const dpl_case_inputs *in,
                  void *out) {
    const dpl_grid *grid = &in->grids[c->world];
    dpl_clearances distances = {grid->width, grid->height, grid->clearance, 1, 0.8f};
    for (int32_t first = 0; first < DPL_CASE_RAYS; first += DPL_CASE_CHUNK) {
        dpl_strips strips = {chunk_of(c, in, first), in->planes[0], in->planes[1]};
        kernels->sweep(&distances, &strips, (float *)out + first);
    }
}

#define RAYS .item = "ray", .items = DPL_CASE_RAYS
#define LIGHT .out_bytes = 6 * DPL_CASE_RAYS * sizeof(float)
#define NUMBER .out_bytes = DPL_CASE_RAYS * sizeof(float)

static const dpl_kernel_case cases[] = {
    {"march", "level 1 of cascades", RAYS, LIGHT, .run = march, .span = DPL_CASE_LEVEL_1},
    {"march", "level 3 of cascades", RAYS, LIGHT, .run = march, .span = DPL_CASE_LEVEL_3},
    {"march", "from anywhere to anywhere", RAYS, LIGHT, .run = march, .span = DPL_CASE_ACROSS},
    {"march", "level 3 in mist", RAYS, LIGHT, .run = march, .span = DPL_CASE_LEVEL_3, .world = DPL_CASE_MIST},
    {"march_to_cell", "level 3 of cascades", RAYS, NUMBER, .run = march_to_cell, .span = DPL_CASE_LEVEL_3},
    {"march_to_cell", "from anywhere to anywhere", RAYS, NUMBER, .run = march_to_cell,
     .span = DPL_CASE_ACROSS},
    {"aim", "half of the probes", RAYS, .out_bytes = 4 * DPL_CASE_RAYS * sizeof(float), .run = aim},
    {"list_hits", "half of the probes", RAYS, .out_bytes = 2 * DPL_CASE_RAYS * sizeof(float),
     .run = list_hits},
    {"sweep", "level 3 of cascades", RAYS, NUMBER, .run = sweep, .span = DPL_CASE_LEVEL_3},
    {"march_surface", "level 3 of cascades", RAYS, LIGHT, .run = march_surface, .span = DPL_CASE_LEVEL_3},
};

const dpl_kernel_case *dpl_cases_of_marches(int32_t *count) {
    *count = sizeof cases / sizeof cases[0];
    return cases;
}
