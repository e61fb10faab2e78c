/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A form from a request's schema. Every control is {node, get, set, fault, clear}: `get` gives undefined where nothing
 * is given; `fault(tokens, text)` shows a fault at the field that a JSON pointer leads to, and says whether it could. */
import { freshId, h } from './dom.js';
import { label, readComplex, readList, readNumber, readQuantity, readVariable, showComplex, showVariable } from './values.js';
import { makeList } from './form_list.js';
import { makeSlider } from './slider.js';

function bound(value) {
  return Math.abs(value) >= 1e5 ? value.toExponential().replace('e+', 'e') : String(value);
}

function rangeWords(schema) {
  const number = schema.oneOf?.find((one) => one.type === 'number') ?? schema;
  const parts = [];
  if (number.exclusiveMinimum !== undefined) parts.push(`> ${bound(number.exclusiveMinimum)}`);
  if (number.minimum !== undefined) parts.push(`\u2265 ${bound(number.minimum)}`);
  if (number.exclusiveMaximum !== undefined) parts.push(`< ${bound(number.exclusiveMaximum)}`);
  if (number.maximum !== undefined) parts.push(`\u2264 ${bound(number.maximum)}`);
  if (schema.oneOf?.some((one) => one.const === 'infinite')) parts.push('or infinite');
  if (schema.oneOf?.some((one) => one.type === 'object')) parts.push('or a variable, such as R or 2*R + 5');
  return parts.join(', ');
}

/* Label, input, help and a place for faults. */
function frame(name, schema, input, extra = []) {
  const unit = schema['x-unit'] && schema['x-unit'] !== '1' ? schema['x-unit'] : '';
  const id = input.id;
  const range = rangeWords(schema.type === 'array' ? schema.items : schema);
  const fault = h('p', { class: 'fault', id: `${id}-fault`, hidden: true });
  const help = h('p', { class: 'help', id: `${id}-help` },
    schema.description ?? '', range ? ` (${range})` : '', ' ', h('code', {}, name));
  const needed = h('span', { class: 'needed', hidden: true }, 'needed');
  input.setAttribute('aria-describedby', `${help.id} ${fault.id}`);
  input.name = name;
  let need = false;
  const follow = () => { needed.hidden = !need || input.value !== ''; };
  input.addEventListener('input', follow);
  const node = h('div', { class: 'field', 'data-field': name },
    h('label', { for: id }, label(name, schema['x-unit']), unit && h('span', { class: 'unit' }, ` ${unit}`), ' ', needed),
    input, ...extra, help, fault);
  return {
    node,
    follow,
    need(is) {
      need = is;
      follow();
      input.setAttribute('aria-required', String(is));
    },
    say(text) {
      fault.textContent = text;
      fault.hidden = !text;
      if (text) input.setAttribute('aria-invalid', 'true');
      else input.removeAttribute('aria-invalid');
    },
  };
}

/* What stands where nothing is given: the default, or else what could. */
function placeholderOf(schema, show) {
  if (schema.default !== undefined) return String(schema.default);
  return schema.examples?.length ? `e.g. ${show(schema.examples[0])}` : '';
}

function textControl(name, schema, changed, { read, show, numeric }) {
  const input = h('input', { id: freshId('f'), type: 'text', autocomplete: 'off', spellcheck: 'false', inputmode: numeric ? 'decimal' : undefined,
    placeholder: placeholderOf(schema, show) });
  const slider = numeric ? makeSlider(schema, label(name, schema['x-unit']), () => readQuantity(input.value, schema['x-unit']) ?? schema.default, (value) => {
    input.value = String(value);
    around.follow();
    changed();
  }) : null;
  const around = frame(name, schema, input, slider ? [slider.node] : []);
  input.addEventListener('input', () => {
    slider?.follow();
    changed();
  });
  return {
    node: around.node,
    need: around.need,
    get: () => read(input.value),
    set(value) {
      input.value = value === undefined ? '' : show(value);
      slider?.follow();
      around.follow();
    },
    fault(tokens, text) {
      around.say(text);
      return true;
    },
    clear: () => around.say(''),
  };
}

