/* The skip modes: the paper's table and code, the shares of rays they leave out, and where scores change the
 * mode. Shares are counted here ray by ray, not taken from the library. */
#include "testing.h"

#include <dapple/schedule.h>
#include <dapple/skip.h>

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { PAPER_LEVELS = 5, TABLE_LEVELS = 6, BOTTOM_RAYS = 16 };

static const dpl_skip_mode fixed_modes[] = {DPL_SKIP_OFF, DPL_SKIP_L5, DPL_SKIP_L4, DPL_SKIP_L3, DPL_SKIP_L2};

static dpl_skip_rule rule_of(dpl_skip_mode mode) {
    dpl_skip_rule rule;
    assert_ok(dpl_skip_rule_of(mode, &rule));
    return rule;
}

static void assert_rule(dpl_skip_mode mode, int32_t start, int32_t bits) {
    const dpl_skip_rule rule = rule_of(mode);
    assert_int_equal(rule.start_level, start);
    assert_int_equal(rule.max_bits, bits);
}

static void modes_are_the_papers_start_and_bits(void **state) {
    (void)state;
    assert_rule(DPL_SKIP_OFF, 0, 0);
    assert_rule(DPL_SKIP_L5, 4, 2); /* { startLevel: 4, maxSkip: 2 } */
    assert_rule(DPL_SKIP_L4, 3, 1); /* { startLevel: 3, maxSkip: 1 } */
    assert_rule(DPL_SKIP_L3, 3, 2); /* { startLevel: 3, maxSkip: 2 } */
    assert_rule(DPL_SKIP_L2, 2, 2);
}

static void factors_are_those_of_the_papers_table(void **state) {
    (void)state;
    static const struct {
        dpl_skip_mode mode;
        int32_t factors[TABLE_LEVELS];
    } table[] = {
        {DPL_SKIP_OFF, {1, 1, 1, 1, 1, 1}}, {DPL_SKIP_L5, {1, 1, 1, 1, 2, 4}},
        {DPL_SKIP_L4, {1, 1, 1, 2, 2, 2}},  {DPL_SKIP_L3, {1, 1, 1, 2, 4, 4}},
        {DPL_SKIP_L2, {1, 1, 2, 4, 4, 4}},
    };
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++)
        for (int32_t level = 0; level < TABLE_LEVELS; level++)
            assert_int_equal(dpl_skip_factor(rule_of(table[i].mode), level), table[i].factors[level]);
}

/* The paper's shader: 1 below start, else 1 << min(level - start + 1, bits). */
static void factors_are_those_of_the_papers_code(void **state) {
    (void)state;
    for (int32_t start = 0; start <= 6; start++)
        for (int32_t bits = 0; bits <= 2; bits++)
            for (int32_t level = 0; level <= 10; level++) {
                const int32_t grown = level - start + 1;
                const int32_t step = level < start ? 1 : 1 << (grown < bits ? grown : bits);
                assert_int_equal(dpl_skip_factor((dpl_skip_rule){start, bits}, level), step);
            }
}

/* ---- shares of rays ------------------------------------------------------------------------------- */

/* Share of rays left out of `levels` levels with as many rays each: of four sub-rays every f-th is traced. */
static double share_left_out(dpl_skip_mode mode, int32_t levels) {
    int32_t traced = 0;
    for (int32_t level = 0; level < levels; level++)
        for (int32_t ray = 0; ray < 4; ray += dpl_skip_factor(rule_of(mode), level))
            traced++;
    return 1.0 - (double)traced / (4.0 * levels);
}

static void assert_share(double share, double percent) {
    assert_true(fabs(100.0 * share - percent) < 0.05);
}

static void five_levels_of_equal_rays_lose_10_20_25_40_percent(void **state) {
    (void)state;
    assert_share(share_left_out(DPL_SKIP_OFF, PAPER_LEVELS), 0.0);
    assert_share(share_left_out(DPL_SKIP_L5, PAPER_LEVELS), 10.0);
    assert_share(share_left_out(DPL_SKIP_L4, PAPER_LEVELS), 20.0); /* not the 17 % that the paper prints */
    assert_share(share_left_out(DPL_SKIP_L3, PAPER_LEVELS), 25.0);
    assert_share(share_left_out(DPL_SKIP_L2, PAPER_LEVELS), 40.0);
}

