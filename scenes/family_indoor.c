/* Families of enclosed spaces: "maze", "rooms" and "thin". Light gets about by many corners here, which is
 * where interval seams and leaks show. Called through the table in families.c. */
#include "family_list.h"
#include "scene_builder.h"

/* Most cells per side of a maze. */
#define MAZE_MOST 24

/* Which walls of a cell are open. */
typedef struct maze {
    int32_t side;
    bool visited[MAZE_MOST][MAZE_MOST];
    bool open_right[MAZE_MOST][MAZE_MOST];
    bool open_below[MAZE_MOST][MAZE_MOST];
} maze;

static void open_wall(maze *m, int32_t x, int32_t y, int32_t next_x, int32_t next_y) {
    if (next_x != x)
        m->open_right[y][next_x < x ? next_x : x] = true;
    else
        m->open_below[next_y < y ? next_y : y][x] = true;
}

/* A neighbour not yet visited, by a random turn; false when there is none. */
static bool pick_neighbour(const maze *m, dpl_random *random, int32_t x, int32_t y, int32_t *next) {
    static const int32_t steps[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    int32_t turn = dpl_random_below(random, 4);
    for (int32_t i = 0; i < 4; i++) {
        next[0] = x + steps[(turn + i) % 4][0];
        next[1] = y + steps[(turn + i) % 4][1];
        if (next[0] >= 0 && next[1] >= 0 && next[0] < m->side && next[1] < m->side &&
            !m->visited[next[1]][next[0]])
            return true;
    }
    return false;
}

/* Depth-first: a tree of passages that reaches every cell. */
static void carve(maze *m, dpl_random *random) {
    int32_t stack[MAZE_MOST * MAZE_MOST][2] = {{0, 0}}, depth = 1, next[2];
    m->visited[0][0] = true;
    while (depth > 0) {
        int32_t x = stack[depth - 1][0], y = stack[depth - 1][1];
        if (!pick_neighbour(m, random, x, y, next)) {
            depth--;
            continue;
        }
        open_wall(m, x, y, next[0], next[1]);
        m->visited[next[1]][next[0]] = true;
        stack[depth][0] = next[0];
        stack[depth][1] = next[1];
        depth++;
    }
}

/* Walls are whole pixels thick, on whole pixels, whatever the size. */
static void draw_maze(dpl_scene_builder *b, const maze *m, int32_t cell, int32_t thick) {
    for (int32_t y = 0; y < m->side; y++) {
        for (int32_t x = 0; x < m->side; x++) {
            int32_t right = (x + 1) * cell, below = (y + 1) * cell;
            if (x + 1 < m->side && !m->open_right[y][x])
                dpl_build_rectangle(b, right, y * cell, right + thick, below + thick, dpl_build_wall());
            if (y + 1 < m->side && !m->open_below[y][x])
                dpl_build_rectangle(b, x * cell, below, right + thick, below + thick, dpl_build_wall());
        }
    }
}

DPL_FAMILY(maze) {
    dpl_scene_builder b = dpl_build_start("maze", seed, index, size, scene, error);
    if (!b.good) /* whole pixels are counted in integers below */
        return dpl_build_finish(&b);
    maze m = {.side = 6 + 2 * dpl_random_below(&b.random, 10)};
    int32_t thick = 1 + dpl_random_below(&b.random, 3);
    int32_t cell = size / m.side > thick + 4 ? size / m.side : thick + 4;
    b.scale = 1;
    carve(&m, &b.random);
    draw_maze(&b, &m, cell, thick);
    int32_t lamps = 3 + dpl_random_below(&b.random, 5);
    for (int32_t i = 0; i < lamps; i++) {
        double x = (dpl_random_below(&b.random, m.side) + 0.5) * cell + thick / 2.0;
        double y = (dpl_random_below(&b.random, m.side) + 0.5) * cell + thick / 2.0;
        double radius = dpl_build_draw(&b, 0.1, 0.3) * cell;
        dpl_build_lit_disc(&b, x, y, radius, 1, 4);
    }
    return dpl_build_finish(&b);
}

/* A wall along a line with a doorway in each of its `rooms` stretches; horizontal or upright. */
static void draw_room_wall(dpl_scene_builder *b, double at, int32_t rooms, double thick, bool upright) {
    double stretch = DPL_SCENE_BASE / rooms;
    for (int32_t i = 0; i < rooms; i++) {
        double door = dpl_build_draw(b, 14, 40), begin = dpl_build_draw(b, 8, stretch - door - 8);
        double ends[2][2] = {{i * stretch, i * stretch + begin},
                             {i * stretch + begin + door, (i + 1) * stretch}};
        for (int32_t k = 0; k < 2; k++) {
            if (upright)
                dpl_build_rectangle(b, at, ends[k][0], at + thick, ends[k][1], dpl_build_wall());
            else
                dpl_build_rectangle(b, ends[k][0], at, ends[k][1], at + thick, dpl_build_wall());
        }
    }
}

DPL_FAMILY(rooms) {
    dpl_scene_builder b = dpl_build_start("rooms", seed, index, size, scene, error);
    int32_t columns = 2 + dpl_random_below(&b.random, 3), rows = 2 + dpl_random_below(&b.random, 3);
    double thick = dpl_build_draw(&b, 3, 10);
    for (int32_t i = 0; i <= columns; i++)
        draw_room_wall(&b, i * (DPL_SCENE_BASE - thick) / columns, rows, thick, true);
    for (int32_t i = 0; i <= rows; i++)
        draw_room_wall(&b, i * (DPL_SCENE_BASE - thick) / rows, columns, thick, false);
    for (int32_t room = 0; room < columns * rows; room++) {
        double x = (room % columns + dpl_build_draw(&b, 0.25, 0.75)) * DPL_SCENE_BASE / columns;
        double y = (room / columns + dpl_build_draw(&b, 0.25, 0.75)) * DPL_SCENE_BASE / rows;
        if (room == 0 || dpl_random_below(&b.random, 2) == 0)
            dpl_build_lit_disc(&b, x, y, dpl_build_draw(&b, 3, 12), 1, 5);
        else
            dpl_build_turned_box(&b, x, y, 4, 25);
    }
    return dpl_build_finish(&b);
}

/* Walls of one pixel at any size: straight ones on whole pixels, and slanted lines. */
DPL_FAMILY(thin) {
    dpl_scene_builder b = dpl_build_start("thin", seed, index, size, scene, error);
    if (!b.good) /* whole pixels are counted in integers below */
        return dpl_build_finish(&b);
    int32_t walls = 20 + dpl_random_below(&b.random, 40), lamps = 3 + dpl_random_below(&b.random, 6);
    for (int32_t i = 0; i < lamps; i++) {
        double x = dpl_build_draw(&b, 30, 482), y = dpl_build_draw(&b, 30, 482);
        dpl_build_lit_disc(&b, x, y, dpl_build_draw(&b, 3, 10), 1, 4);
    }
    b.scale = 1;
    for (int32_t i = 0; i < walls; i++) {
        int32_t x = dpl_random_below(&b.random, size), y = dpl_random_below(&b.random, size);
        double length = dpl_build_draw(&b, 0.05, 0.25) * size, slope = dpl_build_draw(&b, -1, 1);
        int32_t whole = (int32_t)length + 1, turn = dpl_random_below(&b.random, 4);
        if (turn == 0)
            dpl_build_rectangle(&b, x, y, x + whole, y + 1, dpl_build_wall());
        else if (turn == 1)
            dpl_build_rectangle(&b, x, y, x + 1, y + whole, dpl_build_wall());
        else if (turn == 2)
            dpl_build_segment(&b, x, y, x + length, y + slope * length, 1, dpl_build_wall());
        else
            dpl_build_segment(&b, x, y, x + slope * length, y + length, 1, dpl_build_wall());
    }
    return dpl_build_finish(&b);
}
