#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# SciPy's characteristic values of Mathieu's equation jump to another order, from q = 71 on.
#
# They bound the tensions at which a cable's end, moved at some frequency, makes it swing (parametric resonance).
# One would guess: mathieu_a(n, q) and mathieu_b(n, q) are good to some ten digits for the orders and parameters of practice, and say NaN
#   beyond; in any case a_n grows with n.
# What happens: most are. But mathieu_a(15, 71) is 185.2 instead of 236.7, mathieu_a(14, 78) is 101 instead of 213 and below mathieu_a(10,
#   78), and so on: of the orders up to 40 at every seventh q up to 400 one in twenty is another order's, or none's, in both directions.
#   GSL's gsl_sf_mathieu_a and _b agree there with the eigenvalues of the recursion to 1e-11.
# What follows: take eigh_tridiagonal of the recursion's matrix: six lines.
# Seen with SciPy 1.10.1 and GSL 2.7.1 (Debian 12), on 2026-11-28. SciPy's own list of errors has had jumps at larger q for years.
#
# Needs Debian 12's python3, gcc and apt-get. Exit status: 0 as described, 1 it has changed, 2 it could not be tried.
set -euo pipefail
/usr/bin/python3 -c 'import sys; sys.exit(sys.version_info[:2] != (3, 11))' || { echo "needs Debian 12's python3 (3.11)" >&2 && exit 2; }
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
(cd "$place" && apt-get download -qq -o APT::Sandbox::User=root python3-scipy=1.10.1-2 python3-numpy=1:1.24.2-1+deb12u1 \
    python3-decorator=5.1.1-3 libblas3=3.11.0-2 liblapack3=3.11.0-2 liblbfgsb0=3.0+dfsg.4-1 libgfortran5 libquadmath0 \
    libgsl-dev=2.7.1+dfsg-5+deb12u1 libgsl27=2.7.1+dfsg-5+deb12u1 libgslcblas0=2.7.1+dfsg-5+deb12u1 >&2) || exit 2
for package in "$place"/*.deb; do dpkg-deb -x "$package" "$place"; done
usr=$place/usr/lib/x86_64-linux-gnu
export PYTHONPATH=$place/usr/lib/python3/dist-packages PYTHONDONTWRITEBYTECODE=1 LD_LIBRARY_PATH=$usr/blas:$usr/lapack:$usr
cat >"$place/gsl.c" <<'TRY'
#include <gsl/gsl_sf_mathieu.h>
#include <gsl/gsl_version.h>
#include <stdio.h>

int main(void)
{
    fprintf(stderr, "GSL %s\n", gsl_version);
    for (int q = 1; q <= 400; q += 7)
        for (int n = 1; n <= 40; n++)
            printf("%d %d %.17g %.17g\n", n, q, gsl_sf_mathieu_a(n, q), gsl_sf_mathieu_b(n, q));
    return 0;
}
TRY
gcc -I"$place/usr/include" -o "$place/gsl" "$place/gsl.c" -L"$usr" -lgsl -lgslcblas -lm
"$place/gsl" >"$place/gsl.txt"
/usr/bin/python3 - "$place/gsl.txt" <<'TRY'
import sys
import numpy as np
import scipy
from scipy.linalg import eigvalsh_tridiagonal
from scipy.special import mathieu_a, mathieu_b

ROWS = 120


def exact(kind, q):
    """The characteristic values of orders 0 to 40 (a) or 1 to 40 (b): eigenvalues of the recursion of the Fourier coefficients."""
    values = {}
    for odd in (0, 1):
        k = np.arange(ROWS) + (1 if kind == "b" and not odd else 0)
        diagonal, beside = (2.0 * k + odd) ** 2, np.full(ROWS - 1, float(q))
        if odd:
            diagonal[0] += q if kind == "a" else -q
        elif kind == "a":
            beside[0] *= np.sqrt(2)
        for i, value in enumerate(eigvalsh_tridiagonal(diagonal, beside)[:21]):
            values[2 * (i + (kind == "b" and not odd)) + odd] = value
    return values


table = {}
count, scipy_off, scipy_worst, gsl_worst = 0, [], 0, 0
for line in open(sys.argv[1], encoding="ascii"):
    n, q, *gsl = (float(word) for word in line.split())
    for kind, function, value in (("a", mathieu_a, gsl[0]), ("b", mathieu_b, gsl[1])):
        if (kind, q) not in table:
            table[kind, q] = exact(kind, q)
        right = table[kind, q][n]
        scale = max(1, abs(right))
        count += 1
        gsl_worst = max(gsl_worst, abs(value - right) / scale)
        if not abs(function(n, q) - right) < 1e-6 * scale:
            scipy_off.append((q, n, kind, float(function(n, q)), right))
status = not (0.005 * count < len(scipy_off) < 0.2 * count and gsl_worst < 1e-9)
print(f"SciPy {scipy.__version__}: {len(scipy_off)} of {count} values wrong; GSL off by at most {gsl_worst:.0e}"
      f"{': CHANGED' if status else ''}")
for q, n, kind, found, right in sorted(scipy_off)[:6]:
    print(f"  mathieu_{kind}({n:g}, {q:g}) = {found:.2f}, right is {right:.2f}")
sharp = abs(mathieu_a(15, 71) - 185.22) < 0.1 and abs(mathieu_a(14, 78) - 101.12) < 0.1
print(f"  mathieu_a(14, 78) = {mathieu_a(14, 78):.2f} < mathieu_a(10, 78) = {mathieu_a(10, 78):.2f}{'' if sharp else ': CHANGED'}")
sys.exit(status or not sharp)
TRY
