/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The view in the address: #/catenary/frequencies?{"r": request, "k": [[label, request], ..]}. */

export function readState() {
  const [path, rest] = decodeURI(location.hash.slice(1)).split(/\?(.*)/s);
  if (!path) return null;
  let held = {};
  try {
    held = JSON.parse(decodeURIComponent(location.hash.slice(1).split(/\?(.*)/s)[1] ?? '') || '{}');
  } catch {
    if (rest) return { path: `/v1${path}`, broken: true };
  }
  const kept = Array.isArray(held.k) ? held.k.filter((one) => Array.isArray(one) && one.length === 2) : [];
  return { path: `/v1${path}`, request: held.r && typeof held.r === 'object' ? held.r : undefined, kept };
}

export function stateLink(path, request, kept) {
  const held = { r: request };
  if (kept.length) held.k = kept.map((one) => [one.label, one.request]);
  return `#${path.slice(3)}?${encodeURIComponent(JSON.stringify(held))}`;
}
