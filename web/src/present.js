// Brings the stage to what the view says: fetches what is needed, in the order in which a person wants to see it, and drops work that a
// later change has made pointless.

import {Quaternion} from 'three';
import * as workspace from './workspace.js';
import {announce} from './dom.js';
import {droppedBy, pullBack} from './map/correspondence.js';
import {boundingBox, broadSide, closestRotation, turn} from './map/geometry.js';
import {matchQuery} from './state.js';
import {paintsOf} from './view/paints.js';
import {IDENTITY_MATRIX, IDENTITY_TURN, Surface} from './view/surface.js';

const PAIR = ['src', 'tgt', 'candidate', 'orientation', 'refine', 'method'];
const has = (changed, names) => names.some((name) => changed.has(name));

export class Presenter {
  /** `ui`: {busy(side, text), failed(side, problem), legend(legend), arrived(scene)} */
  constructor(stage, store, ui) {
    this.stage = stage;
    this.store = store;
    this.ui = ui;
    this.scene = {source: null, target: null, map: null, align: IDENTITY_TURN};
    this.surfaces = {source: null, target: null};
    this.truth = null;
    this.sphereRotation = IDENTITY_MATRIX;
    this.generation = 0;
    store.subscribe((view, changed) => this.update(view, changed));
  }

  async update(view, changed) {
    if (has(changed, PAIR)) await this.load(view);
    else if (has(changed, ['paint', 'time'])) await this.paint();
    if (has(changed, ['form', 'morph', 'align', 'symmetry', 'shade', 'wire', 'linked'])) await this.form();
    if (has(changed, ['camera', 'camera2'])) this.aim(view);
  }

  setTruth(truth) {
    this.truth = truth;
    return this.store.view.paint === 'error' ? this.paint() : undefined;
  }

  /** The shapes as soon as each is there, then the map. */
  async load(view) {
    const generation = ++this.generation;
    const started = performance.now();
    this.scene.map = null;
    this.scene.align = IDENTITY_TURN;
    this.stage.root.dataset.state = 'loading';
    const asked = view.src && view.tgt ? workspace.map(matchQuery(view)) : null;
    asked?.catch(() => {});
    try {
      await Promise.all([this.bring('source', view.src, generation), this.bring('target', view.tgt, generation)]);
    } catch (error) {
      if (generation === this.generation) this.ui.failed('shape', error);
      return;
    }
    if (generation !== this.generation) return;
    if (!view.camera) this.lookFromBroadSide();
    this.ui.arrived(this.scene);
    let failed = false;
    try {
      if (asked) {
        this.ui.busy('Matching …');
        this.takeMap(await asked, generation);
      }
    } catch (error) {
      if (generation !== this.generation) return;
      this.ui.failed('match', error);
      failed = true;
    }
    if (generation !== this.generation) return;
    await this.paint();
    await this.form();
    if (generation !== this.generation) return;
    this.ui.busy('');
    this.stage.drawNow();
    Object.assign(this.stage.root.dataset, {state: failed ? 'failed' : this.scene.map ? 'matched' : view.src || view.tgt ? 'shown' : 'empty', milliseconds: String(Math.round(performance.now() - started))});
    this.ui.arrived(this.scene);
    if (this.scene.map) announce('The match is shown.');
  }

  async bring(side, id, generation) {
    if (this.scene[side]?.id === id && id) return;
    if (!id) return this.place(side, null);
    this.ui.busy('Loading …');
    const shape = await workspace.shape(id);
    if (generation === this.generation) this.place(side, shape);
  }

  place(side, shape) {
    this.scene[side] = shape;
    this.surfaces[side] = shape ? new Surface(shape) : null;
    this.stage.setSurface(side, this.surfaces[side], shape?.radius);
  }

  takeMap(map, generation) {
    if (generation !== this.generation) return;
    const {source, target} = this.scene;
    if (map.vertex.length !== source.places.length / 3) throw new Error('the map is of another shape');
    this.scene.map = {...map};
    const images = pullBack(map, target.places);
    this.scene.images = images;
    this.scene.align = new Quaternion(...closestRotation(images, source.places));
    source.box = boundingBox(source.positions, droppedBy(map));
    this.surfaces.source.goal = null;
  }

