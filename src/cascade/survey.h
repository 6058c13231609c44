/* The survey of ray skipping: before any light is merged, which rays of a level are needed, which of those
 * are proved to hit nothing, and what the rest hits. Runs from level 0 up, because what is opaque below makes
 * rays above needless. Made by survey.c from need.c, proof.c and trace.c; obeyed by level.c.
 * docs/algorithms/ray-skipping-exact-and-bounded.md says why nothing of it changes a bit of the picture. */
#ifndef DPL_CASCADE_SURVEY_H
#define DPL_CASCADE_SURVEY_H

#include "cascade/mask.h"
#include "cascade/near.h"
#include "solver/solver.h"

#include <stdatomic.h>

/* Probes of a row that are handled at once, wherever rays are traced or merged: enough to fill vectors, few
 * enough for buffers to stay in cache. Even, so that pairs of children with one parent are not cut; a whole
 * number of words of a mask. */
#define DPL_CHUNK 128
#define DPL_LAMP_TILE 8 /* side of the squares of dpl_survey::lamps [px] */
#define DPL_CHUNK_WORDS (DPL_CHUNK / DPL_MASK_BITS)

/* Rows of probes whose first rays of each slot are traced before all others, see guess.c. */
typedef enum dpl_known_rows { DPL_KNOWN_NONE, DPL_KNOWN_PILOT, DPL_KNOWN_ALL } dpl_known_rows;

/* Of so many rows one shows what guessing will yield, and which. */
#define DPL_PILOT_ROWS 8
#define DPL_PILOT_ROW 3

/* What is known of a level. */
typedef struct dpl_survey_level {
    const dpl_schedule_level *plan;
    const dpl_schedule_level *above; /* NULL at the top */
    const float (*directions)[2];    /* as in dpl_level */
    int32_t number;
    dpl_merge merge;
    int32_t aims;     /* rays per direction */
    float reach;      /* by which a ray's end may lie further from its probe than t1, in either axis [px] */
    dpl_mask empty;   /* [0]: probes whose rays all hit nothing */
    dpl_mask needed;  /* [slot]: probes whose slot is seen by a transparent ray below */
    dpl_mask live;    /* [slot]: those of them whose rays are not proved to hit nothing */
    dpl_mask lit;     /* [slot]: live probes whose slot may see a lamp; of --skip bounded alone */
    dpl_mask guessed; /* [slot * aims + aim]: probes that have guesses; of --skip bounded alone */
    int32_t *ends;    /* [slot * aims + aim][row][probe]: of first rays that hit, where; likewise */
    dpl_known_rows known; /* whose first rays are traced before all others, into `hits` and `ends` */
    bool has_guesses;     /* `guessed` is there, in rows that are known */
    dpl_mask hits;        /* [ray * aims + aim]: probes whose ray ends at an opaque pixel */
    const int32_t *cells; /* opaque pixels that rays end at, of all levels */
    int64_t *cells_at;    /* [slot][row][chunk]: which of them begin a chunk */
    bool traced;          /* `hits` is there */
    bool stored;          /* and so are the cells; else rays are traced when they are merged */
} dpl_survey_level;

typedef struct dpl_survey {
    dpl_buffer masks[DPL_MAX_LEVELS];
    dpl_buffer cells;      /* int32_t: opaque pixels that rays end at */
    dpl_buffer ends;       /* int32_t: of guessing, what every first ray of a level ends at */
    dpl_buffer tiles;      /* of guessing */
    dpl_buffer lamp_tiles; /* float: memory of `lamps` */
    dpl_buffer scratch;    /* of tracing and of proofs, per worker */
    size_t scratch_bytes;  /* of one worker */
    int64_t capacity;      /* of `cells` */
    atomic_llong used;     /* cells handed out */
    dpl_survey_level levels[DPL_MAX_LEVELS];
    dpl_clearances distances;
    dpl_clearances lamps; /* of squares of pixels, to the nearest that emits light; of --skip bounded alone */
    bool has_lamps;       /* there are small lamps, so `lamps` says something */
    float margin;         /* bound on how far a march may stray from its ray, this level [px] */
    dpl_ray_box box;      /* where rays can hit anything */
    bool guesses;         /* of --skip bounded, as long as that is not hopeless */
    double error_left;    /* of mean radiance, that guesses may still come to in this frame */
} dpl_survey;

