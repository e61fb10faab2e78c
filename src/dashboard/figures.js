/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The figures of a bench: kept from answer to answer, so that they change rather than flicker. */
import { askAll } from './api_client.js';
import { h } from './dom.js';
import { makeChart } from './chart.js';
import { makeMotion } from './motion.js';

const SWEEPS_KEPT = 6;

export function makeFigures(path, pictures) {
  const place = h('div', { class: 'figures' });
  const figures = new Map();
  const sweeps = new Map();
  let sweeping = null;

  function put(description) {
    const drawable = description.kind === 'motion' ? description.modes.length : description.series.length;
    if (!drawable) return drop(description.key);
    const old = figures.get(description.key);
    if (old) return old.redraw(description);
    const figure = description.kind === 'motion' ? makeMotion(description) : makeChart(description);
    figure.dataset.figure = description.key;
    figures.set(description.key, figure);
    /* In one order, whichever comes first: motion, sweeps, the rest. What stands is not moved: it may have the focus. */
    const rank = (node) => (node.classList.contains('motion') ? 0 : node.dataset.figure === 'compare' ? 2 : 1);
    place.insertBefore(figure, [...place.children].find((other) => rank(other) > rank(figure)) ?? null);
    return undefined;
  }
  function drop(key) {
    figures.get(key)?.end();
    figures.get(key)?.remove();
    figures.delete(key);
  }
  function show(list, complete) {
    const now = list.filter(Boolean);
    now.forEach(put);
    if (!complete) return;
    const wanted = new Set([...now.map((one) => one.key), ...pictures.sweeps.map((one) => one.key)]);
    for (const key of [...figures.keys()]) if (!wanted.has(key)) drop(key);
  }

  /* Sweeps are asked once for equal questions; what only marks the present cable is drawn from what is known. */
  async function sweep(answer) {
    sweeping?.abort();
    sweeping = new AbortController();
    const { signal } = sweeping;
    for (const one of pictures.sweeps) {
      const requests = one.requests(answer);
      if (!requests.length) {
        drop(one.key);
        continue;
      }
      const name = JSON.stringify(requests);
      let found = sweeps.get(name);
      if (!found) {
        found = [];
        await askAll(path, requests, signal, (i, result) => { if (result.ok) found[i] = { request: requests[i], answer: result.answer }; });
        if (signal.aborted) return;
        found = found.filter(Boolean);
        if (sweeps.size >= SWEEPS_KEPT) sweeps.delete(sweeps.keys().next().value);
        sweeps.set(name, found);
      }
      if (found.length > 1) put(one.chart(answer, found));
      else drop(one.key);
    }
  }
  return {
    place,
    show,
    sweep: (answer) => sweep(answer).catch((fault) => { if (fault.name !== 'AbortError') throw fault; }),
    stop: () => sweeping?.abort(),
    end() {
      sweeping?.abort();
      for (const key of [...figures.keys()]) drop(key);
    },
  };
}
