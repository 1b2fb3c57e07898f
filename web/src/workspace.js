// What the server has told of shapes and maps. Each thing is asked for once, when it is first needed, and the latest few are kept.

import {abilities, api} from './api.js';
import {pullBack} from './map/correspondence.js';
import {boundingBox, measure, normalised, radiusOf} from './map/geometry.js';

/** Keeps the promises of the last `size` keys; a failed one is forgotten, so that asking again tries again. */
class Kept {
  constructor(size) {
    this.size = size;
    this.entries = new Map();
  }

  get(key, make) {
    let promise = this.entries.get(key);
    if (!promise) {
      promise = make();
      promise.catch(() => this.entries.delete(key));
    }
    this.entries.delete(key);
    this.entries.set(key, promise);
    if (this.entries.size > this.size) this.entries.delete(this.entries.keys().next().value);
    return promise;
  }
}

const shapes = new Kept(8);
const spheres = new Kept(8);
const signatures = new Kept(8);
const symmetries = new Kept(4);
const maps = new Kept(12);
const figures = new Kept(24);
const extras = new Kept(12);

/** {id, info, positions, normals, index, places, area, centre, scale, radius, box} */
export function shape(id) {
  return shapes.get(id, async () => {
    const [info, mesh] = await Promise.all([api.shape(id), api.mesh(id)]);
    const size = measure(mesh);
    const places = normalised(mesh.positions, size);
    return {id, info, ...mesh, ...size, places, radius: radiusOf(places), box: boundingBox(mesh.positions)};
  });
}

export const sphere = (id) => spheres.get(id, () => api.sphere(id));

/** {times, grids: Float32Array[], n} */
export function signature(id) {
  return signatures.get(id, async () => {
    const {times, grids} = await api.signatures(id);
    const [count, n] = grids.shape;
    return {times: times.data, n, grids: Array.from({length: count}, (_, t) => grids.data.subarray(t * n * n, (t + 1) * n * n))};
  });
}

/** The arrays of GET /match: {vertex, corners, bary, and where the server gives them confidence and distortion}. */
export function map(query) {
  return maps.get(String(query), async () => plainArrays(await api.map(query)));
}

function plainArrays(arrays) {
  return Object.fromEntries(Object.entries(arrays).map(([name, {data}]) => [name, data]));
}

export const matchFigures = (query) => figures.get(String(query), () => api.figures(query));

/**
 * `confidence` and `distortion` of each source vertex, in the map where the archive has them, else asked for by name.
 * @returns {{confidence, distortion}|null} null where the server does not know them
 */
export function quality(query) {
  return extras.get(String(query), async () => {
    const known = await map(query);
    if (known.confidence && known.distortion) return known;
    if (!(await abilities()).quality) return null;
    const {confidence, distortion} = await api.fields(query, 'confidence,distortion');
    const numbers = (values) => Float32Array.from(values, (value) => value ?? NaN);
    return {confidence: numbers(confidence), distortion: numbers(distortion)};
  });
}

/** The values of `format` that GET /match takes. */
let formats = null;
export const matchFormats = () => (formats ??= api.version().then((version) => version.formats.match));

/** Left to right on one shape: {vertex, images (normalised), distance, involution}. */
export function symmetry(id) {
  return symmetries.get(id, async () => {
    const [own, arrays] = await Promise.all([shape(id), api.symmetry(id)]);
    const mapped = plainArrays(arrays);
    const images = pullBack(mapped, own.places);
    const distance = new Float32Array(own.places.length / 3);
    for (let i = 0; i < distance.length; ++i) {
      const gap = Math.hypot(...[0, 1, 2].map((k) => images[3 * i + k] - own.places[3 * i + k]));
      distance[i] = Number.isFinite(gap) ? gap : 1;
    }
    return {...mapped, images, distance};
  });
}

/** Forgets what was known of a removed shape. */
export function forget(id) {
  for (const kept of [shapes, spheres, signatures, symmetries, maps, figures, extras]) {
    for (const key of [...kept.entries.keys()]) if (key.includes(id)) kept.entries.delete(key);
  }
}
