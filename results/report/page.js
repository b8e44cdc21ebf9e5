// The results page: shows the data that the program filled in. Text reaches the page through textContent alone, so
// that names may contain any character.
'use strict';

const data = JSON.parse(document.getElementById('data').textContent);
const runs = data.runs;  // of a matrix its members, else the run
const records = runs.flatMap((run) =>
  run.results.records.map((record, i) => ({...record, run, display: run.display[i]})));
const axes = Object.keys(runs[0].coordinates);  // what the members of a matrix vary
const distances = [...new Set(records.map((record) => record.distance))];
const methods = [...new Set(records.map((record) => record.method))];
const state = {distance: distances[0], all: false, place: {}, hidden: new Set(), sort: null, descending: false,
  scale: 'own', stops: 0};
const dark = window.matchMedia('(prefers-color-scheme: dark)');
const paper = window.matchMedia('print');

// Okabe and Ito's colours, distinct for every kind of colour vision; each with a mark of its own.
const palette = {
  light: ['#0072b2', '#d55e00', '#007a5a', '#b5488a', '#b07a00', '#2b8cc4', '#444444'],
  dark: ['#4aa8e8', '#ff8a3c', '#2fc79a', '#e79cc8', '#f0c040', '#8fd3ff', '#d0d0d0'],
};
const marks = ['circle', 'rectRot', 'triangle', 'rect', 'star', 'crossRot'];

/** The value at a JSON pointer into a record. */
const valueAt = (record, place) => place.split('/').slice(1).reduce((value, name) => value?.[name], record);

// The program lists the columns. Two sort by something other than the figure at their place in results.json.
const sortedBy = {rank: (r) => (r.display.rank === '–' ? null : Number(r.display.rank)), equivalent_spp: worth};
const bestBy = {shading_error: 'is_best', equivalent_spp: 'is_best', frame_median_ms: 'is_fastest'};
const columns = data.columns.map((column) => (
  {...column, value: sortedBy[column.key] ?? ((r) => valueAt(r, column.place)), best: bestBy[column.key]}));
const nameColumn = {title: 'Method', key: 'name', words: true, value: (r) => r.method};
const axisColumns = axes.map((axis) => ({title: axis, key: `axis ${axis}`, words: true, show: (r) => r.run.coordinates[axis],
  value: (r) => r.run.coordinates[axis], meaning: 'Axis of the matrix.'}));

/** Whether any record has a figure in the column. */
const blank = new Set(['n/a', 'none', '–']);
const isUsed = ({key}) => (key !== 'distance' || state.all) && records.some((r) => !blank.has(r.display[key]));

/** The samples that a record is worth as a sortable number; bounds go beyond the curve's ends. */
function worth(record) {
  const bound = record.equivalent_bound;
  if (bound.startsWith('>')) return Infinity;
  if (bound.startsWith('<')) return 0;
  return record.equivalent_spp;
}

/** An element with a class and children: nodes or text. */
function element(tag, className, ...children) {
  const node = document.createElement(tag);
  if (className) node.className = className;
  node.append(...children);
  return node;
}

const byId = (id) => document.getElementById(id);
const theme = () => (dark.matches && !paper.matches ? 'dark' : 'light');
const seriesColor = (method) => palette[theme()][methods.indexOf(method) % palette.light.length];
const styleValue = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// The members that pass the filters, of which the first is shown in detail, and its records at one distance.
const matching = () => runs.filter((run) => axes.every((axis) => (state.place[axis] ?? run.coordinates[axis]) === run.coordinates[axis]));
const focus = () => matching()[0] ?? runs[0];
const isVisible = (record) => !state.hidden.has(record.method);
const shown = () => records.filter((r) => r.run === focus() && r.distance === state.distance && isVisible(r));
const filtered = () => {
  const members = new Set(matching());
  return records.filter((r) => members.has(r.run) && isVisible(r));
};
const placeOf = (run) => axes.map((axis) => run.coordinates[axis]).join(', ');

