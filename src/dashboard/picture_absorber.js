/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Absorbers: every branch of damping against the variable swept, and the optimum on them. */
import { brief } from './values.js';

/* Beyond a coalescence roots lie on no numbered branch, several at a value: as points, the first of each value, the
 * second, and so on. */
function layers(points) {
  const out = [];
  points.forEach((point, i) => {
    const before = points.slice(0, i).filter((other) => other.value === point.value).length;
    (out[before] ??= []).push(point);
  });
  return out;
}

function branches(answer, key, label, title) {
  const { result } = answer;
  const sweep = result.sweep;
  const variable = sweep?.variable ?? answer.request.sweep?.variable;
  if (!sweep || !variable) return null;
  const curve = (words, points, more) => ({ label: words, x: points.map((point) => point.value), y: points.map((point) => point[key]), ...more });
  const numbered = sweep.branches.filter(({ mode }) => mode);
  const others = sweep.branches.filter(({ mode }) => !mode).flatMap(({ points }) => layers(points));
  const series = [...numbered.map(({ mode, points }) => curve(`mode ${mode}`, points, { colour: mode - 1 })),
    ...others.map((points, i) => curve(`on no branch${i ? `, ${i + 1}` : ''}`, points, { pointsOnly: true, colour: 3 }))].filter((one) => one.x.length);
  if (!series.length) return null;
  const best = result.optimum?.[variable];
  const span = [Math.min(...series.flatMap((one) => one.x)), Math.max(...series.flatMap((one) => one.x))];
  if (best !== undefined) {
    const there = (result.limiting_modes ?? []).filter((mode) => mode[key] !== undefined);
    series.push({ label: 'optimum', x: there.map(() => best), y: there.map((mode) => mode[key]), pointsOnly: true, colour: 4 });
  }
  if (key === 'damping_ratio' && result.required_damping_ratio !== undefined) {
    series.push({ label: 'required', x: span, y: span.map(() => result.required_damping_ratio), dash: true, colour: 5 });
  }
  const positive = series.every((one) => one.x.every((x) => x > 0));
  const wide = positive && Math.max(...series.flatMap((one) => one.x)) > 50 * Math.min(...series.flatMap((one) => one.x));
  return { kind: 'chart', key, name: `sweep-${key}`, title, x: { label: variable, log: wide }, y: { label, min: key === 'damping_ratio' ? 0 : undefined }, series,
    marks: best === undefined ? [] : [{ x: best, label: `optimum ${brief(best, 5)}` }] };
}

/* With the branches of kept answers, dashed, where the same variable was swept. */
function compared(answer, kept, ...how) {
  const chart = branches(answer, ...how);
  for (const one of chart ? kept : []) {
    const other = branches(one.answer, ...how);
    if (other?.x.label !== chart.x.label) continue;
    chart.series.push(...other.series.filter(({ label }) => label !== 'required').map((curve) => ({ ...curve, label: `${one.label}, ${curve.label}`, dash: true })));
  }
  return chart;
}

export const absorber = {
  slow: true,
  hint: ({ result }) => (result.sweep || result.assessment ? '' : 'A sweep over one of the variables draws every branch of damping, with the optimum on it.'),
  headline: ({ result }) => [
    result.assessment && { label: 'excited modes', value: result.excited_modes, unit: '', more: result.met === undefined ? '' : result.met ? 'all damped as required' : 'not all damped as required' },
    { label: 'damping ratio at the optimum', value: result.damping_ratio, unit: '', more: Object.entries(result.optimum ?? {}).map(([name, value]) => `${name} = ${brief(value)}`).join(', ') },
    result.required_damping_ratio !== undefined && { label: 'required against vortex-induced vibration', value: result.required_damping_ratio, unit: '', more: result.met ? 'met' : 'not met' },
  ].filter((one) => one && one.value !== undefined),
  pictures: (answer, kept) => [compared(answer, kept, 'damping_ratio', 'damping ratio', 'Damping of every branch'),
    compared(answer, kept, 'angular_frequency_rad_per_s', 'angular frequency, rad/s', 'Frequency of every branch')],
  sweeps: [],
};
