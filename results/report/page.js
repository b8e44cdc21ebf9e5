// The page of every command: its data, what is shown and where the address keeps it, and the sections that it fills.
// Text reaches the page through textContent alone, so that names may contain any character.
'use strict';

const data = JSON.parse(document.getElementById('data').textContent);
const runs = data.runs ?? [];  // of a matrix its members, else the run; none: views and sections are in the data
const records = runs.flatMap((run) =>
  run.results.records.map((record, i) => ({...record, run, display: run.display[i]})));
const isFilm = Boolean(runs[0]?.path);  // of an animation
const axes = Object.keys(runs[0]?.coordinates ?? {});  // what the members of a matrix vary
const distances = isFilm ? [] : [...new Set(records.map((record) => record.distance))];
const methods = [...new Set(runs.length ? records.map((record) => record.method)
  : (data.views ?? []).flatMap(({images}) => images.slice(1).map(({name}) => name)))];
const state = {distance: distances[0], all: false, columns: false, place: {}, hidden: new Set(), sort: null, descending: false,
  cost: '', view: 0, a: null, b: null, mode: 'slider', map: 'image', zoom: null, center: null, split: 50, stops: 0, top: null};
const dark = window.matchMedia('(prefers-color-scheme: dark)');
const paper = window.matchMedia('print');

// Okabe and Ito's colours, distinct for every kind of colour vision; each with a mark of its own.
const {palette} = data;
const marks = ['circle', 'rectRot', 'triangle', 'rect', 'star', 'crossRot'];

/** The value at a JSON pointer into a record. */
const valueAt = (record, place) => place.split('/').slice(1).reduce((value, name) => value?.[name], record);

/** An element with a class and children: nodes or text. */
function element(tag, className, ...children) {
  const node = document.createElement(tag);
  if (className) node.className = className;
  node.append(...children);
  return node;
}

/** A control with properties; `act` is called with it when it is clicked or changed. */
function control(tag, properties, act, ...children) {
  const node = Object.assign(element(tag, '', ...children), properties);
  node.addEventListener(tag === 'button' ? 'click' : 'change', () => act(node));
  return node;
}

const button = (properties, act, ...children) => control('button', {type: 'button', ...properties}, act, ...children);
const option = (value, text = value) => Object.assign(element('option', '', text), {value});
const byId = (id) => document.getElementById(id);
const theme = () => (dark.matches && !paper.matches ? 'dark' : 'light');

// {method: the place of its colour}, as the program assigns them for all reports.
const placeOfColor = new Map(Object.entries(data.color_places));
const seriesColor = (method) => palette[theme()][placeOfColor.get(method) ?? 0];
const styleValue = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// The members that pass the filters, of which the first is shown in detail, and its records at one distance.
const matching = () => runs.filter((run) => axes.every((axis) => (state.place[axis] ?? run.coordinates[axis]) === run.coordinates[axis]));
const focus = () => matching()[0] ?? runs[0];
const isVisible = (record) => !state.hidden.has(record.method);
const shown = () => records.filter((r) => r.run === focus() && r.distance === state.distance && isVisible(r));
const filtered = () => {
  const members = new Set(matching());
  return records.filter((record) => members.has(record.run) && isVisible(record));
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
  for (const {value, text} of choices) {
    const input = control('input', {type: 'radio', name: id, value, checked: value === chosen}, () => onChange(value));
    byId(id).append(element('label', '', input, element('span', '', text)));
  }
}

function count(number, noun) {
  return `${number} ${noun}${number === 1 ? '' : 's'}`;
}

const figure = (value) => (value >= 1000 ? String(Math.round(value)) : String(Number(value.toPrecision(3))));

// ---- images

const urlOf = (path) => path.split('/').map(encodeURIComponent).join('/');
const pathOf = (run, path) => (run.folder ? `${run.folder}/${path}` : path);
const withEnd = (path, end) => path.replace(/\.exr$/i, end);

function picture(place, description) {
  const image = element('img');
  image.alt = description;
  image.draggable = false;
  image.addEventListener('error', () => image.replaceWith(element('span', 'missing', `${place} is missing`)));
  image.src = data.pictures?.[place] ?? urlOf(place);
  return image;
}

/** An image of the comparator from the files of a record; all: an animation has no maps. */
function imageOf(run, exr, name, {error, flip} = {}, caption = '') {
  const own = (path) => (path ? pathOf(run, path) : '');
  return {name, png: own(withEnd(exr, '.png')), values: own(withEnd(exr, '_values.js')), error: own(error), flip: own(flip), caption};
}

