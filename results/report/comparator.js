// The comparator: any image of a view against any other. Images are drawn on canvases under one shared zoom and pan.
// Linear values come from scripts beside the images, because a page from disk cannot read pixels of images beside it;
// exposure, maps and the values under the cursor need them. Until they are there, the PNG is drawn.
'use strict';

const modes = [['flip', 'flip'], ['slider', 'slider'], ['side', 'side by side'], ['all', 'all']];
const maps = [['image', 'none'], ['error', 'error'], ['flip', 'FLIP'], ['signed', 'luminance ±'], ['difference', 'A against B'],
  ['winner', 'closest method']];
const tie = 1 / 255;  // errors closer than this are no victory
const largestZoom = 64;  // CSS pixels per image pixel
const closest = {view: null, images: [], panes: [], cursor: null, flipped: false, pointers: new Map(), drag: null,
  queued: 0, shares: null};

// ---- values

const halves = (() => {
  const table = new Float32Array(65536);
  for (let i = 0; i < 65536; ++i) {
    const exponent = (i >> 10) & 31, mantissa = i & 1023;
    const size = exponent === 0 ? mantissa * 2 ** -24
      : exponent === 31 ? (mantissa ? NaN : Infinity) : (1 + mantissa / 1024) * 2 ** (exponent - 15);
    table[i] = i & 0x8000 ? -size : size;
  }
  return table;
})();

/** The values in a PNG of renderer/image/pixel_script.hpp. */
async function decoded(url) {
  const image = new Image();
  image.src = url;
  await image.decode();
  const [width, height] = [image.naturalWidth, image.naturalHeight / 3];
  const canvas = Object.assign(document.createElement('canvas'), {width, height: 3 * height});
  const context = canvas.getContext('2d', {willReadFrequently: true});
  context.drawImage(image, 0, 0);
  const bytes = context.getImageData(0, 0, width, 3 * height).data;
  const part = 4 * width * height;
  const rgb = new Float32Array(3 * width * height), coverage = new Uint8Array(width * height);
  for (let i = 0; i < width * height; ++i) {
    for (let c = 0; c < 3; ++c) rgb[3 * i + c] = halves[(bytes[4 * i + c] << 8) | bytes[part + 4 * i + c]];
    coverage[i] = bytes[2 * part + 4 * i];
  }
  return {width, height, rgb, coverage};
}

/** The data URL that a script beside the page sets. */
function loadedScript(place) {
  return new Promise((done, failed) => {
    const script = document.createElement('script');
    script.onload = () => {
      script.remove();
      if (script.pixels) done(script.pixels); else failed(new Error(place));
    };
    script.onerror = () => {
      script.remove();
      failed(new Error(place));
    };
    script.src = urlOf(place);
    document.head.append(script);
  });
}

const keptPixels = 2 ** 25;  // of values, and of canvases: some hundred megabytes
const keptFiles = 200;

/** Forgets the oldest entries, but none that one view needs at once. */
function trim(map, pixels) {
  const most = Math.max(closest.images.length + 2, Math.floor(keptPixels / pixels));
  while (map.size > most) map.delete(map.keys().next().value);
}

const loads = new Map();  // place: {values}, null until they are there, or {missing}

/** The image's values once they are there, else null; `draw` is called then. A file that is missing stays null. */
function valuesOf(image) {
  if (!image.values) return null;
  let load = loads.get(image.values);
  if (!load) {
    load = {values: null};
    Promise.resolve(data.pictures ? data.pictures[image.values] : loadedScript(image.values)).then(decoded)
      .then((values) => {
        load.values = values;
        trim(loads, values.width * values.height);
      }, () => { load.missing = true; }).then(draw);
    loads.set(image.values, load);
  }
  return load.values;
}

const pngs = new Map();

function pngOf(place) {
  if (!pngs.has(place)) {
    const image = new Image();
    image.onload = draw;
    image.onerror = () => { image.missing = true; draw(); };
    image.src = data.pictures?.[place] ?? urlOf(place);
    pngs.set(place, image);
    if (pngs.size > keptFiles) pngs.delete(pngs.keys().next().value);
  }
  return pngs.get(place);
}