/* What the parts of a level's survey work on. */
typedef struct dpl_survey_task {
    dpl_survey *survey;
    dpl_survey_level *level;
    const dpl_survey_level *below; /* NULL at level 0 */
    const dpl_field *field;
    const dpl_kernels *kernels;
    dpl_grid grid;
    bool guesses;      /* of --skip bounded */
    bool walls_unseen; /* pixels of walls show their emission: level 0 need not light them */
    dpl_ray_counter *counters;
} dpl_survey_task;

/* need.c: fills `needed` from the level below; items are slots x rows. */
void dpl_survey_need(int32_t begin, int32_t end, int32_t worker, void *task);

/* proof.c: fills `live`. Items of work, and a dpl_task_function over them. */
void dpl_survey_find_empty(int32_t begin, int32_t end, int32_t worker, void *task); /* rows */
int32_t dpl_survey_proof_items(const dpl_survey_level *level);
void dpl_survey_prove(int32_t begin, int32_t end, int32_t worker, void *task);
size_t dpl_survey_proof_bytes(void); /* of scratch */

/* trace.c: fills `hits` and the cells; items are slots x rows. */
void dpl_survey_trace(int32_t begin, int32_t end, int32_t worker, void *task);
size_t dpl_survey_trace_bytes(void); /* of scratch */

/* Whatever memory a schedule needs. `aims` of a level are as in the schedule. */
DPL_MUST_CHECK dpl_status dpl_survey_plan(dpl_survey *survey, dpl_context *context,
                                          const dpl_schedule *schedule, bool guesses);
void dpl_survey_free(dpl_survey *survey, dpl_context *context);
size_t dpl_survey_bytes(dpl_survey *survey);

static inline int32_t dpl_survey_chunks(const dpl_survey_level *level) {
    return (level->plan->probes_x + DPL_CHUNK - 1) / DPL_CHUNK;
}

static inline int64_t *dpl_survey_cells_at(const dpl_survey_level *level, int32_t slot, int32_t row,
                                           int32_t chunk) {
    return level->cells_at + ((int64_t)slot * level->plan->probes_y + row) * dpl_survey_chunks(level) + chunk;
}

static inline bool dpl_survey_is_pilot_row(int32_t row) {
    return row % DPL_PILOT_ROWS == DPL_PILOT_ROW;
}

/* Are the first rays of a row known? */
static inline bool dpl_survey_is_known_row(const dpl_survey_level *level, int32_t row) {
    return level->known == DPL_KNOWN_ALL || (level->known == DPL_KNOWN_PILOT && dpl_survey_is_pilot_row(row));
}

/* Where the first rays of a slot and row end. */
static inline int32_t *dpl_survey_ends(const dpl_survey_level *level, int32_t slot, int32_t aim,
                                       int32_t row) {
    size_t index =
        ((size_t)slot * (size_t)level->aims + (size_t)aim) * (size_t)level->plan->probes_y + (size_t)row;
    return level->ends + index * (size_t)level->plan->probes_x;
}

/* Where guesses for ray j of a slot, 1 .. 3, are taken from: this slot's first ray or the next one's. */
static inline int32_t *dpl_survey_guess_ends(const dpl_survey_level *level, int32_t slot, int32_t j,
                                             int32_t aim, int32_t row) {
    int32_t next = slot + 1 < level->plan->slots ? slot + 1 : 0;
    return dpl_survey_ends(level, j <= DPL_BRANCHING / 2 ? slot : next, aim, row);
}

/* A worker's scratch memory. */
static inline void *dpl_survey_scratch(const dpl_survey *survey, int32_t worker) {
    return (char *)survey->scratch.data + (size_t)worker * survey->scratch_bytes;
}

/* Room for `count` cells; `at` receives where it begins. NULL when there is not enough. */
static inline int32_t *dpl_survey_take_cells(dpl_survey *survey, int64_t count, int64_t *at) {
    *at = atomic_fetch_add(&survey->used, count);
    return *at + count <= survey->capacity ? (int32_t *)survey->cells.data + *at : NULL;
}

#endif
