// The table of records, and that of pairs. They use the names of page.js.
'use strict';

// The program lists the columns. Two sort by something other than the figure at their place in results.json.
const sortedBy = {rank: (r) => (r.display.rank === '–' ? null : Number(r.display.rank)), equivalent_spp: worth};
const bestBy = {shading_error: 'is_best', equivalent_spp: 'is_best', frame_median_ms: 'is_fastest'};
const columns = (data.columns ?? []).map((column) => (
  {...column, value: sortedBy[column.key] ?? ((r) => valueAt(r, column.place)), best: bestBy[column.key]}));
const nameColumn = {title: 'Method', key: 'name', words: true, value: (r) => r.method};
const changeColumn = {title: 'vs direct', key: 'change', value: (r) => (r.display.change ? parseFloat(r.display.change) : null),
  show: (r) => r.display.change, meaning: 'Error compared with that of direct.'};
const axisColumns = axes.map((axis) => ({title: axis, key: `axis ${axis}`, words: true, show: (r) => r.run.coordinates[axis],
  value: (r) => r.run.coordinates[axis], meaning: 'Axis of the matrix.'}));

/** The few columns that are shown at first, by short names. */
const few = {shading_error: 'Error', change: 'vs direct', equivalent_spp: '= spp', ratio_to_direct_median: 'Cost',
  precompute_bytes: 'Memory'};
const listed = () => columns.flatMap((column) => (column.key === 'shading_error' ? [column, changeColumn] : [column]));
const visibleColumns = () => [...(runs.length > 1 ? axisColumns : []),
  ...listed().filter((column) => isUsed(column) && (state.columns || column.key in few || column.key === 'distance'))];

/** Whether any record has a figure in the column. */
const blank = new Set(['n/a', 'none', '–', '', undefined]);
const isUsed = ({key: name}) => (name !== 'distance' || state.all) && records.some((r) => !blank.has(r.display[name]));

/** The samples that a record is worth as a sortable number; bounds go beyond the curve's ends. */
function worth(record) {
  const bound = record.equivalent_bound;
  if (bound.startsWith('>')) return Infinity;
  if (bound.startsWith('<')) return 0;
  return record.equivalent_spp;
}

/** Without a choice the least error is first. */
function sorted(rows) {
  const column = state.sort ?? {value: (r) => plotted(r.error)};
  const missing = (value) => value === null || value === undefined;
  return [...rows].sort((a, b) => {
    const [x, y] = [column.value(a), column.value(b)];
    if (missing(x) || missing(y)) return missing(x) - missing(y);
    const order = x < y ? -1 : x > y ? 1 : 0;
    return state.descending ? -order : order;
  });
}

function headCell(column) {
  const sort = () => {
    state.descending = state.sort === column && !state.descending;
    state.sort = column;
    showTable();
    writeState();
    byId('table').querySelector('th[aria-sort] button').focus();
  };
  const cell = element('th', column.words ? 'words-column' : '', button({title: column.meaning ?? ''}, sort,
    state.columns ? column.title : few[column.key] ?? column.title));
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
  const visible = visibleColumns();
  byId('table').classList.toggle('few', !state.columns);
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
  byId('pair-picture').replaceChildren(picture(pathOf(focus(), pair.picture), `Where ${pair.methods.join(' or ')} is closer`));
  byId('pair-picture').style.aspectRatio = shown()[0].size.join(' / ');
  byId('pair-caption').replaceChildren(swatch('first', pair.methods[0], pair.closer[0]),
    swatch('second', pair.methods[1], pair.closer[1]),
    element('span', 'verdict neither', `tie within noise: ${(100 * undecided).toFixed(1)}%`));
}

function pairCell(row, column) {
  const pair = row === column ? null : pairOf(row, column);
  if (!pair) return element('td', '', '–');
  const share = pair.closer[pair.methods.indexOf(row)];
  return element('td', '', button({title: `Where is ${row} closer than ${column}?`}, () => showPair(pair),
    `${(100 * share).toFixed(1)}%`));
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

