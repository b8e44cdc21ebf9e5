// The film of an animation: frames by a slider, and the figures along the path. It uses the names of page.js.
'use strict';

{
  const film = runs[0].results;
  const recordsOf = (method) => records.filter((record) => record.method === method);
  const frames = recordsOf(methods[0]);  // what all methods share
  const shownNow = {frame: 0, method: methods[0], timer: null};
  const causes = [['shading', 'shading'], ['edges', 'edges'], ['filter', 'filter'], ['method', 'method’s own']];

  const causeColor = (index) => palette[theme()][index % palette.light.length];
  const pngUrl = (path) => urlOf(path.replace(/\.exr$/i, '.png'));
  const text = (value) => (value === null || value === undefined ? 'n/a' : value.toFixed(5));

  const mean = (values) => {
    const there = values.filter((value) => Number.isFinite(value));
    return there.length ? there.reduce((sum, value) => sum + value, 0) / there.length : null;
  };

  /** The position on the path in a frame, in words. */
  const place = (frame) => {
    const {distance, degrees, seconds} = frames[frame];
    const short = (value) => Number(value.toPrecision(4));
    const where = {zoom: `distance ${short(distance)}`, animation: `${short(seconds)} s`}[film.way.path] ?? `${short(degrees)}°`;
    return `frame ${frame} of ${frames.length - 1}, ${where}`;
  };

  // ---- the film

  const namedImage = (name, className = '') => Object.assign(element('img', className), {alt: name});

  const makeFilm = () => {
    byId('film').append(element('figure', '', namedImage('reference'),
      element('figcaption', '', element('span', '', 'reference'))));
    for (const method of methods) {
      byId('film').append(element('figure', '',
        element('div', 'stack', namedImage(method), namedImage('', 'over')),
        element('figcaption', '', element('span', '', method), ' ', element('span'))));
    }
  };

  const showFrame = () => {
    const figures = byId('film').children;
    const reference = pngUrl(frames[shownNow.frame].images.reference);
    figures[0].querySelector('img').src = reference;
    methods.forEach((method, i) => {
      const record = recordsOf(method)[shownNow.frame];
      const [own, over] = figures[i + 1].querySelectorAll('img');
      own.src = pngUrl(record.images.color);
      over.src = reference;
      figures[i + 1].querySelectorAll('span')[1].textContent =
        `error ${text(record.error?.normalized_color)} · flicker ${text(record.flicker?.mean)}`;
    });
    byId('frame').value = shownNow.frame;
    byId('where').textContent = place(shownNow.frame);
    for (const id of ['error', 'flicker', 'highlights', 'causes']) Chart.getChart(id)?.draw();
  };

  const go = (frame) => {
    shownNow.frame = Math.max(0, Math.min(frames.length - 1, frame));
    showFrame();
  };

  const play = () => {
    if (shownNow.timer) {
      clearInterval(shownNow.timer);
      shownNow.timer = null;
    } else {
      shownNow.timer = setInterval(() => go((shownNow.frame + 1) % frames.length), 100);
    }
    byId('play').textContent = shownNow.timer ? 'Pause' : 'Play';
  };

  // ---- along the path

  /** An upright line at the frame that is shown. */
  const cursor = {
    id: 'cursor',
    afterDatasetsDraw(chart) {
      const {ctx, chartArea, scales: {x}} = chart;
      ctx.save();
      ctx.strokeStyle = styleValue('--muted');
      ctx.beginPath();
      ctx.moveTo(x.getPixelForValue(shownNow.frame), chartArea.top);
      ctx.lineTo(x.getPixelForValue(shownNow.frame), chartArea.bottom);
      ctx.stroke();
      ctx.restore();
    },
  };

  const line = (label, values, tint, dash = []) => ({
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
  });

  const drawLines = (id, title, datasets) => {
    Chart.getChart(id)?.destroy();
    drawChart(id, datasets, {
      x: {...linearAxis('Frame'), min: 0, max: frames.length - 1},
      y: {...linearAxis(title), beginAtZero: true},
    }, (item) => `${item.dataset.label}, ${place(item.raw.x)}: ${text(item.raw.y)}`, {
      legendWidth: 18,
      displayColors: true,
      plugins: [cursor],
      onClick: (event, hits, chart) => go(Math.round(chart.scales.x.getValueForPixel(event.x))),
    });
  };

  const showCauses = () => {
    const own = recordsOf(shownNow.method);
    drawLines('causes', 'Flicker', causes.map(([name, label], i) =>
      line(label, own.map((record) => record.flicker?.[name]?.mean), causeColor(i))));
  };

  const showCharts = () => {
    const lines = (value) => methods.map((method) => line(method, recordsOf(method).map(value), seriesColor(method)));
    drawLines('error', 'Error', lines((record) => record.error?.normalized_color));
    drawLines('flicker', 'Flicker', methods.flatMap((method) => [
      line(method, recordsOf(method).map((record) => record.flicker?.mean), seriesColor(method)),
      line(`${method}, p99`, recordsOf(method).map((record) => record.flicker?.p99), seriesColor(method), [5, 4])]));
    drawLines('highlights', 'Highlight energy', [
      line('reference', frames.map((frame) => frame.reference_highlight_energy), styleValue('--ink'), [6, 4]),
      ...lines((record) => record.highlight_energy)]);
    showCauses();
  };

  // ---- the means and the rest

  const showMeans = () => {
    const means = [
      ['Error', (r) => r.error?.normalized_color], ['Floor', (r) => r.error?.noise_floor],
      ['Shading', (r) => r.error?.shading], ['Edges', (r) => r.error?.edges],
      ['Flicker', (r) => r.flicker?.mean], ['p99', (r) => r.flicker?.p99], ['Floor', (r) => r.flicker?.noise_floor],
      ...causes.flatMap(([name, label]) => [[`Flicker: ${label}`, (r) => r.flicker?.[name]?.mean],
        ['p99', (r) => r.flicker?.[name]?.p99]]),
      ['Highlights', (r) => r.highlight_energy]];
    byId('means').tHead.append(element('tr', '', element('th', 'words-column', 'Method'),
      ...means.map(([title]) => element('th', '', title))));
    for (const method of methods) {
      byId('means').tBodies[0].append(element('tr', '', element('td', 'name words-column', key(method), method),
        ...means.map(([, value]) => element('td', '', text(mean(recordsOf(method).map(value)))))));
    }
  };

  const showVideo = () => {
    if (!film.film) return;
    const link = element('a', '', film.film);
    link.href = urlOf(film.film);
    byId('video').hidden = false;
    byId('video').append('As one file (the reference, then the methods in this order): ', link);
  };

  byId('lede').textContent = `${frames.length} frames of ${frames[0].size.join(' × ')} pixels: ${runs[0].path}.`;
  byId('frame').max = frames.length - 1;
  byId('frame').addEventListener('input', (event) => go(Number(event.target.value)));
  byId('play').addEventListener('click', play);
  for (const name of ['difference', 'sharp'])
    byId(name).addEventListener('change', (event) => byId('film').classList.toggle(name, event.target.checked));
  for (const query of [dark, paper]) {
    query.addEventListener('change', () => {
      recolourKeys();
      showCharts();
    });
  }
  segments('of-method', methods.map((method) => ({value: method, text: method})), methods[0], (method) => {
    shownNow.method = method;
    showCauses();
  });

  makeFilm();
  showMeans();
  showVideo();
  showCharts();
  showFrame();
}
