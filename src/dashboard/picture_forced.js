/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forced motion: tension against forcing frequency with the resonances marked (Gale, Figures 3.14 and 3.15), profiles
 * along the cable (3.16), and the cable in motion. */
import { moveOf, restOf } from './picture_catenary.js';
import { polar } from './picture_parts.js';
import { brief } from './values.js';

function curve(answer, kept) {
  const series = [{ answer, label: kept.length ? 'this' : 'largest along the cable' }, ...kept].map(({ answer: one, label }, i) => {
    const points = one.result.curve.filter((point) => !point.unbounded);
    return { label, x: points.map((point) => point.frequency_ratio), y: points.map((point) => point.max_dynamic_tension), points: points.length < 40, dash: i > 0 };
  });
  const marks = answer.result.resonances.map((one) => ({ x: one.forcing_frequency_ratio ?? one.frequency_ratio, label: `${one.plane === 'in_plane' ? '' : 'out '}${one.mode}` }));
  return {
    kind: 'chart', key: 'curve', name: 'dynamic-tension', title: 'Largest dynamic tension against forcing frequency', series, marks,
    x: { label: 'forcing frequency \u03c9/\u221a(g/a)' }, y: { label: 'tension in S\u2080', log: true },
    note: `${marks.length} natural frequenc${marks.length === 1 ? 'y' : 'ies'} in the range, marked with the mode's number.`,
  };
}

function along(answer) {
  const profiles = (answer.result.profiles ?? []).filter((one) => one.points);
  if (!profiles.length) return null;
  return {
    kind: 'chart', key: 'profiles', name: 'tension-profile', title: 'Dynamic tension along the cable', x: { label: 'chi: x/a from the lowest point' }, y: { label: 'tension in S\u2080' },
    series: profiles.map((one) => ({ label: `ratio ${brief(one.frequency_ratio)}`, x: one.points.map((point) => point.chi), y: one.points.map((point) => point.tension) })),
    note: answer.request.eta_normal || answer.request.eta_tangential ? 'Amplitudes; with damping the phase differs along the cable.' : '',
  };
}

function motion(answer) {
  const profiles = (answer.result.profiles ?? []).filter((one) => one.points);
  if (!profiles.length) return null;
  const parts = (point) => Object.fromEntries(['tangential', 'normal', 'out_of_plane'].map((name) => [name, polar(point[name], point[`${name}_phase_deg`])]));
  return {
    kind: 'motion', key: 'motion', name: 'forced-motion', title: 'The cable while its end moves', unit: profiles[0].points[0].x_m !== undefined ? 'm' : 'in a',
    rest: profiles[0].points.map(restOf), note: 'Scaled so that the largest displacement is as large as the slider says.',
    modes: profiles.map((one) => {
      const moves = one.points.map(parts);
      const largest = Math.max(1e-300, ...moves.map((move) => Math.hypot(...Object.values(move).flatMap((part) => [part.re, part.im]))));
      return { label: `at ratio ${brief(one.frequency_ratio)}`, rate: 0.8, at: (phase) => one.points.map((point, i) => {
        const move = moveOf(point, moves[i], phase);
        return { x: move.x / largest, y: move.y / largest };
      }) };
    }),
  };
}

export const forced = {
  headline({ request, result }) {
    const free = !request.eta_normal && !request.eta_tangential && result.resonances.length > 0;
    const bounded = result.curve.filter((point) => !point.unbounded);
    const worst = bounded.reduce((a, b) => (b.max_dynamic_tension > (a?.max_dynamic_tension ?? -1) ? b : a), null);
    return [
      worst && { label: free ? 'largest at the frequencies asked for; at a resonance it has no bound' : 'largest dynamic tension', value: worst.max_dynamic_tension_N ?? worst.max_dynamic_tension, unit: worst.max_dynamic_tension_N !== undefined ? 'N' : 'S\u2080',
        more: `at ratio ${brief(worst.frequency_ratio)}${worst.frequency_Hz !== undefined ? `, ${brief(worst.frequency_Hz)} Hz` : ''}` },
      { label: 'resonances in the range', value: result.resonances.length, unit: '', more: result.resonances.slice(0, 4).map((one) => brief(one.frequency_ratio, 5)).join(', ') },
    ].filter(Boolean);
  },
  /* Without profiles asked for there is none to draw: one beside the lowest resonance is asked for. */
  companion(request, answer) {
    if (request.profiles_at || request.harmonics) return null;
    const near = answer.result.resonances[0]?.frequency_ratio;
    const at = near !== undefined ? 0.985 * near : answer.result.curve[0].frequency_ratio;
    const few = { ...request, profiles_at: [at], profile_points: 121, frequency_ratios: [at], verify: undefined };
    for (const name of ['frequency_ratio_min', 'frequency_ratio_max', 'points']) delete few[name];
    return few;
  },
  pictures: (answer, kept, companion) => [curve(answer, kept), motion(answer.result.profiles?.length ? answer : companion ?? answer), along(answer.result.profiles?.length ? answer : companion ?? answer)],
  sweeps: [],
};
