// The settings beside the viewer: paint, form, and the choice among maps. Each control shows and changes a member of the view.

import {h, number} from '../dom.js';

export function section(title, ...children) {
  const body = h('div', {class: 'section-body'}, ...children);
  return h('details', {class: 'section', open: true, data: {section: title.toLowerCase()}}, h('summary', {}, h('h2', {text: title})), body);
}

/** A row of buttons of which one is pressed. */
function choice(store, member, label, options) {
  const buttons = options.map(([value, text, title]) =>
    h('button', {type: 'button', text, title, data: {value}, 'aria-pressed': 'false', on: {click: () => store.set({[member]: value})}}));
  const group = h('div', {class: 'choice', role: 'group', 'aria-label': label, data: {member}}, ...buttons);
  const show = (view) => buttons.forEach((button) => button.setAttribute('aria-pressed', String(button.dataset.value === String(view[member]))));
  store.subscribe(show);
  show(store.view);
  return group;
}

function toggle(store, member, label, title, key) {
  const box = h('input', {type: 'checkbox', id: `toggle-${member}`, checked: store.view[member], on: {change: () => store.set({[member]: box.checked})}});
  store.subscribe((view) => (box.checked = view[member]));
  return h('label', {class: 'toggle', for: box.id, title: key ? `${title} (${key})` : title}, box, h('span', {text: label}));
}

function slider(store, member, {label, low, high, step, title}) {
  const input = h('input', {type: 'range', id: `slider-${member}`, min: low, max: high, step, value: store.view[member], title, on: {input: () => store.set({[member]: Number(input.value)})}});
  store.subscribe((view) => (input.value = view[member]));
  return h('div', {class: 'slider'}, h('label', {for: input.id, text: label}), input);
}

function select(store, member, label, options) {
  const input = h('select', {id: `select-${member}`, on: {change: () => store.set({[member]: input.value, candidate: 0})}},
    ...options.map(([value, text]) => h('option', {value, text})));
  input.value = store.view[member];
  store.subscribe((view) => (input.value = view[member]));
  return h('div', {class: 'field'}, h('label', {for: input.id, text: label}), input);
}

export function paintSection(store) {
  const paints = [
    ['coordinates', 'Coordinates', 'Place on the target'],
    ['normals', 'Normals', 'Direction of the target'],
    ['checker', 'Checker', 'A sheet of squares on the target'],
    ['signature', 'Signature', 'Heat kernel signature of each shape'],
    ['distortion', 'Distortion', 'How much the map stretches'],
    ['confidence', 'Confidence', 'How sure each image is'],
    ['error', 'Error', 'Distance from the ground truth'],
    ['plain', 'Plain', 'No colours'],
  ];
  return section('Colour', choice(store, 'paint', 'Colour by', paints));
}

export function formSection(store) {
  const forms = choice(store, 'form', 'Form', [['surface', 'Surface', 'The shapes as they are'], ['sphere', 'Sphere', 'Both on the sphere']]);
  const morph = slider(store, 'morph', {label: 'Morph', low: 0, high: 1, step: 0.01, title: 'The source on its way to its image'});
  store.subscribe((view) => (morph.hidden = view.form !== 'surface'));
  morph.hidden = store.view.form !== 'surface';
  return section('View', forms, morph,
    h('div', {class: 'toggles'},
      toggle(store, 'linked', 'Link cameras', 'Both sides turn together', 'L'),
      toggle(store, 'align', 'Align poses', 'Turn the target to the source', 'A'),
      toggle(store, 'shade', 'Light', 'Shaded, or colours as they are', 'H'),
      toggle(store, 'wire', 'Edges', 'Show the triangles', 'E'),
      toggle(store, 'symmetry', 'Symmetry', 'Left and right of each shape: the middle line, and links between mirror images', 'Y')));
}

export function mapSection(store) {
  const candidates = h('div', {class: 'choice', role: 'group', 'aria-label': 'Candidate', data: {member: 'candidate'}});
  const figures = h('dl', {class: 'figures', id: 'figures'});
  const element = section('Map',
    h('div', {class: 'field'}, h('span', {class: 'label', text: 'Candidate'}), candidates),
    h('div', {class: 'fields'},
      select(store, 'orientation', 'Orientation', [['preserve', 'as it is'], ['reverse', 'mirrored'], ['any', 'better of both']]),
      select(store, 'refine', 'Refinement', [['default', 'elastic flow'], ['none', 'none']]),
      select(store, 'method', 'Method', [['default', 'default'], ['paper', 'the paper']])),
    figures);
  return {element, show: (match) => showMatch(store, candidates, figures, match), clear: () => { candidates.replaceChildren(); figures.replaceChildren(); }};
}

/** The candidates that can be asked for: those followed to the end, two as a rule, best first. */
function showMatch(store, candidates, figures, match) {
  const count = Math.min(2, match.candidates.length);
  const chosen = match.quality.score;
  candidates.replaceChildren(...Array.from({length: count}, (_, k) => {
    const score = k === match.candidate ? chosen : match.quality.score_runner_up;
    return h('button', {type: 'button', 'aria-pressed': String(k === match.candidate), data: {value: k}, title: 'Lower scores fit better',
      on: {click: () => store.set({candidate: k})}}, k === 0 ? 'Best' : 'Next best', score ? h('small', {text: ' ' + number(score, 2)}) : '');
  }));
  const {quality, seconds} = match;
  const rows = [
    ['Strain', number(quality.strain), 'Root mean square strain; 0 for an isometry'],
    ['Bijective', quality.bijective === 1 ? 'yes' : quality.bijective === 0 ? 'no' : '–', 'Whether the map of the spheres was checked to be one to one'],
    ['Computed in', `${number(seconds.total, 2)} s`, 'Wall-clock time of the match when it was computed'],
    ['Orientation', match.orientation === 'reverse' ? 'mirrored' : 'kept', 'Which way round the source was matched'],
  ];
  if (quality.ambiguous) rows.unshift(['Ambiguous', 'yes', 'The next best map fits nearly as well: look at it, or give hints']);
  figures.replaceChildren(...rows.flatMap(([name, value, title]) => [h('dt', {text: name, title}), h('dd', {text: value, title, data: {figure: name.toLowerCase()}})]));
}