function key(method) {
  const node = element('span', 'key');
  node.dataset.method = method;
  node.style.setProperty('--series', seriesColor(method));
  return node;
}

/** A method's name that may break before its options. */
function breakable(method) {
  return method.split(/(?=:)/).flatMap((part, i) => (i ? [element('wbr'), part] : [part]));
}

/** A row of radio buttons that looks like one segmented control; `chosen` at first. */
function segments(id, choices, chosen, onChange) {
  for (const choice of choices) {
    const input = element('input');
    Object.assign(input, {type: 'radio', name: id, value: choice.value, checked: choice.value === chosen});
    input.addEventListener('change', () => onChange(choice.value));
    byId(id).append(element('label', '', input, element('span', '', choice.text)));
  }
}

function count(number, noun) {
  return `${number} ${noun}${number === 1 ? '' : 's'}`;
}

function showHead() {
  byId('lede').textContent = `${count(methods.length, 'method')} at ${count(distances.length, 'distance')}` +
    `${runs.length > 1 ? ` in ${count(runs.length, 'member')} of a matrix, ${count(records.length, 'record')}` : ''}, compared ` +
    `with a reference of ${count(Math.round(runs[0].results.reference.samples), 'sample')} per pixel.`;
  for (const {title, meaning} of columns.filter(isUsed)) byId('meanings').append(element('dt', '', title), element('dd', '', meaning));
}

/** Which member the parts below are of, where there are several, and where its figures come from. */
function showFocus() {
  byId('focus').textContent = runs.length > 1 ? `Details below: ${placeOf(focus())}.` : '';
  byId('provenance').replaceChildren(...focus().provenance.flatMap(({label, value}) =>
    [element('dt', '', label), element('dd', label === 'Warning' ? 'warning' : '', value)]));
}

const ofDistance = () => focus().distances.find((entry) => entry.distance === state.distance);

function showCautions() {
  const warnings = focus().results.ranking_warnings;
  byId('caution').hidden = warnings.length === 0;
  byId('cautions').replaceChildren(...warnings.map((text) => element('li', '', text)));
}

function showWords() {
  byId('pixels').textContent = ofDistance()?.pixels ?? '';
  byId('words').replaceChildren(...(ofDistance()?.findings ?? []).map((text) => element('li', '', text)));
}

// ---- table

function sorted(rows) {
  if (!state.sort) return rows;
  const missing = (value) => value === null || value === undefined;
  return [...rows].sort((a, b) => {
    const [x, y] = [state.sort.value(a), state.sort.value(b)];
    if (missing(x) || missing(y)) return missing(x) - missing(y);
    const order = x < y ? -1 : x > y ? 1 : 0;
    return state.descending ? -order : order;
  });
}

function headCell(column) {
  const button = element('button', '', column.title);
  button.type = 'button';
  button.title = column.meaning ?? '';
  button.addEventListener('click', () => {
    state.descending = state.sort === column && !state.descending;
    state.sort = column;
    showTable();
    writeState();
    byId('table').querySelector('th[aria-sort] button').focus();
  });
  const cell = element('th', column.words ? 'words-column' : '', button);
  cell.scope = 'col';
  if (state.sort === column) cell.setAttribute('aria-sort', state.descending ? 'descending' : 'ascending');
  return cell;
}