// ---- figures of a pixel

const encoded = (value) => (value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055);
const byteOf = (() => {  // of a displayed linear value, 0 to 1
  const table = Uint8Array.from({length: 65536}, (_, i) => Math.round(255 * encoded(i / 65535)));
  return (value) => table[value > 0 ? Math.min(65535, Math.round(value * 65535)) : 0];
})();
const clamp = (value) => (value > 0 ? Math.min(value, 1) : 0);
const gain = () => data.in_false_color ? 1 : exposureOfView() * 2 ** state.stops;

/** The normalised colour error of docs/reference/metrics.md between two images at a pixel, at the run's own exposure. */
function errorAt(a, b, i, exposure) {
  let sum = 0;
  for (let c = 3 * i; c < 3 * i + 3; ++c) sum += (clamp(exposure * a.rgb[c]) - clamp(exposure * b.rgb[c])) ** 2;
  return Math.sqrt(sum / 3);
}

const luminanceAt = (values, i, exposure) => 0.2126 * clamp(exposure * values.rgb[3 * i]) +
  0.7152 * clamp(exposure * values.rgb[3 * i + 1]) + 0.0722 * clamp(exposure * values.rgb[3 * i + 2]);

const counts = (reference, i) => reference.coverage[i] === 255;

/** Which image but the first is closest at a pixel: its index, 0 for a tie. */
function winnerAt(all, i, exposure) {
  let best = Infinity, second = Infinity, index = 0;
  for (let k = 1; k < all.length; ++k) {
    const error = errorAt(all[k], all[0], i, exposure);
    if (error < best) [second, best, index] = [best, error, k];
    else if (error < second) second = error;
  }
  return second - best > tie ? index : 0;
}

const bytesOfColor = (text) => [1, 3, 5].map((at) => parseInt(text.slice(at, at + 2), 16));
const tieColor = [190, 190, 190], outside = [0, 0, 0];

// Blue darker than the reference, orange brighter; both are distinct for every kind of colour vision.
const signedColor = (share) => {
  const [r, g, b] = share < 0 ? [0, 114, 178] : [230, 130, 0];
  const size = Math.min(1, Math.abs(share));
  return [r, g, b].map((channel) => Math.round(245 + (channel - 245) * size));
};

const scaled = (error) => data.scale_colors[Math.round(255 * Math.min(1, error / scaleTop()))];

/** The colour of each pixel of an image under the chosen map; null: values are not there (yet). */
function colorsOf(image) {
  const own = valuesOf(image), exposure = exposureOfView();
  if (!own) return null;
  if (state.map === 'image') {
    const factor = gain();
    return (i) => [byteOf(factor * own.rgb[3 * i]), byteOf(factor * own.rgb[3 * i + 1]), byteOf(factor * own.rgb[3 * i + 2])];
  }
  const reference = valuesOf(closest.images[0]);
  if (!reference) return null;
  const over = (color) => (i) => (counts(reference, i) ? color(i) : outside);
  if (state.map === 'error') return over((i) => scaled(errorAt(own, reference, i, exposure)));
  if (state.map === 'signed')
    return over((i) => signedColor((luminanceAt(own, i, exposure) - luminanceAt(reference, i, exposure)) / scaleTop()));
  if (state.map === 'difference') {
    const [a, b] = [valuesOf(chosen('a')), valuesOf(chosen('b'))];
    return a && b && ((i) => scaled(errorAt(a, b, i, exposure)));
  }
  const all = closest.images.map(valuesOf);
  if (all.some((values) => !values)) return null;
  const colors = [tieColor, ...closest.images.slice(1).map(({name}) => bytesOfColor(seriesColor(name)))];
  const wins = all.map(() => 0);
  closest.shares = wins;
  return over((i) => {
    const winner = winnerAt(all, i, exposure);
    ++wins[winner];
    return colors[winner];
  });
}

// ---- what is drawn: one canvas per image and map, kept until one of its settings changes

const drawn = new Map();

