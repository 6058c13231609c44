/* From the centre of the free pixel before a face, rays spread evenly over the angle of a light's disc, each
 * followed through the pixels as far as the disc's rim and weighed by its cosine. See light.h. */
#include "reference/light.h"

#include <math.h>

/* The integral of cosine times what is let through, over the disc's angle; in the disc that is the half
 * circle, 2, whatever stands in it. */
static int64_t look_at(const dpl_field *field, const dpl_face *face, const double to[2], double radius,
                       double sum[3]) {
    double distance = hypot(to[0], to[1]);
    int64_t rays = 0;
    sum[0] = sum[1] = sum[2] = distance <= radius && radius > 0.0 ? 2.0 : 0.0;
    if (distance <= radius || !(radius > 0.0))
        return 0;
    double angle = asin(radius / distance), middle = atan2(to[1], to[0]);
    for (int k = 0; k < DPL_LIGHT_RAYS; k++) {
        double turn = angle * ((2.0 * k + 1.0) / DPL_LIGHT_RAYS - 1.0), passed[3];
        double unit[2] = {cos(middle + turn), sin(middle + turn)};
        double cosine = unit[0] * face->normal[0] + unit[1] * face->normal[1];
        double across = distance * sin(turn);
        double rim = distance * cos(turn) - sqrt(fmax(radius * radius - across * across, 0.0));
        if (!(cosine > 0.0))
            continue;
        rays++;
        if (dpl_ray_reaches(field, face->x, face->y, unit, rim, passed))
            for (int c = 0; c < 3; c++)
                sum[c] += cosine * passed[c] * 2.0 * angle / DPL_LIGHT_RAYS;
    }
    return rays;
}

int64_t dpl_lights_on_face(const dpl_solver *solver, const dpl_field *field, const dpl_face *face,
                           double half[3]) {
    const dpl_light *lights = solver->lights.data;
    int64_t rays = 0;
    half[0] = half[1] = half[2] = 0.0;
    for (int32_t i = 0; i < solver->light_count; i++) {
        double to[2] = {lights[i].position[0] + field->margin - face->x - 0.5,
                        lights[i].position[1] + field->margin - face->y - 0.5},
               sum[3];
        rays += look_at(field, face, to, lights[i].radius, sum);
        for (int c = 0; c < 3; c++)
            half[c] += 0.5 * sum[c] * (double)lights[i].color[c] * (double)lights[i].intensity;
    }
    return rays;
}
