// The film's page: frames by a slider, and the figures along the path. Text reaches the page through textContent alone.
'use strict';

const film = JSON.parse(document.getElementById('data').textContent);
const methods = [...new Set(film.records.map((record) => record.method))];
const recordsOf = (method) => film.records.filter((record) => record.method === method);
const state = {frame: 0, method: methods[0], timer: null};
const dark = window.matchMedia('(prefers-color-scheme: dark)');

// Okabe and Ito's colours, as on the results page.
const palette = {
  light: ['#0072b2', '#d55e00', '#007a5a', '#b5488a', '#b07a00', '#2b8cc4', '#444444'],
  dark: ['#4aa8e8', '#ff8a3c', '#2fc79a', '#e79cc8', '#f0c040', '#8fd3ff', '#d0d0d0'],
};
const causes = [['shading', 'shading'], ['edges', 'edges'], ['filter', 'filter'], ['method', 'method’s own']];

const byId = (id) => document.getElementById(id);
const color = (index) => palette[dark.matches ? 'dark' : 'light'][index % palette.light.length];
const styleValue = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const urlOf = (path) => path.replace(/\.exr$/i, '.png').split('/').map(encodeURIComponent).join('/');
const text = (value) => (value === null || value === undefined ? 'n/a' : value.toFixed(5));

function element(tag, className, ...children) {
  const node = document.createElement(tag);
  if (className) node.className = className;
  node.append(...children);
  return node;
}

function mean(values) {
  const there = values.filter((value) => Number.isFinite(value));
  return there.length ? there.reduce((sum, value) => sum + value, 0) / there.length : null;
}

/** Where the path is in a frame, in words. */
function place(frame) {
  const {distance, degrees} = film.frames[frame];
  const where = film.path === 'zoom' ? `distance ${Number(distance.toPrecision(4))}`
    : `${Number(degrees.toPrecision(4))}°`;
  return `frame ${frame} of ${film.frames.length - 1}, ${where}`;
}

// ---- the film

function picture(name) {
  const image = element('img');
  image.alt = name;
  return image;
}

function makeFilm() {
  const reference = picture('reference');
  byId('film').append(element('figure', '', reference, element('figcaption', '', element('span', '', 'reference'))));
  for (const method of methods) {
    const over = picture('');
    over.className = 'over';
    byId('film').append(element('figure', '', element('div', 'stack', picture(method), over),
      element('figcaption', '', element('span', '', method), ' ', element('span'))));
  }
}

function showFrame() {
  const figures = byId('film').children;
  const reference = urlOf(film.frames[state.frame].image);
  figures[0].querySelector('img').src = reference;
  methods.forEach((method, i) => {
    const record = recordsOf(method)[state.frame];
    const [own, over] = figures[i + 1].querySelectorAll('img');
    own.src = urlOf(record.image);
    over.src = reference;
    figures[i + 1].querySelectorAll('span')[1].textContent =
      `error ${text(record.error?.normalized_color)} · flicker ${text(record.flicker?.mean)}`;
  });
  byId('frame').value = state.frame;
  byId('where').textContent = place(state.frame);
  for (const id of ['error', 'flicker', 'highlights', 'causes']) Chart.getChart(id)?.draw();
}

function go(frame) {
  state.frame = Math.max(0, Math.min(film.frames.length - 1, frame));
  showFrame();
}

function play() {
  if (state.timer) {
    clearInterval(state.timer);
    state.timer = null;
  } else {
    state.timer = setInterval(() => go((state.frame + 1) % film.frames.length), 100);
  }
  byId('play').textContent = state.timer ? 'Pause' : 'Play';
}

// ---- along the path

/** An upright line at the frame that is shown. */
const cursor = {
  id: 'cursor',
  afterDatasetsDraw(plot) {
    const {ctx, chartArea, scales: {x}} = plot;
    ctx.save();
    ctx.strokeStyle = styleValue('--muted');
    ctx.beginPath();
    ctx.moveTo(x.getPixelForValue(state.frame), chartArea.top);
    ctx.lineTo(x.getPixelForValue(state.frame), chartArea.bottom);
    ctx.stroke();
    ctx.restore();
  },
};

function line(label, values, tint, dash = []) {
  return {
    label,
    data: values.map((y, x) => ({x, y: Number.isFinite(y) ? y : NaN})),
    borderColor: tint,
    backgroundColor: tint,
    borderWidth: 2,
    borderDash: dash,
    pointRadius: 0,
    pointHitRadius: 8,
    showLine: true,
    pointStyle: 'line',
  };
}

function axis(title) {
  return {
    title: {display: true, text: title, color: styleValue('--ink')},
    grid: {color: styleValue('--line'), borderColor: styleValue('--muted')},
    ticks: {color: styleValue('--muted'), maxRotation: 0},
  };
}

