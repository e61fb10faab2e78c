/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A chart's description as a standing SVG picture, for documents; from it the PNG. */
import { extent, logTicks, padded, ticks } from './scale.js';
import { tickWords } from './values.js';

const COLOURS = ['#0b6b8f', '#b8500f', '#5b4aa8', '#1f7a47', '#a3265f', '#6b5b12'];
const WIDTH = 860;
const HEIGHT = 520;
const BOX = { left: 72, right: 24, top: 52, bottom: 56 };

function escape(text) {
  return String(text).replace(/[&<>"]/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[c]);
}

function text(x, y, words, more = '') {
  return `<text x="${x.toFixed(1)}" y="${y.toFixed(1)}" ${more}>${escape(words)}</text>`;
}

/* Both axes, as functions from values to the sheet. With `equal` a metre is as long up as along. */
function axes(chart) {
  const all = (part) => chart.series.map((one) => one[part]).concat(chart.marks && part === 'x' ? [chart.marks.map((mark) => mark.x)] : []);
  const range = (part) => {
    const found = extent(all(part), chart[part].log);
    return padded([chart[part].min ?? found[0], chart[part].max ?? found[1]], chart[part].log, chart[part].log ? 0.02 : 0.04);
  };
  let [xs, ys] = [range('x'), range('y')];
  const [width, height] = [WIDTH - BOX.left - BOX.right, HEIGHT - BOX.top - BOX.bottom];
  if (chart.equal) {
    const unit = Math.max((xs[1] - xs[0]) / width, (ys[1] - ys[0]) / height);
    const widen = ([low, high], size) => [(low + high) / 2 - (unit * size) / 2, (low + high) / 2 + (unit * size) / 2];
    [xs, ys] = [widen(xs, width), widen(ys, height)];
  }
  const part = ([low, high], log) => (value) => (log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low));
  const [px, py] = [part(xs, chart.x.log), part(ys, chart.y.log)];
  return { xs, ys, x: (value) => BOX.left + width * px(value), y: (value) => HEIGHT - BOX.bottom - height * py(value) };
}

function grid(chart, at) {
  const out = [];
  const [bottom, right] = [HEIGHT - BOX.bottom, WIDTH - BOX.right];
  for (const value of chart.x.log ? logTicks(at.xs) : ticks(at.xs)) {
    out.push(`<path d="M${at.x(value).toFixed(1)} ${BOX.top}V${bottom}" class="grid"/>`, text(at.x(value), bottom + 20, tickWords(value), 'text-anchor="middle"'));
  }
  for (const value of chart.y.log ? logTicks(at.ys) : ticks(at.ys)) {
    out.push(`<path d="M${BOX.left} ${at.y(value).toFixed(1)}H${right}" class="grid"/>`, text(BOX.left - 8, at.y(value) + 4, tickWords(value), 'text-anchor="end"'));
  }
  out.push(`<rect x="${BOX.left}" y="${BOX.top}" width="${right - BOX.left}" height="${bottom - BOX.top}" class="box"/>`);
  out.push(text((BOX.left + right) / 2, HEIGHT - 14, chart.x.label, 'text-anchor="middle"'));
  out.push(text(16, (BOX.top + bottom) / 2, chart.y.label, `text-anchor="middle" transform="rotate(-90 16 ${(BOX.top + bottom) / 2})"`));
  return out.join('');
}

function path(one, at) {
  let pen = 'M';
  let d = '';
  one.x.forEach((x, i) => {
    const y = one.y[i];
    const [left, top] = [at.x(x), at.y(y)];
    if (y === null || !Number.isFinite(left) || !Number.isFinite(top)) {
      pen = 'M';
      return;
    }
    d += `${pen}${left.toFixed(1)} ${top.toFixed(1)}`;
    pen = 'L';
  });
  return d;
}

export function chartSvg(chart) {
  const at = axes(chart);
  const out = [`<svg xmlns="http://www.w3.org/2000/svg" width="${WIDTH}" height="${HEIGHT}" viewBox="0 0 ${WIDTH} ${HEIGHT}">`,
    '<style>text{font:13px sans-serif;fill:#17212b}.grid{stroke:#e0e4e8;fill:none}.box{stroke:#52606d;fill:none}</style>',
    `<title>${escape(chart.title)}</title><rect width="${WIDTH}" height="${HEIGHT}" fill="#fff"/>`,
    text(BOX.left, 22, chart.title, 'style="font-size:16px;font-weight:600"'), grid(chart, at),
    `<clipPath id="c"><rect x="${BOX.left}" y="${BOX.top}" width="${WIDTH - BOX.left - BOX.right}" height="${HEIGHT - BOX.top - BOX.bottom}"/></clipPath>`];
  const free = [-Infinity, -Infinity, -Infinity];
  for (const mark of chart.marks ?? []) {
    const width = 5.6 * String(mark.label).length;
    const begin = at.x(mark.x) + width > WIDTH - BOX.right ? at.x(mark.x) - width - 3 : at.x(mark.x) + 3;
    const row = Math.max(0, free.findIndex((end) => begin > end));
    free[row] = begin + width + 5;
    out.push(`<path d="M${at.x(mark.x).toFixed(1)} ${BOX.top}V${HEIGHT - BOX.bottom}" stroke="#a52019" stroke-dasharray="3 4" fill="none"/>`,
      text(begin, BOX.top + 12 + 12 * row, mark.label, 'style="font-size:10px;fill:#a52019"'));
  }
  let legend = BOX.left;
  chart.series.forEach((one, i) => {
    const colour = COLOURS[(one.colour ?? i) % COLOURS.length];
    if (!one.pointsOnly) {
      out.push(`<path d="${path(one, at)}" clip-path="url(#c)" fill="none" stroke="${colour}" stroke-width="1.8"${one.dash ? ' stroke-dasharray="6 4"' : ''}/>`);
    }
    if (one.points || one.pointsOnly) {
      one.x.forEach((x, k) => {
        const [left, top] = [at.x(x), at.y(one.y[k])];
        if (Number.isFinite(left) && Number.isFinite(top)) out.push(`<circle cx="${left.toFixed(1)}" cy="${top.toFixed(1)}" r="3.2" fill="${colour}" clip-path="url(#c)"/>`);
      });
    }
    const width = 30 + 6.6 * one.label.length;
    if (legend + width < WIDTH) {
      out.push(`<path d="M${legend} 38h18" stroke="${colour}" stroke-width="3"/>`, text(legend + 23, 42, one.label));
      legend += width;
    }
  });
  out.push('</svg>');
  return out.join('');
}

/* The SVG, drawn twice as large for print. */
export async function chartPng(chart) {
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(chartSvg(chart))}`;
  await image.decode();
  const canvas = document.createElement('canvas');
  canvas.width = 2 * WIDTH;
  canvas.height = 2 * HEIGHT;
  canvas.getContext('2d').drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise((done) => { canvas.toBlob(done, 'image/png'); });
}

/* One column for x and y of every series: they need not share their x. */
export function chartCsv(chart) {
  const quote = (word) => `"${String(word).replaceAll('"', '""')}"`;
  const head = chart.series.flatMap((one) => [quote(`${one.label}: ${chart.x.label}`), quote(`${one.label}: ${chart.y.label}`)]);
  const longest = Math.max(0, ...chart.series.map((one) => one.x.length));
  const rows = Array.from({ length: longest }, (_, i) => chart.series.flatMap((one) => [one.x[i] ?? '', one.y[i] ?? '']).join(','));
  return `${head.join(',')}\r\n${rows.join('\r\n')}\r\n`;
}
