#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Fewer than twenty masses on a weightless cable: ARPACK complains of its workspace, and finds not even one mode.
#
# A cable of 200 nodes whose mass sits in a few of them (a mass matrix with zeros on its diagonal), the lowest modes wanted.
# One would guess: shift and invert needs no inverse of the mass matrix, which may be singular; ten masses have ten modes, and the first of
#   them is a small problem.
# What happens: "ARPACK error -9999: Could not build an Arnoldi factorization ... enough workspace and array storage". It is neither: eigsh
#   takes at least ncv = 20 vectors by itself, and a basis of more vectors than there are masses cannot be. With ncv up to the number of
#   masses all is right to 14 digits, with one more it fails. 20 masses work as they are, 19 do not.
# What follows: give ncv (at most the number of masses); what the message proposes, more workspace, makes it worse.
# Seen with SciPy 1.10.1 (Debian 12), which has ARPACK inside, on 2026-11-28.
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

/usr/bin/python3 -W error - <<'TRY'
import sys
import numpy as np
import scipy
from scipy.sparse import diags
from scipy.sparse.linalg import ArpackError, eigsh

NODES = 209
stiffness = diags([2 * np.ones(NODES), -np.ones(NODES - 1), -np.ones(NODES - 1)], [0, 1, -1], format="csc")


def attempt(masses, modes, ncv):
    """The worst relative error of the lowest modes, or what was raised."""
    at = np.linspace(0, NODES - 1, masses + 2).astype(int)[1:-1]
    mass = np.zeros(NODES)
    mass[at] = 1
    flexibility = np.linalg.inv(stiffness.toarray())[np.ix_(at, at)]
    exact = np.sort(1 / np.linalg.eigvalsh(flexibility))[:modes]
    try:
        found = np.sort(eigsh(stiffness, k=modes, M=diags(mass, format="csc"), sigma=0, ncv=ncv,
                              v0=np.random.default_rng(1).standard_normal(NODES), return_eigenvectors=False))
    except ArpackError as error:
        return str(error)[:63]
    return max(abs(found - exact) / exact)


print(f"SciPy {scipy.__version__}, eigsh about 0:")
status = 0
for masses, modes, ncv, works in ((10, 1, None, 0), (10, 4, None, 0), (10, 4, 10, 1), (10, 4, 11, 0), (10, 4, 15, 0),
                                  (19, 1, None, 0), (19, 1, 19, 1), (20, 1, None, 1), (20, 1, 21, 0), (20, 9, None, 1)):
    answer = attempt(masses, modes, ncv)
    as_described = works == (not isinstance(answer, str)) and (answer < 1e-10 if works else "-9999" in answer)
    status |= not as_described
    print(f"  {masses} masses, {modes} mode(s), ncv {ncv}: {f'right to {answer:.0e}' if works == 1 and as_described else answer}"
          f"{'' if as_described else ': CHANGED'}")
sys.exit(status)
TRY
