/* Which triangles hang together, and is what they form closed? Corners at the same place are one corner,
 * whatever their numbers: files split corners where normals or colours change. Called by dpl_mesh_keep(). */
#include "mesh/mesh.h"

/* An edge between two places, low number first. */
typedef struct edge {
    int32_t from; /* -1: this entry is free */
    int32_t to;
    int32_t forward; /* triangles that run it from `from` to `to` */
    int32_t backward;
} edge;

/* What has been seen of a part. */
typedef enum seen { SEEN_CLOSED, SEEN_UNORIENTED, SEEN_OPEN, SEEN_NOTHING } seen;

typedef struct parts {
    const dpl_mesh_corners *corners;
    int32_t count;    /* triangles */
    uint32_t places;  /* entries of place_table, a power of two */
    uint32_t edges;   /* entries of edge_table, a power of two */
    int32_t *place;   /* per corner 3 * triangle + k: number of the first corner at that place */
    int32_t *above;   /* per corner: towards the corner that names its part */
    uint8_t *state;   /* per corner that names a part: seen */
    double *volume;   /* per corner that names a part: six times what it encloses */
    int32_t *at;      /* hash table of corners */
    edge *edge_table; /* hash table of edges */
} parts;

static uint32_t power_of_two(size_t least) {
    uint32_t size = 16;
    while (size < least)
        size *= 2;
    return size;
}

static uint32_t mix(uint32_t hash, uint32_t value) {
    hash = (hash ^ value) * 0x9e3779b1u;
    return hash ^ hash >> 15;
}

/* ---- places --------------------------------------------------------------------------------------- */

static uint32_t hash_of_point(const float point[3]) {
    uint32_t bits[3];
    memcpy(bits, point, sizeof bits);
    return mix(mix(mix(0, bits[0]), bits[1]), bits[2]);
}

static void find_places(parts *p, dpl_mesh_facts *facts) {
    const float(*points)[3] = (const float(*)[3])p->corners;
    memset(p->at, -1, p->places * sizeof *p->at);
    for (int32_t i = 0; i < 3 * p->count; i++) {
        uint32_t entry = hash_of_point(points[i]) & (p->places - 1);
        while (p->at[entry] >= 0 && memcmp(points[p->at[entry]], points[i], sizeof points[i]) != 0)
            entry = (entry + 1) & (p->places - 1);
        if (p->at[entry] < 0) {
            p->at[entry] = i;
            facts->corners++;
        }
        p->place[i] = p->at[entry];
        p->above[i] = i;
        p->state[i] = SEEN_NOTHING;
        p->volume[i] = 0.0;
    }
}

/* ---- parts ---------------------------------------------------------------------------------------- */

static int32_t part_of(parts *p, int32_t corner) {
    while (p->above[corner] != corner)
        corner = p->above[corner] = p->above[p->above[corner]];
    return corner;
}

/* The lower number names the part. */
static void join(parts *p, int32_t a, int32_t b) {
    a = part_of(p, a);
    b = part_of(p, b);
    if (a < b)
        p->above[b] = a;
    else
        p->above[a] = b;
}

static bool has_area(const dpl_mesh_corners corner) {
    double u[3], v[3];
    for (int axis = 0; axis < 3; axis++) {
        u[axis] = (double)corner[1][axis] - (double)corner[0][axis];
        v[axis] = (double)corner[2][axis] - (double)corner[0][axis];
    }
    double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
    return x * x + y * y + z * z > 0.0;
}

static void count_edge(parts *p, int32_t a, int32_t b) {
    int32_t from = a < b ? a : b, to = a < b ? b : a;
    uint32_t entry = mix(mix(0, (uint32_t)from), (uint32_t)to) & (p->edges - 1);
    while (p->edge_table[entry].from >= 0 &&
           (p->edge_table[entry].from != from || p->edge_table[entry].to != to))
        entry = (entry + 1) & (p->edges - 1);
    edge *e = &p->edge_table[entry];
    if (e->from < 0)
        *e = (edge){from, to, 0, 0};
    if (a < b)
        e->forward++;
    else
        e->backward++;
}

/* A triangle whose corners lie on a line still closes what is around it, so it counts as an edge run to and
 * fro, unless two corners coincide. */