function sourceOf(image) {
  const flip = state.map === 'flip', shown = state.map === 'image';
  const fixed = (shown && (data.in_false_color || (state.stops === 0 && !loads.get(image.values)?.values))) || flip ||
    (data.in_false_color && state.map === 'error');
  if (fixed) {
    const place = flip ? image.flip : shown ? image.png : image.error;
    return place ? pngOf(place) : null;
  }
  const id = [image.png, state.map, state.stops, scaleTop(), theme(),
    state.map === 'difference' ? `${chosen('a').name}\n${chosen('b').name}` : '',
    state.map === 'winner' ? closest.images.map(({name}) => name).join('\n') : ''].join('\n');
  if (!drawn.has(id)) {
    const colors = colorsOf(image);
    if (!colors) return shown ? pngOf(image.png) : state.map === 'error' && image.error && isMissing() ? pngOf(image.error) : null;
    const {width, height} = loads.get(image.values).values;
    const canvas = Object.assign(document.createElement('canvas'), {width, height});
    const pixels = new ImageData(width, height);
    for (let i = 0; i < width * height; ++i) {
      const color = colors(i);
      for (let c = 0; c < 3; ++c) pixels.data[4 * i + c] = color[c];
      pixels.data[4 * i + 3] = 255;
    }
    canvas.getContext('2d').putImageData(pixels, 0, 0);
    drawn.set(id, {canvas, shares: closest.shares});
    trim(drawn, width * height);
  }
  const found = drawn.get(id);
  if (state.map === 'winner') closest.shares = found.shares;
  return found.canvas;
}

/** Whether any of the shown values has no file. */
const isMissing = () => closest.images.some((image) => !image.values || loads.get(image.values)?.missing);

// ---- views

const chosen = (side) => closest.images.find(({name}) => name === state[side]) ??
  closest.images[side === 'a' ? 0 : Math.min(closest.images.length - 1, defaultImage())];
const shownImage = () => chosen(closest.flipped ? 'a' : 'b');

function scaleTop() {
  return state.top ?? usualTop();
}

// ---- zoom and pan: `zoom` in CSS pixels per image pixel about a point of the image; none: fit

function sizeOfImages() {
  for (const image of closest.images) {
    const values = loads.get(image.values)?.values;
    if (values) return [values.width, values.height];
    const png = pngOf(image.png);
    if (png.naturalWidth) return [png.naturalWidth, png.naturalHeight];
  }
  return closest.images[0]?.size ?? [256, 256];
}

/** What fits into a pane: the part of the reference that covers anything, with a margin, once its values are there. A
    film keeps its frame. */
function boundsOfView() {
  const values = loads.get(closest.images[0].values)?.values, size = sizeOfImages();
  if (!values || isFilm) return [[0, 0], size];
  if (!values.bounds) {
    const low = [Infinity, Infinity], high = [0, 0];
    for (let i = 0; i < values.coverage.length; ++i) {
      if (values.coverage[i] === 0) continue;
      [i % values.width, Math.floor(i / values.width)].forEach((at, k) => {
        low[k] = Math.min(low[k], at);
        high[k] = Math.max(high[k], at + 1);
      });
    }
    const margin = size.map((side) => Math.ceil(side / 50));
    values.bounds = high[0] ? [low.map((at, k) => Math.max(0, at - margin[k])), high.map((at, k) => Math.min(size[k], at + margin[k]))]
      : [[0, 0], size];
  }
  return values.bounds;
}

function fitZoom() {
  const [low, high] = boundsOfView(), [width, height] = high.map((at, k) => at - low[k]);
  const pane = closest.panes[0].canvas;
  const fit = Math.min(pane.clientWidth / width, pane.clientHeight / height);
  return fit >= 1 ? Math.floor(fit) : fit;
}

const zoomNow = () => state.zoom ?? fitZoom();
const centerNow = () => {
  const [low, high] = boundsOfView();
  return state.zoom && state.center ? state.center : low.map((at, k) => (at + high[k]) / 2);
};

/** The image pixel (fractional) at a place of a pane, in CSS pixels from its corner. */
function pixelAt(pane, x, y) {
  const zoom = zoomNow(), [cx, cy] = centerNow();
  return [(x - Math.round(pane.clientWidth / 2)) / zoom + cx, (y - Math.round(pane.clientHeight / 2)) / zoom + cy];
}

