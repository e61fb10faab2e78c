#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""In-plane frequencies of a level cable (sag parameter 0.85) as a user of SciPy would get them: finite elements and
a dense eigensolver, with just enough elements for 1e-5 in the first 6 modes.

bars      two-node bars with geometric stiffness and consistent mass, nearly inextensible: what a textbook says
hermite   cubic elements for the tangential displacement, inextensible (Gale 1976, 2.35): what an expert would write
"""
import os
import time

os.environ["OPENBLAS_NUM_THREADS"] = "1"
import numpy as np
from scipy.linalg import eigh

CHI = 1.00344348597387  # slope parameter of the ends, sinh(CHI)/CHI = 1/0.85
# Taylor shooting in 220 bit arithmetic
RIGHT = np.array([2.445024346759859, 4.0243893777239735, 5.5882526820268992, 7.0475296053033344,
                  8.5484596034136764, 9.9941713939015167])


def bars(elements, kappa=4e-6):
    """Nodes equally spaced along the cable; stiffness 1/kappa, of which much more would cost digits; tension cosh(chi)."""
    sigma = np.linspace(-np.sinh(CHI), np.sinh(CHI), elements + 1)
    chi = np.arcsinh(sigma)
    node = np.stack([chi, np.cosh(chi)])
    edge = np.diff(node)
    length = np.hypot(*edge)
    along = edge / length
    tension = np.cosh((chi[1:] + chi[:-1]) / 2)
    k = np.zeros((2 * elements + 2, 2 * elements + 2))
    m = np.zeros_like(k)
    for e in range(elements):
        t = np.outer(along[:, e], along[:, e])
        block = (t / kappa + (np.eye(2) - t) * tension[e]) / length[e]
        i = slice(2 * e, 2 * e + 4)
        k[i, i] += np.block([[block, -block], [-block, block]])
        m[i, i] += length[e] / 6 * np.kron([[2, 1], [1, 2]], np.eye(2))
    return np.sqrt(eigh(k[2:-2, 2:-2], m[2:-2, 2:-2], eigvals_only=True, subset_by_index=[0, 5]))


def hermite(elements):
    """INT (cosh u'' + sinh u' + u/cosh)^2 = omega^2 INT cosh (u^2 + cosh^2 u'^2), u clamped."""
    h = 2 * CHI / elements
    x, w = np.polynomial.legendre.leggauss(5)
    s = (x + 1) / 2
    shape = np.array([1 - 3 * s**2 + 2 * s**3, h * (s - 2 * s**2 + s**3), 3 * s**2 - 2 * s**3, h * (s**3 - s**2)])
    first = np.array([6 * s**2 - 6 * s, h * (1 - 4 * s + 3 * s**2), 6 * s - 6 * s**2, h * (3 * s**2 - 2 * s)]) / h
    second = np.array([12 * s - 6, h * (6 * s - 4), 6 - 12 * s, h * (6 * s - 2)]) / h**2
    k = np.zeros((2 * elements + 2, 2 * elements + 2))
    m = np.zeros_like(k)
    for e in range(elements):
        chi = -CHI + h * (e + s)
        c = np.cosh(chi)
        strain = c * second + np.sinh(chi) * first + shape / c
        i = slice(2 * e, 2 * e + 4)
        k[i, i] += strain * (w * h / 2) @ strain.T
        m[i, i] += shape * (w * h / 2 * c) @ shape.T + first * (w * h / 2 * c**3) @ first.T
    return np.sqrt(eigh(k[2:-2, 2:-2], m[2:-2, 2:-2], eigvals_only=True, subset_by_index=[0, 5]))


def measure(name, solve, elements, rounds):
    times = []
    for _ in range(rounds):
        begin = time.process_time()
        omega = solve(elements)
        times.append(time.process_time() - begin)
    error = abs(omega / RIGHT - 1).max()
    assert error < 1e-5, f"{name}: {error:.1e} with {elements} elements"
    print(f"time catenary/level-0.85/scipy-{name}-{elements}-elements {sorted(times)[rounds // 2] * 1e6:.1f}", flush=True)


if __name__ == "__main__":
    measure("bars", bars, 1400, 1)
    measure("hermite", hermite, 66, 9)
