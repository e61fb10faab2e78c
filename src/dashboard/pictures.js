/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which endpoint has which pictures. One without a row here still has its tab, form, tables and a comparison of modes. */
import { absorber } from './picture_absorber.js';
import { cableModes, cableStatics } from './picture_cable.js';
import { catenary } from './picture_catenary.js';
import { forced } from './picture_forced.js';
import { inclined } from './picture_inclined.js';
import { compareModes } from './picture_parts.js';
import { matrix, taut } from './picture_taut.js';
import { validation } from './picture_validation.js';

const known = {
  '/v1/catenary/frequencies': catenary,
  '/v1/forced/tension': forced,
  '/v1/inclined/modes': inclined,
  '/v1/cable/statics': cableStatics,
  '/v1/cable/modes': cableModes,
  '/v1/taut/modes': taut,
  '/v1/taut/matrix': matrix,
  '/v1/absorber/optimize': absorber,
  '/v1/validation': validation,
};

const plain = {
  headline: () => [],
  pictures: (answer, kept) => (Array.isArray(answer.result.modes)
    ? [compareModes('frequencies', [{ answer, label: kept.length ? 'this' : '' }, ...kept], ({ result }) => ({ modes: result.modes }))] : []),
  sweeps: [],
};

export function picturesOf(path) {
  return known[path] ?? plain;
}