  /** How the shapes are painted. */
  async paint() {
    const generation = this.generation;
    const view = this.store.view;
    try {
      const paints = await paintsOf(view, this.scene, this.truth);
      if (generation !== this.generation || view.paint !== this.store.view.paint || view.time !== this.store.view.time) return;
      for (const side of ['source', 'target']) this.surfaces[side]?.setPaint(paints[side]);
      this.ui.legend(paints.legend);
      this.stage.root.dataset.paint = view.paint;
      this.stage.draw();
    } catch (error) {
      if (generation === this.generation) this.ui.failed('paint', error);
    }
  }

  /** Surface, sphere or something on the way to the image; edges, light, symmetry. */
  async form() {
    const generation = this.generation;
    const view = this.store.view;
    try {
      await this.fetchForms(view);
    } catch (error) {
      if (generation === this.generation) this.ui.failed('form', error);
    }
    if (generation !== this.generation) return;
    this.stage.linked = view.linked;
    for (const side of ['source', 'target']) {
      const surface = this.surfaces[side];
      if (!surface) continue;
      surface.setForm(view.form === 'sphere' ? 1 : 0, side === 'source' && view.form === 'surface' ? view.morph : 0);
      surface.setTurns(this.turnOf(side, view), side === 'source' ? this.sphereRotation : IDENTITY_MATRIX);
      surface.uniforms.shade.value = view.shade;
      surface.showWires(view.wire);
      surface.showSymmetry(view.symmetry);
    }
    Object.assign(this.stage.root.dataset, {form: view.form, morph: String(view.morph), symmetry: String(view.symmetry), wire: String(view.wire)});
    this.stage.draw();
  }

  turnOf(side, view) {
    if (side === 'target') return view.align ? this.scene.align : IDENTITY_TURN;
    // Where the target is not turned to the source, the source turns to the target while it becomes it.
    if (view.align || view.morph === 0) return IDENTITY_TURN;
    return IDENTITY_TURN.clone().slerp(this.scene.align.clone().conjugate(), view.morph);
  }

  async fetchForms(view) {
    const {source, target, map} = this.scene;
    const surfaces = this.surfaces;
    const shown = [['source', source], ['target', target]].filter(([, shape]) => shape);
    if (view.form === 'sphere') {
      await Promise.all(shown.map(async ([side, shape]) => {
        const surface = surfaces[side];
        if (!surface.sphere) surface.setSphere(await workspace.sphere(shape.id));
      }));
      this.sphereRotation = IDENTITY_MATRIX;
      if (map) this.sphereRotation = await this.candidateRotation(view);
    }
    if (view.morph > 0 && map && !surfaces.source.goal) this.makeGoal();
    if (view.symmetry) {
      await Promise.all(shown.map(async ([side, shape]) => {
        const surface = surfaces[side];
        if (surface.links) return;
        const {distance, images} = await workspace.symmetry(shape.id);
        if (!surface.links) surface.setSymmetry(distance, linkEnds(shape.places, images, distance));
      }));
    }
  }

  async candidateRotation(view) {
    const {candidates} = await workspace.matchFigures(matchQuery(view));
    return candidates.find(({chosen}) => chosen)?.rotation ?? IDENTITY_MATRIX;
  }

  /** The images in the source's frame, so that a morph on the way does not shrink by turning. */
  makeGoal() {
    const {images, map, target, align} = this.scene;
    const turned = (values) => {
      const result = new Float32Array(values.length);
      const q = align.toArray();
      for (let i = 0; i < values.length; i += 3) result.set(turn(q, [values[i], values[i + 1], values[i + 2]]), i);
      return result;
    };
    this.surfaces.source.setGoal(turned(images), turned(pullBack(map, target.normals)));
  }

  aim(view) {
    for (const [side, camera] of [['source', view.camera], ['target', view.camera2]]) {
      if (camera) this.stage.cameras[side].set(camera);
    }
    this.stage.draw();
  }

  lookFromBroadSide() {
    const shape = this.scene.source ?? this.scene.target;
    if (!shape) return;
    const q = broadSide(shape.places);
    for (const side of ['source', 'target']) this.stage.cameras[side].set([...q, 1, 0, 0]);
  }
}

/** A few hundred links between vertices and their mirror images, each once, spread evenly over the vertices. */
function linkEnds(places, images, distance) {
  const step = Math.max(1, Math.floor(distance.length / 140));
  const ends = [];
  for (let i = 0; i < distance.length; i += step) {
    if (distance[i] < 0.05 || distance[i] >= 1.5 || !Number.isFinite(images[3 * i])) continue;
    ends.push(...places.subarray(3 * i, 3 * i + 3), ...images.subarray(3 * i, 3 * i + 3));
  }
  return new Float32Array(ends);
}