/** The images of one distance or frame, the reference first. */
function viewOfRecords(run, own) {
  if (own.length === 0) return null;
  const images = own.map((r) => imageOf(run, r.images.color, r.method, r.images,
    isFilm ? textOf(r.error?.normalized_color) : r.display.shading_error));
  return {images: [{...imageOf(run, own[0].images.reference, 'reference'), size: own[0].size}, ...images]};
}

/** What the comparator shows. */
function currentView() {
  if (isFilm) return viewOfRecords(runs[0], records.filter((r) => r.frame === state.view && isVisible(r)));
  if (runs.length) return viewOfRecords(focus(), shown().filter((r) => !r.failure));
  return data.views[state.view];
}

const exposureOfView = () => (runs.length ? focus().results.scene.exposure : data.exposure);
/** The top of the scale of maps: that of the distance, along a path the largest mean error. */
function usualTop() {
  if (isFilm) return Math.max(0.01, ...records.map((r) => r.error?.normalized_color ?? 0));
  if (!runs.length) return 0.1;
  const {error_scales: scales, error_scale: shared} = focus().results;
  return scales.find(({distance}) => distance === state.distance)?.error || shared || 0.1;
}

/** The image that is compared at first: the most accurate method. */
function defaultImage() {
  const best = (runs.length && !isFilm ? ofDistance()?.shown : data.shown)?.at(-1);
  return Math.max(1, closest.images.findIndex(({name}) => name === best));
}

// ---- the first screen

const ofDistance = () => focus().distances.find((entry) => entry.distance === state.distance);

function ledeText() {
  if (data.lede) return data.lede;
  if (isFilm) {
    const frames = new Set(records.map(({frame}) => frame)).size;
    return `${count(methods.length, 'method')}, ${frames} frames of ${records[0].size.join(' × ')} pixels: ${runs[0].path}.`;
  }
  return `${count(methods.length, 'method')} at ${count(distances.length, 'distance')}` +
    `${runs.length > 1 ? ` in ${count(runs.length, 'member')} of a matrix, ${count(records.length, 'record')}` : ''}, compared ` +
    `with a reference of ${count(Math.round(runs[0].results.reference.samples), 'sample')} per pixel.`;
}

function thumb(image, isReference, lines) {
  return button({className: 'thumb', title: 'Compare this image'}, () => {
    choose('b', image.name);
    byId('comparator').scrollIntoView({block: 'start'});
  }, element('div', 'picture', picture(image.png, image.name)),
  element('strong', '', ...(isReference ? [] : [key(image.name)]), ...breakable(image.name)),
  ...lines.map((text) => element('span', '', text)));
}

/** The images that the answer names, with error and cost. */
function showThumbs() {
  const images = currentView()?.images ?? [];
  const chosenNames = (runs.length && !isFilm ? ofDistance()?.shown : data.shown) ?? [];
  const named = chosenNames.length || (runs.length && !isFilm) ? chosenNames : images.slice(1, 4).map(({name}) => name);
  const wanted = [images[0], ...named.map((name) => images.find((image) => image.name === name))].filter(Boolean);
  const linesOf = (image) => {
    const record = runs.length && !isFilm && shown().find((r) => r.method === image.name);
    if (!record) return image.caption ? [image.caption] : [''];
    const {shading_error: error, change, ratio_to_direct_median: cost} = record.display;
    return [`error ${error}${change ? ` (${change})` : ''}`, `cost ${cost.split(' (')[0]}× direct`];
  };
  byId('thumbs').replaceChildren(...(wanted.length > 1 ? wanted.map((image, i) => thumb(image, i === 0, linesOf(image))) : []));
}

function showAnswer() {
  const sentences = (runs.length && !isFilm ? ofDistance()?.answer : data.answer) ?? [];
  byId('answer').replaceChildren(...sentences.map((text, i) => element('p', i && runs.length ? 'second' : 'first', text)));
  byId('focus').textContent = runs.length > 1 ? `Details of ${placeOf(focus())}:` : '';
  const warnings = runs.length ? focus().results.ranking_warnings : [];
  byId('caution').hidden = warnings.length === 0;
  byId('cautions').replaceChildren(...warnings.map((text) => element('li', '', text)));
  byId('caveat-note').hidden = warnings.length === 0;
  byId('caveat-note').firstElementChild.textContent = `${count(warnings.length, 'caveat')} on this answer`;
  showThumbs();
}

function showFindings() {
  byId('pixels').textContent = ofDistance()?.pixels ?? '';
  byId('words').replaceChildren(...(ofDistance()?.findings ?? []).map((text) => element('li', '', text)));
}

