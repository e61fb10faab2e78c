#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A cubic with the roots 1, 2 and 1e8 is solved worse by the function made for cubics than by the one for any polynomial.
#
# (x - 1)(x - 2)(x - 1e8): its coefficients are whole numbers that a double holds exactly, its roots are far apart and well conditioned. A
#   stiff damper on a light mass makes such cubics.
# One would guess: gsl_poly_solve_cubic, by its closed formula, is as exact as the general gsl_poly_complex_solve, and faster.
# What happens: it gives 1.09 and 1.91 for 1 and 2, two digits where the general one gives twelve or more. For 1, 1 and 1e8 it says that there is
#   one real root. At 1e6 four digits are left. mathjs' polynomialRoot does likewise: 1.0097 and a complex 1.99 + 5e-9 i. The formula takes
#   roots of differences of squares and cubes of the largest root; neither manual speaks of that.
# What follows: where one root is that large, polish the small ones with a Newton step, or ask for eigenvalues.
# Seen with GSL 2.7.1+dfsg-5+deb12u1 (Debian 12), and mathjs 15.2.0, node 20.20.2, on 2026-11-28.
#
# Needs gcc, node, npm and apt-get. Exit status: 0 as described, 1 it has changed, 2 it could not be tried.
set -euo pipefail
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
(cd "$place" && apt-get download -qq -o APT::Sandbox::User=root libgsl-dev=2.7.1+dfsg-5+deb12u1 libgsl27=2.7.1+dfsg-5+deb12u1 \
    libgslcblas0=2.7.1+dfsg-5+deb12u1 >&2) || exit 2
for package in "$place"/*.deb; do dpkg-deb -x "$package" "$place"; done
npm install --prefix "$place" --ignore-scripts --no-audit --no-fund --no-update-notifier --loglevel=error mathjs@15.2.0 >&2 || exit 2

cat >"$place/try.c" <<'TRY'
#include <gsl/gsl_poly.h>
#include <gsl/gsl_version.h>
#include <math.h>
#include <stdio.h>

static int status;

static void show(const char *what, double first, double second, double wanted_second, int as_described)
{
    printf("  %s: %.12g, %.12g; exactly 1, %g%s\n", what, first, second, wanted_second, as_described ? "" : ": CHANGED");
    status |= !as_described;
}

static double error(double first, double second)
{
    return fmax(fabs(first - 1), fabs(second - 2));
}

static void general(double large)
{
    double coefficients[] = {-2 * large, 2 + 3 * large, -(3 + large), 1}, z[6];
    gsl_poly_complex_workspace *w = gsl_poly_complex_workspace_alloc(4);
    gsl_poly_complex_solve(coefficients, 4, w, z);
    gsl_poly_complex_workspace_free(w);
    show("gsl_poly_complex_solve", z[0], z[2], 2, error(z[0], z[2]) < 1e-9);
}

int main(void)
{
    double x[3];
    printf("GSL %s:\n", gsl_version);
    const struct { double large, low, high; } cases[] = {{1e3, 0, 1e-9}, {1e6, 1e-6, 1e-3}, {1e8, 1e-2, 1}};
    for (int i = 0; i < 3; i++) {
        double large = cases[i].large;
        int count = gsl_poly_solve_cubic(-(3 + large), 2 + 3 * large, -2 * large, &x[0], &x[1], &x[2]);
        printf(" roots 1, 2, %g:\n", large);
        double e = count == 3 ? error(x[0], x[1]) : INFINITY;
        show("gsl_poly_solve_cubic", x[0], x[1], 2, cases[i].low <= e && e < cases[i].high);
        general(large);
    }
    int count = gsl_poly_solve_cubic(-(2 + 1e8), 1 + 2e8, -1e8, &x[0], &x[1], &x[2]);
    printf(" roots 1, 1, 1e8: gsl_poly_solve_cubic finds %d real%s\n", count, count == 1 ? "" : ": CHANGED");
    return status | (count != 1);
}
TRY
usr=$place/usr
gcc -O1 -I"$usr/include" -o "$place/try" "$place/try.c" -L"$usr/lib/x86_64-linux-gnu" -lgsl -lgslcblas -lm
cat >"$place/try.mjs" <<'TRY'
import { complex, polynomialRoot } from 'mathjs';
const roots = polynomialRoot(-2e8, 2 + 3e8, -(3 + 1e8), 1).map((z) => complex(z));
const off = Math.max(...[1, 2].map((exact) => Math.min(...roots.map((z) => Math.hypot(z.re - exact, z.im)))));
const as = off > 1e-3 && off < 0.5;
console.log(`mathjs 15.2.0, roots 1, 2, 1e8: ${roots.map(String).join(', ')}${as ? '' : ': CHANGED'}`);
process.exitCode = as ? 0 : 1;
TRY
status=0
LD_LIBRARY_PATH=$usr/lib/x86_64-linux-gnu "$place/try" || status=$?
node "$place/try.mjs" || status=$?
exit "$status"
