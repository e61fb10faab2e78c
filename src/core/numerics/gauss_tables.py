# SPDX-License-Identifier: GPL-3.0-or-later
"""gauss_tables.py OUTPUT: nodes and weights of the Gauss-Legendre rules that gauss.c holds as constants.

For each number n of nodes (even) the positive zeros of P_n, ascending, by Newton's method in fixed point of 128 bits,
and their weights 2/((1 - x^2) P_n'(x)^2); each is the double nearest to it.
"""
import math
import sys

SIZES = (32, 64, 96, 128, 256, 512, 1024)
ONE = 1 << 128


def start(n, i):
    """The i-th zero from the right, as a double."""
    x = math.cos(math.pi * (i + 0.75) / (n + 0.5))
    for _ in range(4):
        before, now = 1.0, x
        for k in range(1, n):
            before, now = now, ((2 * k + 1) * x * now - k * before) / (k + 1)
        x -= now * (x * x - 1) / (n * (x * now - before))
    return x


def polynomial(n, x):
    """P_n(x) and P_n'(x) in fixed point."""
    before, now = ONE, x
    for k in range(1, n):
        before, now = now, ((2 * k + 1) * (x * now >> 128) - k * before) // (k + 1)
    return now, n * ((x * now >> 128) - before) * ONE // ((x * x >> 128) - ONE)


def rule(n):
    for i in range(n // 2 - 1, -1, -1):
        x = int(start(n, i) * 2.0**64) << 64
        for _ in range(2):
            value, slope = polynomial(n, x)
            x -= value * ONE // slope
        _, slope = polynomial(n, x)
        yield x / ONE, 2 * ONE**3 / ((ONE - (x * x >> 128)) * slope * slope)


with open(sys.argv[1], "w", encoding="ascii") as table:
    table.write("/* made by gauss_tables.py: node, weight */\n")
    for n in SIZES:
        table.write(f"static const double gauss_{n}[][2] = {{\n")
        for x, w in rule(n):
            table.write(f"    {{{x.hex()}, {w.hex()}}},\n")
        table.write("};\n")
    table.write("static const struct {\n    int size;\n    const double (*half)[2];\n} gauss_tables[] = {\n")
    table.write("".join(f"    {{{n}, gauss_{n}}},\n" for n in SIZES) + "};\n")
