/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Any result as tables: what an endpoint without pictures of its own shows, and all the numbers of the others. */
import { download, h } from './dom.js';
import { brief, heading } from './values.js';

const ROWS = 400;
const OPEN_ROWS = 25; /* a longer table is folded away, and built when it is asked for */

function isRecord(value) {
  return value !== null && typeof value === 'object' && !Array.isArray(value) && !('re' in value && 'im' in value);
}
function isFlat(value) {
  return !isRecord(value) && !Array.isArray(value);
}
function words(value) {
  if (Array.isArray(value)) return value.every(isFlat) ? value.map((one) => brief(one)).join(', ') : `${value.length} items`;
  if (typeof value === 'boolean') return value ? 'yes' : 'no';
  return isRecord(value) ? Object.entries(value).map(([name, one]) => `${name} ${words(one)}`).join('; ') : brief(value);
}
function raw(value) {
  if (value === undefined) return '';
  if (typeof value === 'number') return String(value);
  const text = typeof value === 'object' ? JSON.stringify(value) : String(value);
  return `"${text.replaceAll('"', '""')}"`;
}

/* Columns of a list of records; a list inside a cell is left to its own table. */
function columnsOf(list) {
  const names = new Set(list.flatMap((row) => Object.keys(row)));
  return [...names].filter((name) => !list.some((row) => Array.isArray(row[name]) && row[name].some(isRecord)));
}

function classOf(value) {
  if (typeof value === 'number') return 'number';
  const size = typeof value === 'string' ? value.length : 0;
  return size > 60 ? 'long' : size > 24 ? 'some' : undefined;
}

/* What a cell shows; where `opens` has a question for it, a button that asks it. */
function cell(column, row, { opens, load }) {
  const question = opens?.(column, row);
  return question ? h('button', { type: 'button', onclick: () => load(question) }, words(row[column])) : words(row[column]);
}

function listTable(name, list, doors) {
  const columns = columnsOf(list);
  const csv = () => `${columns.join(',')}\r\n${list.map((row) => columns.map((column) => raw(row[column])).join(',')).join('\r\n')}\r\n`;
  const left = list.length > ROWS ? h('p', { class: 'note' }, `${list.length - ROWS} more rows are in the CSV and the JSON.`) : null;
  return h('div', {},
    h('div', { class: 'wide', tabindex: '0', role: 'region', 'aria-label': heading(name) }, h('table', {},
      h('caption', {}, heading(name)),
      h('thead', {}, h('tr', {}, columns.map((column) => h('th', { scope: 'col', class: list.every((row) => typeof (row[column] ?? 0) === 'number') ? 'number' : undefined }, heading(column))))),
      h('tbody', {}, list.slice(0, ROWS).map((row) => h('tr', {}, columns.map((column) =>
        h('td', { class: classOf(row[column]), title: typeof row[column] === 'number' ? String(row[column]) : undefined }, cell(column, row, doors)))))))),
    left,
    h('div', { class: 'exports' }, h('button', { type: 'button', 'aria-label': `${heading(name)}: save as CSV`, onclick: () => download(`${name}.csv`, 'text/csv', csv()) }, 'CSV')));
}

function recordTable(name, record) {
  const flat = Object.entries(record).filter(([, value]) => isFlat(value) || (Array.isArray(value) && value.length && value.every(isFlat)));
  if (!flat.length) return null;
  return h('table', { class: 'record' }, h('caption', {}, heading(name)), h('tbody', {}, flat.map(([key, value]) =>
    h('tr', {}, h('th', { scope: 'row' }, heading(key)), h('td', { class: typeof value === 'string' ? undefined : typeof value === 'number' ? 'number' : 'list', title: words(value) === String(value) ? undefined : JSON.stringify(value) }, words(value))))));
}

/* All tables of a value, deepest last. `doors` = {opens(column, row) -> a question or null, load(question)}. */
export function tablesOf(name, value, doors = {}) {
  if (Array.isArray(value)) {
    if (!value.length) return [h('p', { class: 'note' }, `${heading(name)}: none`)];
    if (!value.every(isRecord)) return value.every(isFlat) ? [recordTable(name, { [name]: value })] : [];
    const inner = [];
    for (const [i, row] of value.entries()) {
      for (const [key, list] of Object.entries(row)) {
        if (!Array.isArray(list) || !list.length || !list.every(isRecord)) continue;
        inner.push(h('details', { ontoggle: (event) => {
          if (event.target.open && event.target.children.length === 1) event.target.append(...tablesOf(key, list, doors));
        } }, h('summary', {}, `${heading(name)} ${row.mode ?? i + 1}: ${heading(key)}, ${list.length} rows`)));
      }
    }
    if (value.length <= OPEN_ROWS) return [listTable(name, value, doors), ...inner];
    return [h('details', { ontoggle: (event) => {
      if (event.target.open && event.target.children.length === 1) event.target.append(listTable(name, value, doors));
    } }, h('summary', {}, `${heading(name)}, ${value.length} rows`)), ...inner];
  }
  if (!isRecord(value)) return [];
  const out = [recordTable(name, value)];
  for (const [key, inner] of Object.entries(value)) {
    if (isRecord(inner) || (Array.isArray(inner) && !inner.every(isFlat))) out.push(...tablesOf(key, inner, doors));
    else if (Array.isArray(inner) && !inner.length) out.push(h('p', { class: 'note' }, `${heading(key)}: none`));
  }
  return out.filter(Boolean);
}
