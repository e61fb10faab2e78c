/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Taut chains: the chain with what hangs on it, its motion with nodes and antinodes, roots in the complex plane. */
import { atPhase, compareModes, magnitude } from './picture_parts.js';
import { brief } from './values.js';

const LENGTHS = { sphere: 'diameter_m', cone: 'height_m' };

function lengthOf(component) {
  if (component.type === 'inline_absorber') return component.links.reduce((sum, link) => sum + link.left_m + link.right_m, 0);
  const length = component[LENGTHS[component.type] ?? 'length_m'];
  return typeof length === 'number' ? length : 0;
}

/* Where each component that is not cable stands. */
export function attachments(components) {
  let at = 0;
  const out = [];
  for (const component of components) {
    const long = lengthOf(component);
    if (!component.type.includes('cable')) out.push({ x: at + long / 2, kind: 'mass', type: component.type });
    at += long;
  }
  return { out, length: at };
}

function nearest(points, x) {
  return points.reduce((best, point, i) => (Math.abs(point.x - x) < Math.abs(points[best].x - x) ? i : best), 0);
}

function motion(answer) {
  const shaped = answer.result.modes.filter((mode) => mode.shape?.length);
  if (!shaped.length) return null;
  const rest = shaped[0].shape.map((point) => ({ x: point.x_m, y: 0 }));
  const hung = attachments(answer.request.components).out;
  const label = hung.length <= 12;
  return {
    kind: 'motion', key: 'motion', name: 'chain', title: 'The chain, its nodes and antinodes', unit: 'm', rest,
    modes: shaped.map((mode) => ({
      source: mode, label: `mode ${mode.mode}: ${brief(mode.frequency_Hz, 5)} Hz`, rate: Math.min(2, 0.6 + 0.15 * mode.mode),
      note: 'Discs: what hangs on the chain; rings: nodes; diamonds: antinodes.',
      at: (phase) => mode.shape.map((point) => ({ x: 0, y: atPhase(point.displacement, phase) })),
    })),
    marks: ({ source }, now) => [
      ...(source.nodes_m ?? []).slice(0, 60).map((x) => ({ x, y: 0, kind: 'node' })),
      ...(source.antinodes ?? []).slice(0, 60).map(({ x_m: x }) => ({ x, y: now[nearest(rest, x)].y, kind: 'antinode' })),
      ...hung.map(({ x, type }) => ({ x, y: now[nearest(rest, x)].y, kind: 'mass', label: label ? type.replaceAll('_', ' ') : '' })),
    ],
  };
}

function roots(answer) {
  const damped = answer.result.modes.filter((mode) => mode.damping_ratio > 0);
  if (!damped.length) return null;
  return { kind: 'chart', key: 'roots', name: 'damping', title: 'Damping ratio of each mode', x: { label: 'frequency, Hz' }, y: { label: 'damping ratio', min: 0 },
    series: [{ label: 'modes', x: damped.map((mode) => mode.frequency_Hz), y: damped.map((mode) => mode.damping_ratio), pointsOnly: true }] };
}

export const taut = {
  companion: (request, answer) => (request.shape_points > 60 || !answer.result.modes.length ? null : { ...request, shape_points: 401, nodes: true, verify: undefined }),
  headline: ({ result }) => result.modes.slice(0, 2).map((mode) => ({ label: `mode ${mode.mode}`, value: mode.frequency_Hz, unit: 'Hz',
    more: `${brief(mode.angular_frequency_rad_per_s)} rad/s${mode.damping_ratio ? `, damping ratio ${brief(mode.damping_ratio, 4)}` : ''}` })),
  pictures: (answer, kept, companion) => [motion(companion ?? answer), roots(answer),
    compareModes('frequencies', [{ answer, label: kept.length ? 'this' : '' }, ...kept], ({ result }) => ({ modes: result.modes }))],
  sweeps: [],
};

export const matrix = {
  headline: () => [],
  hint: ({ result }) => (result.matrices.filter((one) => one.angular_frequency.im === 0).length < 2
    ? 'Several real frequencies make a curve of t\u2081\u2082, whose zeros are the natural frequencies.' : ''),
  pictures(answer, kept) {
    const series = [{ answer, label: kept.length ? 'this' : '|t\u2081\u2082|' }, ...kept].map(({ answer: one, label }, i) => {
      const rows = one.result.matrices.filter((row) => row.angular_frequency.im === 0);
      return { label, x: rows.map((row) => row.angular_frequency.re), y: rows.map((row) => magnitude(row.chain[1])), points: rows.length < 60, dash: i > 0 };
    });
    if (series[0].x.length < 2) return [];
    return [{ kind: 'chart', key: 't12', name: 't12', title: 'Size of t\u2081\u2082 of the chain', x: { label: 'angular frequency, rad/s' }, y: { label: '|t\u2081\u2082|, m/N', log: true },
      series,
      note: 'Its zeros are the natural frequencies of the chain between fixed ends (Levesque, Figure 3-2).' }];
  },
  sweeps: [],
};
