/** @file
 * All of Dapple. The headers by tier, as a reader would meet them:
 *
 * 1. status.h, version.h, context.h: errors, memory, threads
 * 2. image.h, shape.h, field.h, light.h: what the world is made of
 * 3. schedule.h, skip.h, signal.h, solver.h: light; flood.h: light in tile worlds
 * 4. shadow.h: shadows of lights with a size; mesh.h, solid_shadow.h: the same in space; ray.h, tracer.h:
 * rays against geometry itself
 * 5. lightmap.h, tonemap.h, metric.h, correlation.h: looking at light, and judging it
 */
#ifndef DAPPLE_DAPPLE_H
#define DAPPLE_DAPPLE_H

#include <dapple/context.h>
#include <dapple/correlation.h>
#include <dapple/field.h>
#include <dapple/flood.h>
#include <dapple/image.h>
#include <dapple/light.h>
#include <dapple/lightmap.h>
#include <dapple/mesh.h>
#include <dapple/metric.h>
#include <dapple/ray.h>
#include <dapple/schedule.h>
#include <dapple/shadow.h>
#include <dapple/shape.h>
#include <dapple/signal.h>
#include <dapple/skip.h>
#include <dapple/solid_shadow.h>
#include <dapple/solver.h>
#include <dapple/status.h>
#include <dapple/tonemap.h>
#include <dapple/tracer.h>
#include <dapple/version.h>

#endif
