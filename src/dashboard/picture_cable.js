/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cables as they hang: the static shape with what is on it and the bed, the tension along it, and the modes in motion. */
import { atPhase, compareModes } from './picture_parts.js';
import { brief } from './values.js';

const shapeOf = (answer) => answer.result.statics.shape;

/* Bodies and links, at their places. */
function marksOf({ result }) {
  return result.statics.attachments.map((one) => ({ x: one.x_m, y: one.z_m, kind: 'mass' }));
}

function bedLine({ request, result }) {
  if (!request.bed) return [];
  const depth = request.bed.depth_below_end_1_m ?? 0;
  const slope = Math.tan(((request.bed.slope_deg ?? 0) * Math.PI) / 180);
  const ends = [0, result.statics.span_m];
  return [{ label: 'bed', x: ends, y: ends.map((x) => x * slope - depth), dash: true }];
}

function statics(answer, kept, companion) {
  const shape = shapeOf(companion);
  if (!shape) return null;
  return {
    kind: 'chart', key: 'shape', name: 'static-shape', title: 'Static shape', x: { label: 'x, m' }, y: { label: 'z, m' }, equal: true,
    series: [{ label: 'cable', x: shape.map((point) => point.x_m), y: shape.map((point) => point.z_m) }, ...bedLine(answer)],
    note: answer.result.statics.lying_m > 0 ? `${brief(answer.result.statics.lying_m, 5)} m lie on the bed.` : '',
  };
}

function tension(answer) {
  const shape = shapeOf(answer);
  if (!shape) return null;
  return { kind: 'chart', key: 'tension', name: 'tension', title: 'Tension along the cable', x: { label: 'unstretched length from end 1, m' }, y: { label: 'tension, N' },
    series: [{ label: 'tension', x: shape.map((point) => point.position_m), y: shape.map((point) => point.tension_N) }] };
}

/* Sideways motion is drawn upwards. */
function motion(answer) {
  const rest = shapeOf(answer);
  const modes = [['in_plane', 'in plane'], ['out_of_plane', 'out of plane']].flatMap(([plane, words]) => (answer.result[plane] ?? [])
    .filter((mode) => mode.shape).map((mode) => ({
      label: `${words} ${mode.mode}: ${brief(mode.frequency_Hz, 5)} Hz${mode.damping_ratio > 0 ? `, damping ${brief(100 * mode.damping_ratio, 3)} %` : ''}`,
      rate: Math.min(2, 0.6 + 0.15 * mode.mode), note: plane === 'out_of_plane' ? 'Motion across the plane is drawn upwards.' : '',
      at: (phase) => mode.shape.map((point) => ({ x: atPhase(point.x, phase), y: atPhase(point.z ?? point.y, phase) })),
    })));
  if (!rest || !modes.length) return null;
  return { kind: 'motion', key: 'motion', name: 'mode-shape', title: 'Mode shape', unit: 'in m', rest: rest.map((point) => ({ x: point.x_m, y: point.z_m })), modes, marks: () => marksOf(answer) };
}

const forces = ({ result: { statics: s } }) => [
  { label: 'largest tension', value: s.tension_max_N, unit: 'N', more: `at the ends ${brief(s.tension_end_1_N, 6)} and ${brief(s.tension_end_2_N, 6)} N` },
  { label: 'sag', value: s.sag_max_m, unit: 'm', more: `unstretched length ${brief(s.unstretched_length_m, 8)} m` },
].filter((one) => one.value !== undefined);

const lowest = ({ result }) => ['in_plane', 'out_of_plane'].flatMap((plane) => (result[plane] ?? []).slice(0, 1).map((mode) => ({
  label: `mode 1 ${plane === 'in_plane' ? 'in plane' : 'out of plane'}`, value: mode.frequency_Hz, unit: 'Hz',
  more: mode.damping_ratio !== undefined ? `damping ratio ${brief(mode.damping_ratio, 4)}` : `axial share ${brief(mode.energy.axial, 3)}`,
})));

const withShape = (request) => (request.shape_points > 60 ? null : { ...request, shape_points: 161, compare: undefined });

export const cableStatics = {
  companion: withShape,
  headline: forces,
  pictures: (answer, kept, companion) => [statics(answer, kept, companion ?? answer), tension(companion ?? answer)],
  sweeps: [],
};

export const cableModes = {
  companion: withShape,
  headline: (answer) => [...lowest(answer), ...forces(answer).slice(0, 1)],
  pictures: (answer, kept, companion) => [motion(companion ?? answer), statics(answer, kept, companion ?? answer),
    compareModes('frequencies', [{ answer, label: kept.length ? 'this' : '' }, ...kept], ({ result }) => ({ 'in plane': result.in_plane, 'out of plane': result.out_of_plane }))],
  sweeps: [],
};