function showProvenance() {
  const lines = runs.length ? focus().provenance : data.provenance;
  byId('provenance-section').hidden = lines.length === 0;
  byId('provenance').replaceChildren(...lines.flatMap(({label, value}) =>
    [element('dt', '', label), element('dd', label === 'Warning' ? 'warning' : '', value)]));
}

// ---- sections that the data bring along

function tableOf({columns: heads, rows}, marked) {
  const kind = (i) => (heads[i].numeric ? '' : 'words-column');
  return element('div', 'scroll', element('table', 'few',
    element('thead', '', element('tr', '', ...heads.map(({title}, i) => element('th', kind(i), title)))),
    element('tbody', '', ...rows.map((row, j) => element('tr', j === marked ? 'chosen-row' : '',
      ...row.map((text, i) => element('td', kind(i), ...breakable(text))))))));
}

function commandBox(text) {
  const box = element('pre', 'scroll', text);
  return element('div', 'command', box, button({}, (node) => {
    getSelection().selectAllChildren(box);
    node.textContent = document.execCommand('copy') ? 'Copied' : 'Press Ctrl+C';  // pages from disk have no clipboard
  }, 'Copy'));
}

function showSections() {
  byId('sections').replaceChildren();
  for (const {heading, sentences, command, plot, table, marked, links} of data.sections) {
    const node = element('section', '', element('h2', '', heading));
    if (sentences.length) node.append(element('ul', 'words', ...sentences.map((text) => element('li', '', text))));
    if (command) node.append(commandBox(command));
    byId('sections').append(node);
    if (plot.points.some(({x, y}) => x > 0 && y > 0)) {
      const canvas = element('canvas');
      canvas.setAttribute('role', 'img');
      canvas.setAttribute('aria-label', 'Error against cost; the table shows the same values');
      node.append(element('div', 'plot', canvas));
      showCandidates(canvas, plot);
    }
    if (table.rows.length) node.append(tableOf(table, marked));
    if (links.length) node.append(element('ul', '', ...links.map((path) =>
      element('li', '', Object.assign(element('a', '', path), {href: urlOf(path)})))));
  }
}

// ---- what is shown, in the address: a link to it shows the same

// Words of the address that are the state's own, each with how it is read; null: not valid here.
const number = (low, high) => (text) => (text !== '' && Number(text) >= low && Number(text) <= high ? Number(text) : null);
const oneOf = (list) => (text) => (list.includes(text) ? text : null);
const plainWords = () => ({
  a: (text) => text, b: (text) => text, mode: oneOf(modes.map(([name]) => name)), map: oneOf(availableMaps()),
  stops: number(-8, 8), zoom: number(0.01, largestZoom), top: number(2 ** -7, 1), cost: oneOf(costKinds()),
  view: (text) => (/^\d+$/.test(text) && Number(text) < viewCount() ? Number(text) : null), split: number(0, 100),
});
const initial = {};  // those of a page whose address has no words

const viewCount = () => (isFilm ? new Set(records.map(({frame}) => frame)).size : data.views.length);

let laterAddress = 0;

function writeState() {
  const words = new URLSearchParams();
  if (state.distance !== distances[0]) words.set('distance', state.distance);
  if (state.all) words.set('all', '1');
  if (state.columns) words.set('columns', '1');
  for (const axis of axes) if (state.place[axis] !== undefined) words.set(axis, state.place[axis]);
  for (const method of state.hidden) words.append('without', method);
  if (state.sort) words.set('sort', state.sort.key);
  if (state.descending) words.set('down', '1');
  for (const name of Object.keys(initial)) if (state[name] !== initial[name]) words.set(name, state[name]);
  if (state.center) words.set('at', state.center.map((value) => Number(value.toFixed(2))).join(','));
  clearTimeout(laterAddress);  // browsers limit how often an address may change
  laterAddress = setTimeout(() => history.replaceState(null, '', `#${words}`), 100);
}

/** Ignores values that no record has, because a link may be of another run. */
function readState() {
  const words = new URLSearchParams(location.hash.slice(1));
  const distance = Number(words.get('distance'));
  state.distance = distances.includes(distance) ? distance : distances[0];
  state.all = words.has('all');
  state.columns = words.has('columns');
  state.place = {};
  for (const axis of axes) {
    if (runs.some((run) => run.coordinates[axis] === words.get(axis))) state.place[axis] = words.get(axis);
  }
  if (matching().length === 0) state.place = {};
  state.hidden = new Set(words.getAll('without').filter((method) => methods.includes(method)));
  state.sort = [nameColumn, changeColumn, ...axisColumns, ...columns].find((column) => column.key === words.get('sort')) ?? null;
  state.descending = words.has('down');
  for (const [name, read] of Object.entries(plainWords())) state[name] = (words.has(name) ? read(words.get(name)) : null) ?? initial[name];
  const at = (words.get('at') ?? '').split(',').map(Number);
  state.center = state.zoom && at.length === 2 && at.every(Number.isFinite) ? at : null;
}