/** Zooms so that the pixel at a place of the pane stays there. */
function zoomAt(zoom, pane = closest.panes[0].canvas, x = pane.clientWidth / 2, y = pane.clientHeight / 2) {
  const before = pixelAt(pane, x, y);
  const fit = fitZoom();
  const wanted = Math.min(largestZoom, zoom);
  if (wanted <= fit) return moveTo({zoom: null, center: null});
  const center = [before[0] - (x - pane.clientWidth / 2) / wanted, before[1] - (y - pane.clientHeight / 2) / wanted];
  return moveTo({zoom: wanted, center});
}

function moveTo(what) {
  if (what.center) {
    const size = sizeOfImages();
    what.center = what.center.map((value, k) => Math.max(0, Math.min(size[k], value)));
  }
  changeComparator(what);
}

// ---- drawing

/** Draws everything with the next frame of the screen. */
function draw() {
  if (closest.queued || !closest.view) return;
  closest.queued = requestAnimationFrame(() => {
    closest.queued = 0;
    drawPanes();
    showReadout();
    showLegend();
  });
}

function drawImageIn(context, pane, image, left, right) {
  const {clientWidth: width, clientHeight: height} = pane;
  const zoom = zoomNow(), [cx, cy] = centerNow(), [w, h] = sizeOfImages();
  const source = sourceOf(image);
  context.save();
  context.beginPath();
  context.rect(left, 0, right - left, height);
  context.clip();
  const [x, y] = [Math.round(width / 2) - cx * zoom, Math.round(height / 2) - cy * zoom];
  if (source && (source.naturalWidth || source instanceof HTMLCanvasElement)) {
    context.imageSmoothingEnabled = zoom < 1;
    context.drawImage(source, Math.round(x), Math.round(y), Math.round(w * zoom), Math.round(h * zoom));
  } else {
    const place = state.map === 'flip' ? image.flip : image.png;
    context.fillStyle = '#cfd6dd';
    context.font = '14px system-ui, sans-serif';
    context.textAlign = 'center';
    const text = source?.missing ? `${place} is missing`
      : state.map === 'flip' && !image.flip ? 'no map: this is the reference' : isMissing() ? 'no values of this image' : 'loading';
    context.fillText(text, (left + right) / 2, height / 2, right - left);
  }
  context.restore();
}

function tag(context, text, x, align, height) {
  context.font = '13px system-ui, sans-serif';
  const width = context.measureText(text).width + 14;
  const left = align === 'left' ? x + 8 : x - width - 8;
  context.fillStyle = 'rgb(0 0 0 / 0.66)';
  context.fillRect(left, height - 30, width, 22);
  context.fillStyle = '#fff';
  context.textAlign = 'left';
  context.fillText(text, left + 7, height - 14);
}

/** What a pane shows: an image, or what all images have in common. */
function paneWords(image) {
  if (state.map === 'winner') return 'closest method';
  return state.map === 'difference' ? `${chosen('a').name} against ${chosen('b').name}` : image.name;
}

function drawCursor(context, pane) {
  if (!closest.cursor) return;
  const zoom = zoomNow(), [cx, cy] = centerNow();
  const x = Math.round(pane.clientWidth / 2) + (closest.cursor[0] - cx) * zoom;
  const y = Math.round(pane.clientHeight / 2) + (closest.cursor[1] - cy) * zoom;
  const side = Math.max(zoom, 5);
  for (const [color, grow] of [['#000', 1.5], ['#fff', 0.5]]) {
    context.strokeStyle = color;
    context.strokeRect(x - grow + (zoom - side) / 2, y - grow + (zoom - side) / 2, side + 2 * grow, side + 2 * grow);
  }
}