function choiceControl(name, schema, changed) {
  const input = h('select', { id: freshId('f'), onchange: changed },
    schema.default === undefined && h('option', { value: '' }, '\u2013'),
    schema.enum.map((word) => h('option', { value: word }, word.replaceAll('_', ' '))));
  if (schema.default !== undefined) input.value = schema.default;
  const around = frame(name, schema, input);
  return {
    node: around.node,
    need: around.need,
    get: () => (input.value === '' || input.value === schema.default ? undefined : input.value),
    set: (value) => { input.value = value ?? schema.default ?? ''; },
    fault(tokens, text) {
      around.say(text);
      return true;
    },
    clear: () => around.say(''),
  };
}

function flagControl(name, schema, changed) {
  const input = h('input', { id: freshId('f'), type: 'checkbox', onchange: changed });
  input.checked = Boolean(schema.default);
  const around = frame(name, schema, input);
  around.node.classList.add('flag');
  return {
    node: around.node,
    need: around.need,
    get: () => (input.checked === Boolean(schema.default) ? undefined : input.checked),
    set: (value) => { input.checked = value ?? Boolean(schema.default); },
    fault(tokens, text) {
      around.say(text);
      return true;
    },
    clear: () => around.say(''),
  };
}

function nestedControl(name, schema, changed) {
  const inner = makeObject(schema.allOf[0], changed);
  const node = h('fieldset', { class: 'nested', 'data-field': name }, h('legend', {}, label(name)),
    h('p', { class: 'help' }, schema.description ?? ''), inner.node);
  return {
    ...inner,
    node,
    need: () => {},
    get() {
      const value = inner.get();
      return Object.keys(value).length ? value : undefined;
    },
    set: (value) => inner.set(value ?? {}),
  };
}

function makeControl(name, schema, changed) {
  if (schema.allOf) return nestedControl(name, schema, changed);
  if (schema.type === 'array') {
    const items = schema.items;
    if (items.oneOf?.[0].properties || items.type === 'object') return makeList(name, schema, changed, makeObject);
    const complex = Boolean(items.oneOf);
    const [read, show] = complex ? [readComplex, showComplex] : [readNumber, String];
    return textControl(name, schema, changed, { read: (text) => readList(text, read), show: (list) => list.map(show).join(', ') });
  }
  if (schema.enum) return choiceControl(name, schema, changed);
  if (schema.type === 'boolean') return flagControl(name, schema, changed);
  if (schema.type === 'number' || schema.type === 'integer') {
    return textControl(name, schema, changed, { read: (text) => readQuantity(text, schema['x-unit']), show: String, numeric: true });
  }
  if (schema.oneOf) return textControl(name, schema, changed, { read: readVariable, show: showVariable });
  return textControl(name, schema, changed, { read: (text) => text.trim() || undefined, show: String });
}

/* "[rise_to_span] sag_parameter" as words. */
function alternativeWords(title, fields) {
  const words = title.split(' ').filter((word) => !word.startsWith('+'));
  const chosen = words.some((word) => !word.startsWith('[')) ? words.filter((word) => !word.startsWith('[')) : words.map((word) => word.slice(1, -1));
  return chosen.map((word) => label(word, fields[word]?.['x-unit'])).join(', ');
}

/* "One of these groups": a choice, and the fields of the group chosen. */
function makeGroups(group, fields, controls, claimed, changed) {
  const own = new Set(group.oneOf.flatMap((one) => [...Object.keys(one.properties ?? {}).filter((name) => !one.properties[name]), ...one.title.match(/[A-Za-z_]\w*/g)
    .filter((name) => name in fields && !one.title.includes(`+${name}`))]));
  const ways = group.oneOf.map((one) => ({
    words: one.title === 'none' ? 'none' : alternativeWords(one.title, fields),
    required: one.required ?? [],
    own: [...own].filter((name) => !(one.properties && one.properties[name] === false)),
  }));
  const mine = Object.keys(fields).filter((name) => own.has(name) && !claimed.has(name));
  mine.forEach((name) => claimed.add(name));
  let chosen = 0;
  const choice = h('select', { id: freshId('g') }, ways.map((way, i) => h('option', { value: i }, way.words)));
  const place = h('div', {}, mine.map((name) => controls[name].node));
  const node = h('fieldset', { class: 'group' }, h('legend', {}, group.title),
    h('label', { for: choice.id, class: 'choose' }, 'given by '), choice, place);
  function show() {
    choice.value = chosen;
    for (const name of mine) {
      controls[name].node.hidden = !ways[chosen].own.includes(name);
      controls[name].need?.(ways[chosen].required.includes(name));
    }
  }
  choice.addEventListener('change', () => {
    chosen = Number(choice.value);
    show();
    changed();
  });
  show();
  return {
    node,
    absent: () => mine.filter((name) => !ways[chosen].own.includes(name)),
    needs: () => ways[chosen].required.filter((name) => !mine.includes(name)),
    /* The first way that allows all that is given and has all it needs; else one that allows it. */
    choose(value) {
      const given = [...own].filter((name) => value[name] !== undefined);
      const allows = (way) => given.every((name) => way.own.includes(name));
      const best = ways.findIndex((way) => allows(way) && way.required.every((name) => value[name] !== undefined));
      chosen = best >= 0 ? best : Math.max(0, ways.findIndex(allows));
      show();
    },
  };
}

