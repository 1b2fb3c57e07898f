// Dialogs: of the browser's own kind, which keeps the focus inside and closes with Escape.

import {h, icon} from './dom.js';

/** @returns the open dialog; `closed` is called once when it goes */
export function openDialog({title, name, body, closed = () => {}}) {
  const close = h('button', {type: 'button', class: 'bare', 'aria-label': 'Close', title: 'Close (Esc)'}, icon('close'));
  const heading = h('h2', {id: `dialog-${name}`, text: title});
  const dialog = h('dialog', {data: {name}, 'aria-labelledby': heading.id},
    h('div', {class: 'dialog-head'}, heading, close), h('div', {class: 'dialog-body'}, ...body));
  close.addEventListener('click', () => dialog.close());
  dialog.addEventListener('click', (event) => {
    if (event.target === dialog) dialog.close();
  });
  dialog.addEventListener('close', () => {
    dialog.remove();
    closed();
  });
  document.body.append(dialog);
  dialog.showModal();
  return dialog;
}

/** Asks for a key of the server. Resolves to null where the dialog is closed without one. */
export function askForKey(message) {
  return new Promise((resolve) => {
    const input = h('input', {type: 'password', 'aria-label': 'Key', autocomplete: 'off', required: true});
    let key = null;
    const form = h('form', {}, input, h('button', {type: 'submit', text: 'Use it'}));
    const dialog = openDialog({title: 'This server wants a key', name: 'key', closed: () => resolve(key),
      body: [h('p', {text: `${message}.`}), form, h('p', {class: 'hint', text: 'It is kept until this tab is closed, and sent to this server alone.'})]});
    form.addEventListener('submit', (event) => {
      event.preventDefault();
      key = input.value.trim();
      dialog.close();
    });
  });
}

const KEYS = [
  ['1 … 8', 'colour by coordinates, normals, checker, signature, distortion, confidence, error, nothing'],
  ['X', 'swap source and target'],
  ['C', 'another candidate'],
  ['S', 'surface or sphere'],
  ['M', 'morph the source into its image and back'],
  ['L', 'link the cameras'],
  ['A', 'align the poses'],
  ['Y', 'symmetry of each shape'],
  ['E', 'edges'],
  ['H', 'light, or colours as they are'],
  ['G', 'go to a vertex by its number'],
  ['R', 'look from the broad side'],
  ['Esc', 'clear the points'],
  ['Arrows + − [ ]', 'in a view: turn, zoom, roll'],
];

export function openHelp() {
  const rows = KEYS.flatMap(([keys, meaning]) => [h('dt', {}, ...keys.split(' ').map((key) => (key === '…' ? ' … ' : h('kbd', {text: key})))), h('dd', {text: meaning})]);
  openDialog({title: 'Keys and gestures', name: 'help', body: [
    h('dl', {class: 'keys'}, ...rows),
    h('p', {text: 'Drag turns, wheel or pinch zooms, shift-drag or right-drag shifts. A click pins a point and shows its image; shift-click keeps more. Drop meshes anywhere, and ground truth (.vts, .txt, .npy) beside a match.'}),
    h('p', {}, 'The address holds the whole view: send it to a colleague who reaches this server. ', h('a', {href: '/docs', text: 'Interface'}), ' · ', h('a', {href: '/page/licences.txt', text: 'Licences'})),
  ]});
}
