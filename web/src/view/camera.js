// Where the eye is: an orientation without a preferred upright, a zoom, and a shift. Drags, wheel, pinches and keys change it.
import {Quaternion, Vector3} from 'three';

export class Camera {
  constructor() {
    this.turn = new Quaternion();
    this.zoom = 1;
    this.shift = [0, 0];
  }

  /** The seven numbers that the address holds. */
  toArray() {
    return [...this.turn.toArray(), this.zoom, ...this.shift];
  }

  set([x, y, z, w, zoom, right, up]) {
    this.turn.set(x, y, z, w).normalize();
    this.zoom = zoom;
    this.shift = [right, up];
    return this;
  }

  /** Turns by angles around the screen's axes: to the right and downwards are positive. */
  rotate(right, down) {
    const angle = Math.hypot(right, down);
    if (angle === 0) return;
    this.turn.premultiply(new Quaternion().setFromAxisAngle(new Vector3(down / angle, right / angle, 0), angle)).normalize();
  }

  roll(angle) {
    this.turn.premultiply(new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), angle)).normalize();
  }

  scale(factor) {
    this.zoom = Math.min(40, Math.max(0.2, this.zoom * factor));
  }

  move(right, up) {
    this.shift = [this.shift[0] + right, this.shift[1] + up];
  }
}

const KEYS = {
  ArrowLeft: (camera, step) => camera.rotate(-step, 0),
  ArrowRight: (camera, step) => camera.rotate(step, 0),
  ArrowUp: (camera, step) => camera.rotate(0, -step),
  ArrowDown: (camera, step) => camera.rotate(0, step),
  '+': (camera) => camera.scale(1.15),
  '=': (camera) => camera.scale(1.15),
  '-': (camera) => camera.scale(1 / 1.15),
  '[': (camera, step) => camera.roll(step),
  ']': (camera, step) => camera.roll(-step),
};

/**
 * Lets a pane's pointer and keys move a camera. `camera()` names it; `changed()` is called after each step, `hover(event)` and
 * `click(event)` for what is no drag, `leave()` when the pointer goes.
 */
export function control(pane, {camera, changed, hover, click, leave}) {
  const pointers = new Map();
  let travelled = 0;
  const turnBy = 0.008;

  pane.addEventListener('pointerdown', (event) => {
    if (event.target.closest('button')) return;
    pane.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
    if (pointers.size === 1) travelled = 0;
  });
  pane.addEventListener('pointermove', (event) => {
    const before = pointers.get(event.pointerId);
    if (!before) {
      if (event.pointerType !== 'touch') hover(event);
      return;
    }
    const step = [event.clientX - before[0], event.clientY - before[1]];
    travelled += Math.hypot(...step);
    if (pointers.size === 2) pinch(event, before);
    else if (travelled > 3) drag(event, step);
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
  });
  const drag = (event, [right, down]) => {
    const unit = 1 / pane.clientHeight / camera().zoom;
    if (event.shiftKey || event.ctrlKey || event.buttons & 6) camera().move(right * unit, -down * unit);
    else camera().rotate(right * turnBy, down * turnBy);
    changed();
  };
  const pinch = (event, before) => {
    const other = [...pointers].find(([id]) => id !== event.pointerId)[1];
    const now = [event.clientX, event.clientY];
    const span = (point) => Math.hypot(point[0] - other[0], point[1] - other[1]) || 1;
    const unit = 0.5 / pane.clientHeight / camera().zoom;
    camera().scale(span(now) / span(before));
    camera().move((now[0] - before[0]) * unit, -(now[1] - before[1]) * unit);
    changed();
  };
  const lift = (event) => {
    if (!pointers.delete(event.pointerId)) return;
    if (event.type === 'pointerup' && travelled <= 3 && pointers.size === 0 && event.button === 0) click(event);
  };
  pane.addEventListener('pointerup', lift);
  pane.addEventListener('pointercancel', lift);
  pane.addEventListener('pointerleave', leave);
  pane.addEventListener('contextmenu', (event) => event.preventDefault());
  pane.addEventListener('wheel', (event) => {
    event.preventDefault();
    camera().scale(Math.exp(-Math.sign(event.deltaY) * Math.min(0.25, Math.abs(event.deltaY) * 0.002)));
    changed();
  }, {passive: false});
  pane.addEventListener('keydown', (event) => {
    const move = KEYS[event.key];
    if (!move || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    move(camera(), 0.12);
    changed();
  });
}
