/* Opening the bucket queue, and new chunks for it. Called by world.c, update.c and queue.h. */
#include "flood/queue.h"

#include <stddef.h>

#define LOWEST_SHIFT 5 /* 32768 levels in DPL_QUEUE_BUCKETS buckets */

void dpl_flood_queue_open(dpl_flood_queue *queue, dpl_flood_chunk *chunks, uint32_t capacity, int32_t step) {
    queue->chunks = chunks;
    queue->capacity = capacity;
    queue->fresh = 0;
    queue->free = DPL_NO_CHUNK;
    queue->brightest = -1;
    queue->lost = false;
    queue->shift = LOWEST_SHIFT;
    while (2 << queue->shift <= step)
        queue->shift++;
    for (size_t i = 0; i < DPL_QUEUE_BUCKETS; i++)
        queue->first[i] = queue->last[i] = DPL_NO_CHUNK;
}

static uint32_t free_chunk(dpl_flood_queue *queue) {
    uint32_t chunk = queue->free;
    if (chunk != DPL_NO_CHUNK) {
        queue->free = queue->chunks[chunk].next;
        return chunk;
    }
    return queue->fresh < queue->capacity ? queue->fresh++ : DPL_NO_CHUNK;
}

bool dpl_flood_queue_extend(dpl_flood_queue *queue, int32_t bucket) {
    uint32_t chunk = free_chunk(queue);
    if (chunk == DPL_NO_CHUNK) {
        queue->lost = true;
        return false;
    }
    queue->chunks[chunk].next = DPL_NO_CHUNK;
    queue->chunks[chunk].count = 0;
    if (queue->last[bucket] == DPL_NO_CHUNK)
        queue->first[bucket] = chunk;
    else
        queue->chunks[queue->last[bucket]].next = chunk;
    queue->last[bucket] = chunk;
    queue->brightest = bucket > queue->brightest ? bucket : queue->brightest;
    return true;
}
