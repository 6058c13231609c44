/* Saved worlds, and memory: what comes back is the same world, bad bytes are refused whatever they say,
 * nothing is allocated after creation, and memory may run out anywhere. */
#include "flood_world.h"

/* ---- an allocator that counts and can run out ------------------------------------------------------- */

typedef struct books {
    int64_t calls;
    int64_t alive;
    int64_t bytes; /* alive now */
    int64_t most;
    int64_t allowed; /* negative: any number */
} books;

static void *book_allocate(size_t bytes, size_t alignment, void *user) {
    books *b = user;
    if (b->allowed == 0)
        return NULL;
    b->allowed--;
    b->calls++;
    b->alive++;
    b->bytes += (int64_t)bytes;
    b->most = b->bytes > b->most ? b->bytes : b->most;
    void *memory = aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
    assert_non_null(memory);
    memset(memory, 0xa5, bytes);
    return memory;
}

static void book_release(void *memory, size_t bytes, void *user) {
    books *b = user;
    b->alive--;
    b->bytes -= (int64_t)bytes;
    free(memory);
}

static dpl_context *context_with(books *b) {
    dpl_context_desc desc = dpl_context_desc_default();
    dpl_context *counted;
    desc.thread_count = 1;
    desc.allocator = (dpl_allocator){book_allocate, book_release, b};
    b->allowed = -1;
    assert_ok(dpl_context_create(&desc, &counted));
    return counted;
}

/* ---- a world with everything in it ------------------------------------------------------------------ */

static const dpl_flood_material materials[] = {
    {{0, 0, 0, 0}}, {{32767, 32767, 32767, 32767}}, {{900, 700, 100, 3000}}, {{0, 32767, 32767, 0}}};

static dpl_flood_desc busy_desc(void) {
    dpl_flood_desc desc = dpl_flood_desc_default();
    desc.width = 12;
    desc.height = 10;
    desc.depth = 7;
    desc.channels = 4;
    desc.falloff = DPL_FLOOD_EUCLIDEAN;
    desc.sun = DPL_FLOOD_SUN_Y_DOWN;
    desc.sun_level[1] = 20000;
    desc.materials = materials;
    desc.material_count = 4;
    return desc;
}

/* Edits without end: the same for the same seed. Keeps to at most 16 lights. */
static void live(dpl_flood *flood, int32_t edits, uint64_t seed, dpl_flood_light lights[16]) {
    dpl_flood_desc d = world_desc(flood);
    for (int32_t i = 0; i < edits; i++) {
        int32_t x = (int32_t)random_below(&seed, (uint32_t)d.width),
                y = (int32_t)random_below(&seed, (uint32_t)d.height);
        int32_t z = (int32_t)random_below(&seed, (uint32_t)d.depth);
        uint16_t level[4];
        for (int c = 0; c < 4; c++)
            level[c] = (uint16_t)random_below(&seed, 32768);
        uint32_t which = random_below(&seed, 16);
        if (i % 2)
            assert_ok(dpl_flood_set_cell(flood, x, y, z, (int32_t)random_below(&seed, 4)));
        else if (lights[which].generation == 0)
            assert_ok(dpl_flood_add_light(flood, x, y, z, level, &lights[which]));
        else {
            assert_ok(dpl_flood_remove_light(flood, lights[which]));
            lights[which].generation = 0;
        }
        if (i % 3 == 0)
            assert_ok(dpl_flood_update(flood, NULL));
    }
    assert_ok(dpl_flood_update(flood, NULL));
}

static dpl_flood *busy_world(dpl_context *owner, dpl_flood_light lights[16]) {
    dpl_flood_desc desc = busy_desc();
    dpl_flood *flood;
    memset(lights, 0, 16 * sizeof *lights);
    assert_ok(dpl_flood_create(owner, &desc, &flood));
    live(flood, 400, 5, lights);
    return flood;
}

static uint8_t *save(dpl_flood *flood, size_t *size) {
    *size = dpl_flood_save_size(flood);
    uint8_t *bytes = malloc(*size);
    assert_non_null(bytes);
    assert_ok(dpl_flood_save(flood, bytes, *size));
    return bytes;
}

static void assert_same_light(dpl_flood *a, dpl_flood *b) {
    dpl_flood_desc desc = world_desc(a);
    uint16_t *one = read_world(a), *other = read_world(b);
    assert_memory_equal(one, other, world_cells(&desc) * (size_t)desc.channels * sizeof *one);
    free(one);
    free(other);
}