function drawPane({canvas, images}) {
  const ratio = window.devicePixelRatio || 1;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    Object.assign(canvas, {width: Math.round(width * ratio), height: Math.round(height * ratio)});
  }
  const context = canvas.getContext('2d');
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.fillStyle = '#000';
  context.fillRect(0, 0, width, height);
  const edge = images.length > 1 ? width * state.split / 100 : width;
  drawImageIn(context, canvas, images[0], 0, edge);
  if (images.length > 1) drawImageIn(context, canvas, images[1], edge, width);
  drawCursor(context, canvas);
  tag(context, paneWords(images[0]), 0, 'left', height);
  if (images.length === 1) return;
  tag(context, paneWords(images[1]), width, 'right', height);
  context.fillStyle = '#fff';
  context.fillRect(edge - 1, 0, 2, height);
  context.beginPath();
  context.arc(edge, height - 19, 11, 0, 2 * Math.PI);
  context.fill();
  context.fillStyle = '#222';
  context.textAlign = 'center';
  context.font = '15px system-ui, sans-serif';
  context.fillText('⇔', edge, height - 14);
}

function drawPanes() {
  for (const pane of closest.panes) drawPane(pane);
  const {dataset, style} = byId('stage');
  dataset.zoomed = state.zoom ? '1' : '';
  style.touchAction = state.zoom ? 'none' : 'pan-y';
}

/** The panes of the mode: their canvases stay where they can, so that nothing flickers. */
function layPanes() {
  const wanted = {flip: () => [[shownImage()]], slider: () => [[chosen('a'), chosen('b')]],
    side: () => [[chosen('a')], [chosen('b')]], all: () => closest.images.map((image) => [image])}[state.mode]();
  const root = byId('panes');
  while (root.children.length > wanted.length) root.lastChild.remove();
  while (root.children.length < wanted.length) root.append(element('canvas'));
  root.dataset.mode = state.mode;
  const [width, height] = sizeOfImages();
  root.style.setProperty('--aspect', `${width} / ${height}`);
  closest.panes = wanted.map((images, i) => ({canvas: root.children[i], images}));
  closest.panes.forEach(({canvas, images}) => {
    canvas.setAttribute('role', 'img');
    canvas.setAttribute('aria-label', images.map(({name}) => name).join(' and '));
  });
  byId('split').hidden = state.mode !== 'slider';
  byId('split').value = state.split;
}

// ---- the column beside the images

function showPicker() {
  const radio = (side, image) => {
    const input = control('input', {type: 'radio', name: `side-${side}`, checked: chosen(side) === image},
      () => choose(side, image.name));
    input.setAttribute('aria-label', `${image.name} is ${side.toUpperCase()}`);
    return element('td', '', input);
  };
  byId('picker').tBodies[0].replaceChildren(...closest.images.map((image, i) => {
    const label = button({title: i && i < 10 ? `key ${i}` : 'key R'}, () => choose('b', image.name),
      ...(i ? [key(image.name)] : []), ...breakable(image.name));
    return element('tr', '', radio('a', image), radio('b', image), element('td', 'words-column', label),
      element('td', 'number', image.caption ?? ''));
  }));
}

function choose(side, name) {
  closest.flipped = side === 'a' && state.mode === 'flip';
  changeComparator({[side]: name});
}

function triple(values, text) {
  return values.map(text).join('  ');
}

const shortFigure = (value) => (Number.isFinite(value) ? (value === 0 ? '0' : value.toPrecision(4)) : 'not finite');

/** The values of the images that are shown, at the cursor. */
function showReadout() {
  const node = byId('readout');
  if (!closest.cursor) {
    node.replaceChildren(element('p', 'note', 'Point at a pixel, tap it, or use the arrow keys: its values appear here.'));
    return;
  }
  const [x, y] = closest.cursor;
  const images = [...new Set([closest.images[0], ...(state.mode === 'all' ? closest.images : [chosen('a'), chosen('b')])])];
  const reference = valuesOf(closest.images[0]);
  const rows = images.map((image) => {
    const values = valuesOf(image);
    if (!values) return element('tr', '', element('th', '', image.name), element('td', '', isMissing() ? 'no values' : 'loading'));
    const i = y * values.width + x;
    const linear = [0, 1, 2].map((c) => values.rgb[3 * i + c]);
    const figures = data.in_false_color ? [element('td', 'linear', shortFigure(linear[0]))]
      : [element('td', 'linear', triple(linear, shortFigure)),
        element('td', 'displayed', triple(linear, (value) => String(byteOf(gain() * value)))),
        element('td', 'pixel-error', reference && image !== closest.images[0] && counts(reference, i)
          ? figure(errorAt(values, reference, i, exposureOfView())) : '')];
    const row = element('tr', '', element('th', '', image.name), ...figures);
    row.dataset.name = image.name;
    return row;
  });
  const heads = data.in_false_color ? ['density'] : ['linear RGB', 'displayed', 'error'];
  node.replaceChildren(element('table', '', element('caption', '', `pixel ${x}, ${y}`),
    element('thead', '', element('tr', '', element('th'), ...heads.map((text) => element('th', '', text)))),
    element('tbody', '', ...rows)));
}

