# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the table of powers of ten that number.c prints doubles with.

For every k with 10^k needed to scale a double: the 128 leading bits of 10^k, rounded up (exact
integers; 10^k = g 2^(e-127), e = floor(log2 10^k), 2^127 <= g < 2^128).
"""

import sys

# k of the smallest and the largest scale: a double's exponent q runs from -1074 to 971, and
# number.c multiplies by 10^-floor(log10 2^q).
FIRST, LAST = -292, 324


def leading_bits(k):
    if k >= 0:
        power = 10**k
        shift = power.bit_length() - 128
        return -(-power >> shift) if shift > 0 else power << -shift
    # ceil(2^n / 10^-k), with n such that the quotient has 128 bits
    divisor = 10**-k
    n = 127 + divisor.bit_length()
    g = -(-(1 << n) // divisor)
    assert 1 << 127 <= g < 1 << 128
    return g


with open(sys.argv[1], "w", encoding="ascii") as table:
    table.write(f"/* made by powers_of_ten.py */\n#define POWER_FIRST ({FIRST})\n#define POWER_LAST {LAST}\n")
    table.write("static const struct { uint64_t high, low; } powers_of_ten[] = {\n")
    for k in range(FIRST, LAST + 1):
        g = leading_bits(k)
        table.write(f"    {{0x{g >> 64:016x}, 0x{g & (1 << 64) - 1:016x}}},\n")
    table.write("};\n")
