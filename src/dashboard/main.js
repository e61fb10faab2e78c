/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tabs: one an endpoint of the contract. */
import { h } from './dom.js';
import { loadContract } from './contract.js';
import { makeBench } from './panel.js';
import { readState } from './state.js';

const tabs = document.getElementById('tabs');
const place = document.getElementById('bench');
const benches = new Map();
let endpoints = [];
let open = null;

function show(path, state) {
  const endpoint = endpoints.find((one) => one.path === path) ?? endpoints[0];
  benches.get(open)?.sleep();
  open = endpoint.path;
  if (!benches.has(open) || state?.request) {
    const bench = makeBench(endpoint, state?.request, state?.kept);
    benches.set(open, bench);
    bench.start();
  } else {
    history.replaceState(null, '', benches.get(open).link());
  }
  place.replaceChildren(benches.get(open).node);
  place.setAttribute('aria-labelledby', `tab-${endpoint.name}`);
  document.title = `${endpoint.tab} - strum`;
  for (const tab of tabs.children) {
    const chosen = tab.id === `tab-${endpoint.name}`;
    tab.setAttribute('aria-selected', String(chosen));
    tab.tabIndex = chosen ? 0 : -1;
  }
}

function onKey(event) {
  const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
  const at = endpoints.findIndex((one) => one.path === open);
  const to = step ? (at + step + endpoints.length) % endpoints.length : { Home: 0, End: endpoints.length - 1 }[event.key];
  if (to === undefined) return;
  event.preventDefault();
  show(endpoints[to].path);
  tabs.children[to].focus();
}

async function begin() {
  endpoints = await loadContract();
  tabs.append(...endpoints.map((endpoint) => h('button', {
    type: 'button', role: 'tab', id: `tab-${endpoint.name}`, 'aria-controls': 'bench', onclick: () => show(endpoint.path),
  }, endpoint.tab)));
  tabs.addEventListener('keydown', onKey);
  const state = readState();
  show(state?.path, state);
  addEventListener('hashchange', () => {
    const next = readState();
    if (next) show(next.path, next);
  });
}

begin().catch((fault) => {
  place.replaceChildren(h('p', { role: 'alert' }, `The page could not begin: ${fault.message}`));
});
