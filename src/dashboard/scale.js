/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Extents and ticks of pictures that are not uPlot's. */

export function extent(lists, positive = false) {
  let low = Infinity;
  let high = -Infinity;
  for (const list of lists) {
    for (const value of list) {
      if (!Number.isFinite(value) || (positive && value <= 0)) continue;
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  return low <= high ? [low, high] : [positive ? 0.1 : 0, 1];
}

/* A little more on both sides. */
export function padded([low, high], log = false, part = 0.05) {
  if (log) {
    const factor = (high / low) ** part || 1.1;
    return [low / Math.max(factor, 1.02), high * Math.max(factor, 1.02)];
  }
  const span = high - low || Math.abs(high) || 1;
  return [low - part * span, high + part * span];
}

export function ticks([low, high], wanted = 6) {
  const rough = (high - low) / wanted;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((size) => size >= rough) ?? rough;
  const out = [];
  for (let k = Math.ceil(low / step); k * step <= high + 1e-9 * step; k += 1) out.push(Number((k * step).toPrecision(12)));
  return out;
}

export function logTicks([low, high]) {
  const out = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); power += 1) {
    const decades = Math.log10(high / low);
    for (const digit of decades > 5 ? [1] : decades > 1.5 ? [1, 3] : [1, 2, 3, 5, 7]) {
      const value = Number((digit * 10 ** power).toPrecision(12));
      if (value >= low && value <= high) out.push(value);
    }
  }
  return out;
}