/* The paper's table has six levels; its totals belong to five. */
static void six_levels_of_equal_rays_lose_other_shares(void **state) {
    (void)state;
    assert_share(share_left_out(DPL_SKIP_L5, TABLE_LEVELS), 20.8);
    assert_share(share_left_out(DPL_SKIP_L4, TABLE_LEVELS), 25.0);
    assert_share(share_left_out(DPL_SKIP_L3, TABLE_LEVELS), 33.3);
}

/* Share of rays left out when rays of slots that nobody reads go too, with the first ray of a group standing
 * for it. The pixels read all slots of level 0; ray r of a level reads slot r of the level above; slot s is
 * made of rays 4s .. 4s+3. All levels have as many rays, so a level's share of probes does not matter. */
static double share_left_out_with_dead(dpl_skip_mode mode) {
    int32_t slots = BOTTOM_RAYS / DPL_BRANCHING;
    bool *read = malloc((size_t)slots * sizeof *read);
    assert_non_null(read);
    for (int32_t slot = 0; slot < slots; slot++)
        read[slot] = true;
    double traced_share = 0.0;
    for (int32_t level = 0; level < PAPER_LEVELS; level++) {
        const int32_t rays = DPL_BRANCHING * slots;
        bool *read_above = calloc((size_t)rays, sizeof *read_above);
        assert_non_null(read_above);
        int32_t traced = 0;
        for (int32_t slot = 0; slot < slots; slot++)
            for (int32_t ray = 0; read[slot] && ray < 4; ray += dpl_skip_factor(rule_of(mode), level)) {
                read_above[4 * slot + ray] = true;
                traced++;
            }
        traced_share += (double)traced / rays;
        free(read);
        read = read_above;
        slots = rays;
    }
    free(read);
    return 1.0 - traced_share / PAPER_LEVELS;
}

static void dropping_dead_rays_saves_up_to_46_9_percent(void **state) {
    (void)state;
    assert_share(share_left_out_with_dead(DPL_SKIP_OFF), 0.0);
    assert_share(share_left_out_with_dead(DPL_SKIP_L5), 10.0);
    assert_share(share_left_out_with_dead(DPL_SKIP_L4), 25.0);
    assert_share(share_left_out_with_dead(DPL_SKIP_L3), 27.5);
    assert_share(share_left_out_with_dead(DPL_SKIP_L2), 46.9);
}

/* ---- robustness ----------------------------------------------------------------------------------- */

static void any_rule_and_level_give_1_2_or_4(void **state) {
    (void)state;
    const int32_t numbers[] = {
        INT32_MIN, INT32_MIN + 1, -100,     -1, 0, 1, 2, 3, 4, 5, 30, 31, 32, 33, 63, 64,
        65,        INT32_MAX - 1, INT32_MAX};
    const size_t count = sizeof numbers / sizeof numbers[0];
    for (size_t i = 0; i < count * count * count; i++) {
        const int32_t start = numbers[i % count], bits = numbers[i / count % count];
        const int32_t level = numbers[i / count / count];
        const int32_t factor = dpl_skip_factor((dpl_skip_rule){start, bits}, level);
        assert_true(factor == 1 || factor == 2 || factor == 4);
        if (level < 0 || level < start || bits <= 0)
            assert_int_equal(factor, 1);
    }
    assert_int_equal(dpl_skip_factor((dpl_skip_rule){0, 2}, INT32_MAX), 4);
    assert_int_equal(dpl_skip_factor((dpl_skip_rule){INT32_MAX, 2}, INT32_MAX), 2);
    assert_int_equal(dpl_skip_factor((dpl_skip_rule){0, -1}, 3), 1);
    assert_int_equal(dpl_skip_factor((dpl_skip_rule){0, 64}, 3), 4); /* a slot has four rays */
}