static void a_restored_world_is_the_same_and_lives_on_the_same(void **state) {
    (void)state;
    size_t size, again;
    dpl_flood_light lights[16];
    dpl_flood *flood = busy_world(context, lights), *restored;
    uint8_t *bytes = save(flood, &size);
    assert_ok(dpl_flood_restore(context, bytes, size, &restored));
    assert_same_light(flood, restored);
    uint8_t *twice = save(restored, &again);
    assert_int_equal(size, again);
    assert_memory_equal(bytes, twice, size);
    for (int i = 0; i < 16; i++) /* names of lights still hold */
        if (lights[i].generation) {
            assert_ok(dpl_flood_move_light(flood, lights[i], i % 12, 3, 3));
            assert_ok(dpl_flood_move_light(restored, lights[i], i % 12, 3, 3));
        }
    assert_ok(dpl_flood_update(flood, NULL));
    assert_ok(dpl_flood_update(restored, NULL));
    assert_same_light(flood, restored);
    free(bytes);
    free(twice);
    dpl_flood_destroy(flood);
    dpl_flood_destroy(restored);
}

static void edits_that_wait_for_an_update_are_saved(void **state) {
    (void)state;
    size_t size;
    dpl_flood_light lights[16];
    dpl_flood *flood = busy_world(context, lights), *restored;
    const uint16_t level[4] = {30000, 20000, 10000, 32767};
    dpl_flood_light light;
    assert_ok(dpl_flood_add_light(flood, 5, 5, 5, level, &light));
    assert_ok(dpl_flood_set_cell(flood, 5, 6, 5, 1));
    uint8_t *bytes = save(flood, &size);
    assert_ok(dpl_flood_restore(context, bytes, size, &restored));
    assert_ok(dpl_flood_update(flood, NULL));
    assert_same_light(flood, restored);
    free(bytes);
    dpl_flood_destroy(flood);
    dpl_flood_destroy(restored);
}

static void expect_refusal(const uint8_t *bytes, size_t size) {
    dpl_flood *restored = (dpl_flood *)(uintptr_t)bytes;
    /* An exact copy, so that a sanitizer sees a read past its end. */
    uint8_t *copy = malloc(size + (size == 0));
    assert_non_null(copy);
    memcpy(copy, bytes, size);
    assert_int_equal(dpl_flood_restore(context, copy, size, &restored), DPL_ERROR_ARGUMENT);
    assert_null(restored);
    assert_memory_equal(dpl_context_message(context), "saved world: ", 13);
    free(copy);
}

static void cut_or_damaged_bytes_are_refused(void **state) {
    (void)state;
    size_t size;
    dpl_flood_light lights[16];
    dpl_flood *flood = busy_world(context, lights);
    uint8_t *bytes = save(flood, &size);
    for (size_t cut = 0; cut < size; cut++)
        expect_refusal(bytes, cut);
    for (size_t i = 0; i < size; i++) {
        bytes[i] ^= (uint8_t)(1u << i % 8);
        expect_refusal(bytes, size);
        bytes[i] ^= (uint8_t)(1u << i % 8);
    }
    assert_int_equal(dpl_flood_save(flood, bytes, size - 1), DPL_ERROR_SIZE);
    free(bytes);
    dpl_flood_destroy(flood);
}

/* FNV-1a, as save.c has it: damage with a good checksum is a forgery. */
static void forge(uint8_t *bytes, size_t size) {
    uint64_t sum = UINT64_C(14695981039346656037);
    for (size_t i = 0; i + 8 < size; i++)
        sum = (sum ^ bytes[i]) * UINT64_C(1099511628211);
    for (size_t i = 0; i < 8; i++)
        bytes[size - 8 + i] = (uint8_t)(sum >> (8 * i));
}

