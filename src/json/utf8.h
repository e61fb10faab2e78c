/* SPDX-License-Identifier: GPL-3.0-or-later */
/* UTF-8 as RFC 3629 has it: no overlong forms, no surrogates, nothing above U+10FFFF. */
#ifndef JSON_UTF8_H
#define JSON_UTF8_H

#include <stddef.h>

/* Length of the character at `at`, which ends before `end`; 0 when the bytes there are not
 * UTF-8. */
static inline size_t utf8_size(const char *at, const char *end)
{
    const unsigned char *b = (const unsigned char *)at;
    const size_t left = (size_t)(end - at);
    if (left == 0)
        return 0;
    if (b[0] < 0x80)
        return 1;
    /* Size, and the range of the second byte, which alone rules out overlong forms,
     * surrogates and code points beyond the last. */
    size_t size = 0;
    unsigned char low = 0x80, high = 0xBF;
    if (b[0] >= 0xC2 && b[0] <= 0xDF)
        size = 2;
    else if (b[0] >= 0xE0 && b[0] <= 0xEF)
        size = 3;
    else if (b[0] >= 0xF0 && b[0] <= 0xF4)
        size = 4;
    else
        return 0;
    if (b[0] == 0xE0)
        low = 0xA0;
    else if (b[0] == 0xED)
        high = 0x9F;
    else if (b[0] == 0xF0)
        low = 0x90;
    else if (b[0] == 0xF4)
        high = 0x8F;
    if (left < size || b[1] < low || b[1] > high)
        return 0;
    for (size_t i = 2; i < size; i++)
        if ((b[i] & 0xC0) != 0x80)
            return 0;
    return size;
}

#endif
