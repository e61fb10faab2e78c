/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text, the writer and problem documents. */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "json/problem.h"
#include "json/utf8.h"

static void text_grows(void **state)
{
    (void)state;
    strbuf out = {0};
    for (int i = 0; i < 1000; i++)
        strbuf_format(&out, "%d,", i % 10);
    strbuf_add(&out, "a\0b", 3);
    assert_false(out.failed);
    assert_int_equal(out.size, 2003);
    assert_memory_equal(out.data, "0,1,2,3,4,5,6,7,8,9,0,", 22);
    assert_memory_equal(out.data + 2000, "a\0b\0", 4);
    strbuf_clear(&out);
    assert_null(out.data);
    assert_int_equal(out.size, 0);
    /* exactly as many bytes as there is room for still leave room for the NUL */
    for (size_t size = 0; size < 600; size++) {
        char *bytes = malloc(size + 1);
        assert_non_null(bytes);
        memset(bytes, 'x', size);
        strbuf_add(&out, bytes, size);
        assert_int_equal(out.size, size);
        assert_int_equal(out.data[size], '\0');
        strbuf_clear(&out);
        bytes[size] = '\0';
        strbuf_format(&out, "%s", bytes);
        assert_int_equal(out.size, size);
        assert_string_equal(out.data, bytes);
        strbuf_clear(&out);
        free(bytes);
    }
}

static void impossible_sizes_fail(void **state)
{
    (void)state;
    strbuf out = {0};
    strbuf_add(&out, "x", 1);
    strbuf_add(&out, "x", SIZE_MAX / 2 + 1);
    assert_true(out.failed);
    strbuf_add(&out, "y", 1);
    assert_true(out.failed);
    assert_string_equal(out.data, "x");
    strbuf_clear(&out);
    assert_false(out.failed);
}

static void commas_and_nesting(void **state)
{
    (void)state;
    strbuf out = {0};
    json_writer json = {.out = &out};
    json_open_object(&json);
    json_put_number(&json, "a", 0.1);
    json_put_integer(&json, "b", INT64_MIN);
    json_key(&json, "c");
    json_open_array(&json);
    json_open_array(&json);
    json_close_array(&json);
    json_open_object(&json);
    json_close_object(&json);
    json_number(&json, -0.0);
    json_number(&json, 1e300);
    json_flag(&json, true);
    json_string(&json, "x");
    json_raw(&json, "[1,2]", 5);
    json_complex(&json, CMPLX(1, -2.5));
    json_close_array(&json);
    json_put_flag(&json, "d", false);
    json_put_string(&json, "e", "");
    json_put_complex(&json, "f", CMPLX(0, 1));
    json_close_object(&json);
    assert_false(out.failed);
    assert_string_equal(out.data,
                        "{\"a\":0.1,\"b\":-9223372036854775808,\"c\":[[],{},0,1e+300,true,"
                        "\"x\",[1,2],{\"re\":1,\"im\":-2.5}],\"d\":false,\"e\":\"\",\"f\":{"
                        "\"re\":0,\"im\":1}}");
    strbuf_clear(&out);
}

static void expect_escaped(const char *bytes, size_t size, const char *want)
{
    strbuf out = {0};
    json_string_n(&(json_writer){.out = &out}, bytes, size);
    assert_false(out.failed);
    assert_string_equal(out.data, want);
    strbuf_clear(&out);
}

static void strings_are_escaped(void **state)
{
    (void)state;
    expect_escaped("a\"b\\c/d", 7, "\"a\\\"b\\\\c/d\"");
    expect_escaped("\b\f\n\r\t\0\x1f\x7f", 8, "\"\\b\\f\\n\\r\\t\\u0000\\u001f\x7f\"");
    expect_escaped("\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80", 9,
                   "\"\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80\"");
    /* what is not UTF-8 becomes U+FFFD, byte by byte; a character cut short too */
    expect_escaped("a\xFF\xC3", 3, "\"a\xEF\xBF\xBD\xEF\xBF\xBD\"");
    expect_escaped("\xED\xA0\x80z", 4, "\"\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBDz\"");
}

static void non_finite_numbers_fail(void **state)
{
    (void)state;
    const double values[] = {NAN, INFINITY, -INFINITY};
    for (int i = 0; i < 3; i++) {
        strbuf out = {0};
        json_number(&(json_writer){.out = &out}, values[i]);
        assert_true(out.failed);
        strbuf_clear(&out);
    }
}

/* The encoding of RFC 3629, section 3, by its table of bits. */
static size_t encode(uint32_t point, char *bytes)
{
    if (point < 0x80) {
        bytes[0] = (char)point;
        return 1;
    }
    const size_t size = point < 0x800 ? 2 : point < 0x10000 ? 3 : 4;
    for (size_t i = size - 1; i > 0; i--, point >>= 6)
        bytes[i] = (char)(0x80 | (point & 0x3F));
    bytes[0] = (char)((0xF00 >> size) | point);
    return size;
}