static void forged_bytes_make_a_sound_world_or_none(void **state) {
    (void)state;
    size_t size;
    uint64_t seed = 77;
    dpl_flood_light lights[16];
    books b = {0};
    dpl_context *counted = context_with(&b);
    dpl_flood *flood = busy_world(counted, lights);
    uint8_t *bytes = save(flood, &size), *forged = malloc(size);
    assert_non_null(forged);
    int made = 0;
    for (int round = 0; round < 4000; round++) {
        memcpy(forged, bytes, size);
        for (uint32_t n = 1 + random_below(&seed, 3); n > 0; n--) {
            size_t at =
                random_below(&seed, 4) ? random_below(&seed, 200) : random_below(&seed, (uint32_t)size);
            forged[at] = (uint8_t)random_below(&seed, 256);
        }
        forge(forged, size);
        dpl_flood *restored, *fresh;
        b.most = b.bytes;
        int64_t before = b.bytes;
        dpl_status status = dpl_flood_restore(counted, forged, size, &restored);
        assert_true(b.most - before < (int64_t)size * 100 + (4 << 20));
        if (status != DPL_OK)
            continue;
        made++;
        size_t resaved;
        uint8_t *again = save(restored, &resaved);
        assert_ok(dpl_flood_restore(counted, again, resaved, &fresh));
        assert_same_light(restored, fresh);
        free(again);
        dpl_flood_destroy(restored);
        dpl_flood_destroy(fresh);
    }
    assert_true(made > 100);
    free(bytes);
    free(forged);
    dpl_flood_destroy(flood);
    dpl_context_destroy(counted);
    assert_int_equal(b.alive, 0);
}

/* ---- memory ---------------------------------------------------------------------------------------- */

static void nothing_is_allocated_after_creation_and_the_first_lights(void **state) {
    (void)state;
    books b = {0};
    dpl_flood_light lights[16];
    dpl_context *counted = context_with(&b);
    dpl_flood *flood = busy_world(counted, lights);
    int64_t calls = b.calls;
    live(flood, 3000, 6, lights);
    assert_ok(dpl_flood_solve(flood));
    assert_int_equal(b.calls, calls);
    dpl_flood_stats stats;
    dpl_flood_read_stats(flood, &stats);
    int64_t with = b.bytes;
    dpl_flood_destroy(flood);
    assert_int_equal(with - b.bytes, stats.memory_bytes);
    dpl_context_destroy(counted);
    assert_int_equal(b.alive, 0);
}

static void memory_may_run_out_at_any_allocation(void **state) {
    (void)state;
    books b = {0};
    size_t size;
    const uint16_t level[4] = {30000, 1, 2, 3};
    dpl_flood_light lights[16], light;
    dpl_context *counted = context_with(&b);
    dpl_flood *flood = busy_world(counted, lights), *other;
    uint8_t *bytes = save(flood, &size);
    dpl_flood_desc desc = busy_desc();
    int64_t alive = b.alive;
    int refused[2] = {0, 0};
    for (int what = 0; what < 2; what++) {
        for (b.allowed = 0;; b.allowed = ++refused[what]) {
            dpl_status status = what ? dpl_flood_restore(counted, bytes, size, &other)
                                     : dpl_flood_create(counted, &desc, &other);
            if (status == DPL_OK)
                break;
            assert_int_equal(status, DPL_ERROR_MEMORY);
            assert_null(other);
            assert_int_equal(b.alive, alive);
        }
        if (what == 0)
            dpl_flood_destroy(other);
    }
    assert_true(refused[0] >= 6 && refused[1] > refused[0]);
    b.allowed = 0;
    assert_int_equal(dpl_flood_solve_depth_first(other), DPL_ERROR_MEMORY);
    dpl_status status = DPL_OK; /* more lights than there is room for: the world goes on without */
    for (int i = 0; i < 100 && status == DPL_OK; i++)
        status = dpl_flood_add_light(flood, i % 12, 2, 2, level, &light);
    assert_int_equal(status, DPL_ERROR_MEMORY);
    assert_ok(dpl_flood_update(flood, NULL));
    b.allowed = -1;
    assert_ok(dpl_flood_add_light(flood, 3, 3, 3, level, &light));
    assert_ok(dpl_flood_update(flood, NULL));
    assert_true(level_at(flood, 3, 3, 3) >= 30000);
    free(bytes);
    dpl_flood_destroy(flood);
    dpl_flood_destroy(other);
    dpl_context_destroy(counted);
    assert_int_equal(b.alive, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_restored_world_is_the_same_and_lives_on_the_same),
        cmocka_unit_test(edits_that_wait_for_an_update_are_saved),
        cmocka_unit_test(cut_or_damaged_bytes_are_refused),
        cmocka_unit_test(forged_bytes_make_a_sound_world_or_none),
        cmocka_unit_test(nothing_is_allocated_after_creation_and_the_first_lights),
        cmocka_unit_test(memory_may_run_out_at_any_allocation),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
