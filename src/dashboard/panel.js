/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One endpoint's tab: the form, the answer, its pictures, and how to cite it. */
import { announce, copy, download, freshId, h } from './dom.js';
import { ask, askLive, curlOf } from './api_client.js';
import { brief } from './values.js';
import { makeFigures } from './figures.js';
import { makeObject } from './form.js';
import { picturesOf } from './pictures.js';
import { presetsOf } from './presets.js';
import { stateLink } from './state.js';
import { tablesOf } from './tables.js';

const SLOW_MS = 50; /* an answer that took longer is not asked for at every move */
const BUSY_MS = 250;

export function makeBench(endpoint, first, keptFirst) {
  const pictures = picturesOf(endpoint.path);
  const presets = [...presetsOf(endpoint.path), ...endpoint.examples];
  const figures = makeFigures(endpoint.path, pictures);
  let kept = [];
  let current = null;
  let controller = null;
  let timer = 0;
  let settle = 0;
  let lastMs = 0;

  const form = makeObject(endpoint.schema, () => schedule());
  const preset = h('select', { id: freshId('preset'), onchange: () => load(presets[Number(preset.value)]?.request) },
    h('option', { value: '' }, 'choose\u2026'), presets.map((one, i) => h('option', { value: i }, one.title)));
  const status = h('p', { class: 'status', role: 'status' });
  const doing = h('span', {}, 'computing');
  const busy = h('div', { class: 'busy', hidden: true }, h('progress', { 'aria-label': 'Computing' }), doing,
    h('button', { type: 'button', onclick: () => controller?.abort() }, 'Cancel'));
  const trouble = h('div', { class: 'trouble', role: 'alert', hidden: true });
  const warnings = h('div', { class: 'warnings', hidden: true });
  const headline = h('div', { class: 'headline' });
  const cite = h('div', { class: 'cite' });
  const hint = h('p', { class: 'note', hidden: true });
  const keeping = h('div', { class: 'kept' });
  const tables = h('div', { class: 'tables' });
  const node = h('div', { class: 'panels' },
    h('form', { class: 'form', 'aria-label': endpoint.summary, onsubmit: (event) => {
      event.preventDefault();
      schedule(0);
    } }, h('h1', {}, endpoint.summary),
    h('p', { class: 'note' }, h('a', { href: `/docs/${endpoint.name}` }, 'Reference'), ' \u00b7 ', h('code', {}, endpoint.path)),
    h('div', { class: 'field preset' }, h('label', { for: preset.id }, 'start from'), preset), form.node),
    h('section', { id: 'answer', class: 'answer', 'aria-label': 'Answer', tabindex: '-1' }, h('div', { class: 'top' }, status, busy),
      trouble, headline, cite, keeping, warnings, hint, figures.place, tables));

  function load(request) {
    if (!request) return;
    form.set(request);
    schedule(0);
  }
  function schedule(delay = lastMs < SLOW_MS ? 0 : Math.min(700, lastMs)) {
    clearTimeout(timer);
    cancelAnimationFrame(schedule.frame);
    if (delay === 0) schedule.frame = requestAnimationFrame(run);
    else timer = setTimeout(run, delay);
  }

  function come({ evaluations, best, text }) {
    doing.textContent = `${evaluations} ${text ?? 'evaluations'}${best === undefined ? '' : `, best so far ${brief(best, 5)}`}`;
  }

  async function run() {
    doing.textContent = 'computing';
    controller?.abort();
    const mine = new AbortController();
    controller = mine;
    const request = form.get();
    const waiting = setTimeout(() => { busy.hidden = false; }, BUSY_MS);
    try {
      const result = await (pictures.slow ? askLive(endpoint.path, request, mine.signal, come) : ask(endpoint.path, request, mine.signal));
      if (controller !== mine) return;
      lastMs = result.ms;
      form.clear();
      if (result.ok) show(request, result);
      else refuse(result);
    } catch (fault) {
      if (controller !== mine) return;
      stale(fault.name === 'AbortError' ? 'Cancelled.' : 'The daemon cannot be reached.');
    } finally {
      clearTimeout(waiting);
      if (controller === mine) busy.hidden = true;
    }
  }

  function stale(words) {
    node.classList.add('stale');
    status.textContent = current ? `${words} What stands below answers the question before.` : words;
  }

  function refuse({ problem, status: code }) {
    figures.stop();
    clearTimeout(settle);
    stale('');
    const errors = problem.errors ?? [];
    const tokens = (pointer) => pointer.split('/').slice(1).map((token) => token.replaceAll('~1', '/').replaceAll('~0', '~'));
    for (const { pointer, detail } of errors) form.fault(tokens(pointer), detail);
    trouble.hidden = false;
    trouble.replaceChildren(h('strong', {}, code === 422 ? 'There is no answer: ' : errors.length ? 'The form needs a change: ' : 'Refused: '));
    if (code === 422 || !errors.length) trouble.append(problem.detail ?? problem.title);
    else trouble.append(h('ul', {}, errors.map(({ pointer, detail }) => h('li', {}, h('code', {}, tokens(pointer).join('.') || 'request'), ` ${detail}`))));
  }

  function show(request, { answer, text, ms }) {
    current = { request, answer, text };
    node.classList.remove('stale');
    trouble.hidden = true;
    status.textContent = `Answered in ${ms < 10 ? ms.toFixed(1) : Math.round(ms)} ms`;
    warnings.hidden = !answer.warnings.length;
    warnings.replaceChildren(...answer.warnings.map((warning) => h('p', {}, warning)));
    headline.replaceChildren(...pictures.headline(answer).map((one) => h('div', { class: 'figure-of' },
      h('span', { class: 'what' }, one.label), h('span', { class: 'value' }, brief(one.value, 6), h('span', { class: 'unit' }, ` ${one.unit}`)), h('span', { class: 'more-of' }, one.more ?? ''))));
    hint.textContent = pictures.hint?.(answer) ?? '';
    hint.hidden = !hint.textContent;
    figures.show(pictures.pictures(answer, kept, null), false);
    clearTimeout(settle);
    settle = setTimeout(() => complete(request, answer), 90);
  }

  /* What may come a moment later: the motion, sweeps, tables, the address. */
  async function complete(request, answer) {
    const mine = controller;
    showCite();
    history.replaceState(null, '', stateLink(endpoint.path, request, kept));
    tables.replaceChildren(h('h2', {}, 'All numbers'), ...tablesOf('result', pictures.tables?.(answer.result) ?? answer.result, { opens: pictures.opens, load }),
      h('details', {}, h('summary', {}, 'The request as it was understood'), h('pre', { tabindex: '0' }, JSON.stringify(answer.request, null, 2))));
    const more = pictures.companion?.(request, answer);
    let companion = null;
    try {
      const extra = more ? await ask(endpoint.path, more, mine.signal) : null;
      companion = extra?.ok ? extra.answer : null;
    } catch { /* given up for a newer question, or out of reach: the next answer says so */ }
    if (current?.answer !== answer) return;
    figures.show(pictures.pictures(answer, kept, companion), true);
    figures.sweep(answer);
  }

  function showCite() {
    const { request, answer, text } = current;
    const { key, solver, solver_number: number, numerics, theory } = answer.meta;
    const address = `/v1/results/${key}`;
    const curl = curlOf(endpoint.path, request);
    /* With the question, since the daemon keeps an answer no longer than it has room and runs. */
    const citation = `${solver}, solver number ${number}, numerics ${numerics}, ${endpoint.path}, ${theory}. Answer ${key}, asked by: ${curl}`;
    const link = () => new URL(stateLink(endpoint.path, current.request, kept), location.href).href;
    const below = () => {
      cite.querySelector('details').open = true;
      return 'shown below, to be copied by hand';
    };
    const button = (word, act) => h('button', { type: 'button', onclick: act }, word);
    cite.replaceChildren(
      h('div', { class: 'exports' },
        !pictures.single && button('Keep to compare', keep),
        button('Copy citation', () => copy(citation, 'The citation', below)),
        button('Copy link', () => copy(link(), 'The link to this view', () => 'in the address bar')),
        button('Copy curl', () => copy(curl, 'The curl line', below)),
        button('JSON', () => download(`${endpoint.name}.json`, 'application/json', text))),
      h('details', {}, h('summary', {}, 'Cite, repeat, check'),
        h('p', {}, 'Cite the question: a solver of the same number and the same numerics answers it with the same key and the same bytes; other numerics differ in last digits.'),
        h('p', {}, 'While this daemon keeps it: ', h('a', { href: address, class: 'address' }, h('code', {}, address))),
        h('p', {}, h('code', { class: 'citation' }, citation)),
        h('pre', { tabindex: '0' }, h('code', { class: 'curl' }, curl))));
  }

  function keep() {
    const label = `kept ${kept.length + 1}`;
    kept.push({ label, request: current.request, answer: current.answer });
    announce(`Kept as \u201c${label}\u201d: change the cable to compare`);
    rekeep();
  }
  function rekeep() {
    keeping.replaceChildren(...kept.map((one) => h('span', { class: 'chip' },
      h('button', { type: 'button', class: 'quiet', 'aria-label': `Show ${one.label} again`, onclick: () => load(one.request) }, one.label),
      h('button', { type: 'button', class: 'quiet', 'aria-label': `Forget ${one.label}`, onclick: () => {
        kept = kept.filter((other) => other !== one);
        rekeep();
      } }, '\u00d7'))));
    if (current) {
      figures.show(pictures.pictures(current.answer, kept, null), false);
      history.replaceState(null, '', stateLink(endpoint.path, current.request, kept));
    }
  }

  async function start() {
    form.set(first ?? presets[0]?.request ?? {});
    for (const [label, request] of keptFirst ?? []) {
      const result = await ask(endpoint.path, request);
      if (result.ok) kept.push({ label, request, answer: result.answer });
    }
    rekeep();
    schedule(0);
  }
  return {
    node,
    start,
    link: () => (current ? stateLink(endpoint.path, current.request, kept) : `#${endpoint.path.slice(3)}`),
    sleep() {
      controller?.abort();
      figures.stop();
    },
  };
}
