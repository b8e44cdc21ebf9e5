// The results page: shows the data that the program filled in. Text reaches the page through textContent alone, so
// that names may hold any character.
'use strict';

const data = JSON.parse(document.getElementById('data').textContent);
const records = data.results.records.map((record, i) => ({...record, display: data.display[i]}));
const distances = [...new Set(records.map((record) => record.distance))];
const methods = [...new Set(records.map((record) => record.method))];
const state = {distance: distances[0], all: false, sort: null, descending: false, scale: 'own', stops: 0};
const dark = window.matchMedia('(prefers-color-scheme: dark)');

// Okabe and Ito's colours, told apart by every kind of colour vision; each with a mark of its own.
const palette = {
  light: ['#0072b2', '#d55e00', '#007a5a', '#b5488a', '#b07a00', '#2b8cc4', '#444444'],
  dark: ['#4aa8e8', '#ff8a3c', '#2fc79a', '#e79cc8', '#f0c040', '#8fd3ff', '#d0d0d0'],
};
const marks = ['circle', 'rectRot', 'triangle', 'rect', 'star', 'crossRot'];

const columns = [
  {title: 'Distance', words: false, text: 'distance', value: (r) => r.distance, only: () => state.all,
   meaning: 'How far the camera stands, as a factor on the distance at which the scene places it.'},
  {title: 'Rank', text: 'rank', value: (r) => (r.display.rank === '–' ? null : Number(r.display.rank)),
   meaning: 'Place by shading error. Methods that differ by no more than the reference’s noise share it; – where too few pixels are interior.'},
  {title: 'Error', text: 'error', value: (r) => r.error?.normalized_color,
   meaning: 'Normalised colour error against the reference: mean over the object’s pixels, 0 to 1.'},
  {title: 'Shading', text: 'shading', value: (r) => r.error?.shading, best: 'is_best',
   meaning: 'The same over interior pixels alone, in which the reference sees one smooth piece of surface. Methods are ranked by it.'},
  {title: 'Edges', text: 'edges', value: (r) => r.error?.edges,
   meaning: 'The same over the object’s other pixels, which no method filters.'},
  {title: 'Filter', text: 'filter', value: (r) => r.error?.filter,
   meaning: 'What the true distribution of normals is off by under the same footprint filter: the filter’s share.'},
  {title: 'Method', text: 'method', value: (r) => r.error?.method,
   meaning: 'What the method’s picture differs from that by: its own share.'},
  {title: 'Light', text: 'light', value: (r) => r.error?.light, only: () => records.some((r) => Number.isFinite(r.error?.light)),
   meaning: 'What the lookup of an environment by lobes costs.'},
  {title: 'Represent.', text: 'representation', value: (r) => r.error?.representation,
   meaning: 'Error of the method’s finest level, supersampled: what filtering cannot mend.'},
  {title: 'Worth spp', text: 'equivalent', value: worth, best: 'is_best',
   meaning: 'Frames of direct, averaged, that have the same shading error.'},
  {title: 'Pixels', text: 'pixels', value: (r) => r.pixels.interior,
   meaning: 'Interior pixels, over which the shading error is taken; ! marks fewer than 100.'},
  {title: 'Frame ms', text: 'frame', value: (r) => r.time.frame_ms.median, best: 'is_fastest',
   meaning: 'Time of one frame: median (least–90th percentile of the repeats).'},
  {title: '× direct', text: 'ratio', value: (r) => r.time.ratio_to_direct.median,
   meaning: 'Frame time over that of direct beside it: median (least–most); about 1 where that spread covers it.'},
  {title: 'fps', text: 'fps', value: (r) => r.time.fps, meaning: 'Frames a second at the median frame time.'},
  {title: 'Fetches', text: 'fetches', value: (r) => r.time.fetches, meaning: 'Texture lookups a pixel, counted; – of methods whose frames take seconds.'},
  {title: 'Lobes', text: 'lobes', value: (r) => r.time.lobes, meaning: 'Lobes evaluated a pixel over all lights, counted likewise.'},
  {title: 'Build ms', text: 'build', value: (r) => r.time.frame_build_ms,
   only: () => records.some((r) => r.time.frame_build_ms !== null), meaning: 'What the method rebuilds when something moves, and whether the timed frames have it in them.'},
  {title: 'Bake s', text: 'precompute', value: (r) => r.precompute.seconds,
   meaning: 'What the method bakes once, in seconds.'},
  {title: 'Maps', text: 'bytes', value: (r) => r.precompute.bytes, meaning: 'Memory that the baked maps take.'},
  {title: 'B/texel', text: 'bytes_per_texel', value: (r) => r.precompute.bytes_per_texel,
   meaning: 'That memory, in bytes, over the texels of the finest level.'},
  {title: 'Left out', words: true, text: 'left_out', value: (r) => r.effects.left_out.join(),
   meaning: 'Effects that the scene calls for and the method cannot show.'},
];
const nameColumn = {title: 'Method', words: true, value: (r) => r.method};

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
const theme = () => (dark.matches ? 'dark' : 'light');
const seriesColor = (method) => palette[theme()][methods.indexOf(method) % palette.light.length];
const styleValue = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const shown = () => records.filter((record) => record.distance === state.distance);

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

