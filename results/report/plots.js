// Charts: error against cost, figures against distance, and the luminance histogram. They use the names of page.js.
'use strict';

/** The errors of the plot: shading errors, or where no pixel is interior errors over all of the object. */
const plotted = (figures) => figures?.shading ?? figures?.normalized_color;

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

/** Names beside points, moved away from those that are there; a name that has no room is left to the legend. */
const pointLabels = {
  id: 'pointLabels',
  afterDatasetsDraw(plot) {
    const {ctx, chartArea} = plot, taken = [];
    plot.$named = [];  // for tests
    ctx.save();
    plot.data.datasets.forEach((set, i) => {
      if (!set.names || !plot.isDatasetVisible(i)) return;
      ctx.fillStyle = styleValue(set.isQuiet ? '--muted' : '--ink');
      ctx.font = `${set.isQuiet ? '' : '600 '}12px system-ui, sans-serif`;
      plot.getDatasetMeta(i).data.forEach((point, j) => {
        if (!set.names[j]) return;
        const width = ctx.measureText(set.names[j]).width;
        const places = [[11, -9], [11, 18], [-11 - width, -9], [-11 - width, 18], [11, -24], [11, 33]];
        for (const [dx, dy] of places) {
          const box = [point.x + dx, point.y + dy - 11, point.x + dx + width, point.y + dy + 3];
          const isInside = box[0] >= chartArea.left && box[2] <= chartArea.right && box[1] >= chartArea.top && box[3] <= chartArea.bottom;
          if (!isInside || taken.some((b) => box[0] < b[2] && b[0] < box[2] && box[1] < b[3] && b[1] < box[3])) continue;
          taken.push(box);
          plot.$named.push(set.names[j]);
          ctx.fillText(set.names[j], box[0], point.y + dy);
          break;
        }
      });
    });
    ctx.restore();
  },
};

/** A word in the corner of the chart's better end, and what the axes leave out. */
const corner = {
  id: 'corner',
  afterDatasetsDraw({ctx, chartArea, options}) {
    const lines = options.corner ?? [];
    ctx.save();
    ctx.fillStyle = styleValue('--muted');
    ctx.font = '12px system-ui, sans-serif';
    lines.forEach((text, i) => ctx.fillText(text, chartArea.left + 10, chartArea.bottom - 10 - 16 * (lines.length - 1 - i)));
    ctx.restore();
  },
};

/** What costs can be: frame times, and estimates on GPUs where there are some. */
const costKinds = () => ['', ...new Set(records.flatMap((record) => record.gpu_costs.map(({gpu}) => gpu)))];
const gpuCost = (record) => record.gpu_costs.find(({gpu, failure}) => gpu === state.cost && !failure)?.cost_ns;
const costOf = (record) => (state.cost ? gpuCost(record) : record.time.frame_ms.median);
const costUnit = () => (state.cost ? 'ns per pixel' : 'ms');
const costTitle = () => (state.cost ? `Estimated cost on ${state.cost} (ns per pixel)` : 'Frame time (ms)');

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
    isMethod: true,
    data: own.map((r) => ({x: costOf(r), y: plotted(r.error), place: placeOf(r.run)})),
    names: own.length > 1 ? undefined : [method],
    whiskers: own.length > 20 || state.cost ? undefined : own.map(({time: {frame_ms: {min, p90}}}) => [min, p90]),
  };
}

/** A line without marks. */
const lineSeries = (label, data, color, own) => ({
  label,
  data,
  showLine: true,
  borderColor: color,
  backgroundColor: color,
  borderWidth: 1.5,
  pointRadius: 0,
  pointHitRadius: 0,
  pointStyle: 'line',
  ...own,
});

/** The methods of one member that none is both faster and closer than: each left of them costs error, each below time. */
function frontSeries(own) {
  let least = Infinity;
  const front = [...own].sort((a, b) => costOf(a) - costOf(b) || plotted(a.error) - plotted(b.error))
    .filter((r) => plotted(r.error) < least && ((least = plotted(r.error)), true));
  return lineSeries('Pareto front', front.map((r) => ({x: costOf(r), y: plotted(r.error)})), styleValue('--ink'),
    {stepped: 'before', borderDash: [2, 3]});
}

