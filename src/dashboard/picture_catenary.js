/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Suspended cables: modes in motion, frequencies against the sag parameter (Gale, Figures 3.2 to 3.11), comparison. */
import { atPhase, compareModes, spread } from './picture_parts.js';
import { brief } from './values.js';

/* The equilibrium point of a shape point: metres where the answer has them, else in a from the lowest point. */
export function restOf(point) {
  return point.x_m !== undefined ? { x: point.x_m, y: point.y_m } : { x: point.chi, y: Math.cosh(point.chi) - 1 };
}

/* Displacement (tangential, normal) turned into the sheet; out of plane it is drawn towards the reader's lower left. */
export function moveOf(point, parts, phase) {
  const slope = Math.sinh(point.chi);
  const long = Math.hypot(1, slope);
  const [u, v, w] = [atPhase(parts.tangential, phase), atPhase(parts.normal, phase), atPhase(parts.out_of_plane, phase)];
  return { x: (u - slope * v) / long - 0.45 * w, y: (slope * u + v) / long - 0.6 * w };
}

function modeWords(plane, mode) {
  const rate = mode.frequency_Hz !== undefined ? `${brief(mode.frequency_Hz, 5)} Hz` : `ratio ${brief(mode.frequency_ratio, 5)}`;
  return `${plane.replaceAll('_', ' ')} ${mode.mode}: ${rate}${mode.symmetry === 'none' ? '' : `, ${mode.symmetry}`}`;
}

function motion(answer) {
  const planes = ['in_plane', 'out_of_plane'].filter((plane) => answer.result[plane]?.some((mode) => mode.shape));
  if (!planes.length) return null;
  const shaped = planes.flatMap((plane) => answer.result[plane].filter((mode) => mode.shape).map((mode) => [plane, mode]));
  const points = shaped[0][1].shape;
  return {
    kind: 'motion', key: 'motion', name: 'mode-shape', title: 'Mode shape on the hanging cable', unit: points[0].x_m !== undefined ? 'm' : 'in a',
    rest: points.map(restOf),
    modes: shaped.map(([plane, mode]) => ({
      label: modeWords(plane, mode), rate: Math.min(2, 0.6 + 0.15 * mode.mode),
      note: plane === 'out_of_plane' ? 'Out of plane: drawn obliquely, towards you.' : '',
      at: (phase) => mode.shape.map((point) => moveOf(point, point, phase)),
    })),
  };
}

function sagParameter(geometry) {
  return 1 / Math.sqrt(geometry.length_to_span ** 2 - geometry.rise_to_span ** 2);
}

const FIGURES = { 0: ['3.2', '3.7'], 0.25: ['3.3', '3.8'], 0.5: ['3.4', '3.9'], 1: ['3.5', '3.10'], 2: ['3.6', '3.11'] };

const sweep = {
  key: 'sag',
  requests(answer) {
    const { geometry } = answer.result;
    const modes = Math.min(6, answer.request.modes ?? 6);
    const rise = geometry.rise_to_span;
    return spread(0.04, 0.98, 48).map((p) => ({ rise_to_span: rise, sag_parameter: p, modes, plane: answer.request.plane ?? 'both' }));
  },
  chart(answer, found) {
    const { geometry } = answer.result;
    const series = [];
    for (const plane of ['in_plane', 'out_of_plane']) {
      const count = Math.max(0, ...found.map(({ answer: one }) => one.result[plane]?.length ?? 0));
      for (let k = 0; k < count; k += 1) {
        const some = found.filter(({ answer: one }) => one.result[plane]?.[k]);
        series.push({ label: `${plane === 'in_plane' ? 'in' : 'out'} ${k + 1}`, dash: plane !== 'in_plane', colour: k,
          x: some.map(({ request }) => request.sag_parameter), y: some.map(({ answer: one }) => one.result[plane][k].frequency_ratio) });
      }
    }
    /* Towards a taut cable all ratios grow without bound: the sheet ends where most of it would be empty, or above this cable. */
    const inside = sagParameter(geometry) <= 0.98;
    const here = !inside ? [] : [...(answer.result.in_plane ?? []), ...(answer.result.out_of_plane ?? [])].map((mode) => mode.frequency_ratio);
    const beside = series.flatMap((one) => one.y.filter((y, i) => one.x[i] <= 0.955));
    const top = 1.1 * Math.max(...here.slice(0, 6), ...beside);
    const figure = FIGURES[Math.abs(geometry.rise_to_span)];
    return {
      kind: 'chart', key: 'sag', name: 'frequency-against-sag', title: 'Natural frequency against sag',
      x: { label: 'sag parameter b/\u221a(l\u00b2 \u2212 h\u00b2): deep to taut', min: 0, max: 1 }, y: { label: 'frequency ratio \u03c9/\u221a(g/a)', min: 0, max: top }, series,
      marks: [{ x: sagParameter(geometry), label: 'this cable' }],
      note: `Inextensible and undamped, h/b = ${brief(geometry.rise_to_span)}${figure ? ` (Gale, Figures ${figure.join(' and ')})` : ''}; in-plane lines are whole, out-of-plane ones dashed.`,
    };
  },
};

export const catenary = {
  companion: (request) => (request.shape_points > 60 ? null : { ...request, shape_points: 121, verify: undefined }),
  headline({ result }) {
    const first = ['in_plane', 'out_of_plane'].filter((plane) => result[plane]?.length).map((plane) => ({ plane, mode: result[plane][0] }));
    return first.map(({ plane, mode }) => ({
      label: `first frequency ${plane.replaceAll('_', ' ')}${mode.symmetry === 'none' ? '' : `, ${mode.symmetry}`}`,
      value: mode.frequency_Hz ?? mode.frequency_ratio, unit: mode.frequency_Hz !== undefined ? 'Hz' : '\u221a(g/a)',
      more: mode.frequency_Hz !== undefined ? `period ${brief(mode.period_s)} s, ${brief(mode.angular_frequency_rad_per_s)} rad/s` : '',
    }));
  },
  pictures: (answer, kept, companion) => [motion(companion ?? answer),
    compareModes('frequencies', [{ answer, label: kept.length ? 'this' : '' }, ...kept], ({ result }) => ({ 'in plane': result.in_plane, 'out of plane': result.out_of_plane }))],
  sweeps: [sweep],
};
