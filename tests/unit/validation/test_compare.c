/* SPDX-License-Identifier: GPL-3.0-or-later */
/* compare_answer must see every way in which an answer can miss what a case expects. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "validation/compare.h"

static const char answer[] =
    "{\"a\":1.5,\"s\":\"x\",\"list\":[{\"f\":1},{\"f\":2}],\"z\":{\"re\":3,\"im\":4},"
    "\"modes\":[{\"d\":3,\"w\":4}],\"plain\":[10,20,30],\"t~/x\":7}";

/* Number of values compared that miss; -1: nothing was compared. */
static int missed(const char *checks)
{
    cJSON *want = cJSON_Parse(checks), *got = cJSON_Parse(answer);
    assert_non_null(want);
    strbuf out = {0};
    json_writer rows = {.out = &out};
    comparison c = {.rows = &rows};
    compare_answer(want, got, &c);
    assert_false(c.failed);
    assert_false(out.failed);
    cJSON_Delete(want);
    cJSON_Delete(got);
    strbuf_clear(&out);
    return c.values ? (int)c.missed : -1;
}

#define CHECK(kind, pointer, rest)                                                             \
    "[{\"kind\":\"" kind "\",\"pointer\":\"" pointer "\"," rest "}]"

static void test_single_values(void **state)
{
    (void)state;
    assert_int_equal(missed(CHECK("value", "/a", "\"want\":[1.5],\"allowed\":[null]")), 0);
    assert_int_equal(missed(CHECK("value", "/a", "\"want\":[1.51],\"allowed\":[null]")), 1);
    assert_int_equal(missed(CHECK("value", "/a", "\"want\":[1.51],\"allowed\":[0.011]")), 0);
    assert_int_equal(missed(CHECK("value", "/a", "\"want\":[1.51],\"allowed\":[0.009]")), 1);
    /* One unit in the last place is another number. */
    assert_int_equal(
        missed(CHECK("value", "/a", "\"want\":[1.5000000000000002],\"allowed\":[null]")), 1);
    assert_int_equal(missed(CHECK("value", "/s", "\"want\":[\"x\"],\"allowed\":[null]")), 0);
    assert_int_equal(missed(CHECK("value", "/s", "\"want\":[\"y\"],\"allowed\":[null]")), 1);
    assert_int_equal(missed(CHECK("value", "/none", "\"want\":[1],\"allowed\":[1]")), 1);
    assert_int_equal(missed(CHECK("value", "/t~0~1x", "\"want\":[7],\"allowed\":[0]")), 0);
    assert_int_equal(
        missed(CHECK("value", "/z", "\"want\":[{\"re\":3,\"im\":4.1}],\"allowed\":[0.11]")), 0);
    assert_int_equal(
        missed(CHECK("value", "/z", "\"want\":[{\"re\":3,\"im\":4.1}],\"allowed\":[0.09]")), 1);
    assert_int_equal(missed(CHECK("value", "/list/1/f", "\"want\":[2],\"allowed\":[0]")), 0);
}

static void test_lists(void **state)
{
    (void)state;
    assert_int_equal(missed(CHECK("values", "/list/*/f", "\"want\":[1,2],\"allowed\":[0,0]")),
                     0);
    assert_int_equal(missed(CHECK("values", "/list/*/f", "\"want\":[2,1],\"allowed\":[0,0]")),
                     2);
    assert_int_equal(missed(CHECK("values", "/list/*/f", "\"want\":[1],\"allowed\":[0]")), 1);
    assert_int_equal(
        missed(CHECK("values", "/list/*/f", "\"want\":[1,2,3],\"allowed\":[0,0,0]")), 1);
    assert_int_equal(
        missed(CHECK("values", "/plain", "\"want\":[10,20,30],\"allowed\":[0,0,0]")), 0);
    assert_int_equal(missed(CHECK("values", "/a", "\"want\":[1.5],\"allowed\":[0]")), 1);
    assert_int_equal(missed(CHECK("values", "/modes/*",
                                  "\"members\":[\"d\",\"w\"],\"want\":[{\"re\":3,\"im\":4}],"
                                  "\"allowed\":[0]")),
                     0);
    assert_int_equal(missed(CHECK("matches", "/plain", "\"want\":[30,10],\"allowed\":[0,0]")),
                     0);
    /* Each beside another one: 10 cannot stand for both. */
    assert_int_equal(missed(CHECK("matches", "/plain", "\"want\":[10,10],\"allowed\":[1,1]")),
                     1);
    assert_int_equal(missed(CHECK("matches", "/plain", "\"want\":[11],\"allowed\":[0.5]")), 1);
}

static void test_bounds(void **state)
{
    (void)state;
    assert_int_equal(missed(CHECK("below", "/a", "\"want\":[1.6]")), 0);
    assert_int_equal(missed(CHECK("below", "/a", "\"want\":[1.5]")), 1);
    assert_int_equal(missed(CHECK("below", "/s", "\"want\":[1.5]")), 1);
    assert_int_equal(missed(CHECK("above", "/a", "\"want\":[1.4]")), 0);
    assert_int_equal(missed(CHECK("above", "/none", "\"want\":[1.4]")), 1);
    assert_int_equal(missed(CHECK("count", "/list", "\"want\":[2]")), 0);
    assert_int_equal(missed(CHECK("count", "/list/*/f", "\"want\":[2]")), 0);
    assert_int_equal(missed(CHECK("count", "/list", "\"want\":[3]")), 1);
    assert_int_equal(missed(CHECK("count", "/none", "\"want\":[0]")), 1);
    assert_int_equal(missed(CHECK("absent", "/none", "\"want\":[true]")), 0);
    assert_int_equal(missed(CHECK("absent", "/a", "\"want\":[true]")), 1);
}

static void test_up_to_scale(void **state)
{
    (void)state;
    const char *scaled = "[{\"kind\":\"up_to_scale\",\"parts\":[" /* 10, 20, 30 by -0.1 */
                         "{\"kind\":\"values\",\"pointer\":\"/plain\",\"want\":[-1,-2,-3],"
                         "\"allowed\":[1e-12,1e-12,1e-12]}]}]";
    assert_int_equal(missed(scaled), 0);
    const char *bent = "[{\"kind\":\"up_to_scale\",\"parts\":["
                       "{\"kind\":\"values\",\"pointer\":\"/plain\",\"want\":[-1,-2,-3.1],"
                       "\"allowed\":[1e-3,1e-3,1e-3]}]}]";
    assert_int_equal(missed(bent), 3);
}

static void test_nothing_is_not_success(void **state)
{
    (void)state;
    assert_int_equal(missed("[]"), -1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_single_values), cmocka_unit_test(test_lists),
        cmocka_unit_test(test_bounds), cmocka_unit_test(test_up_to_scale),
        cmocka_unit_test(test_nothing_is_not_success)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
