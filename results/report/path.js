// The path of an animation: its frames by a slider, and the figures along it. It uses the names of page.js.
'use strict';

const flickerCauses = [['shading', 'shading'], ['edges', 'edges'], ['filter', 'filter'], ['method', 'method’s own']];
const path = {method: methods[0], timer: null};
const recordsOf = (method) => records.filter((record) => record.method === method);
const textOf = (value) => (value === null || value === undefined ? 'n/a' : value.toFixed(5));

const mean = (values) => {
  const there = values.filter((value) => Number.isFinite(value));
  return there.length ? there.reduce((sum, value) => sum + value, 0) / there.length : null;
};

/** The position on the path in a frame, in words. */
function frameWords(frame) {
  const own = recordsOf(methods[0]), {distance, degrees, seconds} = own[frame];
  const short = (value) => Number(value.toPrecision(4));
  const where = {zoom: `distance ${short(distance)}`, animation: `${short(seconds)} s`}[runs[0].results.way.path] ?? `${short(degrees)}°`;
  return `frame ${frame} of ${own.length - 1}, ${where}`;
}

function showFrame() {
  byId('frame').value = state.view;
  byId('where').textContent = frameWords(state.view);
  for (const id of ['error', 'flicker', 'highlights', 'causes']) Chart.getChart(id)?.draw();
}

function goTo(frame) {
  changeComparator({view: Math.max(0, Math.min(viewCount() - 1, frame))});
  showFrame();
}

function play() {
  if (path.timer) {
    clearInterval(path.timer);
    path.timer = null;
  } else {
    closest.cursor = null;  // values of every frame would take longer than a frame
    path.timer = setInterval(() => goTo((state.view + 1) % viewCount()), 100);
  }
  byId('play').textContent = path.timer ? 'Pause' : 'Play';
}

// ---- charts

/** An upright line at the frame that is shown. */
const frameLine = {
  id: 'frameLine',
  afterDatasetsDraw({ctx, chartArea, scales: {x}}) {
    ctx.save();
    ctx.strokeStyle = styleValue('--muted');
    ctx.beginPath();
    ctx.moveTo(x.getPixelForValue(state.view), chartArea.top);
    ctx.lineTo(x.getPixelForValue(state.view), chartArea.bottom);
    ctx.stroke();
    ctx.restore();
  },
};

const pathSeries = (label, values, tint, dash = []) =>
  lineSeries(label, values.map((y, x) => ({x, y: Number.isFinite(y) ? y : NaN})), tint,
    {borderWidth: 2, borderDash: dash, pointHitRadius: 8});

function drawLines(id, title, datasets) {
  const axis = linearAxis('Frame');
  drawChart(id, datasets, {
    x: {...axis, min: 0, max: viewCount() - 1, ticks: {...axis.ticks, precision: 0}},
    y: {...linearAxis(title), beginAtZero: true},
  }, (item) => `${item.dataset.label}, ${frameWords(item.raw.x)}: ${textOf(item.raw.y)}`, {
    legendWidth: 18,
    displayColors: true,
    plugins: [frameLine],
    onClick: (event, hits, chart) => goTo(Math.round(chart.scales.x.getValueForPixel(event.x))),
  });
}

function showCauses() {
  const own = recordsOf(path.method);
  drawLines('causes', 'Flicker', flickerCauses.map(([name, label], i) =>
    pathSeries(label, own.map((record) => record.flicker?.[name]?.mean), palette[theme()][i % palette.light.length])));
}

function showCharts() {
  const seen = methods.filter((method) => !state.hidden.has(method));
  const lines = (value) => seen.map((method) => pathSeries(method, recordsOf(method).map(value), seriesColor(method)));
  drawLines('error', 'Error', lines((record) => record.error?.normalized_color));
  drawLines('flicker', 'Flicker', seen.flatMap((method) => [
    pathSeries(method, recordsOf(method).map((record) => record.flicker?.mean), seriesColor(method)),
    pathSeries(`${method}, p99`, recordsOf(method).map((record) => record.flicker?.p99), seriesColor(method), [5, 4])]));
  drawLines('highlights', 'Highlight energy', [
    pathSeries('reference', recordsOf(methods[0]).map((frame) => frame.reference_highlight_energy), styleValue('--ink'), [6, 4]),
    ...lines((record) => record.highlight_energy)]);
  showCauses();
}

// ---- the means

function meansTable(id, means) {
  byId(id).tHead.append(element('tr', '', element('th', 'words-column', 'Method'),
    ...means.map(([title]) => element('th', '', title))));
  for (const method of methods) {
    byId(id).tBodies[0].append(element('tr', '', element('td', 'name words-column', key(method), ...breakable(method)),
      ...means.map(([, value]) => element('td', '', textOf(mean(recordsOf(method).map(value)))))));
  }
}

function showMeans() {
  meansTable('means', [['Error', (r) => r.error?.normalized_color], ['Floor', (r) => r.error?.noise_floor],
    ['Flicker', (r) => r.flicker?.mean], ['p99', (r) => r.flicker?.p99], ['Floor', (r) => r.flicker?.noise_floor]]);
  meansTable('means-causes', [['Shading', (r) => r.error?.shading], ['Edges', (r) => r.error?.edges],
    ...flickerCauses.flatMap(([name, label]) => [[`Flicker: ${label}`, (r) => r.flicker?.[name]?.mean],
      ['p99', (r) => r.flicker?.[name]?.p99]]),
    ['Highlights', (r) => r.highlight_energy]]);
}

function showVideo() {
  const {film} = runs[0].results;
  if (!film) return;
  byId('video').hidden = false;
  byId('video').append('As one file (the reference, then the methods in this order): ',
    Object.assign(element('a', '', film), {href: urlOf(film)}));
}

/** The least flicker and the least error over all frames. */
function pathAnswer() {
  const least = (value) => methods.map((method) => [mean(recordsOf(method).map(value)), method])
    .filter(([figureOf]) => figureOf !== null).sort(([a], [b]) => a - b)[0];
  const [error, flicker] = [least((r) => r.error?.normalized_color), least((r) => r.flicker?.mean)];
  const words = [];
  if (error) words.push(`${error[1]} has the least error over all frames: ${figure(error[0])}.`);
  if (flicker) words.push(`${flicker[1]} flickers least: ${figure(flicker[0])}.`);
  return words;
}

function showPath() {
  showCharts();
  showFrame();
}

/** Opens at the second frame, the first with flicker, with all images side by side. */
function startPath() {
  byId('path').hidden = false;
  byId('frames').hidden = false;
  data.answer = pathAnswer();
  Object.assign(state, {mode: 'all', view: Math.min(1, viewCount() - 1)});
  byId('frame').max = viewCount() - 1;
  byId('frame').addEventListener('input', (event) => goTo(Number(event.target.value)));
  byId('play').addEventListener('click', play);
  segments('of-method', methods.map((method) => ({value: method, text: method})), methods[0], (method) => {
    path.method = method;
    showCauses();
  });
  showMeans();
  showVideo();
}
