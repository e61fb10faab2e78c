/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Charts. A description {name, title, x: {label, log, min, max}, y: {..}, series: [{label, x, y, dash, points, pointsOnly, colour}],
 * marks: [{x, label}], note} is drawn by uPlot on the page and by svg.js for export. */
import { chartCsv, chartPng, chartSvg } from './svg.js';
import { colour, download, h } from './dom.js';
import { brief, tickWords } from './values.js';
import { extent, padded } from './scale.js';

function lineColour(one, i) {
  return colour(`c${((one.colour ?? i) % 6) + 1}`);
}

/* uPlot wants each x once and in order. */
function table(one, logX, logY) {
  const points = one.x.map((x, i) => [x, one.y[i]])
    .filter(([x, y]) => Number.isFinite(x) && (y === null || Number.isFinite(y)) && !(logX && x <= 0))
    .map(([x, y]) => [x, logY && y <= 0 ? null : y])
    .sort((a, b) => a[0] - b[0]).filter(([x], i, all) => i === 0 || x !== all[i - 1][0]);
  return [points.map(([x]) => x), points.map(([, y]) => y)];
}

function drawMarks(chart) {
  return (plot) => {
    const { ctx, bbox } = plot;
    const ratio = devicePixelRatio;
    ctx.save();
    ctx.strokeStyle = colour('bad');
    ctx.fillStyle = colour('bad');
    ctx.font = `${11 * ratio}px sans-serif`;
    ctx.textAlign = 'left';
    ctx.setLineDash([3 * ratio, 4 * ratio]);
    const free = [-Infinity, -Infinity, -Infinity];
    for (const mark of chart.marks ?? []) {
      const x = plot.valToPos(mark.x, 'x', true);
      if (x < bbox.left || x > bbox.left + bbox.width) continue;
      ctx.beginPath();
      ctx.moveTo(x, bbox.top);
      ctx.lineTo(x, bbox.top + bbox.height);
      ctx.stroke();
      const width = ctx.measureText(mark.label).width;
      /* Right of its line, or left of it where the sheet ends; on the first row that is free. */
      const begin = x + width > bbox.left + bbox.width ? x - width - 3 * ratio : x + 3 * ratio;
      const row = free.findIndex((end) => begin > end);
      if (row < 0) continue;
      ctx.fillText(mark.label, begin, bbox.top + (11 + 13 * row) * ratio);
      free[row] = begin + width + 5 * ratio;
    }
    ctx.restore();
  };
}

function options(chart, width) {
  const axis = (part) => ({
    label: chart[part].label, stroke: colour('soft'), labelSize: 22,
    size: part === 'y' ? (plot, words) => 20 + 7 * Math.max(4, ...(words ?? []).map((word) => word.length)) : 36, font: '12px sans-serif', labelFont: '13px sans-serif',
    grid: { stroke: colour('grid'), width: 1 }, ticks: { stroke: colour('line'), width: 1 },
    incrs: chart[part].label === 'mode' ? [1, 2, 5, 10, 20, 50, 100] : undefined,
    values: (plot, splits) => splits.map((value) => (value === null ? '' : tickWords(value))),
  });
  const scale = (part) => {
    const log = Boolean(chart[part].log);
    const found = extent(chart.series.map((one) => one[part]), log);
    const fixed = [chart[part].min ?? found[0], chart[part].max ?? found[1]];
    /* A log axis of uPlot begins and ends at a decade of its own choice; the range asked for is kept on linear ones. */
    return log ? { distr: 3, time: false } : { time: false, range: (plot, low, high) => (part === 'x' && plot.zoomed ? [low, high] : padded(fixed, false, part === 'x' ? 0.01 : 0.05)) };
  };
  return {
    width,
    height: Math.round(Math.min(420, Math.max(260, width * 0.5))),
    scales: { x: scale('x'), y: scale('y') },
    axes: [axis('x'), axis('y')],
    cursor: { drag: { x: false, y: false } },
    legend: { show: chart.series.length <= 12 },
    series: [{ label: chart.x.label, value: (plot, value) => brief(value) },
      ...chart.series.map((one, i) => ({
        label: one.label, stroke: lineColour(one, i), width: one.pointsOnly ? 0 : 1.6, dash: one.dash ? [6, 4] : undefined,
        points: { show: Boolean(one.points || one.pointsOnly), size: 6, fill: lineColour(one, i) }, value: (plot, value) => brief(value),
      }))],
    hooks: { draw: [drawMarks(chart)] },
  };
}

/* What is under the picture: take it away as PNG, SVG or numbers. It stays the same while charts come and go: a button
 * that is replaced while it is pressed would swallow the click. */
function exportBar(current) {
  const save = async (word, chart) => {
    if (word === 'PNG') download(`${chart.name}.png`, 'image/png', await chartPng(chart));
    else if (word === 'SVG') download(`${chart.name}.svg`, 'image/svg+xml', chartSvg(chart));
    else download(`${chart.name}.csv`, 'text/csv', chartCsv(chart));
  };
  const buttons = ['PNG', 'SVG', 'CSV'].map((word) => h('button', { type: 'button', onclick: () => save(word, current()) }, word));
  const node = h('div', { class: 'exports' }, buttons);
  node.rename = (title) => buttons.forEach((button) => button.setAttribute('aria-label', `${title}: save as ${button.textContent}`));
  return node;
}

/* A figure that follows its width and the colours; `figure.redraw(chart)` shows another description in it. */
export function makeChart(first) {
  let chart = first;
  let plot = null;
  const canvas = h('div', { class: 'plot' });
  const caption = h('figcaption', {}, h('h3', {}), h('p', { class: 'note' }));
  const bar = exportBar(() => chart);
  const figure = h('figure', { class: 'chart' }, caption, canvas, bar);
  function draw() {
    plot?.destroy();
    plot = null;
    canvas.setAttribute('role', 'img');
    canvas.setAttribute('aria-label', `${chart.title}. ${chart.series.length} curves of ${chart.y.label} against ${chart.x.label}. The numbers are in the CSV.`);
    caption.firstChild.textContent = chart.title;
    caption.lastChild.textContent = chart.note ?? '';
    caption.lastChild.hidden = !chart.note;
    bar.rename(chart.title);
    const width = canvas.clientWidth;
    if (!width || !chart.series.length) return;
    const tables = chart.series.map((one) => table(one, chart.x.log, chart.y.log));
    if (!tables.some(([x]) => x.length)) return;
    plot = new globalThis.uPlot(options(chart, width), globalThis.uPlot.join(tables), canvas);
  }
  const sizes = new ResizeObserver(() => { if (plot?.width !== canvas.clientWidth) requestAnimationFrame(draw); });
  sizes.observe(canvas);
  document.addEventListener('theme', draw);
  figure.redraw = (next) => {
    chart = next;
    draw();
  };
  figure.end = () => {
    sizes.disconnect();
    document.removeEventListener('theme', draw);
    plot?.destroy();
  };
  return figure;
}
