// What the page shows, all of it in the address: `#src=…&tgt=…&paint=…`. The address is the fragment, so it never reaches a server's log.

/** Names, defaults and checks of the view's members. A member that has its default is left out of the address. */
const ID = /^[0-9a-f]{32}$/;
const oneOf = (...values) => ({fallback: values[0], read: (text) => (values.includes(text) ? text : null)});
const id = {fallback: '', read: (text) => (ID.test(text) ? text : null)};
const flag = (fallback) => ({fallback, read: (text) => (text === '1' ? true : text === '0' ? false : null), write: (value) => (value ? '1' : '0')});
const whole = (low, high) => ({fallback: low, read: (text) => (/^\d+$/.test(text) && +text >= low && +text <= high ? +text : null)});
const fraction = {fallback: 0, read: (text) => (text !== '' && +text >= 0 && +text <= 1 ? +text : null), write: (value) => String(Math.round(value * 1000) / 1000)};

export const PAINTS = ['coordinates', 'normals', 'checker', 'signature', 'distortion', 'confidence', 'error', 'plain'];

const MEMBERS = {
  src: id,
  tgt: id,
  candidate: whole(0, 7),
  orientation: oneOf('preserve', 'reverse', 'any'),
  refine: oneOf('default', 'none'),
  method: oneOf('default', 'paper'),
  paint: oneOf(...PAINTS),
  time: whole(0, 63),
  form: oneOf('surface', 'sphere'),
  morph: fraction,
  align: flag(true),
  linked: flag(true),
  shade: flag(true),
  wire: flag(false),
  symmetry: flag(false),
  pins: {fallback: [], read: readPins, write: (pins) => pins.map(({side, vertex}) => side[0] + vertex).join('.')},
  truth: oneOf('', 'identity'),
  camera: {fallback: null, read: readCamera, write: (camera) => camera.map((value) => String(Math.round(value * 1000) / 1000)).join('_')},
  camera2: {fallback: null, read: readCamera, write: (camera) => camera.map((value) => String(Math.round(value * 1000) / 1000)).join('_')},
};

export const MAX_PINS = 12;

function readPins(text) {
  const pins = text.split('.').map((part) => /^([st])(\d{1,9})$/.exec(part));
  if (pins.some((pin) => !pin) || pins.length > MAX_PINS) return null;
  return pins.map(([, side, vertex]) => ({side: side === 's' ? 'source' : 'target', vertex: +vertex}));
}

/** x, y, z, w of the orientation, zoom, and two of the shift. */
function readCamera(text) {
  const values = text.split('_').map(Number);
  const norm = Math.hypot(...values.slice(0, 4));
  return values.length === 7 && values.every(Number.isFinite) && norm > 0.5 && norm < 1.5 && values[4] > 0 ? values : null;
}

export function defaults() {
  return Object.fromEntries(Object.entries(MEMBERS).map(([name, member]) => [name, structuredClone(member.fallback)]));
}

/** The view that an address names. What it does not name, or names wrongly, has its default. */
export function readAddress(fragment) {
  const view = defaults();
  for (const [name, text] of new URLSearchParams(fragment.replace(/^#/, ''))) {
    const value = Object.hasOwn(MEMBERS, name) ? MEMBERS[name].read(text) : null;
    if (value !== null) view[name] = value;
  }
  return view;
}

/** The shortest address of a view, beginning with "#", or empty. */
export function writeAddress(view) {
  const parts = [];
  for (const [name, member] of Object.entries(MEMBERS)) {
    const write = member.write ?? String;
    if (view[name] === null || JSON.stringify(view[name]) === JSON.stringify(member.fallback)) continue;
    parts.push(`${name}=${encodeURIComponent(write(view[name]))}`);
  }
  return parts.length ? '#' + parts.join('&') : '';
}

/** The query of GET /match that belongs to a view; what is the server's default is left out. */
export function matchQuery(view, turned = false) {
  const query = new URLSearchParams({src: turned ? view.tgt : view.src, tgt: turned ? view.src : view.tgt});
  for (const name of ['candidate', 'orientation', 'refine', 'method']) {
    if (view[name] !== MEMBERS[name].fallback) query.set(name, view[name]);
  }
  return query;
}

/** Holds the view; those who subscribed hear of each change with the names of what changed. */
export class Store {
  constructor(view) {
    this.view = view;
    this.listeners = [];
  }

  subscribe(listener) {
    this.listeners.push(listener);
  }

  set(changes) {
    const names = Object.keys(changes).filter((name) => JSON.stringify(changes[name]) !== JSON.stringify(this.view[name]));
    if (names.length === 0) return;
    this.view = {...this.view, ...changes};
    const changed = new Set(names);
    for (const listener of this.listeners) listener(this.view, changed);
  }
}