function chart(id, title, datasets) {
  Chart.getChart(id)?.destroy();
  new Chart(id, {
    type: 'scatter',
    data: {datasets},
    plugins: [cursor],
    options: {
      animation: false,
      maintainAspectRatio: false,
      scales: {
        x: {...axis('Frame'), min: 0, max: film.frames.length - 1},
        y: {...axis(title), beginAtZero: true},
      },
      onClick: (event, hits, plot) => go(Math.round(plot.scales.x.getValueForPixel(event.x))),
      plugins: {
        legend: {position: 'bottom', labels: {usePointStyle: true, boxWidth: 18, color: styleValue('--ink')}},
        tooltip: {callbacks: {label: (item) => `${item.dataset.label}, ${place(item.raw.x)}: ${text(item.raw.y)}`}},
      },
    },
  });
}

function showCauses() {
  const own = recordsOf(state.method);
  chart('causes', 'Flicker', causes.map(([name, label], i) =>
    line(label, own.map((record) => record.flicker?.[name]?.mean), color(i))));
}

function showCharts() {
  chart('error', 'Error', methods.map((method, i) =>
    line(method, recordsOf(method).map((record) => record.error?.normalized_color), color(i))));
  chart('flicker', 'Flicker', methods.flatMap((method, i) => [
    line(method, recordsOf(method).map((record) => record.flicker?.mean), color(i)),
    line(`${method}, p99`, recordsOf(method).map((record) => record.flicker?.p99), color(i), [5, 4])]));
  chart('highlights', 'Highlight energy', [
    line('reference', film.frames.map((frame) => frame.highlight_energy), styleValue('--ink'), [6, 4]),
    ...methods.map((method, i) => line(method, recordsOf(method).map((record) => record.highlight_energy), color(i)))]);
  showCauses();
}

// ---- the table and the rest

function showTable() {
  const columns = [
    ['Error', (r) => r.error?.normalized_color], ['Floor', (r) => r.error?.noise_floor],
    ['Shading', (r) => r.error?.shading], ['Edges', (r) => r.error?.edges],
    ['Flicker', (r) => r.flicker?.mean], ['p99', (r) => r.flicker?.p99], ['Floor', (r) => r.flicker?.noise_floor],
    ...causes.flatMap(([name, label]) => [[`Flicker: ${label}`, (r) => r.flicker?.[name]?.mean],
      ['p99', (r) => r.flicker?.[name]?.p99]]),
    ['Highlights', (r) => r.highlight_energy]];
  byId('table').tHead.append(element('tr', '', element('th', 'words-column', 'Method'),
    ...columns.map(([title]) => element('th', '', title))));
  for (const method of methods) {
    byId('table').tBodies[0].append(element('tr', '', element('td', 'name words-column', method),
      ...columns.map(([, value]) => element('td', '', text(mean(recordsOf(method).map(value)))))));
  }
}

function showProvenance() {
  const {tool, backend, scene, reference} = film;
  const lines = [['Scene', scene.source], ['Frames', `${film.frames.length} of ${film.size.join(' x ')} pixels`],
    ['Footprint filter', film.footprint], ['Exposure', `${scene.exposure} (${scene.exposure_source})`],
    ['Reference', `${reference.spp} samples per pixel, ${reference.filter}, seed ${reference.seed}`],
    ['OpenGL', `${backend.renderer}, ${backend.version}`], ['Processor', backend.cpu],
    ['Program', `${tool.name} ${tool.version}`], ...scene.defaults.map((line) => ['Supplied', line])];
  for (const [label, value] of lines) byId('provenance').append(element('dt', '', label), element('dd', '', value));
  byId('caution').hidden = scene.warnings.length === 0;
  byId('cautions').append(...scene.warnings.map((warning) => element('li', '', warning)));
  if (!film.film) return;
  const link = element('a', '', film.film);
  link.href = film.film.split('/').map(encodeURIComponent).join('/');
  byId('video').hidden = false;
  byId('video').append('As one file (the reference, then the methods in this order): ', link);
}

function chooseMethod() {
  methods.forEach((method, i) => {
    const input = element('input');
    Object.assign(input, {type: 'radio', name: 'of-method', value: method, checked: i === 0});
    input.addEventListener('change', () => {
      state.method = method;
      showCauses();
    });
    byId('of-method').append(element('label', '', input, element('span', '', method)));
  });
}

byId('frame').max = film.frames.length - 1;
byId('frame').addEventListener('input', (event) => go(Number(event.target.value)));
byId('play').addEventListener('click', play);
for (const name of ['difference', 'pixels'])
  byId(name).addEventListener('change', (event) => byId('film').classList.toggle(name, event.target.checked));
dark.addEventListener('change', showCharts);

makeFilm();
chooseMethod();
showTable();
showProvenance();
showCharts();
showFrame();
