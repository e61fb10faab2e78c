#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tension and bending stiffness of a stay from ten frequencies as a user of SciPy would get them: the same exact
characteristic equation, each root by brentq in its bracket, least_squares from several starts, and the interval of the
tension from its profile. (An answer of strum has also that of the bending stiffness, the fit without each frequency,
and both kinds of ends.)
"""
import os
import time

os.environ["OPENBLAS_NUM_THREADS"] = "1"
import numpy as np
from scipy.optimize import brentq, least_squares

F = np.array([.43, .857, 1.286, 1.71, 2.143, 2.578, 3.012, 3.443, 3.883, 4.322])
SD, LENGTH, MASS = 2e-3, 177.168, 51.6
QUANTILE = 1.959963984540054


def characteristic(b, xi2):
    """Both ends clamped, over cosh a."""
    a = np.sqrt(b * b + xi2)
    sech = 1 / np.cosh(a) if a < 350 else 0.0
    return 2 * a * b * (sech - np.cos(b)) + xi2 * np.tanh(a) * np.sin(b)


def frequencies(tension, bending):
    xi2 = tension * LENGTH**2 / bending
    out = []
    for n in range(1, len(F) + 1):
        b = brentq(characteristic, n * np.pi, (n + .75) * np.pi, args=(xi2,), xtol=1e-13)
        out.append(np.sqrt((tension + bending * b * b / LENGTH**2) / MASS) * b / LENGTH / (2 * np.pi))
    return np.array(out)


def residuals(x):
    return (F - frequencies(*np.exp(x))) / SD


def fit():
    """From nine starts: the string rule's tension and others, three bending stiffnesses."""
    string = 4 * MASS * LENGTH**2 * np.mean(F / np.arange(1, len(F) + 1))**2
    starts = [(np.log(string * s), np.log(string * LENGTH**2 / xi**2)) for s in (.8, .95, 1.1) for xi in (30, 150, 600)]
    found = [least_squares(residuals, start, xtol=1e-12, ftol=1e-12, gtol=1e-12) for start in starts]
    return min(found, key=lambda one: one.cost)


def profile(best, side):
    """Where chi squared has risen by the square of the quantile, the bending stiffness fitted anew."""
    last = [best.x[1]]

    def height(x):
        one = least_squares(lambda y: residuals((x, y[0])), [last[0]], xtol=1e-10, ftol=1e-10, gtol=1e-10)
        last[0] = one.x[0]
        return np.sqrt(max(0, 2 * (one.cost - best.cost))) - QUANTILE

    return np.exp(brentq(height, best.x[0], best.x[0] + side * .02, xtol=1e-9))


def main():
    times = []
    for _ in range(3):
        begin = time.process_time()
        best = fit()
        low, high = profile(best, -1), profile(best, 1)
        times.append((time.process_time() - begin) * 1e6)
    tension = np.exp(best.x[0])
    assert abs(tension / 1163780.578 - 1) < 1e-6 and abs(low / 1159451.459 - 1) < 1e-6 and abs(high / 1168243.885 - 1) < 1e-6
    print(f"time identify/stay-ten-frequencies/scipy-multistart {sorted(times)[1]:.2f}")


main()