static void every_character_is_known(void **state)
{
    (void)state;
    for (uint32_t point = 0; point < 0x120000; point++) {
        char bytes[4];
        const size_t size = encode(point, bytes);
        const bool valid = point < 0x110000 && !(point >= 0xD800 && point <= 0xDFFF);
        assert_int_equal(utf8_size(bytes, bytes + size), valid ? size : 0);
        if (valid && size > 1)
            assert_int_equal(utf8_size(bytes, bytes + size - 1), 0);
    }
    /* overlong forms: every lead byte with the smallest second byte that its size forbids */
    const char *const overlong[] = {"\xC0\x80",
                                    "\xC1\xBF",
                                    "\xE0\x80\x80",
                                    "\xE0\x9F\xBF",
                                    "\xF0\x80\x80\x80",
                                    "\xF0\x8F\xBF\xBF",
                                    "\xF8\x88\x80\x80\x80",
                                    "\x80",
                                    "\xBF",
                                    "\xC3(",
                                    "\xE2\x82(",
                                    "\xF0\x9F\x98("};
    for (size_t i = 0; i < sizeof overlong / sizeof overlong[0]; i++)
        assert_int_equal(utf8_size(overlong[i], overlong[i] + strlen(overlong[i])), 0);
}

static void problems_are_gathered(void **state)
{
    (void)state;
    problem p = {0};
    problem_add(&p, "/a/0", "must be %s", "\"small\"");
    assert_int_equal(p.status, 400);
    problem_add(&p, "", "missing");
    problem_set(&p, 422, "the first status stays");
    strbuf out = {0};
    problem_write(&p, "/v1/x", &out);
    assert_string_equal(
        out.data,
        "{\"type\":\"about:blank\",\"title\":\"Bad Request\",\"status\":400,\"detail\":\"the "
        "request has 2 faults: see errors\",\"instance\":\"/v1/x\",\"errors\":[{\"pointer\":"
        "\"/a/0\",\"detail\":\"must be \\\"small\\\"\"},{\"pointer\":\"\",\"detail\":"
        "\"missing\"}]}");
    strbuf_clear(&out);
    problem_clear(&p);
    problem_set(&p, 422, "no such cable: %d m is shorter than its chord", 5);
    problem_write(&p, NULL, &out);
    assert_string_equal(out.data,
                        "{\"type\":\"about:blank\",\"title\":\"Unprocessable Content\","
                        "\"status\":422,\"detail\":\"no such cable: 5 m is shorter than its "
                        "chord\",\"errors\":[]}");
    strbuf_clear(&out);
    /* out of memory: what was gathered may be incomplete, so none of it is told */
    problem_add(&p, "/x", "wrong");
    problem_out_of_memory(&p);
    problem_write(&p, NULL, &out);
    assert_string_equal(out.data, "{\"type\":\"about:blank\",\"title\":\"Internal Server "
                                  "Error\",\"status\":500,\"detail\":\"memory ran out\","
                                  "\"errors\":[]}");
    strbuf_clear(&out);
    problem_clear(&p);
    assert_int_equal(p.status, 0);
}

static void problems_are_bounded(void **state)
{
    (void)state;
    problem p = {0};
    char pointer[2048];
    memset(pointer, 'p', sizeof pointer - 1);
    pointer[sizeof pointer - 1] = '\0';
    for (int i = 0; i < 100; i++)
        problem_add(&p, pointer, "wrong");
    assert_true(p.bytes < PROBLEM_BYTES_MAX + 2 * sizeof pointer);
    assert_int_equal(p.count + p.omitted, 100);
    assert_true(p.omitted > 0);
    strbuf out = {0};
    problem_write(&p, NULL, &out);
    assert_non_null(strstr(out.data, "the request has 100 faults: see errors (the first 32 of "
                                     "them)"));
    strbuf_clear(&out);
    problem_clear(&p);
}

/* A text stops at the bytes that it may have, and says why. */
static void a_text_has_a_limit(void **state)
{
    (void)state;
    strbuf out = {.most = 10};
    strbuf_add(&out, "0123456789", 10);
    assert_false(out.failed);
    strbuf_add(&out, "", 0);
    assert_false(out.failed);
    strbuf_add(&out, "x", 1);
    assert_true(out.failed && out.full);
    assert_int_equal(out.size, 10);
    strbuf_clear(&out);
    out.most = 10;
    strbuf_format(&out, "%d", 123456789);
    assert_false(out.failed);
    strbuf_format(&out, "%d", 10);
    assert_true(out.failed && out.full);
    assert_string_equal(out.data, "123456789");
    strbuf_clear(&out);
    assert_false(out.full);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_text_has_a_limit),       cmocka_unit_test(text_grows),
        cmocka_unit_test(impossible_sizes_fail),    cmocka_unit_test(commas_and_nesting),
        cmocka_unit_test(strings_are_escaped),      cmocka_unit_test(non_finite_numbers_fail),
        cmocka_unit_test(every_character_is_known), cmocka_unit_test(problems_are_gathered),
        cmocka_unit_test(problems_are_bounded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
