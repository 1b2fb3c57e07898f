// Two panes over one canvas: each shows a surface with its own part of the canvas, its own camera or the common one, and its markers.
import {Group, PerspectiveCamera, Quaternion, Ray, Scene, Vector3, WebGLRenderer} from 'three';
import {h} from '../dom.js';
import {Camera, control} from './camera.js';

const FIELD_OF_VIEW = 24;
export const SIDES = ['source', 'target'];

/** Whether the browser can draw in three dimensions at all. */
export function hasWebGl() {
  try {
    return Boolean(document.createElement('canvas').getContext('webgl2'));
  } catch {
    return false;
  }
}

export class Stage {
  /** `events`: {hover(side, vertex|null), pick(side, vertex, more), moved()} */
  constructor(root, events) {
    this.root = root;
    this.canvas = root.querySelector('canvas');
    this.renderer = new WebGLRenderer({canvas: this.canvas, antialias: true, alpha: true});
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setScissorTest(true);
    this.events = events;
    this.linked = true;
    this.cameras = {source: new Camera(), target: new Camera()};
    this.panes = {};
    for (const side of SIDES) this.panes[side] = this.makePane(side);
    this.wanted = false;
    new ResizeObserver(() => this.draw()).observe(root);
    this.canvas.addEventListener('webglcontextrestored', () => this.draw());
  }

  makePane(side) {
    const element = this.root.querySelector(`.pane.${side}`);
    const scene = new Scene();
    const group = new Group();
    scene.add(group);
    const pane = {element, scene, group, eye: new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.01, 100), surface: null, markers: [], overlay: element.querySelector('.markers')};
    let waiting = null;
    control(element, {
      camera: () => this.cameraOf(side),
      changed: () => {
        this.draw();
        this.events.moved();
      },
      // At most one search per frame.
      hover: (event) => {
        if (!waiting) requestAnimationFrame(() => {
          const at = waiting;
          waiting = null;
          if (at) this.events.hover(side, this.vertexAt(side, at.clientX, at.clientY));
        });
        waiting = event;
      },
      click: (event) => this.events.pick(side, this.vertexAt(side, event.clientX, event.clientY), event.shiftKey),
      leave: () => {
        waiting = null;
        this.events.hover(side, null);
      },
    });
    return pane;
  }

  cameraOf(side) {
    return this.cameras[this.linked ? 'source' : side];
  }

  setSurface(side, surface, radius) {
    const pane = this.panes[side];
    if (pane.surface && pane.surface !== surface) {
      pane.group.remove(pane.surface.mesh);
      pane.surface.drop();
    }
    pane.surface = surface;
    pane.radius = radius;
    if (surface) pane.group.add(surface.mesh);
    this.draw();
  }

  /** Markers of one side: [{corners, bary, label, colour, kind}]. */
  setMarkers(side, markers) {
    const pane = this.panes[side];
    pane.overlay.replaceChildren();
    pane.markers = markers.map((marker) => {
      const element = h('div', {class: `marker ${marker.kind}`, data: {vertex: marker.vertex, kind: marker.kind}}, h('span', {text: marker.label}));
      element.style.setProperty('--marker', marker.colour);
      pane.overlay.append(element);
      return {...marker, element};
    });
    this.draw();
  }

  /** Draws once, in the next frame. */
  draw() {
    if (this.wanted) return;
    this.wanted = true;
    requestAnimationFrame(() => {
      if (this.wanted) this.drawNow();
    });
  }

  drawNow() {
    this.wanted = false;
    const {width, height} = this.root.getBoundingClientRect();
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    for (const side of SIDES) this.drawPane(side, this.place(side));
    this.root.dataset.frames = String(Number(this.root.dataset.frames ?? 0) + 1);
  }

  /** A pane's rectangle within the canvas, in CSS pixels from the lower left corner. */
  place(side) {
    const outer = this.root.getBoundingClientRect();
    const inner = this.panes[side].element.getBoundingClientRect();
    return {left: inner.left - outer.left, bottom: outer.bottom - inner.bottom, width: inner.width, height: inner.height};
  }

  drawPane(side, {left, bottom, width, height}) {
    const pane = this.panes[side];
    this.renderer.setViewport(left, bottom, width, height);
    this.renderer.setScissor(left, bottom, width, height);
    this.renderer.clear();
    if (!pane.surface || width === 0 || height === 0) return;
    this.aim(side, width / height);
    this.renderer.render(pane.scene, pane.eye);
    this.placeMarkers(pane, width, height);
  }

  /** Sets a pane's eye: it looks along -z from a distance at which the larger of both shapes fits. */
  aim(side, aspect) {
    const pane = this.panes[side];
    const camera = this.cameraOf(side);
    const radius = Math.max(...SIDES.map((name) => this.panes[name].radius ?? 0)) || 1;
    const half = Math.tan((FIELD_OF_VIEW * Math.PI) / 360);
    const distance = (radius * 1.02) / half / Math.min(1, aspect);
    pane.group.quaternion.copy(camera.turn);
    pane.eye.aspect = aspect;
    // Zooming narrows the view, so that the eye never enters a shape.
    pane.eye.zoom = camera.zoom;
    pane.eye.near = Math.max(0.01, distance - 4 * radius);
    pane.eye.far = distance + 4 * radius;
    const span = 2 * half * distance;
    pane.eye.position.set(-camera.shift[0] * span, -camera.shift[1] * span, distance);
    pane.eye.updateProjectionMatrix();
    pane.eye.updateMatrixWorld();
    pane.group.updateMatrixWorld(true);
  }

  placeMarkers(pane, width, height) {
    for (const marker of pane.markers) {
      const world = pane.surface.drawnPoint(marker.corners, marker.bary).applyQuaternion(pane.group.quaternion);
      // A morph under way would need a new search tree for every step.
      const hidden = !pane.surface.isMorphing && this.isHidden(pane, world);
      const screen = world.project(pane.eye);
      const [x, y] = [((screen.x + 1) / 2) * width, ((1 - screen.y) / 2) * height];
      marker.element.style.transform = `translate(${x.toFixed(2)}px, ${y.toFixed(2)}px)`;
      marker.element.classList.toggle('hidden', hidden);
      Object.assign(marker.element.dataset, {x: x.toFixed(2), y: y.toFixed(2), hidden: String(hidden)});
    }
  }

  isHidden(pane, world) {
    const toEye = pane.eye.position.clone().sub(world);
    const distance = toEye.length();
    const hit = pane.surface.meet(this.localRay(pane, pane.eye.position, toEye.negate().normalize()));
    return hit !== null && hit.distance < distance - 0.01;
  }

  localRay(pane, origin, direction) {
    const back = new Quaternion().copy(pane.group.quaternion).invert();
    return new Ray(origin.clone().applyQuaternion(back), direction.clone().applyQuaternion(back));
  }

  /** The vertex nearest to what lies under a place of the window, or null. */
  vertexAt(side, x, y) {
    const pane = this.panes[side];
    if (!pane.surface) return null;
    const box = pane.element.getBoundingClientRect();
    this.aim(side, box.width / box.height);
    const far = new Vector3(((x - box.left) / box.width) * 2 - 1, 1 - ((y - box.top) / box.height) * 2, 0.5).unproject(pane.eye);
    const ray = this.localRay(pane, pane.eye.position, far.sub(pane.eye.position).normalize());
    return pane.surface.meet(ray)?.vertex ?? null;
  }
}
