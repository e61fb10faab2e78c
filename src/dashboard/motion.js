/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Modes in motion, on a canvas of our own. A drawing is {name, title, unit, rest: [{x, y}], modes: [{label, at(phase) -> [{x, y}]
 * displacements of the largest value 1 in units of the drawing's size, rate}], marks(mode) -> [{x, y, kind, label}], supports, hang}. */
import { colour, download, h } from './dom.js';
import { chartCsv, chartSvg } from './svg.js';
import { extent, ticks } from './scale.js';
import { brief } from './values.js';

const HEIGHT = 320;
const MARGIN = 34;

function bounds(drawing, reach) {
  const [x, y] = [extent([drawing.rest.map((point) => point.x)]), extent([drawing.rest.map((point) => point.y)])];
  return { x: [x[0] - reach, x[1] + reach], y: [y[0] - reach, y[1] + reach] };
}

function sizeOf(drawing) {
  const [x, y] = [extent([drawing.rest.map((point) => point.x)]), extent([drawing.rest.map((point) => point.y)])];
  return Math.hypot(x[1] - x[0], y[1] - y[0]);
}

function displaced(drawing, mode, phase, reach) {
  const moves = mode.at(phase);
  return drawing.rest.map((point, i) => ({ x: point.x + reach * moves[i].x, y: point.y + reach * moves[i].y }));
}

/* The same, standing, as a chart: rest and both extremes. */
function still(drawing, mode, reach) {
  const line = (label, points, dash) => ({ label, x: points.map((point) => point.x), y: points.map((point) => point.y), dash });
  return {
    name: drawing.name, title: `${drawing.title}: ${mode.label}`, x: { label: drawing.unit }, y: { label: drawing.unit }, equal: true,
    series: [line('at rest', drawing.rest, true), line('displaced', displaced(drawing, mode, 0, reach)), line('half a period later', displaced(drawing, mode, Math.PI, reach))],
  };
}

function polyline(pen, points, to) {
  pen.beginPath();
  points.forEach((point, i) => {
    const [x, y] = to(point);
    if (i === 0) pen.moveTo(x, y);
    else pen.lineTo(x, y);
  });
  pen.stroke();
}

/* A word beside a point: above or below it, where no other stands; left out where there is no room. */
function word(pen, text, x, y, taken, ratio) {
  pen.font = `${11 * ratio}px sans-serif`;
  const half = pen.measureText(text).width / 2;
  const left = Math.min(Math.max(x - half, 0), pen.canvas.width - 2 * half);
  const rows = [-10, 20, -24, 34].map((row) => y + row * ratio);
  const clear = (base) => taken.every((other) => Math.abs(other.base - base) > 12 * ratio || other.right < left || other.left > left + 2 * half);
  const base = rows.find(clear);
  if (base === undefined) return;
  taken.push({ base, left: left - 4 * ratio, right: left + 2 * half + 4 * ratio });
  pen.fillStyle = colour('soft');
  pen.fillText(text, left, base);
}

/* How long the sheet is, by a bar of a round length. */
function measure(pen, unit, words, ratio) {
  const long = ticks([0, (pen.canvas.width / unit) * 0.3], 4).at(-1);
  const [x, y] = [10 * ratio, pen.canvas.height - 8 * ratio];
  pen.strokeStyle = colour('soft');
  pen.fillStyle = colour('soft');
  pen.lineWidth = ratio;
  pen.beginPath();
  pen.moveTo(x, y - 4 * ratio);
  pen.lineTo(x, y);
  pen.lineTo(x + long * unit, y);
  pen.lineTo(x + long * unit, y - 4 * ratio);
  pen.stroke();
  pen.font = `${11 * ratio}px sans-serif`;
  pen.fillText(`${brief(long)} ${words}`, x + 5 * ratio, y - 5 * ratio);
}

function mark(pen, place, to, taken, ratio) {
  const [x, y] = to(place);
  pen.beginPath();
  if (place.kind === 'mass') {
    pen.fillStyle = colour('ink');
    pen.arc(x, y, 5 * ratio, 0, 2 * Math.PI);
    pen.fill();
  } else if (place.kind === 'node') {
    pen.strokeStyle = colour('bad');
    pen.arc(x, y, 4 * ratio, 0, 2 * Math.PI);
    pen.stroke();
  } else {
    pen.fillStyle = colour('c2');
    pen.moveTo(x, y - 5 * ratio);
    pen.lineTo(x + 5 * ratio, y);
    pen.lineTo(x, y + 5 * ratio);
    pen.lineTo(x - 5 * ratio, y);
    pen.fill();
  }
  if (place.label) word(pen, place.label, x, y, taken, ratio);
}

function paint(canvas, drawing, mode, phase, reach) {
  const ratio = devicePixelRatio;
  const [width, height] = [canvas.width, canvas.height];
  const pen = canvas.getContext('2d');
  const box = bounds(drawing, reach);
  const margin = MARGIN * ratio;
  const unit = Math.min((width - 2 * margin) / (box.x[1] - box.x[0]), (height - 2 * margin) / (box.y[1] - box.y[0] || 1e-9));
  const middle = { x: (box.x[0] + box.x[1]) / 2, y: (box.y[0] + box.y[1]) / 2 };
  const to = (point) => [width / 2 + unit * (point.x - middle.x), height / 2 - unit * (point.y - middle.y)];
  pen.clearRect(0, 0, width, height);
  pen.lineJoin = 'round';
  pen.lineWidth = 1.2 * ratio;
  pen.setLineDash([5 * ratio, 4 * ratio]);
  pen.strokeStyle = colour('soft');
  polyline(pen, drawing.rest, to);
  pen.setLineDash([]);
  pen.lineWidth = 2.4 * ratio;
  pen.strokeStyle = colour('c1');
  const now = displaced(drawing, mode, phase, reach);
  polyline(pen, now, to);
  pen.lineWidth = 1.5 * ratio;
  for (const end of [drawing.rest[0], drawing.rest.at(-1)]) {
    const [x, y] = to(end);
    pen.fillStyle = colour('ink');
    pen.fillRect(x - 4 * ratio, y - 4 * ratio, 8 * ratio, 8 * ratio);
  }
  const taken = [];
  for (const place of drawing.marks?.(mode, now) ?? []) mark(pen, place, to, taken, ratio);
  measure(pen, unit, drawing.unit.replace(/^in /, ''), ratio);
}

/* A figure with the choice of a mode, pace, size, and its exports. It stands still where the reader wants less motion. */
export function makeMotion(first) {
  let drawing = first;
  let chosen = 0;
  let phase = 0;
  let moving = !matchMedia('(prefers-reduced-motion: reduce)').matches;
  let last = 0;
  let frame = 0;
  let seen = true;
  const canvas = h('canvas', { role: 'img' });
  const title = h('h3', {});
  const note = h('p', { class: 'note' });
  const choice = h('select', { 'aria-label': 'Mode to show', onchange: () => {
    chosen = Number(choice.value);
    say();
  } });
  const size = h('input', { type: 'range', min: 1, max: 30, value: 10, 'aria-label': 'Size of the displacement', oninput: () => show() });
  const pace = h('button', { type: 'button', onclick: () => {
    moving = !moving;
    say();
    if (moving) step(performance.now());
  } });
  const save = (word, act) => h('button', { type: 'button', 'aria-label': `Motion: save as ${word}`, onclick: act }, word);
  const reach = () => (Number(size.value) / 100) * sizeOf(drawing);
  const mode = () => drawing.modes[Math.min(chosen, drawing.modes.length - 1)];
  const figure = h('figure', { class: 'chart motion' }, h('figcaption', {}, title, note),
    h('div', { class: 'plot' }, canvas),
    h('div', { class: 'exports' }, choice, pace, h('label', {}, 'size ', size),
      save('PNG', () => canvas.toBlob((blob) => download(`${drawing.name}.png`, 'image/png', blob))),
      save('SVG', () => download(`${drawing.name}.svg`, 'image/svg+xml', chartSvg(still(drawing, mode(), reach())))),
      save('CSV', () => download(`${drawing.name}.csv`, 'text/csv', chartCsv(still(drawing, mode(), reach()))))));

  function show() {
    if (!canvas.width || !drawing.modes.length) return;
    paint(canvas, drawing, mode(), phase, reach());
  }
  function say() {
    pace.textContent = moving ? 'Pause' : 'Play';
    title.textContent = drawing.title;
    note.textContent = mode()?.note ?? drawing.note ?? '';
    canvas.setAttribute('aria-label', `${drawing.title}: ${mode()?.label ?? ''}`);
    choice.replaceChildren(...drawing.modes.map((one, i) => h('option', { value: i, selected: i === Math.min(chosen, drawing.modes.length - 1) }, one.label)));
    show();
  }
  function step(now) {
    cancelAnimationFrame(frame);
    if (!moving || !figure.isConnected) return;
    phase = (phase + ((now - last > 100 ? 16 : now - last) / 1000) * 2.6 * (mode()?.rate ?? 1)) % (2 * Math.PI);
    last = now;
    if (seen) show();
    frame = requestAnimationFrame(step);
  }
  const fit = () => {
    const width = canvas.parentElement.clientWidth;
    canvas.width = Math.round(width * devicePixelRatio);
    canvas.height = Math.round(HEIGHT * devicePixelRatio);
    canvas.style.width = `${width}px`;
    canvas.style.height = `${HEIGHT}px`;
    show();
  };
  const sizes = new ResizeObserver(fit);
  sizes.observe(canvas.parentElement);
  const sight = new IntersectionObserver(([entry]) => { seen = entry.isIntersecting; });
  sight.observe(canvas);
  document.addEventListener('theme', show);
  requestAnimationFrame(() => {
    fit();
    say();
    step(performance.now());
  });
  figure.redraw = (next) => {
    drawing = next;
    say();
    if (moving) step(performance.now());
  };
  figure.end = () => {
    cancelAnimationFrame(frame);
    sizes.disconnect();
    sight.disconnect();
    document.removeEventListener('theme', show);
  };
  return figure;
}
