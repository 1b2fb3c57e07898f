// Ground truth: dropped files and what they are taken for, the server's measurement of the match against it, and the error curve.

import {api} from '../api.js';
import {announce, h, icon, number} from '../dom.js';
import {guessRole, readVertices, truthArray, truthOf} from '../map/truth.js';
import {section} from './controls.js';
import {curveFigure} from './curve.js';

const ROLES = [['source', 'on source'], ['target', 'on target'], ['mirrored', 'mirrored'], ['map', 'whole map']];

export class TruthPanel {
  /** `changed(array|null)`: the true target vertex of each source vertex */
  constructor(store, scene, {changed, failed}) {
    Object.assign(this, {store, scene, changed, failed, files: [], turn: 0});
    const input = h('input', {type: 'file', multiple: true, id: 'truth-files', accept: '.vts,.txt,.npy,.json', on: {change: () => this.add(input.files)}});
    this.list = h('ul', {class: 'truth-files', 'aria-label': 'Ground truth files'});
    this.result = h('div', {id: 'evaluation'});
    this.identity = h('button', {type: 'button', text: 'Equal numbers', title: 'Vertices of equal number belong together', 'aria-pressed': String(store.view.truth === 'identity'),
      on: {click: () => store.set({truth: store.view.truth ? '' : 'identity'})}});
    this.element = section('Truth',
      h('label', {class: 'truth-drop', for: 'truth-files'}, input, 'Drop what is known: lists of vertices on both shapes (.vts), or a target vertex for each source vertex (.txt, .npy)'),
      h('div', {class: 'choice'}, this.identity), this.list, this.result);
    store.subscribe((view, names) => {
      if (['src', 'tgt'].some((name) => names.has(name))) this.files = [];
      this.identity.setAttribute('aria-pressed', String(view.truth === 'identity'));
      if (names.has('truth')) this.update();
    });
  }

  async add(files) {
    const scene = this.scene();
    if (!scene.source || !scene.target) return this.failed(new Error('Choose a source and a target first.'));
    for (const file of files) {
      try {
        const numbers = readVertices(file.name, await file.arrayBuffer());
        const taken = new Set(this.files.map(({role}) => role));
        this.files.push({name: file.name, numbers, role: guessRole(file.name, numbers, scene, taken)});
      } catch (error) {
        this.failed(error);
      }
    }
    this.store.set({truth: ''});
    return this.update();
  }

  known() {
    if (this.store.view.truth === 'identity') return {truth: 'identity', base: 0};
    return truthOf(Object.fromEntries(this.files.map(({role, numbers}) => [role, numbers])));
  }

  /** After a change of the files, of the pair or of its map. */
  async update() {
    const turn = ++this.turn;
    this.showFiles();
    const {source, map} = this.scene();
    try {
      const known = map ? this.known() : null;
      this.changed(known ? truthArray(known, source.places.length / 3) : null);
      if (!known) return this.result.replaceChildren(this.files.length ? h('p', {class: 'hint', text: 'A list for the other shape is missing.'}) : '');
      this.result.replaceChildren(h('p', {class: 'hint', text: 'Measuring …'}));
      const {src, tgt, candidate, orientation, refine, method} = this.store.view;
      const evaluation = await api.evaluate({src, tgt, candidate, orientation, refine, method, ...known, both: false, biharmonic: false});
      if (turn === this.turn) this.show(evaluation);
    } catch (error) {
      if (turn !== this.turn) return;
      this.result.replaceChildren();
      this.failed(error);
    }
  }

  showFiles() {
    this.list.replaceChildren(...this.files.map((file, k) => {
      const role = h('select', {'aria-label': `What ${file.name} is`, on: {change: () => {
        file.role = role.value;
        this.update();
      }}}, ...ROLES.map(([value, text]) => h('option', {value, text})));
      role.value = file.role;
      return h('li', {data: {name: file.name, role: file.role}}, h('span', {text: file.name, title: `${file.name}: ${file.numbers.length} vertices`}), role,
        h('button', {type: 'button', class: 'bare', 'aria-label': `Remove ${file.name}`, on: {click: () => {
          this.files.splice(k, 1);
          this.update();
        }}}, icon('close')));
    }));
  }

  show({geodesic, mirrored, thresholds, coverage, continuity}) {
    const curves = [...(mirrored?.curve ? [{values: mirrored.curve, kind: 'second'}] : []), {values: geodesic.curve, kind: 'first'}];
    const percent = (value) => `${number(value * 100)} %`;
    const rows = [['Mean error', percent(geodesic.mean)], ['Median', percent(geodesic.median)], ['95th percentile', percent(geodesic.p95)], ['Largest', percent(geodesic.max)],
      ['Area under the curve', number(geodesic.auc)], ['Scored', number(geodesic.scored)], ['Area covered', percent(coverage.area)], ['Torn edges', `${number(continuity.torn)} of ${number(continuity.edges)}`]];
    const description = `Share of errors below a threshold; mean ${percent(geodesic.mean)} of the square root of the area`;
    this.result.replaceChildren(curveFigure(thresholds, curves, description),
      h('dl', {class: 'figures'}, ...rows.flatMap(([name, value]) => [h('dt', {text: name}), h('dd', {text: value, data: {figure: name.toLowerCase()}})])),
      h('p', {class: 'hint', text: `Per cent of √area along the surface.${mirrored?.curve ? ' Dashed: against left and right exchanged.' : ''}`}));
    this.result.dataset.mean = String(geodesic.mean);
    announce(description);
  }
}