function swatchOf(color, text) {
  const box = element('span', 'swatch');
  box.style.background = `rgb(${color.join(',')})`;
  return element('span', 'entry', box, text);
}

function showLegend() {
  const ramp = (colors, low, high, unit) => {
    const bar = element('span', 'ramp');
    bar.style.background = `linear-gradient(to right, ${colors.map((color) => `rgb(${color.join(',')})`).join(', ')})`;
    return [element('span', 'number', low), bar, element('span', 'number', high), element('span', 'unit', unit)];
  };
  const steps = data.scale_colors.filter((_, i) => i % 15 === 0);
  const top = figure(scaleTop());
  const content = {
    image: () => (data.in_false_color ? ramp(steps, '0', '', 'density') : []),
    error: () => ramp(steps, '0', data.in_false_color ? '' : top, data.in_false_color ? 'difference' : 'normalised colour error'),
    flip: () => ramp(steps, '0', '1', 'LDR-FLIP against the reference, at the run’s exposure'),
    difference: () => ramp(steps, '0', top, 'normalised colour difference of A and B'),
    signed: () => ramp([-1, -0.5, 0, 0.5, 1].map(signedColor), `−${top}`, top, 'luminance above the reference’s'),
    winner: () => {
      const all = closest.shares?.reduce((sum, count) => sum + count, 0);
      const share = (k) => (all ? ` ${(100 * closest.shares[k] / all).toFixed(1)}%` : '');
      return [...closest.images.slice(1).map(({name}, i) => swatchOf(bytesOfColor(seriesColor(name)), `${name}${share(i + 1)}`)),
        swatchOf(tieColor, `tie within 1/255${share(0)}`)];
    },
  }[state.map]();
  byId('legend').replaceChildren(...content);
  byId('top-tool').hidden = data.in_false_color || !['error', 'difference', 'signed'].includes(state.map);
  byId('top').value = Math.log2(scaleTop());
  byId('scale-top').textContent = top;
}

/** Everything of the comparator, for the current view. */
function showComparator() {
  closest.view = currentView();
  closest.images = closest.view?.images ?? [];
  byId('comparator').hidden = closest.images.length === 0;
  if (closest.images.length === 0) return;
  for (const input of document.querySelectorAll('#modes input')) input.checked = input.value === state.mode;
  for (const input of document.querySelectorAll('#zooms input')) input.checked = (input.value === 'fit' ? null : Number(input.value)) === state.zoom;
  byId('map').value = state.map;
  byId('exposure').value = state.stops;
  byId('stops').textContent = state.stops > 0 ? `+${state.stops}` : String(state.stops);
  layPanes();
  showPicker();
  draw();
}

function changeComparator(what) {
  Object.assign(state, what);
  writeState();
  showComparator();
}

// ---- pointers and keys

/** The pane under a pointer, which the stage may have captured. */
function paneOf(event) {
  const under = document.elementFromPoint(event.clientX, event.clientY);
  return closest.panes.find(({canvas}) => canvas === under)?.canvas ?? closest.panes[0].canvas;
}

function placeIn(pane, event) {
  const box = pane.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
}

function pointAt(event) {
  const pane = paneOf(event), [x, y] = pixelAt(pane, ...placeIn(pane, event)).map(Math.floor);
  const [width, height] = sizeOfImages();
  closest.cursor = x >= 0 && y >= 0 && x < width && y < height ? [x, y] : null;
  draw();
}

