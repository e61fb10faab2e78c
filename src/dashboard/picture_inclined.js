/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inclined elastic cables: the crossover of symmetric and antisymmetric modes and their hybrid share over lambda^2. */
import { atPhase, compareModes, spread } from './picture_parts.js';
import { brief } from './values.js';

function motion(answer) {
  const shaped = answer.result.modes.filter((mode) => mode.shape);
  if (!shaped.length) return null;
  const angle = ((answer.request.inclination_deg ?? 0) * Math.PI) / 180;
  const sag = ((answer.request.epsilon ?? answer.result.statics?.epsilon ?? 0) * Math.cos(angle)) / 8;
  const turn = (along, across) => ({ x: along * Math.cos(angle) - across * Math.sin(angle), y: along * Math.sin(angle) + across * Math.cos(angle) });
  return {
    kind: 'motion', key: 'motion', name: 'mode-shape', title: 'Mode shape on the inclined cable', unit: 'in L',
    rest: shaped[0].shape.map(({ s }) => turn(s, -4 * sag * s * (1 - s))),
    modes: shaped.map((mode) => ({
      label: `mode ${mode.mode}: kL/\u03c0 ${brief(mode.kl_over_pi, 5)}, ${mode.family}`, rate: Math.min(2, 0.6 + 0.15 * mode.mode),
      at: (phase) => mode.shape.map((point) => turn(atPhase(point.longitudinal, phase), atPhase(point.transverse, phase))),
    })),
  };
}

function tension(answer) {
  const shaped = answer.result.modes.filter((mode) => mode.shape);
  if (!shaped.length) return null;
  return { kind: 'chart', key: 'tension', name: 'dynamic-tension', title: 'Dynamic tension along the cable', x: { label: 's/L from the lower end' }, y: { label: 'tension in T\u2090' }, note: 'For a displacement of L: a hundredth of L makes a hundredth of it.',
    series: shaped.slice(0, 6).map((mode) => ({ label: `mode ${mode.mode}`, x: mode.shape.map(({ s }) => s), y: mode.shape.map((point) => point.tension) })) };
}

/* In groups of the report, whatever the request was given in. */
function groups({ request, result }) {
  const from = (name) => request[name] ?? result.statics?.[name] ?? result[name];
  return { epsilon: from('epsilon'), inclination_deg: from('inclination_deg'), mass_ratio: from('mass_ratio'), lambda_squared: from('lambda_squared') };
}

function curves(found, value) {
  const count = Math.max(0, ...found.map(({ answer }) => answer.result.modes.length));
  return Array.from({ length: Math.min(count, 6) }, (_, k) => {
    const some = found.filter(({ answer }) => answer.result.modes[k]?.[value] !== undefined);
    return { label: `mode ${k + 1}`, colour: k, x: some.map(({ request }) => request.lambda_squared / Math.PI ** 2),
      /* Where the k-th mode becomes one of another family (longitudinal ones come low in a soft cable) its curve is cut. */
      y: some.map(({ answer }, i) => (i && some[i - 1].answer.result.modes[k].family !== answer.result.modes[k].family ? null : answer.result.modes[k][value])) };
  });
}

function overLambda(key, value, title, label, note) {
  return {
    key,
    shares: 'lambda',
    requests(answer) {
      const { epsilon, inclination_deg: inclination, mass_ratio: mass } = groups(answer);
      if (epsilon === undefined) return [];
      const top = Math.max(24 * Math.PI ** 2, 1.3 * (groups(answer).lambda_squared ?? 0));
      return spread(0.02 * Math.PI ** 2, top, 90).map((lambda) => ({ epsilon, inclination_deg: inclination, mass_ratio: mass, lambda_squared: lambda, modes: 4, statics: answer.request.statics }));
    },
    chart(answer, found) {
      const here = groups(answer).lambda_squared;
      const marks = [1, 2].map((n) => ({ x: 4 * n * n, label: `crossover ${n}` }));
      if (here !== undefined && Number.isFinite(here)) marks.push({ x: here / Math.PI ** 2, label: 'this cable' });
      const series = curves(found, value);
      const last = series[0]?.x.at(-1) ?? 0;
      return { kind: 'chart', key, name: key, title, x: { label: '\u03bb\u00b2/\u03c0\u00b2' }, y: { label, min: 0 }, series, marks: marks.filter((mark) => mark.x <= last).sort((a, b) => a.x - b.x), note };
    },
  };
}

export const inclined = {
  companion: (request) => (request.shape_points > 60 ? null : { ...request, shape_points: 121, verify: undefined, compare: undefined }),
  headline: ({ result }) => result.modes.slice(0, 2).map((mode) => ({
    label: `mode ${mode.mode}, ${mode.family}`, value: mode.frequency_Hz ?? mode.kl_over_pi, unit: mode.frequency_Hz !== undefined ? 'Hz' : 'kL/\u03c0',
    more: `longitudinal share ${brief(mode.longitudinal_energy, 3)}, tension amplification ${brief(mode.tension_amplification, 4)}`,
  })),
  pictures: (answer, kept, companion) => [motion(companion ?? answer), tension(companion ?? answer),
    compareModes('frequencies', [{ answer, label: kept.length ? 'this' : '' }, ...kept], ({ result }) => ({ modes: result.modes }))],
  sweeps: [
    overLambda('crossover', 'kl_over_pi', 'Crossover: frequency over \u03bb\u00b2', 'kL/\u03c0', 'Where a level cable\u2019s curves cross, those of an inclined one veer: both modes are hybrid there.'),
    overLambda('hybrid', 'symmetric_share', 'Hybrid share: how symmetric each mode is', 'symmetric share', '1: symmetric, 0: antisymmetric, between them hybrid.'),
    overLambda('amplification', 'tension_amplification', 'Tension amplification over \u03bb\u00b2', 'amplification of tension', 'Dynamic tension per unit of transverse motion.'),
  ],
};
