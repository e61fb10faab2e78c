#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# numeric.js gives wrong eigenvalues for the stiffness matrix of a string, and nothing tells of it.
#
# The matrix of n equal masses on a taut string: 2 on the diagonal, -1 beside it; its eigenvalues are 4 sin^2(k pi / (2 n + 2)).
# One would guess: a symmetric tridiagonal matrix of whole numbers is the easiest of all; numeric.eig finds its eigenvalues to many digits.
# What happens: right to the last digits for 3 masses, wrong by a third for 6, threefold for 10 (the lowest is 0.268 instead of 0.081). The
#   values are real, all different but a pair, and their sum is the trace, so that they look like an answer; nothing is thrown. ml-matrix
#   and mathjs are right to 13 digits on the same matrices.
# What follows: a page that computes the modes of ten masses with numeric.js shows a first frequency that is 80 % too high.
# Seen with numeric 1.2.6, ml-matrix 6.15.1 and mathjs 15.2.0, node 20.20.2, on 2026-11-28.
#
# Needs node and npm. Exit status: 0 as described, 1 it has changed, 2 it could not be tried.
set -euo pipefail
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
npm install --prefix "$place" --ignore-scripts --no-audit --no-fund --no-update-notifier --loglevel=error \
    numeric@1.2.6 ml-matrix@6.15.1 mathjs@15.2.0 >&2 || exit 2

cat >"$place/try.mjs" <<'TRY'
import { createRequire } from 'node:module';
import { EigenvalueDecomposition, Matrix } from 'ml-matrix';
import { eigs } from 'mathjs';

const numeric = createRequire(import.meta.url)('numeric');
const string = (n) => Array.from({ length: n }, (_, i) => Array.from({ length: n }, (_, j) => [2, -1][Math.abs(i - j)] ?? 0));
const sorted = (values) => Array.from(values).sort((a, b) => a - b);
const ways = {
  numeric: (a) => { const { x, y } = numeric.eig(a).lambda; return y?.some((v) => v !== 0) ? x.map(() => NaN) : x; },
  'ml-matrix': (a) => new EigenvalueDecomposition(new Matrix(a)).realEigenvalues,
  mathjs: (a) => eigs(a, { eigenvectors: false }).values,
};
const wrong = { 3: [0, 1e-12], 6: [0.2, 0.5], 10: [2, 3] };
console.log(`numeric ${numeric.version}, node ${process.versions.node}; worst relative error of the eigenvalues:`);
for (const [n, [low, high]] of Object.entries(wrong)) {
  const exact = Array.from({ length: n }, (_, k) => 4 * Math.sin(((k + 1) * Math.PI) / (2 * n + 2)) ** 2);
  for (const [name, way] of Object.entries(ways)) {
    const found = sorted(way(string(Number(n))));
    const error = Math.max(...found.map((value, k) => Math.abs(value - exact[k]) / exact[k]));
    const trace = found.reduce((a, b) => a + b);
    const as = (name === 'numeric' ? error >= low && error < high : error < 1e-12) && Math.abs(trace - 2 * n) < 1e-9;
    if (!as) process.exitCode = 1;
    const lowest = `the lowest ${found[0].toFixed(4)}, exactly ${exact[0].toFixed(4)}`;
    console.log(`  ${n} masses, ${name}: ${error.toExponential(0)}; ${lowest}${as ? '' : ': CHANGED'}`);
  }
}
TRY
node "$place/try.mjs"