function setSplit(percent) {
  changeComparator({split: Math.max(0, Math.min(100, percent))});
}

function startDrag(event) {
  const pane = paneOf(event), [x, y] = placeIn(pane, event);
  closest.pointers.set(event.pointerId, [event.clientX, event.clientY]);
  byId('stage').setPointerCapture?.(event.pointerId);
  if (closest.pointers.size === 2) {
    const [p, q] = [...closest.pointers.values()];
    closest.drag = {pinch: Math.hypot(p[0] - q[0], p[1] - q[1]), zoom: zoomNow(), pane};
    return;
  }
  const near = Math.abs(x - pane.clientWidth * state.split / 100) < 24;
  const isSplit = state.mode === 'slider' && (near || !state.zoom);
  closest.drag = {pane, isSplit, offset: near ? x - pane.clientWidth * state.split / 100 : 0,
    from: [event.clientX, event.clientY], center: centerNow(), box: pane.getBoundingClientRect(), y};
}

function drag(event) {
  const {drag} = closest;
  if (!drag || !closest.pointers.has(event.pointerId)) return pointAt(event);
  closest.pointers.set(event.pointerId, [event.clientX, event.clientY]);
  if (drag.pinch) {
    if (closest.pointers.size < 2) return undefined;
    const [p, q] = [...closest.pointers.values()], box = drag.pane.getBoundingClientRect();
    return zoomAt(drag.zoom * Math.hypot(p[0] - q[0], p[1] - q[1]) / drag.pinch, drag.pane,
      (p[0] + q[0]) / 2 - box.left, (p[1] + q[1]) / 2 - box.top);
  }
  const moved = [event.clientX - drag.from[0], event.clientY - drag.from[1]];
  if (Math.hypot(...moved) < 3) return undefined;
  if (drag.isSplit) return setSplit(100 * (event.clientX - drag.box.left - drag.offset) / drag.box.width);
  if (!state.zoom) return undefined;
  return moveTo({center: drag.center.map((value, k) => value - moved[k] / state.zoom)});
}

function endDrag(event) {
  closest.pointers.delete(event.pointerId);
  if (closest.pointers.size === 0) closest.drag = null;
}

function moveCursor(dx, dy) {
  const size = sizeOfImages();
  const from = closest.cursor ?? centerNow().map(Math.floor);
  closest.cursor = [dx, dy].map((step, k) => Math.max(0, Math.min(size[k] - 1, from[k] + (closest.cursor ? step : 0))));
  if (!state.zoom) return draw();
  const pane = closest.panes[0].canvas, half = [pane.clientWidth, pane.clientHeight].map((side) => side / 2 / state.zoom - 1);
  const center = centerNow().map((value, k) =>
    Math.max(closest.cursor[k] + 1 - half[k], Math.min(closest.cursor[k] + half[k], value)));
  return moveTo({center});
}

function flipImages() {
  if (state.mode !== 'flip') return changeComparator({mode: 'flip'});
  closest.flipped = !closest.flipped;
  return showComparator();
}

const worstSide = 32;  // pixels of the region that is looked for

/** Zooms to the region in which B differs most from the reference. */
function showWorst() {
  const [reference, own] = [closest.images[0], chosen('b')].map(valuesOf), exposure = exposureOfView();
  if (!reference || !own) return;
  const columns = Math.ceil(own.width / worstSide), sums = new Float64Array(columns * Math.ceil(own.height / worstSide));
  for (let i = 0; i < own.coverage.length; ++i) {
    const at = Math.floor(i / own.width / worstSide) * columns + Math.floor((i % own.width) / worstSide);
    if (counts(reference, i)) sums[at] += errorAt(own, reference, i, exposure);
  }
  const worst = sums.indexOf(Math.max(...sums)), pane = closest.panes[0].canvas;
  const zoom = Math.max(1, Math.floor(Math.min(pane.clientWidth, pane.clientHeight) / (1.5 * worstSide)));
  moveTo({zoom, center: [worst % columns, Math.floor(worst / columns)].map((at) => (at + 0.5) * worstSide)});
}