function bodyCell(record, column) {
  const text = column.show ? column.show(record) : record.display[column.key];
  const [figure, spread] = text.split(/ (?=\()/);
  const cell = element('td', column.words ? 'words-column' : '', figure);
  if (spread) cell.append(element('small', '', ' ' + spread));
  if (column.key === 'shading_error' && record.display.at_floor) cell.prepend(element('span', 'floor-mark', '≈ '));
  if (column.best && !state.all && matching().length === 1 && record.display[column.best]) cell.classList.add('best');
  return cell;
}

const rowsAtOnce = 100;  // laying a thousand out takes longer than a reader waits for the first
let laterRows = 0;

/** The first rows at once, the others as soon as those are seen. */
function showRows(rows, visible) {
  const rowOf = (record) => element(
    'tr', '', element('td', 'name words-column', key(record.method), ...breakable(record.method)),
    ...visible.map((column) => bodyCell(record, column)));
  const body = byId('table').tBodies[0];
  body.replaceChildren(...rows.slice(0, rowsAtOnce).map(rowOf));
  cancelAnimationFrame(laterRows);
  if (rows.length <= rowsAtOnce) return;
  laterRows = requestAnimationFrame(() => {
    laterRows = requestAnimationFrame(() => body.append(...rows.slice(rowsAtOnce).map(rowOf)));
  });
}

function showTable() {
  const rows = sorted(filtered().filter((record) => state.all || record.distance === state.distance));
  const visible = [...(runs.length > 1 ? axisColumns : []), ...columns.filter(isUsed)];
  byId('rows').textContent = `${count(rows.length, 'record')} of ${records.length}`;
  byId('table').tHead.replaceChildren(element('tr', '', headCell(nameColumn), ...visible.map(headCell)));
  showRows(rows, visible);
  byId('floor-note').hidden = !rows.some((record) => record.display.at_floor);
}

// ---- pairs

const pairOf = (row, column) => focus().results.pairs.find((pair) =>
  pair.distance === state.distance && pair.methods.includes(row) && pair.methods.includes(column));

function swatch(name, method, share) {
  return element('span', `verdict ${name}`, `${method} is closer: ${(100 * share).toFixed(1)}%`);
}

/** The image of the pixels in which one of two methods is closer. */
function showPair(pair) {
  const undecided = 1 - pair.closer[0] - pair.closer[1];
  byId('pair-view').hidden = false;
  byId('pair-picture').replaceChildren(picture(focus(), pair.picture, `Where ${pair.methods.join(' or ')} is closer`));
  byId('pair-picture').style.aspectRatio = shown()[0].size.join(' / ');
  byId('pair-caption').replaceChildren(swatch('first', pair.methods[0], pair.closer[0]),
    swatch('second', pair.methods[1], pair.closer[1]),
    element('span', 'verdict neither', `tie within noise: ${(100 * undecided).toFixed(1)}%`));
}

function pairCell(row, column) {
  const pair = row === column ? null : pairOf(row, column);
  if (!pair) return element('td', '', '–');
  const share = pair.closer[pair.methods.indexOf(row)];
  const button = element('button', '', `${(100 * share).toFixed(1)}%`);
  button.type = 'button';
  button.title = `Where is ${row} closer than ${column}?`;
  button.addEventListener('click', () => showPair(pair));
  return element('td', '', button);
}

function showPairs() {
  const here = shown().map((record) => record.method);
  byId('pair-view').hidden = true;
  byId('pairs-section').hidden = !focus().results.pairs.some((pair) => pair.distance === state.distance);
  const head = (method) => element('th', '', key(method), ...breakable(method));
  byId('pairs').tHead.replaceChildren(element('tr', '', element('th', 'words-column', 'closer than'), ...here.map(head)));
  byId('pairs').tBodies[0].replaceChildren(...here.map((row) => element(
    'tr', '', element('td', 'name words-column', key(row), ...breakable(row)),
    ...here.map((column) => pairCell(row, column)))));
}

// ---- plot

/** The errors of the plot: shading errors, or where no pixel is interior errors over all of the object. */
const plotted = (figures) => figures?.shading ?? figures?.normalized_color;

const figure = (value) => (value >= 1000 ? String(Math.round(value)) : String(Number(value.toPrecision(3))));

/** Horizontal whiskers from each point's least time to its 90th percentile. */
const whiskers = {
  id: 'whiskers',
  beforeDatasetsDraw(plot) {
    const {ctx, scales: {x, y}} = plot;
    plot.data.datasets.forEach((set, i) => {
      if (!set.whiskers || !plot.isDatasetVisible(i)) return;
      ctx.save();
      ctx.strokeStyle = set.borderColor;
      ctx.lineWidth = 1.5;
      ctx.beginPath();
      set.whiskers.forEach((ends, j) => {
        const [left, right] = ends.map((value) => x.getPixelForValue(value));
        const at = y.getPixelForValue(set.data[j].y);
        ctx.moveTo(left, at);
        ctx.lineTo(right, at);
        for (const end of [left, right]) {
          ctx.moveTo(end, at - 4);
          ctx.lineTo(end, at + 4);
        }
      });
      ctx.stroke();
      ctx.restore();
    });
  },
};

/** The count of samples beside each point of the supersampling curve. */
const countLabels = {
  id: 'countLabels',
  afterDatasetsDraw(plot) {
    plot.data.datasets.forEach((set, i) => {
      if (!set.counts || !plot.isDatasetVisible(i)) return;
      const {ctx, chartArea} = plot;
      ctx.save();
      ctx.fillStyle = styleValue('--muted');
      ctx.font = '12px system-ui, sans-serif';
      plot.getDatasetMeta(i).data.forEach((point, j) => {
        const text = `${set.counts[j]} spp`;
        const last = chartArea.right - ctx.measureText(text).width;
        ctx.fillText(text, Math.min(point.x + 8, last), point.y - 8);
      });
      ctx.restore();
    });
  },
};

/** The colour and the mark of a method's points. */
function seriesStyle(method, radius) {
  const color = seriesColor(method);
  return {
    label: method,
    borderColor: color,
    backgroundColor: color,
    pointStyle: marks[methods.indexOf(method) % marks.length],
    pointRadius: radius,
    pointHoverRadius: radius + 2,
    pointBorderWidth: 2,
  };
}

/** A method's records, one per member. */
function methodSeries(method, own) {
  return {
    ...seriesStyle(method, own.length > 1 ? 5 : 7),
    data: own.map((r) => ({x: r.time.frame_ms.median, y: plotted(r.error), place: placeOf(r.run)})),
    whiskers: own.length > 20 ? undefined : own.map(({time: {frame_ms: {min, p90}}}) => [min, p90]),
  };
}

/** The methods of one member that none is both faster and closer than: each left of them costs error, each below time. */
function frontSeries(own) {
  let least = Infinity;
  const front = [...own].sort((a, b) => a.time.frame_ms.median - b.time.frame_ms.median || plotted(a.error) - plotted(b.error))
    .filter((r) => plotted(r.error) < least && ((least = plotted(r.error)), true));
  return {
    label: 'Pareto front',
    data: front.map((r) => ({x: r.time.frame_ms.median, y: plotted(r.error)})),
    showLine: true,
    stepped: 'before',
    borderColor: styleValue('--ink'),
    borderWidth: 1.5,
    borderDash: [2, 3],
    pointRadius: 0,
    pointHitRadius: 0,
    pointStyle: 'line',
  };
}

function curveSeries(points) {
  return {
    label: 'plain supersampling',
    data: points.map((point) => ({x: point.ms, y: plotted(point)})),
    counts: points.map((point) => point.spp),
    showLine: true,
    borderColor: styleValue('--muted'),
    backgroundColor: styleValue('--muted'),
    borderWidth: 1.5,
    pointRadius: 3,
    pointStyle: 'circle',
  };
}

function floorSeries(height, range) {
  return {
    label: 'noise floor',
    data: [{x: range.min, y: height}, {x: range.max, y: height}],
    showLine: true,
    borderColor: styleValue('--warn'),
    borderDash: [6, 5],
    borderWidth: 1.5,
    pointRadius: 0,
    pointHitRadius: 0,
    pointStyle: 'line',
  };
}

/** A logarithmic range with room for marks and labels. */
function padded(values, below, above) {
  return {min: Math.min(...values) / below, max: Math.max(...values) * above};
}

function logAxis(title, range) {
  const axis = linearAxis(title);
  const label = (value) => (/^[125]e/.test(value.toExponential()) ? figure(value) : '');
  return {...axis, type: 'logarithmic', min: range.min, max: range.max, ticks: {...axis.ticks, callback: label}};
}

function linearAxis(title) {
  return {
    title: {display: true, text: title, color: styleValue('--ink')},
    grid: {color: styleValue('--line'), borderColor: styleValue('--muted')},
    ticks: {color: styleValue('--muted'), maxRotation: 0},
  };
}

/** Its ticks are the distances. */
function distanceAxis(range) {
  const axis = logAxis('Distance', range);
  return {...axis, afterBuildTicks: (scale) => { scale.ticks = [...distances].sort((a, b) => a - b).map((value) => ({value})); },
    ticks: {...axis.ticks, autoSkip: true, callback: (value) => figure(value)}};
}

/** An entry for each name, with a word for its dashes, which are too long for a legend. */
function legend(width) {
  const entries = (plot) => {
    const sets = plot.data.datasets;
    return Chart.defaults.plugins.legend.labels.generateLabels(plot)
      .filter(({datasetIndex: i}) => sets.findIndex((set) => set.label === sets[i].label) === i)
      .map((entry) => {
        const dash = sets[entry.datasetIndex].borderDash;
        return {...entry, text: dash?.length ? `${entry.text} (${dash[0] < 3 ? 'dotted' : 'dashed'})` : entry.text};
      });
  };
  return {position: 'bottom', labels: {usePointStyle: true, boxWidth: width, boxHeight: 9, padding: 16,
    color: styleValue('--ink'), generateLabels: entries}};
}

/** Draws a chart of points and lines; `label` makes the text of a point. */
function drawChart(id, datasets, scales, label, {legendWidth = 9, displayColors = false, plugins = [], ...options} = {}) {
  new Chart(id, {
    type: 'scatter',
    data: {datasets},
    plugins,
    options: {
      animation: false,
      maintainAspectRatio: false,
      scales,
      plugins: {legend: legend(legendWidth), tooltip: {callbacks: {label}, displayColors}},
      ...options,
    },
  });
}

function tooltipText(item) {
  const set = item.dataset;
  const {x, y} = item.raw;
  const name = set.counts ? `mean of ${set.counts[item.dataIndex]} frames of direct` : set.label;
  return `${name}${item.raw.place ? `, ${item.raw.place}` : ''}: error ${figure(y)} in ${figure(x)} ms`;
}

/** The points for logarithmic axes at the chosen distance, and those without a place on them. */
function plotContent() {
  const positive = (time, error) => time > 0 && error > 0;
  const here = filtered().filter((r) => r.distance === state.distance);
  const drawn = here.filter((r) => positive(r.time.frame_ms.median, plotted(r.error)));
  const alone = matching().length === 1;  // the curve and the floor are of one member
  const curve = !alone ? [] : focus().results.supersampling
    .filter((point) => point.distance === state.distance && positive(point.ms, plotted(point)))
    .sort((a, b) => a.spp - b.spp);
  const floors = !alone ? [] : here.map((r) => r.error?.shading_floor ?? r.error?.noise_floor).filter((floor) => floor > 0);
  const missing = here.filter((r) => !drawn.includes(r));
  return {drawn, curve, floor: floors.length ? Math.max(...floors) : null, missing};
}

function showPlot() {
  Chart.getChart('plot')?.destroy();
  const {drawn, curve, floor, missing} = plotContent();
  byId('plot-note').textContent = missing.length
    ? `Not shown, because the logarithmic axis cannot show an error of 0 or none: ${
      [...new Set(missing.map((r) => r.method))].join(', ')}.`
    : '';
  byId('plot').parentElement.hidden = drawn.length + curve.length === 0;
  if (drawn.length + curve.length === 0) return;
  const frameTimes = drawn.flatMap((r) => Object.values(r.time.frame_ms)).filter((ms) => ms > 0);
  const times = [...frameTimes, ...curve.map((p) => p.ms)];
  const errors = [...drawn.map((r) => plotted(r.error)), ...curve.map(plotted)];
  const x = padded(times, 1.25, 1.45);
  const y = padded(floor ? [...errors, floor] : errors, 1.4, 1.5);
  const datasets = methods.map((method) => [method, drawn.filter((r) => r.method === method)])
    .filter(([, own]) => own.length > 0).map(([method, own]) => methodSeries(method, own));
  if (curve.length) datasets.push(curveSeries(curve));
  if (floor) datasets.push(floorSeries(floor, x));
  const members = [...new Set(drawn.map((r) => r.run))];
  if (members.length <= mostFronts) datasets.push(...members.map((run) => frontSeries(drawn.filter((r) => r.run === run))));
  drawChart('plot', datasets, {x: logAxis('Frame time (ms)', x), y: logAxis('Shading error', y)}, tooltipText,
    {plugins: [whiskers, countLabels]});
}

// ---- figures against distance

const mostFronts = 12;  // lines that readers can distinguish

/** A method's figure at each distance, the mean over the members that have it there. */
function trendSeries(method, value) {
  const own = filtered().filter((r) => r.method === method && value(r) > 0);
  const points = distances.map((distance) => {
    const values = own.filter((r) => r.distance === distance).map(value);
    return {x: distance, y: values.reduce((sum, v) => sum + v, 0) / values.length, count: values.length};
  });
  return {...seriesStyle(method, 5), showLine: true, borderWidth: 2,
    data: points.filter((point) => point.count > 0).sort((a, b) => a.x - b.x)};
}

function trendText(item) {
  const {x, y, count: members} = item.raw;
  return `${item.dataset.label}: ${figure(y)} at ${figure(x)}${members > 1 ? `, mean of ${members}` : ''}`;
}

function showTrend(id, title, value) {
  Chart.getChart(id)?.destroy();
  const datasets = methods.map((method) => trendSeries(method, value)).filter((set) => set.data.length > 0);
  const points = datasets.flatMap((set) => set.data);
  const isThere = new Set(points.map((point) => point.x)).size > 1;
  byId(id).closest('figure').hidden = !isThere;
  if (!isThere) return false;
  drawChart(id, datasets, {x: distanceAxis(padded(points.map((p) => p.x), 1.15, 1.15)),
    y: logAxis(title, padded(points.map((p) => p.y), 1.4, 1.5))}, trendText);
  return true;
}

function showTrends() {
  byId('trends').hidden = false;  // a chart that is hidden has no size
  const error = showTrend('trend-error', 'Shading error', (r) => plotted(r.error));
  const flicker = showTrend('trend-flicker', 'Flicker', (r) => r.flicker?.mean);
  byId('trends').hidden = !error && !flicker;
  byId('trends-note').hidden = runs.length === 1;
}

// ---- sparkle

/** A histogram as the line of its shares; a bin without pixels is drawn as half a pixel, at the axis' foot. */
function histogramSeries(label, counts, color, dash) {
  const pixels = counts.reduce((sum, count) => sum + count, 0);
  return {
    label,
    data: counts.map((count, i) => ({x: (i + 0.5) / counts.length, y: Math.max(count, 0.5) / pixels, count})),
    stepped: 'middle',
    showLine: true,
    borderColor: color,
    backgroundColor: color,
    borderWidth: 2,
    borderDash: dash,
    pointRadius: 0,
    pointHitRadius: 6,
    pointStyle: 'line',
  };
}

function sparkleText(item) {
  const {x, y, count} = item.raw;
  return `${item.dataset.label}: ${count} pixels, ${count ? figure(100 * y) : 0}%, about luminance ${figure(x)}`;
}

function showSparkle() {
  Chart.getChart('sparkle')?.destroy();
  const counted = shown().filter((record) => record.error);
  byId('sparkle-section').hidden = counted.length === 0;
  if (counted.length === 0) return;
  const datasets = [histogramSeries('reference', counted[0].error.reference_luminances, styleValue('--ink'), [6, 4]),
    ...counted.map((record) => histogramSeries(record.method, record.error.luminances, seriesColor(record.method), []))];
  const shares = datasets.flatMap((set) => set.data.map((point) => point.y));
  drawChart('sparkle', datasets, {x: {...linearAxis('Luminance as shown'), min: 0, max: 1},
    y: logAxis('Share of pixels', padded(shares, 1, 1.5))}, sparkleText, {legendWidth: 18});
}

// ---- pictures

// Below 0 stops pictures are those that were written four stops darker, so that highlights come back.
const darkStops = 4;
const pngOf = (path) => path.replace(/\.exr$/i, state.stops < 0 ? '_dark.png' : '.png');
const urlOf = (path) => path.split('/').map(encodeURIComponent).join('/');

function picture(run, path, description) {
  const place = run.folder ? `${run.folder}/${path}` : path;
  const image = element('img');
  image.alt = description;
  image.draggable = false;
  image.addEventListener('error', () => image.replaceWith(element('span', 'missing', `${place} is missing`)));
  image.src = data.pictures?.[place] ?? urlOf(place);
  return image;
}

/** The reference left of a line, the method right of it; the line follows a range input. */
function comparison(record) {
  const slider = element('input');
  Object.assign(slider, {type: 'range', min: 0, max: 100, step: 0.5, value: 50});
  slider.setAttribute('aria-label', `Share of the reference shown next to ${record.method}, in percent`);
  const node = element('div', 'picture compare',
    picture(record.run, pngOf(record.images.reference), `Reference at distance ${record.distance}`),
    element('div', 'over', picture(record.run, pngOf(record.images.color), `${record.method} at distance ${record.distance}`)),
    element('div', 'divider'), element('span', 'tag left', 'reference'), element('span', 'tag right', record.method),
    slider);
  const move = () => node.style.setProperty('--split', `${slider.value}%`);
  slider.addEventListener('input', move);
  move();
  return node;
}

function card(record) {
  const {display} = record;
  const error = element('div', 'picture',
    picture(record.run, state.scale === 'own' ? record.images.error : record.images.error_shared, `Error of ${record.method} at distance ${record.distance}`),
    element('span', 'tag left', 'error'));
  const pair = element('div', 'pair', comparison(record), error);
  for (const node of pair.children) node.style.aspectRatio = record.size.join(' / ');
  return element('article', 'card',
    element('header', '', element('h3', '', key(record.method), record.method),
      element('p', '', `shading error ${display.shading_error} · ${display.frame_median_ms} ms`)),
    pair);
}

function showCards() {
  byId('cards').replaceChildren(...shown().filter((r) => !r.failure).map(card));
}

function setZoom(factor) {
  byId('cards').style.setProperty('--zoom', factor);
  byId('cards').classList.toggle('zoomed', factor > 1);
}

function showScale() {
  byId('ramp').style.background = `linear-gradient(to right, ${data.scale_colors.join(', ')})`;
  byId('scale-top').textContent = state.scale === 'own' ? ofDistance()?.scale_top : focus().scale_top;
}

/** Radiance times 2^stops, in linear light. */
function setExposure(stops) {
  const changes = (stops < 0) !== (state.stops < 0);
  state.stops = stops;
  byId('stops').textContent = stops > 0 ? `+${stops}` : String(stops);
  for (const gain of document.querySelectorAll('#gain feComponentTransfer *')) {
    gain.setAttribute('slope', 2 ** (stops < 0 ? stops + darkStops : stops));
  }
  byId('cards').classList.toggle('exposed', stops !== 0);
  if (changes) showCards();
}

// ---- the whole

function showAll() {
  showFocus();
  showCautions();
  showWords();
  showTable();
  showPairs();
  showPlot();
  showTrends();
  showSparkle();
  showScale();
  showCards();
}

// ---- what is shown, in the address: a link to it shows the same

function writeState() {
  const words = new URLSearchParams();
  if (state.distance !== distances[0]) words.set('distance', state.distance);
  if (state.all) words.set('all', '1');
  for (const axis of axes) if (state.place[axis] !== undefined) words.set(axis, state.place[axis]);
  for (const method of state.hidden) words.append('without', method);
  if (state.sort) words.set('sort', state.sort.key);
  if (state.descending) words.set('down', '1');
  history.replaceState(null, '', `#${words}`);
}

/** Ignores values that no record has, because a link may be of another run. */
function readState() {
  const words = new URLSearchParams(location.hash.slice(1));
  const distance = Number(words.get('distance'));
  state.distance = distances.includes(distance) ? distance : distances[0];
  state.all = words.has('all');
  state.place = {};
  for (const axis of axes) {
    if (runs.some((run) => run.coordinates[axis] === words.get(axis))) state.place[axis] = words.get(axis);
  }
  if (matching().length === 0) state.place = {};
  state.hidden = new Set(words.getAll('without').filter((method) => methods.includes(method)));
  state.sort = [nameColumn, ...axisColumns, ...columns].find((column) => column.key === words.get('sort')) ?? null;
  state.descending = words.has('down');
}

/** The controls as the state is. */
function showControls() {
  for (const input of document.querySelectorAll('#distances input')) input.checked = Number(input.value) === state.distance;
  for (const input of document.querySelectorAll('#methods input')) input.checked = !state.hidden.has(input.value);
  for (const select of document.querySelectorAll('#axes select')) select.value = state.place[select.name] ?? '';
  byId('all-distances').checked = state.all;
  byId('hidden').textContent = state.hidden.size ? `${methods.length - state.hidden.size} of ${methods.length}` : 'all';
}

function change(what) {
  Object.assign(state, what);
  writeState();
  showControls();
  showAll();
}

function axisSelect(axis) {
  const values = [...new Set(runs.map((run) => run.coordinates[axis]))];
  const options = values.map((value) => Object.assign(element('option', '', value), {value}));
  const select = element('select', '', Object.assign(element('option', '', 'all'), {value: ''}), ...options);
  select.name = axis;
  select.addEventListener('change', () => change({place: {...state.place, [axis]: select.value || undefined}}));
  return element('label', 'axis', `${axis} `, select);
}

function methodBox(method) {
  const input = Object.assign(element('input'), {type: 'checkbox', value: method});
  input.addEventListener('change', () => {
    const hidden = new Set(state.hidden);
    if (input.checked) hidden.delete(method); else hidden.add(method);
    change({hidden});
  });
  return element('label', '', input, key(method), method);
}

function recolourKeys() {
  for (const node of document.querySelectorAll('.key')) {
    node.style.setProperty('--series', seriesColor(node.dataset.method));
  }
}

/** All that is drawn in a method's colour, or in the page's. */
function recolour() {
  recolourKeys();
  showPlot();
  showTrends();
  showSparkle();
}

/** Everything that follows the chosen view. */
function startViews() {
  byId('axes').append(...axes.map(axisSelect));
  byId('methods').append(...methods.map(methodBox));
  segments('distances', distances.map((value) => ({value, text: String(value)})), state.distance,
    (distance) => change({distance}));
  segments('zooms', [1, 2, 4, 8].map((value) => ({value, text: `${value}×`})), 1, setZoom);
  segments('layouts', [{value: 'list', text: 'large'}, {value: 'grid', text: 'side by side'}], 'list', (layout) =>
    byId('cards').classList.toggle('grid', layout === 'grid'));
  segments('scales', [{value: 'own', text: 'this distance'}, {value: 'shared', text: 'all distances'}], 'own', (scale) => {
    state.scale = scale;
    showScale();
    showCards();
  });
  byId('exposure').addEventListener('input', (event) => setExposure(Number(event.target.value)));
  byId('all-distances').addEventListener('change', (event) => change({all: event.target.checked}));
  window.addEventListener('hashchange', () => {
    readState();
    showControls();
    showAll();
  });
  for (const query of [dark, paper]) query.addEventListener('change', recolour);
  showHead();
  readState();
  showControls();
  showAll();
}

if (runs[0].path) {  // an animation: film.js shows its frames
  for (const id of ['views-bar', 'views']) byId(id).remove();
  showFocus();
  showCautions();
} else {
  startViews();
}
