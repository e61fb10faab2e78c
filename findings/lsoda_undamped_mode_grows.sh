#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# LSODA lets the free vibration of a lightly damped mode grow, and calls it a success.
#
# x" + 2 z x' + x = 0 from x = 1, x' = 0 over 1000 periods: a mode of a cable in the air, left to itself.
# One would guess: LSODA, which chooses between Adams' and Gear's formulas by itself, is solve_ivp's safe choice; its error at a loose
#   tolerance looks like that of the others, which take some per cent from the amplitude: too much damping, which is easily seen.
# What happens: at solve_ivp's own tolerances (rtol 1e-3, atol 1e-6) the amplitude grows, from 1 to 1.04 in ten periods, 1.45 in a hundred,
#   37 in a thousand. A damping ratio of 1e-4 should leave 0.53 of it, and LSODA makes it 19; of 3e-4: 0.15, and it makes 5.3. Of all
#   six methods it is the only one that adds energy, with the most steps. Ten times finer (1e-4, 1e-7) it loses 26 % instead. Status and
#   message say that the end was reached. RK45 ten times finer is a surprise of its own: it loses 6 %, as before.
# What follows: a decay that looks unstable, as if of galloping or of negative aerodynamic damping, may be the integrator's.
# Seen with SciPy 1.10.1 (Debian 12), on 2026-11-28.
#
# Needs Debian 12's python3 and apt-get. Exit status: 0 as described, 1 it has changed, 2 it could not be tried.
set -euo pipefail
/usr/bin/python3 -c 'import sys; sys.exit(sys.version_info[:2] != (3, 11))' || { echo "needs Debian 12's python3 (3.11)" >&2 && exit 2; }
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
(cd "$place" && apt-get download -qq -o APT::Sandbox::User=root python3-scipy=1.10.1-2 python3-numpy=1:1.24.2-1+deb12u1 \
    python3-decorator=5.1.1-3 libblas3=3.11.0-2 liblapack3=3.11.0-2 liblbfgsb0=3.0+dfsg.4-1 libgfortran5 libquadmath0 >&2) || exit 2
for package in "$place"/*.deb; do dpkg-deb -x "$package" "$place"; done
usr=$place/usr/lib/x86_64-linux-gnu
export PYTHONPATH=$place/usr/lib/python3/dist-packages PYTHONDONTWRITEBYTECODE=1 LD_LIBRARY_PATH=$usr/blas:$usr/lapack:$usr

/usr/bin/python3 - <<'TRY'
import sys
import numpy as np
import scipy
from scipy.integrate import solve_ivp

TURN = 2 * np.pi
status = 0


def end(method, damping, periods, rtol=1e-3):
    """The amplitude that is left, and the number of steps."""
    answer = solve_ivp(lambda t, y: [y[1], -y[0] - 2 * damping * y[1]], (0, TURN * periods), [1, 0],
                       method=method, rtol=rtol, atol=rtol * 1e-3)
    assert answer.success, answer.message
    return np.hypot(*answer.y[:, -1]), len(answer.t) - 1


def show(what, value, low, high, exact):
    global status
    amplitude, steps = value
    as_described = low < amplitude < high
    status |= not as_described
    print(f"  {what}: {amplitude:.4f} after {steps} steps, exactly {exact:.4f}{'' if as_described else ': CHANGED'}")


print(f"SciPy {scipy.__version__}, amplitude of a mode that was let go at 1:")
for method in ("RK23", "RK45", "DOP853", "Radau", "BDF"):
    show(f"{method}, undamped, 1000 periods", end(method, 0, 1000), 0, 0.99, 1)
for periods, low, high in ((10, 1.02, 1.1), (100, 1.3, 1.7), (1000, 10, 100)):
    show(f"LSODA, undamped, {periods} periods", end("LSODA", 0, periods), low, high, 1)
for damping in (1e-4, 3e-4):
    show(f"LSODA, damping ratio {damping}, 1000 periods", end("LSODA", damping, 1000), 2, 60, np.exp(-damping * TURN * 1000))
show("LSODA, undamped, 1000 periods, rtol 1e-4", end("LSODA", 0, 1000, 1e-4), 0.5, 0.9, 1)
show("RK45, undamped, 1000 periods, rtol 1e-4", end("RK45", 0, 1000, 1e-4), 0.9, 0.96, 1)
sys.exit(status)
TRY