const setStops = (stops) => changeComparator({stops: Math.max(-8, Math.min(8, stops))});
const availableMaps = () => (data.in_false_color ? ['image', 'error'] : maps.map(([name]) => name));

const isInSight = ({top, bottom}) => top < window.innerHeight && bottom > 0;

function press(event) {
  if (event.ctrlKey || event.altKey || event.metaKey || closest.images.length === 0) return;
  if (!isInSight(byId('stage').getBoundingClientRect())) return;
  const target = event.target, inStage = byId('stage').contains(target) && target.id !== 'split';
  if (target.matches('select, textarea, input:not([type=radio]):not([type=checkbox])') ||
      (event.key === ' ' && target.matches('button, input, summary, a'))) return;
  const digit = event.code.startsWith('Digit') ? Number(event.code.slice(5)) : 0;
  const step = event.shiftKey ? 10 : 1;
  const letter = event.key.toLowerCase();
  const mode = {f: 'flip', s: 'slider', d: 'side', g: 'all'}[letter];
  const arrow = {ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step]}[event.key];
  if (digit && closest.images[digit]) choose(event.shiftKey ? 'a' : 'b', closest.images[digit].name);
  else if (letter === 'r') choose(event.shiftKey ? 'a' : 'b', closest.images[0].name);
  else if (event.key === ' ') flipImages();
  else if (mode) changeComparator({mode});
  else if (letter === 'w') showWorst();
  else if (letter === 'e') changeComparator({map: state.map === 'error' ? 'image' : 'error'});
  else if (letter === 'm') {
    const names = availableMaps();
    changeComparator({map: names[(names.indexOf(state.map) + 1) % names.length]});
  } else if (event.key === '+' || event.key === '=') zoomAt(2 * zoomNow());
  else if (event.key === '-') zoomAt(zoomNow() / 2);
  else if (event.key === '0') moveTo({zoom: null, center: null});
  else if (event.key === '[' || event.key === ']') setStops(state.stops + (event.key === ']' ? 0.5 : -0.5));
  else if (arrow && inStage) moveCursor(...arrow);
  else return;
  event.preventDefault();
}

function startComparator() {
  const stage = byId('stage');
  segments('modes', modes.map(([value, text]) => ({value, text})), state.mode, (mode) => changeComparator({mode}));
  segments('zooms', [{value: 'fit', text: 'fit'}, ...[2, 4, 8, 16].map((value) => ({value, text: `${value}×`}))], 'fit',
    (zoom) => (zoom === 'fit' ? moveTo({zoom: null, center: null}) : moveTo({zoom: Number(zoom), center: centerNow()})));
  byId('map').append(...maps.filter(([name]) => availableMaps().includes(name)).map(([value, text]) => option(value, text)));
  byId('map').addEventListener('change', (event) => changeComparator({map: event.target.value}));
  byId('exposure-tool').hidden = data.in_false_color;
  byId('exposure').addEventListener('input', (event) => setStops(Number(event.target.value)));
  byId('top').addEventListener('input', (event) => changeComparator({top: 2 ** Number(event.target.value)}));
  byId('split').addEventListener('input', (event) => setSplit(Number(event.target.value)));
  stage.addEventListener('pointerdown', startDrag);
  stage.addEventListener('pointermove', drag);
  for (const name of ['pointerup', 'pointercancel']) stage.addEventListener(name, endDrag);
  stage.addEventListener('click', pointAt);
  stage.addEventListener('dblclick', (event) => {
    const pane = paneOf(event);
    zoomAt(2 * zoomNow(), pane, ...placeIn(pane, event));
  });
  stage.addEventListener('wheel', (event) => {
    if (!event.ctrlKey && !stage.contains(document.activeElement)) return;  // else the page could not be scrolled
    event.preventDefault();
    const pane = paneOf(event);
    zoomAt(zoomNow() * 2 ** (-event.deltaY / 240), pane, ...placeIn(pane, event));
  }, {passive: false});
  document.addEventListener('keydown', press);
  new ResizeObserver(draw).observe(stage);
  window.addEventListener('load', () => setTimeout(() => closest.images.length && [chosen('a'), chosen('b')].forEach(valuesOf)));
}
