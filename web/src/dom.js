// A thin layer over the DOM, so that a piece of interface reads like its markup.

/**
 * Makes an element. `properties`: `class`, `text`, `on: {event: handler}`, `data: {name: value}`; names with a dash and the
 * ones in ATTRIBUTES are attributes, all others properties. Children that are null or false are left out.
 */
const ATTRIBUTES = new Set(['role', 'for', 'href', 'download', 'list', 'viewBox', 'target', 'rel']);

export function h(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (value === null || value === undefined) continue;
    if (name === 'class') element.className = value;
    else if (name === 'text') element.textContent = value;
    else if (name === 'on') for (const [event, handler] of Object.entries(value)) element.addEventListener(event, handler);
    else if (name === 'data') Object.assign(element.dataset, value);
    else if (name.includes('-') || ATTRIBUTES.has(name)) element.setAttribute(name, value);
    else element[name] = value;
  }
  element.append(...children.flat().filter((child) => child !== null && child !== undefined && child !== false));
  return element;
}

const SVG = 'http://www.w3.org/2000/svg';

/** The same for SVG, where everything is an attribute. */
export function svg(tag, attributes = {}, ...children) {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

/** An icon of icons.svg's small set, drawn with strokes of the text's colour. */
export function icon(name) {
  return svg('svg', {class: 'icon', viewBox: '0 0 24 24', 'aria-hidden': 'true'}, svg('path', {d: ICONS[name]}));
}

const ICONS = {
  upload: 'M12 16V4m0 0L7 9m5-5 5 5M4 20h16',
  swap: 'M4 8h15m0 0-4-4m4 4-4 4M20 16H5m0 0 4-4m-4 4 4 4',
  help: 'M9 9a3 3 0 1 1 4.5 2.6c-1 .6-1.5 1.1-1.5 2.4M12 17.5v.1',
  close: 'M6 6l12 12M18 6 6 18',
  trash: 'M4 7h16M9 7V4h6v3m-9 0 1 13h10l1-13',
  link: 'M10 14a4 4 0 0 0 6 0l3-3a4 4 0 0 0-6-6l-1 1m2 4a4 4 0 0 0-6 0l-3 3a4 4 0 0 0 6 6l1-1',
  home: 'M4 4h5M4 4v5M20 4h-5m5 0v5M4 20h5m-5 0v-5m16 5h-5m5 0v-5',
  copy: 'M9 9h11v11H9zM5 15H4V4h11v1',
  menu: 'M4 7h16M4 12h16M4 17h16',
  pencil: 'M4 20l1-5L16 4l4 4L9 19z',
};

/** Calls `run` once after the last of many calls within `milliseconds`. */
export function debounced(run, milliseconds) {
  let timer = 0;
  return (...values) => {
    clearTimeout(timer);
    timer = setTimeout(() => run(...values), milliseconds);
  };
}

/** Says something to those who listen rather than look. */
export function announce(text) {
  document.getElementById('status').textContent = text;
}

export function number(value, digits = 3) {
  if (value === null || value === undefined || Number.isNaN(value)) return '–';
  return Number.isInteger(value) ? value.toLocaleString('en') : Number(value.toPrecision(digits)).toString();
}
