/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Guarded reading: what RFC 8259 allows is read, what it forbids, what I-JSON (RFC 7493)
 * discourages and what is beyond the limits is refused, with the place. */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "json/read.h"

static const json_limits roomy = {.depth = 16, .values = 100000};

static cJSON *accept(const char *json)
{
    problem p = {0};
    cJSON *document;
    if (!json_read(json, strlen(json), &roomy, &document, &p))
        fail_msg("%s: %s", json, p.detail != NULL ? p.detail : p.entries[0].detail);
    assert_int_equal(p.status, 0);
    return document;
}

static void refuse_bytes(const char *json, size_t size, const json_limits *limits, int status,
                         const char *detail)
{
    problem p = {0};
    cJSON *document;
    if (json_read(json, size, limits, &document, &p))
        fail_msg("accepted: %s", json);
    assert_null(document);
    assert_int_equal(p.status, status);
    if (p.detail == NULL || strcmp(p.detail, detail) != 0)
        fail_msg("%s: got \"%s\", want \"%s\"", json, p.detail, detail);
    problem_clear(&p);
}

#define NOT_JSON "the body is not JSON: "

static void refuse(const char *json, const char *detail)
{
    strbuf whole = {0};
    strbuf_format(&whole, NOT_JSON "%s", detail);
    refuse_bytes(json, strlen(json), &roomy, 400, whole.data);
    strbuf_clear(&whole);
}

static void documents_are_read(void **state)
{
    (void)state;
    const char *const documents[] = {
        "null",
        " true ",
        "\"\"",
        "0",
        "-0",
        "{}",
        "[]",
        "\t[ ]\r\n",
        "{\"\":0}",
        "[1,2 , 3]",
        "{\"a\":{\"b\":[[],{}]},\"c\":null}",
        "\"\\\"\\\\\\/\\b\\f\\n\\r\\t\"",
        "\"\\u00e9\\uD83D\\uDE00\"",
        "\"\xC3\xA9\x7f\"",
        "[[[[[[[[[[[[[[[[]]]]]]]]]]]]]]]]",
    };
    for (size_t i = 0; i < sizeof documents / sizeof documents[0]; i++)
        cJSON_Delete(accept(documents[i]));
    cJSON *smile = accept("\"\\u00e9\\uD83D\\uDE00\"");
    assert_string_equal(smile->valuestring, "\xC3\xA9\xF0\x9F\x98\x80");
    cJSON_Delete(smile);
}

static void numbers_are_read_exactly(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double value;
    } numbers[] = {
        {"0", 0},
        {"-0", 0},
        {"-0.0e-7", 0},
        {"1E+2", 100},
        {"1e2", 100},
        {"0.1", 0x1.999999999999ap-4},
        {"1.7976931348623157e308", 0x1.fffffffffffffp1023},
        {"1.7976931348623158e308", 0x1.fffffffffffffp1023}, /* still rounds to the largest */
        {"5e-324", 0x1p-1074},
        {"1e-400", 0},
        {"9007199254740993", 0x1p53},
        /* Python's float() of the exact fractions: half way between two doubles, and just above */
        {"1.00000000000000011102230246251565404236316680908203125", 1},
        {"1.000000000000000111022302462515654042363166809082031250000000000000000000001",
         0x1.0000000000001p0},
        {"123456789012345678901234567890123456789012345678901234567890123",
         0x1.334f346c75fb6p+206},
        {"1234567890123456789012345678901234567890123456789012345678901234",
         0x1.80230187937a3p+209},
        {"-0.00000000000000000000000000000000000000000000000000000000000000000000001e71", -1},
    };
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        cJSON *number = accept(numbers[i].text);
        assert_true(number->valuedouble == numbers[i].value);
        cJSON_Delete(number);
    }
}

