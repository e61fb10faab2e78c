#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# mathjs takes a flexibility matrix in SI units for a diagonal one.
#
# eigs of 2s on the diagonal and -s beside it: the same matrix in other units, s from 1 down to 1e-13.
# One would guess: eigenvalues scale with the matrix; only the last digits may depend on the unit. `precision` is relative, as all of
#   mathjs' tolerances are (config.relTol).
# What happens: entries are compared with 1e-12 itself. Down to 1e-6 the eigenvalues are right to 15 digits, at 1e-10 to five, at 1e-12 the
#   lowest is 58 % too high, and below that the diagonal comes back as it was, six times 2 s: without an error, though eigs can throw. At
#   1e12 nothing is amiss. ml-matrix is right at every scale.
#   `precision` of 1e-12 s mends 1e-10, not 1e-12, where eigenvalues are merged by threes. It must be rounded: 9.999999999999999e-19, which
#   is 1e-12 times 1e-6, is refused for having too many digits for a BigNumber, though nothing here is one.
# What follows: scale a matrix of small numbers (m/N, kg m/N, s^2) to about one before, and the eigenvalues back.
# Seen with mathjs 15.2.0 and ml-matrix 6.15.1, node 20.20.2, on 2026-11-28.
#
# Needs node and npm. Exit status: 0 as described, 1 it has changed, 2 it could not be tried.
set -euo pipefail
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
npm install --prefix "$place" --ignore-scripts --no-audit --no-fund --no-update-notifier --loglevel=error \
    mathjs@15.2.0 ml-matrix@6.15.1 >&2 || exit 2

cat >"$place/try.mjs" <<'TRY'
import { eigs } from 'mathjs';
import { EigenvalueDecomposition, Matrix } from 'ml-matrix';

const N = 6;
const matrix = (s) => Array.from({ length: N }, (_, i) => Array.from({ length: N }, (_, j) => s * ([2, -1][Math.abs(i - j)] ?? 0)));
const exact = Array.from({ length: N }, (_, k) => 4 * Math.sin(((k + 1) * Math.PI) / (2 * N + 2)) ** 2);
const ways = {
  mathjs: (s) => eigs(matrix(s), { eigenvectors: false }).values,
  'mathjs, precision 1e-12 s': (s) => eigs(matrix(s), { eigenvectors: false, precision: Number((1e-12 * s).toPrecision(6)) }).values,
  'ml-matrix': (s) => new EigenvalueDecomposition(new Matrix(matrix(s))).realEigenvalues,
};
const bounds = { 1: [0, 1e-12], '1e-6': [0, 1e-12], '1e-10': [1e-8, 1e-3], '1e-12': [0.1, 1], '1e-13': [9, 10], '1e12': [0, 1e-12] };
console.log(`mathjs 15.2.0, ml-matrix 6.15.1, node ${process.versions.node}; worst relative error of six eigenvalues:`);
for (const [scale, [low, high]] of Object.entries(bounds)) {
  for (const [name, way] of Object.entries(ways)) {
    const found = Array.from(way(Number(scale))).sort((a, b) => a - b).map((value) => value / Number(scale));
    const error = Math.max(...found.map((value, k) => Math.abs(value - exact[k]) / exact[k]));
    const merged = name.includes('precision') && low >= 0.1;
    const [from, to] = name === 'mathjs' ? [low, high] : merged ? [1, 10] : [0, 1e-12];
    const as = error >= from && error < to;
    if (!as) process.exitCode = 1;
    const values = found.map((value) => value.toFixed(3)).join(' ');
    console.log(`  s = ${scale}, ${name}: ${error.toExponential(0)}; over s: ${values}${as ? '' : ': CHANGED'}`);
  }
}
TRY
node "$place/try.mjs"
