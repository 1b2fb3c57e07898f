// Puts the page together: the view in the address, the gallery, the stage, and the panels around it.

import {Problem, onUnauthorized} from './api.js';
import {debounced, h, icon} from './dom.js';
import {askForKey, openHelp} from './dialog.js';
import {Gallery} from './gallery.js';
import {listen} from './keyboard.js';
import {Presenter} from './present.js';
import {explain} from './problems.js';
import {Store, defaults, matchQuery, readAddress, writeAddress} from './state.js';
import * as workspace from './workspace.js';
import {TRUTH} from './upload.js';
import {Stage, hasWebGl} from './view/stage.js';
import {copyText, exportSection} from './panels/export.js';
import {formSection, mapSection, paintSection} from './panels/controls.js';
import {Inspector} from './panels/inspector.js';
import {showLegend} from './panels/legend.js';
import {TruthPanel} from './panels/truth.js';

const byId = (id) => document.getElementById(id);
const store = new Store(readAddress(location.hash));
onUnauthorized((message) => askForKey(message));

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

let presenter = null;
let inspector = null;
let stage = null;
const map = mapSection(store);
const truth = new TruthPanel(store, () => presenter?.scene ?? {}, {changed: (known) => {
  presenter?.setTruth(known);
  inspector?.refresh();
}, failed});
const exports = exportSection(store);
byId('panel').append(paintSection(store), formSection(store), map.element, truth.element, exports.element);

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
  explain,
  failed,
});

if (hasWebGl()) {
  stage = new Stage(byId('stage'), {
    hover: (side, vertex) => inspector.hover(side, vertex),
    pick: (side, vertex, more) => inspector.pick(side, vertex, more),
    moved: debounced(() => store.set({camera: stage.cameras.source.toArray(), camera2: store.view.linked ? null : stage.cameras.target.toArray()}), 150),
  });
  presenter = new Presenter(stage, store, {
    busy: (text) => {
      byId('busy').textContent = text;
      byId('busy').hidden = !text;
    },
    failed: (what, error) => {
      byId('busy').hidden = true;
      // A paint or a form that is not to be had leaves the match as it is.
      if (what === 'shape' || what === 'match') byId('stage').dataset.state = 'failed';
      failed(error);
    },
    legend: (legend) => showLegend(byId('legend'), store, legend),
    arrived,
  });
  inspector = new Inspector(byId('inspector'), stage, store, presenter);
  presenter.update(store.view, new Set(Object.keys(defaults())));
} else {
  withoutWebGl();
}

/** The gallery and the server's own picture of the match still work. */
function withoutWebGl() {
  const place = byId('stage');
  place.dataset.state = 'no-webgl';
  const told = h('div', {class: 'fallback', id: 'no-webgl'});
  place.querySelectorAll('canvas, .pane, .welcome').forEach((part) => (part.hidden = true));
  byId('home').hidden = true;
  place.append(told);
  const show = (view) => {
    const picture = view.src && view.tgt ? h('img', {src: `/match?${matchQuery(view)}&format=png`, alt: 'Both shapes, corresponding points in one colour', width: 1200, height: 600}) : '';
    told.replaceChildren(h('h2', {text: 'This browser does not show WebGL'}),
      h('p', {text: 'Shapes cannot be turned or clicked on here. Uploads, maps and downloads work all the same, and the server draws a picture of each match.'}), picture);
  };
  store.subscribe((view, changed) => {
    if (changed.has('src') || changed.has('tgt') || changed.has('candidate')) show(view);
  });
  show(store.view);
}

async function arrived(scene) {
  for (const side of ['source', 'target']) {
    document.querySelector(`.pane.${side} .name`).textContent = scene[side] ? scene[side].info.name || scene[side].id.slice(0, 8) : '';
  }
  const names = ['source', 'target'].map((side) => scene[side]?.info.name).filter(Boolean);
  document.title = [names.join(' → '), 'Spherematch'].filter(Boolean).join(' · ');
  byId('welcome').hidden = Boolean(scene.source && scene.target);
  inspector.refresh();
  exports.update(scene);
  if (!scene.map) return map.clear();
  truth.update();
  const query = matchQuery(store.view);
  try {
    const figures = await workspace.matchFigures(query);
    if (String(query) === String(matchQuery(store.view))) map.show(figures);
  } catch (error) {
    failed(error);
  }
}

/** Another pair is a step to come back from; anything else changes the address in place. */
function keepAddress(step) {
  const address = writeAddress(store.view);
  if (address !== location.hash) history[step ? 'pushState' : 'replaceState'](null, '', address || location.pathname);
}

const keepAddressLater = debounced(() => keepAddress(false), 120);
const CONTINUOUS = ['morph', 'camera', 'camera2', 'time'];
store.subscribe((view, changed) => {
  // Browsers allow only so many changes in a while.
  if ([...changed].every((name) => CONTINUOUS.includes(name))) keepAddressLater();
  else keepAddress(location.hash !== '' && (changed.has('src') || changed.has('tgt')));
});
addEventListener('hashchange', () => store.set(readAddress(location.hash)));

byId('swap').append(icon('swap'));
byId('home').append(icon('home'));
byId('drop').querySelector('.drop-mark').append(icon('upload'));
byId('share').addEventListener('click', (event) => copyText(location.href, event.currentTarget));
byId('help').addEventListener('click', openHelp);
byId('swap').addEventListener('click', swap);
byId('home').addEventListener('click', home);
listen(store, {swap, home, morph});

function home() {
  store.set({camera: null, camera2: null});
  presenter?.lookFromBroadSide();
  stage?.draw();
}

/** To the image and back, in about a second. */
function morph() {
  const goal = store.view.morph < 0.5 ? 1 : 0;
  const from = store.view.morph;
  const began = performance.now();
  const step = (now) => {
    const share = Math.min(1, (now - began) / 900);
    store.set({morph: from + (goal - from) * (share * share * (3 - 2 * share)), form: 'surface'});
    if (share < 1) requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}

function swap() {
  const turned = store.view.pins.map(({side, vertex}) => ({side: side === 'source' ? 'target' : 'source', vertex}));
  store.set({src: store.view.tgt, tgt: store.view.src, pins: turned, candidate: 0, camera: null, camera2: null});
}
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
  const known = files.filter(({name}) => TRUTH.test(name));
  if (known.length > 0) truth.add(known);
  gallery.send(files.filter((file) => !known.includes(file)));
});

gallery.load();
