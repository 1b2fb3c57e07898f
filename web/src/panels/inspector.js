// Points under the pointer and pinned points: their images, with indices, weights, distances and confidence, and their markers.

import * as workspace from '../workspace.js';
import {announce, h, icon, number} from '../dom.js';
import {imageOf, pointOf, row} from '../map/correspondence.js';
import {MAX_PINS, matchQuery} from '../state.js';

const COLOURS = ['#e8483f', '#2f7ed8', '#e0a100', '#24966b', '#9a55d4', '#d65ea0', '#00899e', '#b0651d', '#5b6bd6', '#7a8c1e', '#c2415d', '#4d7c8a'];
const other = (side) => (side === 'source' ? 'target' : 'source');

export class Inspector {
  constructor(element, stage, store, presenter) {
    Object.assign(this, {element, stage, store, presenter, hovered: null});
    this.list = h('ul', {class: 'points', 'aria-live': 'off'});
    this.input = h('input', {type: 'number', min: 0, id: 'vertex', placeholder: 'vertex', 'aria-label': 'Vertex number'});
    this.side = h('select', {id: 'vertex-side', 'aria-label': 'Side of the vertex'}, h('option', {value: 'source', text: 'source'}), h('option', {value: 'target', text: 'target'}));
    this.form = h('form', {class: 'goto', on: {submit: (event) => this.goTo(event)}}, h('label', {for: 'vertex', text: 'Go to'}), this.side, this.input, h('button', {type: 'submit', text: 'Show'}));
    this.clearing = h('button', {type: 'button', class: 'quiet', text: 'Clear points', hidden: true, on: {click: () => store.set({pins: []})}});
    this.hint = h('p', {class: 'hint', text: 'Click a point on either shape to see its image; shift-click keeps more.'});
    element.replaceChildren(h('div', {class: 'inspector-head'}, this.form, this.clearing), this.hint, this.list);
    store.subscribe((view, changed) => {
      if (['pins', 'src', 'tgt', 'form', 'morph', 'align', 'symmetry'].some((name) => changed.has(name))) this.refresh();
    });
  }

  goTo(event) {
    event.preventDefault();
    const vertex = Number(this.input.value);
    if (this.input.value !== '') this.pick(this.side.value, vertex, false);
  }

  pick(side, vertex, more) {
    const shape = this.presenter.scene[side];
    if (vertex === null || !shape || vertex >= shape.places.length / 3) {
      if (!more) this.store.set({pins: []});
      return;
    }
    const pins = this.store.view.pins;
    this.store.set({pins: more ? [...pins, {side, vertex}].slice(-MAX_PINS) : [{side, vertex}]});
    this.spoken = true;
  }

  hover(side, vertex) {
    const before = this.hovered;
    this.hovered = vertex === null ? null : {side, vertex};
    if (before?.side !== this.hovered?.side || before?.vertex !== this.hovered?.vertex) this.refresh();
  }

  /** The map in the direction in which a side's vertices are its rows. */
  async mapFrom(side) {
    const {scene} = this.presenter;
    if (!scene.map) return null;
    if (side === 'source') return scene.map;
    return workspace.map(matchQuery(this.store.view, true));
  }

  async describe(point) {
    const {scene} = this.presenter;
    const shape = scene[point.side];
    if (!shape || point.vertex >= shape.places.length / 3) return null;
    const map = await this.mapFrom(point.side);
    const place = row(map, point.vertex);
    const view = this.store.view;
    if (place && point.side === 'source') {
      const known = await workspace.quality(matchQuery(view)).catch(() => null);
      if (known) Object.assign(place, {confidence: known.confidence[point.vertex], distortion: known.distortion[point.vertex]});
    }
    const mirror = view.symmetry ? await workspace.symmetry(shape.id).then((symmetry) => row(symmetry, point.vertex), () => null) : null;
    return {...point, shape, target: scene[other(point.side)], place, mirror, mapped: Boolean(map)};
  }

