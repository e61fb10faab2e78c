/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A list of objects, each of one shape or chosen by its `type`: add, remove, move. */
import { freshId, h } from './dom.js';
import { label } from './values.js';

export function makeList(name, schema, changed, makeObject) {
  const shapes = schema.items.oneOf
    ? schema.items.oneOf.map((one) => ({ word: one.title, schema: one }))
    : [{ word: label(name).replace(/s$/, ''), schema: schema.items }];
  let items = [];
  const place = h('ol', { class: 'items' });
  const fault = h('p', { class: 'fault', id: freshId('fault'), hidden: true });
  const choice = shapes.length > 1 && h('select', { 'aria-label': `Kind of ${label(name)} to add` },
    shapes.map((shape) => h('option', { value: shape.word }, shape.word.replaceAll('_', ' '))));
  const add = h('button', { type: 'button', onclick() {
    insert(choice ? choice.value : shapes[0].word, {});
    changed();
    place.lastElementChild.querySelector('input, select')?.focus();
  } }, choice ? 'Add' : `Add ${shapes[0].word}`);
  const node = h('fieldset', { class: 'list', 'data-field': name }, h('legend', {}, label(name)),
    h('p', { class: 'help' }, schema.description ?? ''), fault, place, h('div', { class: 'adder' }, choice, add));

  function number() {
    items.forEach((item, i) => {
      item.title.textContent = `${i + 1}. ${item.shape.word.replaceAll('_', ' ')}`;
      item.up.disabled = i === 0;
      item.up.setAttribute('aria-label', `Move ${item.title.textContent} up`);
      item.away.setAttribute('aria-label', `Remove ${item.title.textContent}`);
    });
  }
  function insert(word, value) {
    const shape = shapes.find((one) => one.word === word) ?? shapes[0];
    const item = { shape, object: makeObject(shape.schema, changed), title: h('span', {}) };
    item.object.set(value);
    item.up = h('button', { type: 'button', class: 'quiet', onclick() {
      const at = items.indexOf(item);
      items.splice(at, 1);
      items.splice(at - 1, 0, item);
      place.insertBefore(item.node, place.children[at - 1]);
      number();
      changed();
    } }, '\u2191');
    item.away = h('button', { type: 'button', class: 'quiet', onclick() {
      items = items.filter((one) => one !== item);
      item.node.remove();
      number();
      changed();
      add.focus();
    } }, '\u00d7');
    item.node = h('li', {}, h('div', { class: 'item-bar' }, item.title, item.up, item.away), item.object.node);
    items.push(item);
    place.append(item.node);
    number();
  }
  return {
    node,
    need: () => {},
    get: () => (items.length ? items.map((item) => item.object.get()) : undefined),
    set(list) {
      items = [];
      place.replaceChildren();
      for (const value of list ?? []) insert(value.type, value);
    },
    fault(tokens, text) {
      const item = tokens.length ? items[Number(tokens[0])] : null;
      if (item) return item.object.fault(tokens.slice(1), text);
      fault.textContent = text;
      fault.hidden = false;
      return true;
    },
    clear() {
      fault.hidden = true;
      items.forEach((item) => item.object.clear());
    },
  };
}
