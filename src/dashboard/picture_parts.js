/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the pictures of several endpoints share. */

/* An amplitude, real or complex, at a phase of the motion. */
export function atPhase(amplitude, phase) {
  if (amplitude === undefined) return 0;
  if (typeof amplitude === 'number') return amplitude * Math.cos(phase);
  return amplitude.re * Math.cos(phase) - amplitude.im * Math.sin(phase);
}

/* Amplitude and phase angle that stand apart (forced motion with damping). */
export function polar(size, degrees) {
  const angle = ((degrees ?? 0) * Math.PI) / 180;
  return { re: size * Math.cos(angle), im: size * Math.sin(angle) };
}

export function magnitude(amplitude) {
  return typeof amplitude === 'object' ? Math.hypot(amplitude.re, amplitude.im) : amplitude;
}

export function frequencyOf(mode) {
  if (mode.frequency_Hz !== undefined) return { value: mode.frequency_Hz, label: 'frequency, Hz' };
  if (mode.angular_frequency_rad_per_s !== undefined) return { value: mode.angular_frequency_rad_per_s, label: 'angular frequency, rad/s' };
  if (mode.kl_over_pi !== undefined) return { value: mode.kl_over_pi, label: 'kL/\u03c0' };
  return { value: mode.frequency_ratio, label: 'frequency ratio' };
}

/* Frequency by mode number of several answers: the comparison of cables. `lists(answer)` gives {name: modes}. */
export function compareModes(name, all, lists) {
  const series = [];
  const labels = new Set();
  all.forEach(({ answer, label }, i) => {
    for (const [plane, modes] of Object.entries(lists(answer))) {
      const some = (modes ?? []).filter((mode) => frequencyOf(mode).value !== undefined);
      if (!some.length) continue;
      labels.add(frequencyOf(some[0]).label);
      series.push({ label: [label, plane].filter(Boolean).join(', '), x: some.map((mode) => mode.mode), y: some.map((mode) => frequencyOf(mode).value),
        points: true, dash: i > 0, colour: series.length });
    }
  });
  return { kind: 'chart', key: 'compare', name, title: all.length > 1 ? 'Cables compared' : 'Frequency by mode', x: { label: 'mode' },
    y: { label: [...labels].join(' or '), min: 0 }, series, note: all.length > 1 ? '' : 'Keep this answer, change the cable, and both stand here.' };
}

/* Between `low` and `high`, equally spaced in value or ratio. */
export function spread(low, high, count, ratio = false) {
  return Array.from({ length: count }, (_, i) => {
    const part = i / (count - 1);
    return Number((ratio ? low * (high / low) ** part : low + part * (high - low)).toPrecision(6));
  });
}