/** The controls as the state is. */
function showControls() {
  for (const input of document.querySelectorAll('#distances input')) input.checked = Number(input.value) === (runs.length ? state.distance : state.view);
  for (const input of document.querySelectorAll('#methods input')) input.checked = !state.hidden.has(input.value);
  for (const select of document.querySelectorAll('#axes select')) select.value = state.place[select.name] ?? '';
  byId('all-distances').checked = state.all;
  byId('all-columns').checked = state.columns;
  byId('cost').value = state.cost;
  byId('hidden').textContent = state.hidden.size ? `${methods.length - state.hidden.size} of ${methods.length}` : 'all';
}

function change(what) {
  Object.assign(state, what);
  writeState();
  showControls();
  showAll();
}

// ---- the whole

/** What is folded is laid out when it is opened: a chart that is hidden has no size. */
const folded = {'words-section': () => showFindings(), 'pairs-section': () => showPairs(), trends: () => showTrends(),
  'sparkle-section': () => showSparkle()};

function showFolded() {
  byId('pairs-section').hidden = !focus().results.pairs.some((pair) => pair.distance === state.distance);
  byId('sparkle-section').hidden = !shown().some((record) => record.error);
  byId('trends').hidden = distances.length < 2;
  for (const [id, show] of Object.entries(folded)) if (byId(id).open && !byId(id).hidden) show();
}

function showAll() {
  showAnswer();
  showComparator();
  showProvenance();
  if (isFilm) return showPath();
  if (!runs.length) return undefined;
  showPlot();
  showTable();
  return showFolded();
}

function axisSelect(axis) {
  const values = [...new Set(runs.map((run) => run.coordinates[axis]))];
  return element('label', 'axis', `${axis} `, control('select', {name: axis},
    ({value}) => change({place: {...state.place, [axis]: value || undefined}}), option('', 'all'), ...values.map((value) => option(value))));
}

function methodBox(method) {
  return element('label', '', control('input', {type: 'checkbox', value: method}, ({checked}) => {
    const hidden = new Set(state.hidden);
    if (checked) hidden.delete(method); else hidden.add(method);
    change({hidden});
  }), key(method), method);
}

/** All that is drawn in a method's colour, or in the page's. */
function recolour() {
  for (const node of document.querySelectorAll('.key')) node.style.setProperty('--series', seriesColor(node.dataset.method));
  showAll();
  showSections();
}

/** The parts that follow the chosen distance and methods. */
function startRuns() {
  for (const id of ['views', 'details']) byId(id).hidden = false;
  byId('axes').append(...axes.map(axisSelect));
  segments('distances', distances.map((value) => ({value, text: String(value)})), state.distance,
    (distance) => change({distance}));
  for (const [id, name] of [['all-distances', 'all'], ['all-columns', 'columns']])
    byId(id).addEventListener('change', (event) => change({[name]: event.target.checked}));
  byId('cost').append(...costKinds().map((gpu) => option(gpu, gpu || 'frame time')));
  byId('cost-tool').hidden = costKinds().length < 2;
  byId('cost').addEventListener('change', (event) => change({cost: event.target.value}));
  for (const {title, meaning} of listed().filter(isUsed)) byId('meanings').append(element('dt', '', title), element('dd', '', meaning));
  for (const [id, show] of Object.entries(folded)) byId(id).addEventListener('toggle', () => byId(id).open && show());
}

/** Views that the data list, as distances: a choice among them. */
function startViews() {
  byId('distances').firstElementChild.textContent = 'View';
  segments('distances', data.views.map(({label}, view) => ({value: view, text: label})), state.view, (view) => change({view}));
}

function start() {
  byId('lede').textContent = ledeText();
  byId('outcome').textContent = document.querySelector('#experiment .outcome')?.textContent ?? '';
  byId('views-bar').hidden = !runs.length && data.views.length < 2;
  byId('filter').hidden = runs.length === 0;
  byId('distances').hidden = isFilm;
  byId('methods').append(...methods.map(methodBox));
  if (isFilm) startPath(); else if (runs.length) startRuns(); else if (data.views.length) startViews();
  startComparator();
  for (const name of Object.keys(plainWords())) initial[name] = state[name];
  readState();
  window.addEventListener('hashchange', () => {
    readState();
    showControls();
    showAll();
  });
  for (const query of [dark, paper]) query.addEventListener('change', recolour);
  showControls();
  showAll();
  showSections();
}

document.addEventListener('DOMContentLoaded', start);