static void modes_without_a_rule_of_their_own_are_refused(void **state) {
    (void)state;
    dpl_skip_rule rule = {7, 8};
    const int numbers[] = {DPL_SKIP_AUTO, DPL_SKIP_CUSTOM, DPL_SKIP_EXACT, DPL_SKIP_BOUNDED, 9, 1000, -1};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
        assert_int_equal(dpl_skip_rule_of((dpl_skip_mode)numbers[i], &rule), DPL_ERROR_ARGUMENT);
    for (size_t i = 0; i < sizeof fixed_modes / sizeof fixed_modes[0]; i++)
        assert_int_equal(dpl_skip_rule_of(fixed_modes[i], NULL), DPL_ERROR_ARGUMENT);
    assert_int_equal(rule.start_level, 7);
    assert_int_equal(rule.max_bits, 8);
}

/* ---- choice --------------------------------------------------------------------------------------- */

static void scores_change_the_mode_at_045_and_100(void **state) {
    (void)state;
    static const double paper[2] = {0.45, 1.00};
    static const struct {
        double score;
        dpl_skip_mode mode;
    } cases[] = {
        {0.0, DPL_SKIP_L5},  {0.33, DPL_SKIP_L5},  {0.45 - 1e-15, DPL_SKIP_L5},
        {0.45, DPL_SKIP_L4}, {0.999, DPL_SKIP_L4}, {1.0 - 1e-15, DPL_SKIP_L4},
        {1.0, DPL_SKIP_L3},  {1e300, DPL_SKIP_L3}, {-1.0, DPL_SKIP_L5},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_int_equal(dpl_skip_choose(cases[i].score, paper), cases[i].mode);
        assert_int_equal(dpl_skip_choose(cases[i].score, (const double[2]){0.0, 0.0}), cases[i].mode);
        assert_int_equal(dpl_skip_choose(cases[i].score, NULL), cases[i].mode);
    }
}

static void own_thresholds_are_obeyed(void **state) {
    (void)state;
    const double own[2] = {2.0, 3.0};
    assert_int_equal(dpl_skip_choose(1.5, own), DPL_SKIP_L5);
    assert_int_equal(dpl_skip_choose(2.0, own), DPL_SKIP_L4);
    assert_int_equal(dpl_skip_choose(3.0, own), DPL_SKIP_L3);
}

static void a_score_that_is_no_number_skips_least(void **state) {
    (void)state;
    assert_int_equal(dpl_skip_choose((double)NAN, (const double[2]){0.45, 1.0}), DPL_SKIP_L5);
}

static void modes_have_the_names_of_the_command_line(void **state) {
    (void)state;
    const char *const names[] = {"off", "L5", "L4", "L3", "L2", "auto", "custom", "exact", "bounded", "?"};
    for (int mode = 0; mode < 10; mode++)
        assert_string_equal(dpl_skip_mode_name((dpl_skip_mode)mode), names[mode]);
    assert_string_equal(dpl_skip_mode_name((dpl_skip_mode)-1), "?");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(modes_are_the_papers_start_and_bits),
        cmocka_unit_test(factors_are_those_of_the_papers_table),
        cmocka_unit_test(factors_are_those_of_the_papers_code),
        cmocka_unit_test(five_levels_of_equal_rays_lose_10_20_25_40_percent),
        cmocka_unit_test(six_levels_of_equal_rays_lose_other_shares),
        cmocka_unit_test(dropping_dead_rays_saves_up_to_46_9_percent),
        cmocka_unit_test(any_rule_and_level_give_1_2_or_4),
        cmocka_unit_test(modes_without_a_rule_of_their_own_are_refused),
        cmocka_unit_test(scores_change_the_mode_at_045_and_100),
        cmocka_unit_test(own_thresholds_are_obeyed),
        cmocka_unit_test(a_score_that_is_no_number_skips_least),
        cmocka_unit_test(modes_have_the_names_of_the_command_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
