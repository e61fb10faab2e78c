/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cables that hang while every allocation fails in turn: the call says so and leaves nothing, or
 * has the right shape. */
#include <malloc.h>
#include <stdlib.h>

#include "cable/lines.h"

static long allocations, failing = -1; /* count, and number of the one that fails (-1: none) */

static bool refuse_memory(void)
{
    return allocations++ == failing;
}

#include "failing_memory.h"

static void each_in_turn(const line *l)
{
    strum_hanging *cable;
    strum_error error;
    failing = -1;
    allocations = 0;
    cable = hang(l);
    const long all = allocations;
    const strum_cable_statics right = statics_of(cable);
    strum_cable_free(cable);
    const size_t before = mallinfo2().uordblks;
    assert_true(all >= 2);
    for (failing = 0; failing < all; failing++) {
        allocations = 0;
        const strum_status status = strum_cable_hang(&l->params, NULL, &cable, &error);
        if (status == STRUM_OK) {
            assert_true(statics_of(cable).horizontal_end_1 == right.horizontal_end_1);
            strum_cable_free(cable);
        } else {
            assert_int_equal(status, STRUM_ERR_MEMORY);
            assert_int_equal(error.status, STRUM_ERR_MEMORY);
            assert_null(cable);
        }
    }
    failing = -1;
    assert_true(mallinfo2().uordblks == before);
}

static const part parts[] = {{60, 80, 4e6}, {50, 35, 1e6}};
static const load loads[] = {{25, 900, 100, 0}, {80, -200, 0, 0}};

static void free_line(void **state)
{
    (void)state;
    line l;
    make_line(&l, 100, 10, 2, parts, 2, loads);
    each_in_turn(&l);
}

static void given_tension(void **state)
{
    (void)state;
    line l;
    make_line(&l, 100, 10, 2, parts, 1, loads);
    l.params.adjusted = 1;
    l.params.given = STRUM_CABLE_TENSION_END_2;
    l.params.value = 9000;
    l.params.taken_in = 0.01;
    each_in_turn(&l);
}

static void on_a_bed(void **state)
{
    (void)state;
    line l;
    make_line(&l, 100, 10, 2, parts, 0, loads);
    l.params.bed = (strum_cable_bed){true, 0, 0, 0.5};
    each_in_turn(&l);
}

static void stiff(void **state)
{
    (void)state;
    line l;
    make_line(&l, 100, 10, 2, parts, 2, loads);
    l.sections[0].bending_stiffness = 1000;
    l.sections[1].bending_stiffness = 100;
    l.params.stiff = true;
    each_in_turn(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(free_line),
        cmocka_unit_test(given_tension),
        cmocka_unit_test(on_a_bed),
        cmocka_unit_test(stiff),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