static void join_triangles(parts *p, dpl_mesh_facts *facts) {
    for (uint32_t i = 0; i < p->edges; i++)
        p->edge_table[i].from = -1;
    for (int32_t i = 0; i < p->count; i++) {
        const int32_t *corner = &p->place[3 * i];
        facts->degenerate += !has_area(p->corners[i]);
        join(p, corner[0], corner[1]);
        join(p, corner[1], corner[2]);
        for (int k = 0; k < 3; k++)
            if (corner[k] != corner[(k + 1) % 3])
                count_edge(p, corner[k], corner[(k + 1) % 3]);
    }
}

/* ---- what they are -------------------------------------------------------------------------------- */

static void judge_parts(parts *p) {
    for (uint32_t i = 0; i < p->edges; i++) {
        const edge *e = &p->edge_table[i];
        if (e->from < 0)
            continue;
        uint8_t *state = &p->state[part_of(p, e->from)];
        seen now = e->forward == e->backward ? SEEN_CLOSED : SEEN_UNORIENTED;
        if ((e->forward + e->backward) % 2 != 0)
            now = SEEN_OPEN;
        if (*state == SEEN_NOTHING || now > *state)
            *state = (uint8_t)now;
    }
}

/* Counted from a corner of the part: the sum of the pyramids over its triangles. */
static void measure_volumes(parts *p) {
    const float(*points)[3] = (const float(*)[3])p->corners;
    for (int32_t i = 0; i < p->count; i++) {
        int32_t part = part_of(p, p->place[3 * i]);
        double away[3][3];
        for (int k = 0; k < 3; k++)
            for (int axis = 0; axis < 3; axis++)
                away[k][axis] = (double)p->corners[i][k][axis] - (double)points[part][axis];
        for (int x = 0; x < 3; x++) {
            int y = (x + 1) % 3, z = (x + 2) % 3;
            p->volume[part] += away[0][x] * (away[1][y] * away[2][z] - away[1][z] * away[2][y]);
        }
    }
}

/* Also finds out whether no part is open or inside out. */
static void write_signs(parts *p, uint8_t *signs, dpl_mesh_facts *facts, bool *is_solid) {
    static const uint8_t sign_of[] = {[SEEN_CLOSED] = DPL_MESH_CLOSED,
                                      [SEEN_UNORIENTED] = DPL_MESH_UNORIENTED,
                                      [SEEN_OPEN] = DPL_MESH_OPEN,
                                      [SEEN_NOTHING] = DPL_MESH_NOTHING};
    int32_t *counts[] = {&facts->closed_parts, &facts->unoriented_parts, &facts->open_parts};
    for (int32_t i = 0; i < p->count; i++)
        signs[i] = sign_of[p->state[part_of(p, p->place[3 * i])]];
    *is_solid = true;
    for (int32_t i = 0; i < 3 * p->count; i++) {
        bool names_a_part = p->place[i] == i && part_of(p, i) == i && p->state[i] != SEEN_NOTHING;
        if (!names_a_part)
            continue;
        facts->parts++;
        ++*counts[p->state[i]];
        *is_solid = *is_solid && p->state[i] == SEEN_CLOSED && p->volume[i] >= 0.0;
    }
}

/* Cuts pieces off one block of memory. */
static void *cut(char **memory, size_t bytes) {
    void *piece = *memory;
    *memory += (bytes + 15) / 16 * 16;
    return piece;
}

dpl_status dpl_mesh_sort_parts(dpl_mesh *mesh) {
    size_t corners = 3 * (size_t)mesh->facts.triangles;
    parts p = {.corners = dpl_mesh_corners_of(mesh), .count = mesh->facts.triangles};
    p.places = power_of_two(2 * corners);
    p.edges = power_of_two(2 * corners);
    size_t bytes = corners * (2 * sizeof(int32_t) + sizeof(double) + 1) + p.places * sizeof(int32_t) +
                   p.edges * sizeof(edge);
    DPL_TRY(dpl_buffer_reserve(mesh->context, &mesh->scratch, bytes + 128, 1));
    char *memory = mesh->scratch.data;
    p.edge_table = cut(&memory, p.edges * sizeof(edge));
    p.at = cut(&memory, p.places * sizeof(int32_t));
    p.place = cut(&memory, corners * sizeof(int32_t));
    p.above = cut(&memory, corners * sizeof(int32_t));
    p.state = cut(&memory, corners);
    p.volume = cut(&memory, corners * sizeof(double));
    find_places(&p, &mesh->facts);
    join_triangles(&p, &mesh->facts);
    judge_parts(&p);
    measure_volumes(&p);
    write_signs(&p, mesh->signs.data, &mesh->facts, &mesh->is_solid);
    return DPL_OK;
}
