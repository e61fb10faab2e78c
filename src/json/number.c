/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Doubles in the shortest decimal form that reads back: R. Giulietti, "The Schubfach way to
 * render doubles" (2020/2021), formatted as ECMAScript's Number::toString does.
 *
 * Index: shortest_decimal -> round_to_odd; json_print_double -> write_digits.
 */
#include <math.h>
#include <string.h>

#include "json/write.h"
#include "powers_of_ten.h"

__extension__ typedef unsigned __int128 wide;

/* floor(log10(2^q)), floor(log10(3/4 2^q)), floor(log2(10^k)): linear with enough bits for the
 * exponents of a double (checked over all of them by the unit test, through the digits). */
static int floor_log10_pow2(int q)
{
    return (int)(((int64_t)q * 1262611) >> 22);
}

static int floor_log10_three_quarters_pow2(int q)
{
    return (int)(((int64_t)q * 1262611 - 524031) >> 22);
}

static int floor_log2_pow10(int k)
{
    return (int)(((int64_t)k * 1741647) >> 19);
}

/* floor(g c / 2^128) with the lowest bit set when anything was cut off: two more bits than the
 * digits need then decide every comparison (Giulietti, section 9.6). g is rounded up by less
 * than 1, so that a remainder of 1 still means none. */
static uint64_t round_to_odd(int k, uint64_t c)
{
    const wide low = (wide)powers_of_ten[k - POWER_FIRST].low * c;
    const wide sum = (wide)powers_of_ten[k - POWER_FIRST].high * c + (uint64_t)(low >> 64);
    return (uint64_t)(sum >> 64) | ((uint64_t)sum > 1);
}

/* digits 10^exponent = the shortest decimal in the rounding interval of `value` > 0, and of
 * those the closest. */
static uint64_t shortest_decimal(double value, int *exponent)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    const uint64_t fraction = bits & ((UINT64_C(1) << 52) - 1);
    const int biased = (int)(bits >> 52);
    /* value = c 2^q */
    const uint64_t c = biased != 0 ? fraction | UINT64_C(1) << 52 : fraction;
    const int q = biased != 0 ? biased - 1075 : -1074;

    /* Four times the ends and the middle of the interval that rounds to value; the end below a
     * power of two is nearer. An even significand owns the ends. */
    const bool nearer = fraction == 0 && biased > 1;
    const uint64_t odd = c & 1;
    const int k = nearer ? floor_log10_three_quarters_pow2(q) : floor_log10_pow2(q);
    const int h = q + floor_log2_pow10(-k) + 1;
    const uint64_t left = round_to_odd(-k, (4 * c - 2 + nearer) << h) + odd;
    const uint64_t middle = round_to_odd(-k, (4 * c) << h);
    const uint64_t right = round_to_odd(-k, (4 * c + 2) << h) - odd;

    const uint64_t s = middle / 4;
    if (s >= 10) { /* one digit fewer? */
        const uint64_t t = s / 10;
        const bool below = left <= 40 * t, above = 40 * t + 40 <= right;
        if (below != above) {
            *exponent = k + 1;
            return t + above;
        }
    }
    *exponent = k;
    const bool below = left <= 4 * s, above = 4 * s + 4 <= right;
    if (below != above)
        return s + above;
    return s + (middle > 4 * s + 2 || (middle == 4 * s + 2 && (s & 1)));
}

/* Two digits at a time. */
static void write_pair(unsigned pair, char *at)
{
    static const char pairs[] = "00010203040506070809101112131415161718192021222324"
                                "25262728293031323334353637383940414243444546474849"
                                "50515253545556575859606162636465666768697071727374"
                                "75767778798081828384858687888990919293949596979899";
    memcpy(at, pairs + 2 * pair, 2);
}

/* The decimal digits of `number`, to end before `end`; returns where they start. */
static char *write_digits(uint64_t number, char *end)
{
    /* Eight digits at once: the divisions of the two halves do not wait for one another. */
    while (number >= 100000000) {
        const uint32_t eight = (uint32_t)(number % 100000000);
        const uint32_t high = eight / 10000, low = eight % 10000;
        number /= 100000000;
        end -= 8;
        write_pair(high / 100, end);
        write_pair(high % 100, end + 2);
        write_pair(low / 100, end + 4);
        write_pair(low % 100, end + 6);
    }
    uint32_t rest = (uint32_t)number;
    for (; rest >= 100; rest /= 100) {
        end -= 2;
        write_pair(rest % 100, end);
    }
    if (rest >= 10) {
        end -= 2;
        write_pair(rest, end);
    } else {
        *--end = (char)('0' + rest);
    }
    return end;
}

/* "e+21": the exponent of the first digit. */
static char *write_exponent(int exponent, char *at)
{
    *at++ = 'e';
    *at++ = exponent < 0 ? '-' : '+';
    char digits[4];
    char *const end = digits + sizeof digits;
    const char *first = write_digits((uint64_t)(exponent < 0 ? -exponent : exponent), end);
    memcpy(at, first, (size_t)(end - first));
    return at + (end - first);
}

size_t json_print_double(double value, char buffer[JSON_NUMBER_MAX])
{
    char *at = buffer;
    if (value < 0) {
        *at++ = '-';
        value = -value;
    }
    char digits[20];
    char *const end = digits + sizeof digits;
    int exponent = 0;
    uint64_t number;
    if (value < 0x1p53 && value == (double)(uint64_t)value) { /* zero of either sign too */
        number = (uint64_t)value;
    } else {
        number = shortest_decimal(value, &exponent);
        for (; number % 10 == 0; number /= 10)
            exponent++;
    }
    const char *first = write_digits(number, end);
    const int count = (int)(end - first);
    const int point = count + exponent; /* digits before the decimal point */

    if (exponent >= 0 && point <= 21) { /* 1200 */
        memcpy(at, first, (size_t)count);
        memset(at + count, '0', (size_t)exponent);
        at += point;
    } else if (point > 0 && point <= 21) { /* 12.5 */
        memcpy(at, first, (size_t)point);
        at += point;
        *at++ = '.';
        memcpy(at, first + point, (size_t)(count - point));
        at += count - point;
    } else if (point > -6 && point <= 0) { /* 0.00125 */
        memcpy(at, "0.000000", (size_t)(2 - point));
        at += 2 - point;
        memcpy(at, first, (size_t)count);
        at += count;
    } else { /* 1.25e-7 */
        *at++ = *first;
        if (count > 1) {
            *at++ = '.';
            memcpy(at, first + 1, (size_t)(count - 1));
            at += count - 1;
        }
        at = write_exponent(point - 1, at);
    }
    return (size_t)(at - buffer);
}
