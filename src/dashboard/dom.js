/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The few things that every module needs of the document. */

/* h('p', {class: 'note', onclick: f}, 'text', node): null and false children are left out. */
export function h(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith('on')) node.addEventListener(name.slice(2), value);
    else if (value === true) node.setAttribute(name, '');
    else if (value !== false && value !== undefined && value !== null) node.setAttribute(name, value);
  }
  node.append(...children.flat().filter((child) => child !== null && child !== undefined && child !== false));
  return node;
}

let serial = 0;
export function freshId(stem) {
  serial += 1;
  return `${stem}-${serial}`;
}

export function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

/* Says it to a screen reader, and shows it for a moment. */
export function announce(text) {
  const place = document.getElementById('said');
  place.textContent = text;
  clearTimeout(announce.timer);
  announce.timer = setTimeout(() => { place.textContent = ''; }, 4000);
}

export function download(name, type, content) {
  const url = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type }));
  const link = h('a', { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

/* Away from localhost and https browsers have no clipboard: `elsewhere` then shows the text. */
export async function copy(text, what, elsewhere) {
  try {
    await navigator.clipboard.writeText(text);
    announce(`${what} copied`);
  } catch {
    announce(`The browser does not let this page copy: ${what.replace(/^The/, 'the')} is ${elsewhere()}`);
  }
}
