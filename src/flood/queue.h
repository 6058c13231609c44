/* Cells by brightness: a bucket queue (Dial 1969) over a fixed pool of chunks. Used by spread.c.
 *
 * When the pool is empty a push is lost, and the queue says so: the cell's mark is still there to find it. */
#ifndef DPL_FLOOD_QUEUE_H
#define DPL_FLOOD_QUEUE_H

#include <stdbool.h>
#include <stdint.h>

#define DPL_QUEUE_BUCKETS 1024
#define DPL_CHUNK_CELLS 62
#define DPL_NO_CHUNK UINT32_MAX

typedef struct dpl_flood_chunk {
    uint32_t next;
    uint32_t count;
    uint32_t cells[DPL_CHUNK_CELLS];
} dpl_flood_chunk;

typedef struct dpl_flood_queue {
    dpl_flood_chunk *chunks;
    uint32_t capacity;                 /* chunks, at least 1 */
    uint32_t fresh;                    /* chunks from here on have never been used */
    uint32_t free;                     /* chain of chunks free again */
    int32_t shift;                     /* bucket = level >> shift */
    int32_t brightest;                 /* no bucket above this one has cells */
    bool lost;                         /* a push found no room */
    uint32_t first[DPL_QUEUE_BUCKETS]; /* chain of chunks per bucket, oldest first */
    uint32_t last[DPL_QUEUE_BUCKETS];
} dpl_flood_queue;

/* An empty queue over `capacity` chunks. Buckets are as wide as `step` allows: what a step takes off moves
 * light to another bucket, so that a cell is done when its bucket is. */
void dpl_flood_queue_open(dpl_flood_queue *queue, dpl_flood_chunk *chunks, uint32_t capacity, int32_t step);

/* Begins a new chunk in a bucket. False, and `lost`, without room. */
bool dpl_flood_queue_extend(dpl_flood_queue *queue, int32_t bucket);

/* Takes all chunks of a bucket; more may be pushed meanwhile. */
static inline uint32_t dpl_flood_queue_take(dpl_flood_queue *queue, int32_t bucket) {
    uint32_t first = queue->first[bucket];
    queue->first[bucket] = queue->last[bucket] = DPL_NO_CHUNK;
    return first;
}

/* Gives back a chunk that was taken; returns the one behind it. */
static inline uint32_t dpl_flood_queue_release(dpl_flood_queue *queue, uint32_t chunk) {
    uint32_t next = queue->chunks[chunk].next;
    queue->chunks[chunk].next = queue->free;
    queue->free = chunk;
    return next;
}

/* Without room the push is lost. */
static inline void dpl_flood_queue_push_bucket(dpl_flood_queue *queue, uint32_t cell, int32_t bucket) {
    uint32_t last = queue->last[bucket];
    if (last == DPL_NO_CHUNK || queue->chunks[last].count == DPL_CHUNK_CELLS) {
        if (!dpl_flood_queue_extend(queue, bucket))
            return;
        last = queue->last[bucket];
    }
    dpl_flood_chunk *chunk = &queue->chunks[last];
    chunk->cells[chunk->count++] = cell;
}

static inline void dpl_flood_queue_push(dpl_flood_queue *queue, uint32_t cell, uint32_t level) {
    dpl_flood_queue_push_bucket(queue, cell, (int32_t)(level >> queue->shift));
}

#endif
