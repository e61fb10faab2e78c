#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# GSL's fifth zero of a Bessel function has nine digits, all its other zeros have fifteen.
#
# gsl_sf_bessel_zero_Jnu(nu, s), the s-th positive zero: frequencies of tapered cables, hanging chains, membranes.
# One would guess: as gsl_sf_bessel_zero_J0 and _J1, right to the last digits for every s; if it were less, then for all s alike, or
#   less and less as s grows.
# What happens: of every whole order from 5 to 20 the fifth zero alone is off by 5e-10 to 4e-9, a million times more than the fourth and the
#   sixth; below order 5 it is as good as they are. The function returns success. Only its estimate of the error (of the _e form) knows: it
#   says 1e-8 there and 2e-15 beside.
# What follows: one Newton step, zero - J/J', gives the missing digits.
# Seen with GSL 2.7.1+dfsg-5+deb12u1 (Debian 12), on 2026-11-28.
#
# Needs gcc and apt-get. Exit status: 0 as described, 1 it has changed, 2 it could not be tried.
set -euo pipefail
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
(cd "$place" && apt-get download -qq -o APT::Sandbox::User=root libgsl-dev=2.7.1+dfsg-5+deb12u1 libgsl27=2.7.1+dfsg-5+deb12u1 \
    libgslcblas0=2.7.1+dfsg-5+deb12u1 >&2) || exit 2
for package in "$place"/*.deb; do dpkg-deb -x "$package" "$place"; done
cat >"$place/try.c" <<'TRY'
#include <gsl/gsl_sf_bessel.h>
#include <gsl/gsl_version.h>
#include <math.h>
#include <stdio.h>

static int status;

/* The relative step that Newton's method would take from the zero, by the C library's own functions of whole order. */
static double error(int order, unsigned s, double *claimed)
{
    gsl_sf_result zero;
    gsl_sf_bessel_zero_Jnu_e(order, s, &zero);
    double slope = order / zero.val * jn(order, zero.val) - jn(order + 1, zero.val);
    *claimed = zero.err / zero.val;
    return fabs(jn(order, zero.val) / slope) / zero.val;
}

int main(void)
{
    printf("GSL %s, relative error of the s-th zero (what GSL claims):\n", gsl_version);
    for (int order = 2; order <= 20; order++) {
        double beside = 0, claimed, most = 0;
        for (unsigned s = 1; s <= 12; s++)
            if (s != 5) {
                beside = fmax(beside, error(order, s, &claimed));
                most = fmax(most, claimed);
            }
        double fifth = error(order, 5, &claimed);
        int as_described = beside < 1e-13 && most < 1e-13 && (order < 5 ? fifth < 1e-13 : fifth > 1e-10 && fifth < 1e-8 && claimed > 1e-9);
        status |= !as_described;
        printf("  order %2d: s = 5: %.0e (%.0e); s = 1 to 12 without 5: at most %.0e (%.0e)%s\n", order, fifth, claimed, beside, most,
               as_described ? "" : ": CHANGED");
    }
    return status;
}
TRY
usr=$place/usr
gcc -O1 -I"$usr/include" -o "$place/try" "$place/try.c" -L"$usr/lib/x86_64-linux-gnu" -lgsl -lgslcblas -lm
LD_LIBRARY_PATH=$usr/lib/x86_64-linux-gnu "$place/try"
