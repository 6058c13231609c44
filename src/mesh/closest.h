/* The point of a triangle that is closest to a given one. Inlined into the loops of band.c and sweep.c. */
#ifndef DPL_MESH_CLOSEST_H
#define DPL_MESH_CLOSEST_H

static inline double dpl_mesh_dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* result = a + u (b - a) + v (c - a) */
static inline void dpl_mesh_mix(const double a[3], const double ab[3], const double ac[3], double u, double v,
                                double result[3]) {
    for (int axis = 0; axis < 3; axis++)
        result[axis] = a[axis] + u * ab[axis] + v * ac[axis];
}

/* A quotient of lengths along an edge: a point's edge is as good as its start. */
static inline double dpl_mesh_share(double part, double rest) {
    return part + rest > 0.0 ? part / (part + rest) : 0.0;
}

/* By the region of the plane that the point lies above: corners first, then edges, then the inside
 * (Ericson 2005, "Real-time collision detection", 5.1.5). Returns the squared distance. */
static inline double dpl_mesh_closest(const float corner[3][3], const double p[3], double result[3]) {
    double a[3], ab[3], ac[3], ap[3];
    for (int axis = 0; axis < 3; axis++) {
        a[axis] = (double)corner[0][axis];
        ab[axis] = (double)corner[1][axis] - a[axis];
        ac[axis] = (double)corner[2][axis] - a[axis];
        ap[axis] = p[axis] - a[axis];
    }
    double d1 = dpl_mesh_dot(ab, ap), d2 = dpl_mesh_dot(ac, ap);
    double bb = dpl_mesh_dot(ab, ab), bc = dpl_mesh_dot(ab, ac), cc = dpl_mesh_dot(ac, ac);
    double d3 = d1 - bb, d4 = d2 - bc, d5 = d1 - bc, d6 = d2 - cc;
    double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
    if (d1 <= 0.0 && d2 <= 0.0)
        dpl_mesh_mix(a, ab, ac, 0.0, 0.0, result);
    else if (d3 >= 0.0 && d4 <= d3)
        dpl_mesh_mix(a, ab, ac, 1.0, 0.0, result);
    else if (d6 >= 0.0 && d5 <= d6)
        dpl_mesh_mix(a, ab, ac, 0.0, 1.0, result);
    else if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0)
        dpl_mesh_mix(a, ab, ac, dpl_mesh_share(d1, -d3), 0.0, result);
    else if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0)
        dpl_mesh_mix(a, ab, ac, 0.0, dpl_mesh_share(d2, -d6), result);
    else if (va <= 0.0 && d4 >= d3 && d5 >= d6) {
        double v = dpl_mesh_share(d4 - d3, d5 - d6);
        dpl_mesh_mix(a, ab, ac, 1.0 - v, v, result);
    } else {
        double sum = va + vb + vc;
        dpl_mesh_mix(a, ab, ac, vb / sum, vc / sum, result);
    }
    double away[3] = {p[0] - result[0], p[1] - result[1], p[2] - result[2]};
    return dpl_mesh_dot(away, away);
}

#endif
