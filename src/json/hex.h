/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hexadecimal digits. */
#ifndef JSON_HEX_H
#define JSON_HEX_H

/* Returns the value of a digit, lower or upper case, or -1 for any other character. */
static inline int hex_digit(char c)
{
    if (c >= '0' && c <= '9')
        return c - '0';
    c |= 0x20;
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

#endif