const curveSeries = (points) => lineSeries('plain supersampling', points.map((point) => ({x: point.ms, y: plotted(point)})),
  styleValue('--muted'), {counts: points.map(({spp}) => spp), names: points.map(({spp}) => `${spp} spp`), isQuiet: true,
    pointRadius: 3, pointHitRadius: 1, pointStyle: 'circle'});

/** A dashed line between two points. */
const limitSeries = (label, data) => lineSeries(label, data, styleValue('--warn'), {borderDash: [6, 5]});

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

const fewNames = 8;  // so many have room beside their points

/** An entry for each name, with a word for its dashes, which are too long for a legend. */
function legend(width) {
  const entries = (plot) => {
    const sets = plot.data.datasets;
    return Chart.defaults.plugins.legend.labels.generateLabels(plot)
      .filter(({datasetIndex: i}) => sets.findIndex((set) => set.label === sets[i].label) === i &&
        !(sets[i].isMethod && sets[i].names && methods.length <= fewNames))
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
  Chart.getChart(id)?.destroy();
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
  return `${name}${item.raw.place ? `, ${item.raw.place}` : ''}: error ${figure(y)} at ${figure(x)} ${costUnit()}`;
}

const farFloor = 4;  // a floor that is further below the errors is named in the corner instead of drawn
const farCurve = 4;  // points of the curve that are so much more expensive than every method are not drawn

/** The points for logarithmic axes at the chosen distance, and those without a place on them. */
function plotContent() {
  const positive = (cost, error) => cost > 0 && error > 0;
  const here = filtered().filter((r) => r.distance === state.distance);
  const drawn = here.filter((r) => positive(costOf(r), plotted(r.error)));
  const alone = matching().length === 1;  // the curve and the floor are of one member
  const curve = !alone || state.cost ? [] : focus().results.supersampling
    .filter((point) => point.distance === state.distance && positive(point.ms, plotted(point)))
    .sort((a, b) => a.spp - b.spp);
  const most = Math.max(...drawn.map(costOf));
  const near = drawn.length ? curve.filter((point) => point.ms <= farCurve * most) : curve;
  const floors = !alone ? [] : here.map((r) => r.error?.shading_floor ?? r.error?.noise_floor).filter((floor) => floor > 0);
  const missing = here.filter((r) => !drawn.includes(r));
  return {drawn, curve: near, further: curve.slice(near.length), floor: floors.length ? Math.max(...floors) : null, missing};
}

function showPlot() {
  const {drawn, curve, further, floor, missing} = plotContent();
  byId('plot-note').textContent = missing.length
    ? `Not shown, because the logarithmic axis cannot show an error of 0 or none: ${
      [...new Set(missing.map((r) => r.method))].join(', ')}.`
    : '';
  byId('plot').parentElement.hidden = drawn.length + curve.length === 0;
  if (drawn.length + curve.length === 0) return;
  const frameTimes = state.cost ? [] : drawn.flatMap((r) => Object.values(r.time.frame_ms)).filter((ms) => ms > 0);
  const costs = [...drawn.map(costOf), ...frameTimes, ...curve.map((p) => p.ms)];
  const errors = [...drawn.map((r) => plotted(r.error)), ...curve.map(plotted)];
  const isNear = floor && Math.min(...errors) < farFloor * floor;
  const x = padded(costs, 1.25, 1.45);
  const y = padded(isNear ? [...errors, floor] : errors, 1.4, 1.5);
  const datasets = methods.map((method) => [method, drawn.filter((r) => r.method === method)])
    .filter(([, own]) => own.length > 0).map(([method, own]) => methodSeries(method, own));
  if (curve.length) datasets.push(curveSeries(curve));
  if (isNear) datasets.push(limitSeries('noise floor', [{x: x.min, y: floor}, {x: x.max, y: floor}]));
  const members = [...new Set(drawn.map((r) => r.run))];
  if (members.length <= mostFronts) datasets.push(...members.map((run) => frontSeries(drawn.filter((r) => r.run === run))));
  const lines = ['↙ better'];
  if (further.length) lines.push(`further samples: ${further.map(({spp, ms, ...point}) =>
    `${spp} spp ${figure(plotted(point))} at ${figure(ms)} ms`).slice(-1)}`);
  if (floor && !isNear) lines.push(`noise floor ${figure(floor)}, below this axis`);
  drawChart('plot', datasets, {x: logAxis(costTitle(), x), y: logAxis('Error', y)}, tooltipText,
    {plugins: [whiskers, pointLabels, corner], corner: lines});
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
  const error = showTrend('trend-error', 'Error', (r) => plotted(r.error));
  const flicker = showTrend('trend-flicker', 'Flicker', (r) => r.flicker?.mean);
  byId('trends').hidden = !error && !flicker;
  byId('trends-note').hidden = runs.length === 1;
}

// ---- sparkle

/** A histogram as the line of its shares; a bin without pixels is drawn as half a pixel, at the axis' foot. */
function histogramSeries(label, counts, color, dash) {
  const pixels = counts.reduce((sum, count) => sum + count, 0);
  return lineSeries(label, counts.map((count, i) => ({x: (i + 0.5) / counts.length, y: Math.max(count, 0.5) / pixels, count})), color,
    {stepped: 'middle', borderWidth: 2, borderDash: dash, pointHitRadius: 6});
}

function sparkleText(item) {
  const {x, y, count} = item.raw;
  return `${item.dataset.label}: ${count} pixels, ${count ? figure(100 * y) : 0}%, about luminance ${figure(x)}`;
}

function showSparkle() {
  const counted = shown().filter((record) => record.error);
  byId('sparkle-section').hidden = counted.length === 0;
  if (counted.length === 0) return;
  const datasets = [histogramSeries('reference', counted[0].error.reference_luminances, styleValue('--ink'), [6, 4]),
    ...counted.map((record) => histogramSeries(record.method, record.error.luminances, seriesColor(record.method), []))];
  const shares = datasets.flatMap((set) => set.data.map((point) => point.y));
  drawChart('sparkle', datasets, {x: {...linearAxis('Luminance as shown'), min: 0, max: 1},
    y: logAxis('Share of pixels', padded(shares, 1, 1.5))}, sparkleText, {legendWidth: 18});
}

// ---- a plot of candidates

/** Error against cost of candidates: the chosen one and those on the front have their names. */
function showCandidates(canvas, {title, points, most_x: mostX, most_y: mostY}) {
  const there = points.filter(({x, y}) => x > 0 && y > 0);
  const isFront = (p) => !there.some((q) => q.x < p.x && q.y < p.y);
  const x = padded(there.map((p) => p.x), 1.15, 1.3), y = padded(there.map((p) => p.y), 1.2, 1.3);
  const series = (label, own, color, radius, pointStyle) => ({label, data: own, borderColor: color, backgroundColor: color,
    pointRadius: radius, pointHoverRadius: radius + 2, pointStyle, names: label === 'others' ? undefined : own.map(({name}) => name),
    whiskers: own.map(({low, high}) => [Math.max(low, x.min), Math.min(high, x.max)])});
  const datasets = [series('chosen', there.filter((p) => p.chosen), styleValue('--warn'), 8, 'rectRot'),
    series('front', there.filter((p) => !p.chosen && isFront(p)), styleValue('--accent'), 5, 'circle'),
    series('others', there.filter((p) => !p.chosen && !isFront(p)), styleValue('--muted'), 4, 'triangle')]
    .filter(({data: own}) => own.length);
  if (mostY > y.min && mostY < y.max) datasets.push(limitSeries('limit', [{x: x.min, y: mostY}, {x: x.max, y: mostY}]));
  if (mostX > x.min && mostX < x.max) datasets.push(limitSeries('limit', [{x: mostX, y: y.min}, {x: mostX, y: y.max}]));
  drawChart(canvas, datasets, {x: logAxis(title, x), y: logAxis('Error', y)},
    ({raw}) => `${raw.name}: error ${figure(raw.y)} at ${figure(raw.x)} times direct`,
    {plugins: [whiskers, pointLabels, corner], corner: ['↙ better']});
}
