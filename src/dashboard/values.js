/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Between what is typed or shown and what JSON holds. What cannot be read goes to the daemon as it was typed: it
 * explains faults better than this page could. */

export function readNumber(text) {
  const typed = text.trim();
  if (typed === '') return undefined;
  const number = Number(typed.replace(/^\+/, ''));
  return Number.isFinite(number) ? number : typed;
}

/* What one of each is in metre, kilogram, second, radian, and its powers of them. */
const INCH = 0.0254, POUND = 0.45359237, GRAVITY = 9.80665;
const MEASURES = { m: [1, 1], mm: [1e-3, 1], cm: [1e-2, 1], km: [1e3, 1], in: [INCH, 1], ft: [12 * INCH, 1], kg: [1, 0, 1], g: [1e-3, 0, 1],
  t: [1e3, 0, 1], lb: [POUND, 0, 1], s: [1, 0, 0, 1], ms: [1e-3, 0, 0, 1], N: [1, 1, 1, -2], kN: [1e3, 1, 1, -2], MN: [1e6, 1, 1, -2],
  kgf: [GRAVITY, 1, 1, -2], lbf: [POUND * GRAVITY, 1, 1, -2], kip: [1e3 * POUND * GRAVITY, 1, 1, -2], Hz: [2 * Math.PI, 0, 0, -1, 1],
  rad: [1, 0, 0, 0, 1], deg: [Math.PI / 180, 0, 0, 0, 1] };

/* "kN/m", "N*s/m^2" as a factor and powers; undefined where a word in it is no unit. */
function measure(unit) {
  const sum = { factor: 1, powers: [0, 0, 0, 0] };
  for (const [part, words] of unit.split('/').entries()) {
    const sign = part ? -1 : 1;
    for (const word of words.split(/[*\u00b7 ]+/)) {
      const [, name, power] = word.match(/^([A-Za-z]+)\^?(\d?)$/) ?? [];
      if (!Object.hasOwn(MEASURES, name ?? '')) return undefined;
      const [factor, ...powers] = MEASURES[name], times = sign * Number(power || 1);
      sum.factor *= factor ** times;
      powers.forEach((one, i) => { sum.powers[i] += one * times; });
    }
  }
  return sum;
}

/* A number as people write it: "99,5", and "3 MN" or "110 ft" for a field in `unit`. One comma before three digits may
 * part thousands: that, and a unit of another quantity, goes to the daemon as typed. */
export function readQuantity(text, unit) {
  const typed = text.trim(), [, digits, given] = typed.match(/^([-+]?[\d.,]+(?:e[-+]?\d+)?)\s*([A-Za-z].*)?$/i) ?? [];
  if (digits === undefined) return readNumber(text);
  const comma = digits.includes(',') && !/^[-+]?[1-9]\d{0,2},\d{3}$/.test(digits) && /^[^.,]*,[^.,]*$/.test(digits);
  const number = readNumber(comma ? digits.replace(',', '.') : digits);
  if (typeof number === 'string') return typed;
  if (!given) return number;
  const from = measure(given.trim()), to = measure(unit ?? '');
  if (!from || !to || String(from.powers) !== String(to.powers)) return typed;
  return Number((number * (from.factor / to.factor)).toPrecision(15));
}

/* A number, or "R", "2*R", "-x + 50": a variable with scale and offset. */
export function readVariable(text) {
  const plain = readNumber(text);
  if (typeof plain !== 'string') return plain;
  const found = plain.match(/^(?:([-+]?[\d.]+(?:e[-+]?\d+)?)\s*\*\s*|(-))?([A-Za-z_]\w*)\s*(?:([-+])\s*([\d.]+(?:e[-+]?\d+)?))?$/i);
  if (!found) return plain;
  const value = { variable: found[3] };
  if (found[1] || found[2]) value.scale = found[2] ? -1 : Number(found[1]);
  if (found[5]) value.offset = Number(found[4] + found[5]);
  return value;
}

export function showVariable(value) {
  if (typeof value !== 'object' || value === null) return String(value ?? '');
  const scale = value.scale === undefined || value.scale === 1 ? '' : value.scale === -1 ? '-' : `${value.scale}*`;
  const offset = value.offset ? ` ${value.offset < 0 ? '-' : '+'} ${Math.abs(value.offset)}` : '';
  return scale + value.variable + offset;
}

/* "2.1+0.3i" or a number. */
export function readComplex(text) {
  const plain = readNumber(text);
  if (typeof plain !== 'string') return plain;
  const found = plain.match(/^([-+]?[\d.]+(?:e[-+]?\d+)?)?\s*([-+]?\s*[\d.]*(?:e[-+]?\d+)?)\s*[ij]$/i);
  if (!found) return plain;
  const im = found[2].replace(/\s/g, '');
  return { re: Number(found[1] ?? 0), im: im === '+' || im === '' ? 1 : im === '-' ? -1 : Number(im) };
}

export function showComplex(value) {
  if (typeof value !== 'object' || value === null) return String(value ?? '');
  return `${value.re}${value.im < 0 ? '-' : '+'}${Math.abs(value.im)}i`;
}

export function readList(text, read) {
  const parts = text.split(/[,;\s]+/).filter(Boolean);
  return parts.length ? parts.map(read) : undefined;
}

/* For reading: six digits. The whole number is in the JSON. */
export function brief(value, digits = 6) {
  if (typeof value === 'number') {
    if (Number.isInteger(value) && Math.abs(value) < 1e9) return String(value);
    const size = Math.abs(value);
    return size >= 1e7 || (size < 1e-4 && size > 0) ? value.toExponential(digits - 2).replace(/\.?0+e/, 'e') : String(Number(value.toPrecision(digits)));
  }
  if (value && typeof value === 'object' && 're' in value) {
    return `${brief(value.re, 5)} ${value.im < 0 ? '\u2212' : '+'} ${brief(Math.abs(value.im), 5)} i`;
  }
  return value === undefined || value === null ? '' : String(value);
}

/* At an axis: no more zeros than one can count. */
export function tickWords(value) {
  return Math.abs(value) >= 1e5 ? value.toExponential().replace('e+', 'e') : brief(value);
}

/* "kg/m" is "_kg_per_m" at the end of a name. */
function suffix(unit) {
  return `_${unit.replaceAll('^', '').replace(/[*\u00b7 ]/g, '_').replace('/', '_per_')}`;
}

export function label(name, unit) {
  const end = unit && unit !== '1' ? suffix(unit) : '';
  const stem = end && name.endsWith(end) ? name.slice(0, -end.length) : name;
  return stem.replaceAll('_', ' ');
}

/* The unit that a name of the answer ends with, for tables and axes. */
const UNITS = [['_rad_per_s', 'rad/s'], ['_kg_per_m', 'kg/m'], ['_N_s_per_m', 'N s/m'], ['_N_per_m', 'N/m'], ['_m_per_s2', 'm/s\u00b2'],
  ['_per_s', '1/s'], ['_Hz', 'Hz'], ['_deg', '\u00b0'], ['_kg', 'kg'], ['_N', 'N'], ['_m', 'm'], ['_s', 's']];

export function unitOf(name) {
  const found = UNITS.find(([end]) => name.endsWith(end));
  return found ? { stem: name.slice(0, -found[0].length).replaceAll('_', ' '), unit: found[1] } : { stem: name.replaceAll('_', ' '), unit: '' };
}

export function heading(name) {
  const { stem, unit } = unitOf(name);
  return unit ? `${stem}, ${unit}` : stem;
}