static void bad_documents_are_refused(void **state)
{
    (void)state;
    refuse("", "the body is empty, at line 1, column 1 (byte 0)");
    refuse(" \n ", "the body is empty, at line 2, column 2 (byte 3)");
    refuse("\xEF\xBB\xBF{}",
           "a byte order mark: send plain UTF-8, at line 1, column 1 (byte 0)");
    refuse("{}x", "something follows the document, at line 1, column 3 (byte 2)");
    refuse("[] []", "something follows the document, at line 1, column 4 (byte 3)");
    refuse("[1,]", "expected a value, at line 1, column 4 (byte 3)");
    refuse("[1 2]", "expected ',' or ']' in an array, at line 1, column 4 (byte 3)");
    refuse("[1", "expected ',' or ']' in an array, at line 1, column 3 (byte 2)");
    refuse("[1}", "expected ',' or ']' in an array, at line 1, column 3 (byte 2)");
    refuse("{\n \"a\": 1,\n}",
           "expected a member name in double quotes, at line 3, column 1 (byte 11)");
    refuse("{a:1}", "expected a member name in double quotes, at line 1, column 2 (byte 1)");
    refuse("{\"a\"=1}", "expected ':' after a member name, at line 1, column 5 (byte 4)");
    refuse("{\"a\":1;}", "expected ',' or '}' in an object, at line 1, column 7 (byte 6)");
    refuse("{\"a\":", "the document ends too soon, at line 1, column 6 (byte 5)");
    refuse("[\"a]", "the document ends inside a string, at line 1, column 5 (byte 4)");
    refuse("nul", "expected a value, at line 1, column 1 (byte 0)");
    refuse("nulll", "something follows the document, at line 1, column 5 (byte 4)");
    refuse("True", "expected a value, at line 1, column 1 (byte 0)");
    refuse("'a'", "expected a value, at line 1, column 1 (byte 0)");
    refuse("[NaN]", "expected a value, at line 1, column 2 (byte 1)");
    refuse("[Infinity]", "expected a value, at line 1, column 2 (byte 1)");
    refuse("/**/1", "expected a value, at line 1, column 1 (byte 0)");
    refuse("[1\f]", "expected ',' or ']' in an array, at line 1, column 3 (byte 2)");
    refuse("[\xC2\xA0"
           "1]",
           "expected a value, at line 1, column 2 (byte 1)");
    /* columns count characters, bytes count bytes */
    refuse("{\"\xC3\xA9\xE2\x82\xAC\" 1}",
           "expected ':' after a member name, at line 1, column 7 (byte 9)");
    refuse_bytes("[\0]", 3, &roomy, 400,
                 NOT_JSON "expected a value, at line 1, column 2 (byte 1)");
    refuse_bytes("1\0", 2, &roomy, 400,
                 NOT_JSON "something follows the document, at line 1, column 2 (byte 1)");
    refuse_bytes("\"a\0b\"", 5, &roomy, 400,
                 NOT_JSON "a control character in a string: escape it, at line 1, column 3 "
                          "(byte 2)");
}

/* They are shortened before they are read: nothing else may change. */
static void long_numbers_stand_where_they_stood(void **state)
{
    (void)state;
    cJSON *list = accept(
        "[\"1234567890123456789012345678901234567890123456789012345678901234567890\\\"-1\","
        "0.1000000000000000055511151231257827021181583404541015625000000000000000,-3e0,"
        "{\"9\":-10000000000000000000000000000000000000000000000000000000000000000000e-67}]");
    assert_string_equal(
        cJSON_GetArrayItem(list, 0)->valuestring,
        "1234567890123456789012345678901234567890123456789012345678901234567890\"-1");
    assert_true(cJSON_GetArrayItem(list, 1)->valuedouble == 0.1);
    assert_true(cJSON_GetArrayItem(list, 2)->valuedouble == -3);
    assert_true(cJSON_GetArrayItem(list, 3)->child->valuedouble == -1);
    cJSON_Delete(list);
}

static void bad_numbers_are_refused(void **state)
{
    (void)state;
    static const char *const numbers[] = {"01", "-01", "00",  "1.",  "-",  "-.5", "1.e3",
                                          "1e", "1e+", "1E-", "--1", "-a", "1.x", "-Infinity"};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
        refuse(numbers[i], "not a number as JSON writes it, at line 1, column 1 (byte 0)");
    refuse("[0x10]", "expected ',' or ']' in an array, at line 1, column 3 (byte 2)");
    refuse("[1_0]", "expected ',' or ']' in an array, at line 1, column 3 (byte 2)");
    refuse("+1", "expected a value, at line 1, column 1 (byte 0)");
    refuse(".5", "expected a value, at line 1, column 1 (byte 0)");
    refuse("[1, 12345678901234567890123456789012345678901234567890123456789012345.]",
           "not a number as JSON writes it, at line 1, column 5 (byte 4)");
}

