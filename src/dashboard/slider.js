/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A slider beside a number. Where the field's range is short it spans the range; ranges of many decades would make it
 * useless, so there it spans a quarter to four times the value at which it was taken. */
import { h } from './dom.js';

const STEPS = 240;
const FACTOR = 4;

function tidy(value) {
  return Number(value.toPrecision(4));
}

export function makeSlider(schema, words, current, change) {
  const low = schema.exclusiveMinimum ?? schema.minimum ?? -Infinity;
  const high = schema.exclusiveMaximum ?? schema.maximum ?? Infinity;
  const whole = schema.type === 'integer';
  const short = Number.isFinite(high - low) && (high - low <= 10 || (whole && high - low <= 200));
  let anchor = 0;
  const input = h('input', { type: 'range', 'aria-label': `${words}, slider`, tabindex: '-1' });
  if (short && whole) Object.assign(input, { min: low, max: Math.min(high, 40), step: 1 });
  else Object.assign(input, { min: 0, max: STEPS, step: 1 });

  function bounds() {
    if (short) {
      const margin = (high - low) / STEPS;
      return [schema.exclusiveMinimum === undefined ? low : low + margin, schema.exclusiveMaximum === undefined ? high : high - margin];
    }
    if (anchor === 0) return [Math.max(low, -1), Math.min(high, 1)];
    const ends = [anchor / FACTOR, anchor * FACTOR].sort((a, b) => a - b);
    return [Math.max(low, ends[0]), Math.min(high, ends[1])];
  }
  const logarithmic = () => !short && anchor !== 0;
  function valueAt(position) {
    if (short && whole) return position;
    const [from, to] = bounds();
    const part = position / STEPS;
    const value = logarithmic() ? anchor * FACTOR ** (2 * part - 1) : from + part * (to - from);
    const inside = Math.min(high, Math.max(low, value));
    return whole ? Math.round(inside) : tidy(inside);
  }
  function follow() {
    const value = current();
    input.hidden = typeof value !== 'number';
    if (input.hidden) return;
    if (short && whole) {
      input.value = value;
      return;
    }
    if (!short) anchor = value;
    const [from, to] = bounds();
    input.value = logarithmic() ? STEPS / 2 : Math.round((STEPS * (value - from)) / (to - from));
  }
  /* While it is held the span stands still; released, it centres itself on the new value. */
  input.addEventListener('input', () => change(valueAt(Number(input.value))));
  input.addEventListener('change', follow);
  follow();
  return { node: input, follow };
}
