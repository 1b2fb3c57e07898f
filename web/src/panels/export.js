// Downloads in every format, and the lines that do the same elsewhere.

import {api, apiKey} from '../api.js';
import {announce, h} from '../dom.js';
import * as workspace from '../workspace.js';
import {snippets} from '../snippets.js';
import {matchQuery} from '../state.js';
import {section} from './controls.js';

const TITLES = {
  npz: 'vertex, corners and weights for NumPy',
  npy: 'the nearest vertex for NumPy',
  txt: 'the nearest vertex, one a line',
  json: 'the map with all there is to say of it',
  ply: 'the coloured source, with the images as tx ty tz',
  glb: 'the coloured source, for any 3D program',
  obj: 'the coloured source as text',
  png: 'a picture of both shapes',
  map: 'the nearest vertex, counted from 1',
};
const LANGUAGES = [['curl', 'curl'], ['python', 'Python'], ['cpp', 'C++']];

const plain = (name) => (name || 'shape').replace(/\.[^.]*$/, '').replace(/[^\w.-]+/g, '-');

function link(path, file, text, title) {
  return h('a', {href: path, download: file, text, title, on: {click: (event) => {
    // A plain link cannot send a key.
    if (!apiKey()) return;
    event.preventDefault();
    api.blob(path).then((blob) => {
      const address = URL.createObjectURL(blob);
      h('a', {href: address, download: file}).click();
      setTimeout(() => URL.revokeObjectURL(address), 10_000);
    }, (error) => announce(error.message));
  }}});
}

export function exportSection(store) {
  const downloads = h('div', {class: 'downloads', id: 'downloads'});
  const code = h('code');
  let language = 'curl';
  let texts = {};
  const show = () => {
    code.textContent = texts[language] ?? '';
    tabs.forEach((tab) => tab.setAttribute('aria-pressed', String(tab.dataset.value === language)));
  };
  const tabs = LANGUAGES.map(([value, text]) => h('button', {type: 'button', text, data: {value}, on: {click: () => {
    language = value;
    show();
  }}}));
  const copy = h('button', {type: 'button', text: 'Copy', id: 'copy-lines', on: {click: () => copyText(texts[language], copy)}});
  const lines = h('div', {id: 'lines'}, h('div', {class: 'choice', role: 'group', 'aria-label': 'Language'}, ...tabs),
    h('div', {class: 'snippet'}, h('pre', {tabIndex: 0, 'aria-label': 'Lines that do the same'}, code), copy));
  const element = section('Export', downloads, lines);
  element.hidden = true;
  return {element, update: async (scene) => {
    element.hidden = !scene.map;
    if (!scene.map) return;
    const query = matchQuery(store.view);
    const formats = await workspace.matchFormats();
    const names = {source: scene.source.info.name || 'the source', target: scene.target.info.name || 'the target'};
    const file = `${plain(names.source)}-${plain(names.target)}`;
    // Of candidates /scene knows the best one alone.
    const rest = new URLSearchParams([...query].filter(([name]) => name !== 'candidate'));
    downloads.replaceChildren(
      ...formats.map((format) => link(`/match?${query}&format=${format}${format === 'json' ? '&fields=vertex,corners,bary' : ''}`, `${file}.${format}`, format.toUpperCase(), TITLES[format])),
      ...(query.has('candidate') ? [] : [link(`/scene?${rest}`, `${file}-scene.glb`, 'Scene', 'both meshes in one GLB file')]));
    texts = snippets(location.origin, query, names);
    show();
  }};
}

export async function copyText(text, button) {
  const before = button.textContent;
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    // Where the clipboard is closed to pages, as without https on another machine, the old way still works.
    const area = h('textarea', {value: text, 'aria-hidden': 'true'});
    document.body.append(area);
    area.select();
    document.execCommand('copy');
    area.remove();
  }
  button.textContent = 'Copied';
  announce('Copied');
  setTimeout(() => (button.textContent = before), 1500);
}