  async refresh() {
    const turn = (this.turn = (this.turn ?? 0) + 1);
    const {pins} = this.store.view;
    const isPinned = this.hovered && pins.some((pin) => pin.side === this.hovered.side && pin.vertex === this.hovered.vertex);
    const points = [...pins.map((pin, k) => ({...pin, colour: COLOURS[k % COLOURS.length], kind: 'pin'})), ...(this.hovered && !isPinned ? [{...this.hovered, colour: '#8a8f98', kind: 'hover'}] : [])];
    const described = (await Promise.all(points.map((point) => this.describe(point).catch(() => null)))).filter(Boolean);
    if (turn !== this.turn) return;
    this.showMarkers(described);
    this.list.replaceChildren(...described.map((point) => this.entry(point)));
    this.clearing.hidden = pins.length === 0;
    this.hint.hidden = described.length > 0;
    this.element.dataset.points = String(described.length);
    if (this.spoken && described[0]?.place) announce(`Vertex ${described[0].vertex} of the ${described[0].side} lies at vertex ${described[0].place.vertex}.`);
    this.spoken = false;
  }

  showMarkers(points) {
    const markers = {source: [], target: []};
    const spot = (vertex) => ({corners: [vertex, vertex, vertex], bary: [1, 0, 0]});
    for (const {side, vertex, place, mirror, colour, kind} of points) {
      markers[side].push({...spot(vertex), vertex, label: String(vertex), colour, kind: `${kind} own`});
      if (place) markers[other(side)].push({...place, vertex: place.vertex, label: String(place.vertex), colour, kind: `${kind} image`});
      if (mirror) markers[side].push({...mirror, vertex: mirror.vertex, label: `${mirror.vertex} ⇄`, colour, kind: `${kind} mirror`});
    }
    for (const side of ['source', 'target']) this.stage.setMarkers(side, markers[side]);
  }

  entry({side, vertex, colour, kind, shape, target, place, mirror, mapped}) {
    const dot = h('span', {class: 'dot', 'aria-hidden': 'true'});
    dot.style.background = colour;
    const data = {side, vertex, kind};
    const facts = [h('div', {}, h('b', {text: `${side} ${vertex}`}), coordinates(pointOf(shape.positions, vertex)))];
    if (place) {
      Object.assign(data, {image: place.vertex, corners: place.corners.join(','), bary: place.bary.join(',')});
      const image = imageOf(place, target.positions);
      const corner = pointOf(target.positions, place.vertex);
      const gap = Math.hypot(...image.map((value, k) => value - corner[k]));
      data.gap = gap;
      facts.push(h('div', {}, h('b', {text: `${other(side)} ${place.vertex}`}), coordinates(image)));
      facts.push(h('div', {class: 'weights', title: 'The image lies between these vertices, with these weights'},
        ...place.corners.map((corner, c) => h('span', {text: `${corner} × ${place.bary[c].toFixed(3)}`}))));
      facts.push(h('div', {class: 'more'}, h('span', {title: 'From the image to its nearest vertex', text: `${number(gap)} to the vertex`}),
        this.errorOf(side, vertex, image, target),
        Number.isFinite(place.confidence) && place.confidence !== null && h('span', {class: 'confidence', text: `confidence ${(100 * place.confidence).toFixed(0)} %`}),
        Number.isFinite(place.distortion) && place.distortion !== null && h('span', {text: `distortion ${number(place.distortion, 2)}`})));
    } else if (mapped) {
      facts.push(h('div', {class: 'more', text: 'Dropped by repair: it has no image.'}));
    }
    if (mirror) facts.push(h('div', {class: 'more', text: `mirror image: vertex ${mirror.vertex}`}));
    const remove = kind === 'pin' && h('button', {type: 'button', class: 'bare', 'aria-label': `Remove point ${vertex}`, title: 'Remove', on: {click: () => this.unpin(side, vertex)}}, icon('close'));
    return h('li', {class: `point ${kind}`, data}, dot, h('div', {class: 'facts'}, ...facts), remove);
  }

  /** How far the image is from where the ground truth has it. */
  errorOf(side, vertex, image, target) {
    const truth = this.presenter.truth;
    if (side !== 'source' || !truth || truth[vertex] < 0) return null;
    const place = pointOf(target.positions, truth[vertex]);
    const error = Math.hypot(...image.map((value, k) => value - place[k]));
    return h('span', {class: 'error', title: 'Straight distance to the true place, and that over the square root of the area', text: `error ${number(error)} (${number(100 * error * target.scale, 2)} %)`});
  }

  unpin(side, vertex) {
    this.store.set({pins: this.store.view.pins.filter((pin) => pin.side !== side || pin.vertex !== vertex)});
  }
}

function coordinates(point) {
  return h('span', {class: 'coordinates', text: point.map((value) => number(value, 4)).join(', ')});
}