/* An object: groups first, then what has to be given or is, and the rest folded away. */
export function makeObject(schema, changed) {
  const fields = Object.fromEntries(Object.entries(schema.properties).filter(([, field]) => field.const === undefined));
  const constants = Object.fromEntries(Object.entries(schema.properties).filter(([, field]) => field.const !== undefined)
    .map(([name, field]) => [name, field.const]));
  const controls = {};
  for (const [name, field] of Object.entries(fields)) controls[name] = makeControl(name, field, changed);
  const claimed = new Set();
  const groups = (schema.allOf ?? []).map((group) => makeGroups(group, fields, controls, claimed, () => update()));
  const required = new Set(schema.required ?? []);
  const folds = (name) => !claimed.has(name) && !required.has(name) && !['modes', 'components'].includes(name);
  const shown = Object.keys(fields).filter((name) => !claimed.has(name) && !folds(name));
  const folded = Object.keys(fields).filter(folds);
  const summary = h('summary', {});
  const details = h('details', { class: 'more' }, summary);
  const fold = (names) => {
    summary.textContent = `More: ${names.map((name) => label(name, fields[name]['x-unit'])).join(', ')}`;
    details.append(...names.map((name) => controls[name].node));
    details.hidden = !names.length;
  };
  fold(folded);
  const open = h('div', {});
  const plainFault = h('p', { class: 'fault', role: 'alert', hidden: true });
  const node = h('div', { class: 'object' }, plainFault, groups.map((group) => group.node), shown.map((name) => controls[name].node),
    open, details);
  const get = () => {
    const absent = new Set(groups.flatMap((group) => group.absent()));
    const value = { ...constants };
    for (const name of Object.keys(fields)) {
      const given = absent.has(name) ? undefined : controls[name].get();
      if (given !== undefined) value[name] = given;
    }
    return value;
  };
  /* What a group needs from elsewhere is marked there. */
  function mark() {
    const needed = new Set(groups.flatMap((group) => group.needs()));
    for (const name of [...shown, ...folded]) controls[name].need?.(required.has(name) || needed.has(name));
    if (folded.some((name) => needed.has(name) && details.contains(controls[name].node))) details.open = true;
  }
  function update() {
    mark();
    changed();
  }
  mark();
  return {
    node,
    get,
    set(value) {
      for (const name of Object.keys(fields)) controls[name].set(value[name]);
      fold(folded.filter((name) => value[name] === undefined));
      open.append(...folded.filter((name) => value[name] !== undefined).map((name) => controls[name].node));
      groups.forEach((group) => group.choose(value));
      details.open = false;
      mark();
    },
    fault(tokens, text) {
      const control = controls[tokens[0]];
      if (control && !control.node.hidden && control.fault(tokens.slice(1), text)) {
        if (folded.includes(tokens[0])) details.open = true;
        return true;
      }
      plainFault.textContent += `${plainFault.textContent ? '; ' : ''}${tokens.length ? `${tokens.join('/')}: ` : ''}${text}`;
      plainFault.hidden = false;
      return true;
    },
    clear() {
      plainFault.textContent = '';
      plainFault.hidden = true;
      Object.values(controls).forEach((control) => control.clear());
    },
  };
}