static void bad_strings_are_refused(void **state)
{
    (void)state;
    refuse("\"\\x\"", "no such escape in a string, at line 1, column 2 (byte 1)");
    refuse("\"\\u12g4\"", "no such escape in a string, at line 1, column 2 (byte 1)");
    refuse("\"\\u123", "no such escape in a string, at line 1, column 2 (byte 1)");
    refuse("\"\\", "no such escape in a string, at line 1, column 2 (byte 1)");
    refuse("\"a\\u0000\"", "\\u0000 is not allowed in a string, at line 1, column 3 (byte 2)");
    refuse("\"\\uD800\"", "a lone surrogate in a string, at line 1, column 2 (byte 1)");
    refuse("\"\\uDC00\\uD800\"", "a lone surrogate in a string, at line 1, column 2 (byte 1)");
    refuse("\"\\uD800\\u0041\"", "a lone surrogate in a string, at line 1, column 2 (byte 1)");
    refuse("\"a\nb\"",
           "a control character in a string: escape it, at line 1, column 3 (byte 2)");
    refuse("\"\xFF\"", "bytes that are not UTF-8, at line 1, column 2 (byte 1)");
    refuse("\"\xC0\x80\"", "bytes that are not UTF-8, at line 1, column 2 (byte 1)");
    refuse("{\"\xED\xA0\x80\":1}", "bytes that are not UTF-8, at line 1, column 3 (byte 2)");
    refuse("\"\xC3\"", "bytes that are not UTF-8, at line 1, column 2 (byte 1)");
}

static void limits_are_kept(void **state)
{
    (void)state;
    const json_limits tight = {.depth = 2, .values = 4};
    problem p = {0};
    cJSON *document;
    assert_true(json_read("[[1,2]]", 7, &tight, &document, &p));
    cJSON_Delete(document);
    /* depth is counted along one branch only */
    assert_true(json_read("[[],[],{}]", 10, &tight, &document, &p));
    cJSON_Delete(document);
    refuse_bytes("[[[]]]", 6, &tight, 413,
                 "nested deeper than this server takes, at line 1, column 3 (byte 2)");
    refuse_bytes("[1,2,3,4]", 9, &tight, 413,
                 "more values than this server takes, at line 1, column 8 (byte 7)");
    /* a limit beyond what the stack is made for is cut */
    const json_limits boundless = {.depth = 1000000, .values = 10000000};
    char *deep = malloc(1000000);
    assert_non_null(deep);
    memset(deep, '[', 1000000);
    refuse_bytes(deep, 1000000, &boundless, 413,
                 "nested deeper than this server takes, at line 1, column 257 (byte 256)");
    free(deep);
}

static void expect_entries(const char *json, const char *lines)
{
    problem p = {0};
    cJSON *document;
    assert_false(json_read(json, strlen(json), &roomy, &document, &p));
    assert_null(document);
    assert_int_equal(p.status, 400);
    strbuf got = {0};
    for (size_t i = 0; i < p.count; i++)
        strbuf_format(&got, "%s: %s\n", p.entries[i].pointer, p.entries[i].detail);
    assert_string_equal(got.data, lines);
    strbuf_clear(&got);
    problem_clear(&p);
}

static void duplicates_and_overflows_are_all_named(void **state)
{
    (void)state;
    expect_entries(
        "{\"a\":1,\"b\":{\"~c/\":1,\"d\":[{\"e\":1,\"\\u0065\":2}],\"~c/\":1},\"a\":2,"
        "\"a\":1e400}",
        "/a: given more than once\n"
        "/b/~0c~1: given more than once\n"
        "/b/d/0/e: given more than once\n"
        "/a: the number is too large for a double (about 1.8e308)\n");
    expect_entries("[1,-1e309,{\"x\":[2e308]}]",
                   "/1: the number is too large for a double (about 1.8e308)\n"
                   "/2/x/0: the number is too large for a double (about 1.8e308)\n");
    expect_entries("1.7976931348623159e308",
                   ": the number is too large for a double (about 1.8e308)\n");
    /* names that differ in case are two names */
    cJSON_Delete(accept("{\"a\":1,\"A\":2}"));
}

static void many_members_are_compared(void **state)
{
    (void)state;
    strbuf body = {0};
    strbuf_add_string(&body, "{");
    for (int i = 0; i < 16000; i++)
        strbuf_format(&body, "%s\"member_%d\":%d", i > 0 ? "," : "", i, i);
    strbuf_add_string(&body, "}");
    cJSON_Delete(accept(body.data));
    body.size--;
    strbuf_add_string(&body, ",\"member_15999\":0,\"member_0\":0}");
    expect_entries(body.data, "/member_0: given more than once\n"
                              "/member_15999: given more than once\n");
    strbuf_clear(&body);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(documents_are_read),
        cmocka_unit_test(numbers_are_read_exactly),
        cmocka_unit_test(bad_documents_are_refused),
        cmocka_unit_test(bad_numbers_are_refused),
        cmocka_unit_test(long_numbers_stand_where_they_stood),
        cmocka_unit_test(bad_strings_are_refused),
        cmocka_unit_test(limits_are_kept),
        cmocka_unit_test(duplicates_and_overflows_are_all_named),
        cmocka_unit_test(many_members_are_compared),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
