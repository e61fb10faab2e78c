/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Printed doubles against an oracle that knows nothing of how they are made: glibc's exact
 * printf and strtod find the shortest digits that read back, ECMA-262 says how they are laid
 * out.
 */
#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "json/write.h"

static uint64_t bits_of(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static double double_of(uint64_t bits)
{
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static double read_decimal(long long digits, int exponent)
{
    char decimal[64];
    (void)snprintf(decimal, sizeof decimal, "%llde%d", digits, exponent);
    return strtod(decimal, NULL);
}

/* The closest decimal of `count` digits that reads back as value > 0: digits 10^exponent. False
 * when none does. printf rounds exactly; beside a power of two, where the interval below is
 * narrower, the second closest may read back when the closest does not. */
static bool decimal_of(double value, int count, long long *digits, int *exponent)
{
    char decimal[64];
    (void)snprintf(decimal, sizeof decimal, "%.*e", count - 1, value);
    const char *e = strchr(decimal, 'e');
    char plain[32];
    int size = 0;
    for (const char *c = decimal; c < e; c++)
        if (*c != '.')
            plain[size++] = *c;
    plain[size] = '\0';
    const long long closest = strtoll(plain, NULL, 10);
    *exponent = (int)strtol(e + 1, NULL, 10) - (count - 1);
    const long long candidates[] = {closest, closest - 1, closest + 1};
    for (int i = 0; i < 3; i++)
        if (read_decimal(candidates[i], *exponent) == value) {
            *digits = candidates[i];
            return true;
        }
    return false;
}

/* ECMA-262, 6.1.6.1.20 Number::toString, steps 6 to 10, for k digits s and value s 10^(n-k). */
static void lay_out(const char *s, int k, int n, char *out)
{
    if (k <= n && n <= 21) {
        out += sprintf(out, "%s", s);
        for (int i = k; i < n; i++)
            *out++ = '0';
        *out = '\0';
    } else if (0 < n && n <= 21) {
        sprintf(out, "%.*s.%s", n, s, s + n);
    } else if (-6 < n && n <= 0) {
        out += sprintf(out, "0.");
        for (int i = 0; i < -n; i++)
            *out++ = '0';
        sprintf(out, "%s", s);
    } else if (k == 1) {
        sprintf(out, "%se%+d", s, n - 1);
    } else {
        sprintf(out, "%c.%se%+d", s[0], s + 1, n - 1);
    }
}

static const char *printed(double value)
{
    static char buffer[JSON_NUMBER_MAX + 1];
    memset(buffer, '#', sizeof buffer);
    const size_t size = json_print_double(value, buffer);
    assert_true(size <= JSON_NUMBER_MAX);
    buffer[size] = '\0';
    return buffer;
}

/* Number of significant digits of what was printed. */
static int digits_in(const char *at)
{
    int first = -1, last = 0, count = 0;
    for (; *at != '\0' && *at != 'e'; at++) {
        if (*at < '0' || *at > '9')
            continue;
        if (*at != '0' && first < 0)
            first = count;
        if (*at != '0')
            last = count;
        count++;
    }
    return last - first + 1;
}

/* A shorter string would also read back with a zero appended: that none of one digit fewer does
 * rules out all shorter ones. */
static void check_double(double value)
{
    const char *got = printed(value);
    const int count = digits_in(got);
    long long digits;
    int exponent;
    if (count > 1 && decimal_of(value, count - 1, &digits, &exponent))
        fail_msg("%a: %s, but %llde%d is shorter", value, got, digits, exponent);
    if (!decimal_of(value, count, &digits, &exponent))
        fail_msg("%a: no %d digits read back, printed %s", value, count, got);
    char s[32], want[64];
    const int size = sprintf(s, "%lld", digits);
    lay_out(s, size, size + exponent, want);
    if (strcmp(got, want) != 0)
        fail_msg("%a: got %s, want %s", value, got, want);
    if (bits_of(strtod(got, NULL)) != bits_of(value))
        fail_msg("%a: %s reads back as %a", value, got, strtod(got, NULL));
}

/* RFC 8785, appendix B */
static void samples_of_rfc_8785(void **state)
{
    (void)state;
    static const struct {
        uint64_t bits;
        const char *text;
    } samples[] = {
        {0x0000000000000000, "0"},
        {0x8000000000000000, "0"},
        {0x0000000000000001, "5e-324"},
        {0x8000000000000001, "-5e-324"},
        {0x7fefffffffffffff, "1.7976931348623157e+308"},
        {0xffefffffffffffff, "-1.7976931348623157e+308"},
        {0x4340000000000000, "9007199254740992"},
        {0xc340000000000000, "-9007199254740992"},
        {0x4430000000000000, "295147905179352830000"},
        {0x44b52d02c7e14af5, "9.999999999999997e+22"},
        {0x44b52d02c7e14af6, "1e+23"},
        {0x44b52d02c7e14af7, "1.0000000000000001e+23"},
        {0x444b1ae4d6e2ef4e, "999999999999999700000"},
        {0x444b1ae4d6e2ef4f, "999999999999999900000"},
        {0x444b1ae4d6e2ef50, "1e+21"},
        {0x3eb0c6f7a0b5ed8c, "9.999999999999997e-7"},
        {0x3eb0c6f7a0b5ed8d, "0.000001"},
        {0x41b3de4355555553, "333333333.3333332"},
        {0x41b3de4355555554, "333333333.33333325"},
        {0x41b3de4355555555, "333333333.3333333"},
        {0x41b3de4355555556, "333333333.3333334"},
        {0x41b3de4355555557, "333333333.33333343"},
        {0xbecbf647612f3696, "-0.0000033333333333333333"},
        {0x43143ff3c1cb0959, "1424953923781206.2"},
    };
    for (size_t i = 0; i < sizeof samples / sizeof samples[0]; i++)
        assert_string_equal(printed(double_of(samples[i].bits)), samples[i].text);
}

/* Every power of two, whose interval is lopsided, with its neighbours. */
static void powers_of_two(void **state)
{
    (void)state;
    for (int e = -1074; e <= 1023; e++) {
        const double power = ldexp(1, e);
        check_double(power);
        check_double(nextafter(power, INFINITY));
        if (e > -1074)
            check_double(nextafter(power, 0));
    }
}

static void powers_of_ten_and_neighbours(void **state)
{
    (void)state;
    for (int e = -323; e <= 308; e++)
        for (int digit = 1; digit <= 9; digit++) {
            const double value = read_decimal(digit, e);
            if (!isfinite(value))
                continue;
            check_double(value);
            check_double(nextafter(value, INFINITY));
            check_double(nextafter(value, 0));
        }
}

static void ends_of_the_range(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < 3000; i++) {
        check_double(double_of(1 + i));                   /* the smallest subnormals */
        check_double(double_of(bits_of(DBL_MIN) - i));    /* the largest subnormals */
        check_double(double_of(bits_of(DBL_MIN) + i));    /* the smallest normals */
        check_double(double_of(bits_of(DBL_MAX) - i));    /* the largest */
        check_double(double_of(bits_of(0x1p53) - 1 - i)); /* the last integers without gaps */
        check_double(double_of(bits_of(0x1p53) + i));
    }
}

static uint64_t random_bits(uint64_t *seed)
{
    *seed ^= *seed << 13;
    *seed ^= *seed >> 7;
    *seed ^= *seed << 17;
    return *seed;
}

static void random_bit_patterns(void **state)
{
    (void)state;
    uint64_t seed = UINT64_C(0x9E3779B97F4A7C15);
    for (int i = 0; i < 1000000; i++) {
        const double value = double_of(random_bits(&seed) & ~(UINT64_C(1) << 63));
        if (isfinite(value) && value > 0)
            check_double(value);
    }
}

/* What people write: few digits, moderate exponents; integers; and what is just beside them. */
static void short_decimals(void **state)
{
    (void)state;
    static const uint64_t scales[] = {10, 1000, 100000, 10000000, 1000000000, 100000000000};
    uint64_t seed = 88172645463325252u;
    for (int i = 0; i < 300000; i++) {
        const long long digits = (long long)(1 + random_bits(&seed) % scales[i % 6]);
        const double value = read_decimal(digits, (int)(random_bits(&seed) % 50) - 30);
        check_double(value);
        check_double(nextafter(value, INFINITY));
    }
}

static void signs_mirror(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int i = 0; i < 10000; i++) {
        const double value = double_of(random_bits(&seed) & ~(UINT64_C(1) << 63));
        if (!isfinite(value) || value == 0)
            continue;
        char positive[JSON_NUMBER_MAX + 1];
        strcpy(positive, printed(value));
        const char *negative = printed(-value);
        assert_int_equal(negative[0], '-');
        assert_string_equal(negative + 1, positive);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_of_rfc_8785),
        cmocka_unit_test(powers_of_two),
        cmocka_unit_test(powers_of_ten_and_neighbours),
        cmocka_unit_test(ends_of_the_range),
        cmocka_unit_test(random_bit_patterns),
        cmocka_unit_test(short_decimals),
        cmocka_unit_test(signs_mirror),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
