/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of a JSON text by pointers. Expected values are those of RFC 6901, read by hand. */
#include "check.h"

#include <string.h>

#include "json/pick.h"
#include "json/strbuf.h"

static const char text[] =
    "{\"a\":1.50,\"b\":{\"c\":[10,{\"d\":\"}]\\\",{\"},[[],[1,[2,-3e-7]]]],\"\":\"empty\"},"
    " \"e/f\" : true ,\"g~h\":null,\"i\":\"\\\\\",\"j\":{},\"k\":[ ] , \"bc\": \"not b\"}";

/* Where nothing is expected, what lies on the way and the part of the pointer that leads there. */
typedef struct row {
    const char *pointer, *value, *inside, *led;
} row;

static const row rows[] = {
    {.pointer = "/a", .value = "1.50"},
    {.pointer = "/b/c", .value = "[10,{\"d\":\"}]\\\",{\"},[[],[1,[2,-3e-7]]]]"},
    {.pointer = "/b/c/0", .value = "10"},
    {.pointer = "/b/c/1/d", .value = "\"}]\\\",{\""},
    {.pointer = "/b/c/2/1/1/1", .value = "-3e-7"},
    {.pointer = "/b/c/2/0", .value = "[]"},
    {.pointer = "/b/", .value = "\"empty\""},
    {.pointer = "/e~1f", .value = "true"},
    {.pointer = "/g~0h", .value = "null"},
    {.pointer = "/i", .value = "\"\\\\\""},
    {.pointer = "/j", .value = "{}"},
    {.pointer = "/k", .value = "[ ]"},
    {.pointer = "/bc", .value = "\"not b\""},
    {.pointer = "/b/c/3",
     .inside = "[10,{\"d\":\"}]\\\",{\"},[[],[1,[2,-3e-7]]]]",
     .led = "/b/c"},
    {.pointer = "/b/c/01",
     .inside = "[10,{\"d\":\"}]\\\",{\"},[[],[1,[2,-3e-7]]]]",
     .led = "/b/c"},
    {.pointer = "/b/c/-",
     .inside = "[10,{\"d\":\"}]\\\",{\"},[[],[1,[2,-3e-7]]]]",
     .led = "/b/c"},
    {.pointer = "/b/c/9999999999999999999",
     .inside = "[10,{\"d\":\"}]\\\",{\"},[[],[1,[2,-3e-7]]]]",
     .led = "/b/c"},
    {.pointer = "/j/x", .inside = "{}", .led = "/j"},
    {.pointer = "/k/0", .inside = "[ ]", .led = "/k"},
    {.pointer = "/a/x", .inside = "1.50", .led = "/a"},
    {.pointer = "/i/0", .inside = "\"\\\\\"", .led = "/i"},
    {.pointer = "/e~1f/x/y", .inside = "true", .led = "/e~1f"},
    {.pointer = "/e", .inside = text, .led = ""},
    {.pointer = "/e/f", .inside = text, .led = ""},
    {.pointer = "/", .inside = text, .led = ""},
    {.pointer = "/abc", .inside = text, .led = ""},
    {.pointer = "", .value = text},
};
enum { ROWS = sizeof rows / sizeof *rows };

static void expect_row(const row *r, const json_pick *p)
{
    if (r->value != NULL) {
        assert_non_null(p->value);
        assert_int_equal(p->size, strlen(r->value));
        assert_memory_equal(p->value, r->value, p->size);
        return;
    }
    assert_null(p->value);
    assert_int_equal(p->inside_size, strlen(r->inside));
    assert_memory_equal(p->inside, r->inside, p->inside_size);
    assert_int_equal(p->inside_pointer, strlen(r->led));
    assert_memory_equal(p->pointer, r->led, p->inside_pointer);
}

static void each_alone(void **state)
{
    (void)state;
    for (int i = 0; i < ROWS; i++) {
        json_pick one = {.pointer = rows[i].pointer};
        json_pick_all(text, sizeof text - 1, &one, 1);
        expect_row(&rows[i], &one);
    }
}

static void all_together(void **state)
{
    (void)state;
    json_pick picks[ROWS];
    for (int i = 0; i < ROWS; i++)
        picks[i] = (json_pick){.pointer = rows[i].pointer};
    json_pick_all(text, sizeof text - 1, picks, ROWS);
    for (int i = 0; i < ROWS; i++)
        expect_row(&rows[i], &picks[i]);
}

static void as_many_as_there_may_be(void **state)
{
    (void)state;
    json_pick picks[JSON_PICKS_MAX];
    for (int i = 0; i < JSON_PICKS_MAX; i++)
        picks[i] = (json_pick){.pointer = rows[i % ROWS].pointer};
    json_pick_all(text, sizeof text - 1, picks, JSON_PICKS_MAX);
    for (int i = 0; i < JSON_PICKS_MAX; i++)
        expect_row(&rows[i % ROWS], &picks[i]);
}

static void pointers_are_checked(void **state)
{
    (void)state;
    const char *good[] = {"", "/", "/a/b", "/~0~1", "//", "/a~0"};
    const char *bad[] = {"a", "#/a", "/~", "/~2", "/a~/b", " /a"};
    for (size_t i = 0; i < sizeof good / sizeof *good; i++)
        assert_true(json_pointer_valid(good[i]));
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_false(json_pointer_valid(bad[i]));
}

static bool note(void *context, const char *name, size_t size)
{
    strbuf_format(context, "%.*s;", (int)size, name != NULL ? name : "");
    return true;
}

static void children_are_told(void **state)
{
    (void)state;
    const char *texts[] = {text, "[1,[2,3],{\"a\":4}]", " {} ", "[]", "7", "\"{\"", ""};
    const char *told[] = {"a;b;e/f;g~h;i;j;k;bc;", ";;;", NULL, NULL, NULL, NULL, NULL};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        strbuf got = {0};
        json_children(texts[i], strlen(texts[i]), note, &got);
        if (told[i] == NULL)
            assert_null(got.data);
        else
            assert_string_equal(got.data, told[i]);
        strbuf_clear(&got);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_alone),
        cmocka_unit_test(all_together),
        cmocka_unit_test(as_many_as_there_may_be),
        cmocka_unit_test(pointers_are_checked),
        cmocka_unit_test(children_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