/** A row of radio buttons that looks like one segmented control. */
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
  byId('lede').textContent = `${count(methods.length, 'method')} at ${count(distances.length, 'distance')}, held ` +
    `against a reference of ${count(data.results.reference.spp, 'sample')} a pixel.`;
  for (const {label, value} of data.provenance) {
    byId('provenance').append(element('dt', '', label), element('dd', label === 'Warning' ? 'warning' : '', value));
  }
  for (const {title, meaning} of columns) byId('meanings').append(element('dt', '', title), element('dd', '', meaning));
}

const ofDistance = () => data.distances.find((entry) => entry.distance === state.distance);

function showCautions() {
  const warnings = data.results.ranking_warnings;
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
    byId('table').querySelector('th[aria-sort] button').focus();
  });
  const cell = element('th', column.words ? 'words-column' : '', button);
  cell.scope = 'col';
  if (state.sort === column) cell.setAttribute('aria-sort', state.descending ? 'descending' : 'ascending');
  return cell;
}

function bodyCell(record, column) {
  const text = String(column.text === 'distance' ? record.distance : record.display[column.text]);
  const [figure, spread] = text.split(/ (?=\()/);
  const cell = element('td', column.words ? 'words-column' : '', figure);
  if (spread) cell.append(element('small', '', ' ' + spread));
  if (column.text === 'shading' && record.display.at_floor) cell.prepend(element('span', 'floor-mark', '≈ '));
  if (column.best && !state.all && record.display[column.best]) cell.classList.add('best');
  return cell;
}

function showTable() {
  const rows = sorted(state.all ? records : shown());
  const visible = columns.filter((column) => !column.only || column.only());
  byId('table').tHead.replaceChildren(element('tr', '', headCell(nameColumn), ...visible.map(headCell)));
  byId('table').tBodies[0].replaceChildren(...rows.map((record) => element(
    'tr', '', element('td', 'name words-column', key(record.method), ...breakable(record.method)),
    ...visible.map((column) => bodyCell(record, column)))));
  byId('floor-note').hidden = !rows.some((record) => record.display.at_floor);
}

// ---- pairs

const pairOf = (row, column) => data.results.pairs.find((pair) =>
  pair.distance === state.distance && pair.methods.includes(row) && pair.methods.includes(column));

function swatch(name, method, share) {
  return element('span', `verdict ${name}`, `${method} is closer: ${(100 * share).toFixed(1)}%`);
}

/** Where of the object which of two methods is closer. */
function showPair(pair) {
  const undecided = 1 - pair.closer[0] - pair.closer[1];
  byId('pair-view').hidden = false;
  byId('pair-picture').replaceChildren(picture(pair.picture, `Where ${pair.methods.join(' or ')} is closer`));
  byId('pair-picture').style.aspectRatio = shown()[0].size.join(' / ');
  byId('pair-caption').replaceChildren(swatch('first', pair.methods[0], pair.closer[0]),
    swatch('second', pair.methods[1], pair.closer[1]),
    element('span', 'verdict neither', `as close, or noise decides: ${(100 * undecided).toFixed(1)}%`));
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
  byId('pairs-section').hidden = !data.results.pairs.some((pair) => pair.distance === state.distance);
  const head = (method) => element('th', '', key(method), ...breakable(method));
  byId('pairs').tHead.replaceChildren(element('tr', '', element('th', 'words-column', 'closer than'), ...here.map(head)));
  byId('pairs').tBodies[0].replaceChildren(...here.map((row) => element(
    'tr', '', element('td', 'name words-column', key(row), ...breakable(row)),
    ...here.map((column) => pairCell(row, column)))));
}

// ---- plot

/** What the plot shows: shading errors, or where no pixel is interior errors over all of the object. */
const plotted = (figures) => figures?.shading ?? figures?.normalized_color;

const figure = (value) => (value >= 1000 ? String(Math.round(value)) : String(Number(value.toPrecision(3))));

/** Horizontal whiskers from each point's least time to its 90th percentile. */
const whiskers = {
  id: 'whiskers',
  beforeDatasetsDraw(plot) {
    const {ctx, scales: {x, y}} = plot;
    plot.data.datasets.forEach((set, i) => {
      if (!set.whiskers || !plot.isDatasetVisible(i)) return;
      const [left, right] = set.whiskers.map((value) => x.getPixelForValue(value));
      const at = y.getPixelForValue(set.data[0].y);
      ctx.save();
      ctx.strokeStyle = set.borderColor;
      ctx.lineWidth = 1.5;
      ctx.beginPath();
      ctx.moveTo(left, at);
      ctx.lineTo(right, at);
      for (const end of [left, right]) {
        ctx.moveTo(end, at - 4);
        ctx.lineTo(end, at + 4);
      }
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

function methodSeries(record) {
  const color = seriesColor(record.method);
  const {median, min, p90} = record.time.frame_ms;
  return {
    label: record.method,
    data: [{x: median, y: plotted(record.error)}],
    whiskers: [min, p90],
    borderColor: color,
    backgroundColor: color,
    pointStyle: marks[methods.indexOf(record.method) % marks.length],
    pointRadius: 7,
    pointHoverRadius: 9,
    pointBorderWidth: 2,
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
  return {
    type: 'logarithmic',
    min: range.min,
    max: range.max,
    title: {display: true, text: title, color: styleValue('--ink')},
    grid: {color: styleValue('--line'), borderColor: styleValue('--muted')},
    ticks: {
      color: styleValue('--muted'),
      maxRotation: 0,
      callback: (value) => (/^[125]e/.test(value.toExponential()) ? figure(value) : ''),
    },
  };
}

function tooltipText(item) {
  const set = item.dataset;
  const {x, y} = item.raw;
  const name = set.counts ? `mean of ${set.counts[item.dataIndex]} frames of direct` : set.label;
  return `${name}: error ${figure(y)} in ${figure(x)} ms`;
}

/** What stands on logarithmic axes at the chosen distance, and what cannot. */
function plotContent() {
  const positive = (time, error) => time > 0 && error > 0;
  const drawn = shown().filter((r) => positive(r.time.frame_ms.median, plotted(r.error)));
  const curve = data.results.supersampling
    .filter((point) => point.distance === state.distance && positive(point.ms, plotted(point)))
    .sort((a, b) => a.spp - b.spp);
  const floors = shown().map((r) => r.error?.shading_floor ?? r.error?.noise_floor).filter((floor) => floor > 0);
  const missing = shown().filter((r) => !drawn.includes(r));
  return {drawn, curve, floor: floors.length ? Math.max(...floors) : null, missing};
}

function showPlot() {
  Chart.getChart('plot')?.destroy();
  const {drawn, curve, floor, missing} = plotContent();
  byId('plot-note').textContent = missing.length
    ? `Not shown, because an error of 0 or none has no place on a logarithmic axis: ${
      missing.map((r) => r.method).join(', ')}.`
    : '';
  byId('plot').parentElement.hidden = drawn.length + curve.length === 0;
  if (drawn.length + curve.length === 0) return;
  const frameTimes = drawn.flatMap((r) => Object.values(r.time.frame_ms)).filter((ms) => ms > 0);
  const times = [...frameTimes, ...curve.map((p) => p.ms)];
  const errors = [...drawn.map((r) => plotted(r.error)), ...curve.map(plotted)];
  const x = padded(times, 1.25, 1.45);
  const y = padded(floor ? [...errors, floor] : errors, 1.4, 1.5);
  const datasets = drawn.map(methodSeries);
  if (curve.length) datasets.push(curveSeries(curve));
  if (floor) datasets.push(floorSeries(floor, x));
  new Chart('plot', {
    type: 'scatter',
    data: {datasets},
    plugins: [whiskers, countLabels],
    options: {
      animation: false,
      maintainAspectRatio: false,
      scales: {x: logAxis('Frame time (ms)', x), y: logAxis('Shading error', y)},
      plugins: {
        legend: {
          position: 'bottom',
          labels: {usePointStyle: true, boxWidth: 9, boxHeight: 9, padding: 16, color: styleValue('--ink')},
        },
        tooltip: {callbacks: {label: tooltipText}, displayColors: false},
      },
    },
  });
}

// ---- sparkle

/** A histogram as the line of its shares; a bin without pixels lies where half a pixel would, at the axis' foot. */
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
  new Chart('sparkle', {
    type: 'scatter',
    data: {datasets},
    options: {
      animation: false,
      maintainAspectRatio: false,
      scales: {
        x: {...logAxis('Luminance as shown', {min: 0, max: 1}), type: 'linear',
          ticks: {color: styleValue('--muted'), maxRotation: 0}},
        y: logAxis('Share of pixels', padded(shares, 1, 1.5)),
      },
      plugins: {
        legend: {
          position: 'bottom',
          labels: {usePointStyle: true, boxWidth: 18, padding: 16, color: styleValue('--ink')},
        },
        tooltip: {callbacks: {label: sparkleText}, displayColors: false},
      },
    },
  });
}

// ---- pictures

// Below 0 stops pictures are those that were written four stops darker, so that highlights come back.
const darkStops = 4;
const pngOf = (path) => path.replace(/\.exr$/i, state.stops < 0 ? '_dark.png' : '.png');
const urlOf = (path) => path.split('/').map(encodeURIComponent).join('/');

function picture(path, description) {
  const image = element('img');
  image.alt = description;
  image.draggable = false;
  image.addEventListener('error', () => image.replaceWith(element('span', 'missing', `${path} is not there`)));
  image.src = urlOf(path);
  return image;
}

/** The reference left of a line, the method right of it; the line follows a range input. */
function comparison(record) {
  const slider = element('input');
  Object.assign(slider, {type: 'range', min: 0, max: 100, step: 0.5, value: 50});
  slider.setAttribute('aria-label', `How much of the reference shows beside ${record.method}, in percent`);
  const node = element('div', 'picture compare',
    picture(pngOf(record.images.reference), `Reference at distance ${record.distance}`),
    element('div', 'over', picture(pngOf(record.images.color), `${record.method} at distance ${record.distance}`)),
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
    picture(state.scale === 'own' ? record.images.error : record.images.error_shared, `Error of ${record.method} at distance ${record.distance}`),
    element('span', 'tag left', 'error'));
  const pair = element('div', 'pair', comparison(record), error);
  for (const node of pair.children) node.style.aspectRatio = record.size.join(' / ');
  return element('article', 'card',
    element('header', '', element('h3', '', key(record.method), record.method),
      element('p', '', `shading error ${display.shading} · ${display.frame} ms`)),
    pair);
}

function showCards() {
  byId('cards').replaceChildren(...shown().map(card));
}

function setZoom(factor) {
  byId('cards').style.setProperty('--zoom', factor);
  byId('cards').classList.toggle('zoomed', factor > 1);
}

function showScale() {
  byId('ramp').style.background = `linear-gradient(to right, ${data.scale_colors.join(', ')})`;
  byId('scale-top').textContent = state.scale === 'own' ? ofDistance()?.scale_top : data.scale_top;
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

function showDistance() {
  showWords();
  showTable();
  showPairs();
  showPlot();
  showSparkle();
  showScale();
  showCards();
}

segments('distances', distances.map((value) => ({value, text: String(value)})), state.distance, (distance) => {
  state.distance = distance;
  showDistance();
});
segments('zooms', [1, 2, 4, 8].map((value) => ({value, text: `${value}×`})), 1, setZoom);
segments('layouts', [{value: 'list', text: 'large'}, {value: 'grid', text: 'side by side'}], 'list', (layout) =>
  byId('cards').classList.toggle('grid', layout === 'grid'));
segments('scales', [{value: 'own', text: 'this distance'}, {value: 'shared', text: 'all distances'}], 'own', (scale) => {
  state.scale = scale;
  showScale();
  showCards();
});
byId('exposure').addEventListener('input', (event) => setExposure(Number(event.target.value)));
byId('all-distances').addEventListener('change', (event) => {
  state.all = event.target.checked;
  showTable();
});
dark.addEventListener('change', () => {
  for (const node of document.querySelectorAll('.key')) {
    node.style.setProperty('--series', seriesColor(node.dataset.method));
  }
  showPlot();
  showSparkle();
});

showHead();
showCautions();
showDistance();
