// Puts the page together: the view in the address, the gallery, the stage, and the panels around it.

import {Problem, api, onUnauthorized} from './api.js';
import {announce, debounced, h, icon} from './dom.js';
import {Gallery} from './gallery.js';
import {Presenter} from './present.js';
import {Store, defaults, matchQuery, readAddress, writeAddress} from './state.js';
import * as workspace from './workspace.js';
import {MESH} from './upload.js';
import {Stage, hasWebGl} from './view/stage.js';
import {formSection, mapSection, paintSection} from './panels/controls.js';
import {Inspector} from './panels/inspector.js';
import {showLegend} from './panels/legend.js';

const byId = (id) => document.getElementById(id);
const store = new Store(readAddress(location.hash));

function notice(text, problem) {
  const element = byId('notice');
  element.replaceChildren(h('span', {text}), h('button', {type: 'button', class: 'bare', 'aria-label': 'Dismiss', on: {click: () => (element.hidden = true)}}, icon('close')));
  element.dataset.code = problem?.code ?? '';
  element.hidden = false;
}

function failed(error) {
  if (error instanceof Problem) notice(`${error.problem.title ?? 'Problem'}: ${error.message}`, error.problem);
  else {
    console.error(error);
    notice(error.message);
  }
}

const map = mapSection(store);
byId('panel').append(paintSection(store), formSection(store), map.element);

const gallery = new Gallery(store, {
  choose: (side, shape) => store.set({[side === 'source' ? 'src' : 'tgt']: shape.id, candidate: 0, pins: [], camera: null, camera2: null}),
  uploaded: (shape) => {
    // The first two of a new session are looked at at once.
    if (!store.view.src) store.set({src: shape.id});
    else if (!store.view.tgt && shape.id !== store.view.src) store.set({tgt: shape.id});
  },
  removed: (id) => {
    workspace.forget(id);
    if (store.view.src === id) store.set({src: '', pins: []});
    if (store.view.tgt === id) store.set({tgt: '', pins: []});
  },
  explain: (file, problem) => notice(problem.detail, problem),
  failed,
});

let inspector = null;
let stage = null;
if (hasWebGl()) {
  stage = new Stage(byId('stage'), {
    hover: (side, vertex) => inspector.hover(side, vertex),
    pick: (side, vertex, more) => inspector.pick(side, vertex, more),
    moved: debounced(() => store.set({camera: stage.cameras.source.toArray(), camera2: store.view.linked ? null : stage.cameras.target.toArray()}), 150),
  });
  const presenter = new Presenter(stage, store, {
    busy: (text) => {
      byId('busy').textContent = text;
      byId('busy').hidden = !text;
    },
    failed: (what, error) => {
      byId('busy').hidden = true;
      byId('stage').dataset.state = 'failed';
      failed(error);
    },
    legend: (legend) => showLegend(byId('legend'), store, legend),
    arrived,
  });
  inspector = new Inspector(byId('inspector'), stage, store, presenter);
  presenter.update(store.view, new Set(Object.keys(defaults())));
}

async function arrived(scene) {
  for (const side of ['source', 'target']) {
    document.querySelector(`.pane.${side} .name`).textContent = scene[side] ? scene[side].info.name || scene[side].id.slice(0, 8) : '';
  }
  byId('welcome').hidden = Boolean(scene.source && scene.target);
  inspector.refresh();
  if (!scene.map) return map.clear();
  const query = matchQuery(store.view);
  const figures = await workspace.matchFigures(query);
  if (String(query) === String(matchQuery(store.view))) map.show(figures);
}

store.subscribe((view) => {
  const address = writeAddress(view);
  if (address !== location.hash) history.replaceState(null, '', address || location.pathname);
});
addEventListener('hashchange', () => store.set(readAddress(location.hash)));

byId('swap').append(icon('swap'));
byId('home').append(icon('home'));
byId('swap').addEventListener('click', () => {
  const turned = store.view.pins.map(({side, vertex}) => ({side: side === 'source' ? 'target' : 'source', vertex}));
  store.set({src: store.view.tgt, tgt: store.view.src, pins: turned, candidate: 0, camera: null, camera2: null});
});
byId('files').addEventListener('change', (event) => {
  gallery.send(event.target.files);
  event.target.value = '';
});

addEventListener('dragover', (event) => {
  event.preventDefault();
  document.body.classList.add('dragging');
});
addEventListener('dragleave', (event) => {
  if (!event.relatedTarget) document.body.classList.remove('dragging');
});
addEventListener('drop', (event) => {
  event.preventDefault();
  document.body.classList.remove('dragging');
  const files = [...event.dataTransfer.files];
  gallery.send(files.filter(({name}) => MESH.test(name)));
});

gallery.load();
