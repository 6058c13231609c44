/* Hands nearest points on from the band to all other samples, along x, then y, then z. What is nearest along
 * a line of samples is the lower envelope of one parabola per sample that knows a point (Maurer, Qi and
 * Raghavan 2003); three passes find the nearest of all points that the band knows, which are a sample's
 * width apart, and the distance is then measured to that point's triangle. Called by dpl_mesh_field_fill().
 *
 * A line is worked on by one task, so the order of tasks cannot show. */
#include "job/jobs.h"
#include "mesh/closest.h"
#include "mesh/field.h"

#include <math.h>

/* Lines that lie side by side in memory, worked on together: four cells are a cache line. */
#define TOGETHER 4

typedef struct sweep {
    const dpl_mesh *mesh;
    const dpl_mesh_grid *grid;
    dpl_mesh_cell *cells;
    float *distance;
    int axis; /* along which the lines of this pass run */
} sweep;

/* A point as a line sees it: nearest of all from `start` on, until the next one's. In spacings. */
typedef struct arc {
    double along;
    double square; /* of its distance from the line */
    double start;
    dpl_mesh_cell cell;
} arc;

/* ---- one line ------------------------------------------------------------------------------------- */

static double height_at(const arc *a, double place) {
    return (place - a->along) * (place - a->along) + a->square;
}

/* Puts an arc behind those before it, taking away those it hides. Points come in the order of the samples
 * that know them; where they lie in another order themselves, which the band's width limits, the one that is
 * nearer to the sample stays. Returns how many there are then. */
static int32_t append(arc *arcs, int32_t count, arc next, double sample) {
    for (; count > 0; count--) {
        const arc *last = &arcs[count - 1];
        double ahead = next.along - last->along;
        if (ahead < 1e-9) {
            if (height_at(&next, sample) >= height_at(last, sample))
                return count;
            continue;
        }
        next.start = (next.along * next.along - last->along * last->along + next.square - last->square) /
                     (2.0 * ahead);
        if (next.start > last->start)
            break;
    }
    if (count == 0)
        next.start = -INFINITY;
    arcs[count] = next;
    return count + 1;
}

/* `line` holds the cells of a line that runs through `place` (its coordinate along the line does not
 * matter). */
static void sweep_line(const sweep *s, const double place[3], dpl_mesh_cell *line) {
    arc arcs[DPL_MAX_MESH_RESOLUTION];
    int32_t size = s->grid->size[s->axis], count = 0;
    double scale = 1.0 / (double)s->grid->spacing;
    for (int32_t i = 0; i < size; i++) {
        if (line[i].triangle < 0)
            continue;
        arc next = {.cell = line[i]};
        for (int axis = 0; axis < 3; axis++) {
            double away = ((double)line[i].point[axis] - place[axis]) * scale;
            next.square += axis == s->axis ? 0.0 : away * away;
        }
        next.along = ((double)line[i].point[s->axis] - (double)s->grid->origin[s->axis]) * scale;
        count = append(arcs, count, next, i);
    }
    for (int32_t i = 0, at = 0; i < size && count > 0; i++) {
        while (at + 1 < count && arcs[at + 1].start <= i)
            at++;
        line[i] = arcs[at].cell;
    }
}

/* ---- all lines ------------------------------------------------------------------------------------ */

static void sweep_rows(int32_t begin, int32_t end, int32_t worker, void *task) {
    const sweep *s = task;
    (void)worker;
    for (int32_t z = begin; z < end; z++)
        for (int32_t y = 0; y < s->grid->size[1]; y++) {
            double place[3] = {0.0, dpl_mesh_coordinate(s->grid, 1, y), dpl_mesh_coordinate(s->grid, 2, z)};
            sweep_line(s, place, s->cells + dpl_mesh_cell_at(s->grid, 0, y, z));
        }
}

/* Lines across rows, through samples x .. x + count - 1 of them: `first` is the first cell of the first. */
static void sweep_columns(const sweep *s, int32_t x, int32_t count, double place[3], dpl_mesh_cell *first,
                          size_t step) {
    dpl_mesh_cell lines[TOGETHER][DPL_MAX_MESH_RESOLUTION];
    for (int32_t i = 0; i < s->grid->size[s->axis]; i++)
        for (int32_t k = 0; k < count; k++)
            lines[k][i] = first[(size_t)i * step + (size_t)k];
    for (int32_t k = 0; k < count; k++) {
        place[0] = dpl_mesh_coordinate(s->grid, 0, x + k);
        sweep_line(s, place, lines[k]);
    }
    for (int32_t i = 0; i < s->grid->size[s->axis]; i++)
        for (int32_t k = 0; k < count; k++)
            first[(size_t)i * step + (size_t)k] = lines[k][i];
}

/* Along y for layers [begin, end), or along z for rows [begin, end) of all layers. */
static void sweep_across(int32_t begin, int32_t end, int32_t worker, void *task) {
    const sweep *s = task;
    int other = s->axis == 1 ? 2 : 1;
    size_t step = dpl_mesh_cell_at(s->grid, 0, s->axis == 1, s->axis == 2);
    (void)worker;
    for (int32_t j = begin; j < end; j++)
        for (int32_t x = 0; x < s->grid->size[0]; x += TOGETHER) {
            int32_t left = s->grid->size[0] - x;
            double place[3] = {0.0, 0.0, 0.0};
            place[other] = dpl_mesh_coordinate(s->grid, other, j);
            sweep_columns(s, x, left < TOGETHER ? left : TOGETHER, place,
                          s->cells + dpl_mesh_cell_at(s->grid, x, other == 1 ? j : 0, other == 2 ? j : 0),
                          step);
        }
}

static void measure_layers(int32_t begin, int32_t end, int32_t worker, void *task) {
    const sweep *s = task;
    const dpl_mesh_corners *corners = dpl_mesh_corners_of(s->mesh);
    (void)worker;
    for (int32_t z = begin; z < end; z++)
        for (int32_t y = 0; y < s->grid->size[1]; y++)
            for (int32_t x = 0; x < s->grid->size[0]; x++) {
                size_t at = dpl_mesh_cell_at(s->grid, x, y, z);
                double nearest[3],
                    p[3] = {dpl_mesh_coordinate(s->grid, 0, x), dpl_mesh_coordinate(s->grid, 1, y),
                            dpl_mesh_coordinate(s->grid, 2, z)};
                s->distance[at] = (float)sqrt(dpl_mesh_closest(corners[s->cells[at].triangle], p, nearest));
            }
}

dpl_status dpl_mesh_field_sweep(dpl_mesh_field *field, const dpl_mesh *mesh) {
    sweep s = {mesh, &field->grid, field->cells.data, field->distance.data, 0};
    const int32_t *size = field->grid.size;
    DPL_TRY(dpl_jobs_run(field->context, sweep_rows, size[2], 1, &s));
    s.axis = 1;
    DPL_TRY(dpl_jobs_run(field->context, sweep_across, size[2], 1, &s));
    s.axis = 2;
    DPL_TRY(dpl_jobs_run(field->context, sweep_across, size[1], 1, &s));
    return dpl_jobs_run(field->context, measure_layers, size[2], 1, &s);
}
