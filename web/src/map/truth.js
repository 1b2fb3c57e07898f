// Ground truth from files: lists of vertices, one a line, of the source and of the target (.vts), or for each source vertex its target
// vertex (.txt, .npy, .json). The body for POST /evaluations comes of it, and the array by which the page colours errors.

import {readNpy} from '../formats/npy.js';

/** @returns {number[]} as the file has them */
export function readVertices(name, buffer) {
  if (/\.npy$/i.test(name)) return Array.from(readNpy(buffer).data);
  const text = new TextDecoder().decode(buffer).trim();
  const numbers = text.startsWith('[') ? JSON.parse(text) : text.split(/[\s,;]+/).map(Number);
  if (!Array.isArray(numbers) || numbers.length === 0 || !numbers.every(Number.isInteger)) throw new Error(`${name} is no list of vertices`);
  return numbers;
}

const stem = (name) => name.replace(/\.[^.]*$/, '').toLowerCase();

/** What a file is taken for at first: `source`, `target`, `mirrored` or `map` (a target vertex for each source vertex). */
export function guessRole(file, numbers, {source, target}, taken) {
  const name = stem(file);
  if (/\.sym$/.test(name)) return 'mirrored';
  if (!/\.vts$/i.test(file) && numbers.length === source.info.vertices) return 'map';
  const [isSource, isTarget] = [source, target].map(({info}) => stem(info.name || '-') === name);
  if (isSource !== isTarget) return isSource ? 'source' : 'target';
  return taken.has('source') ? 'target' : 'source';
}

/** Whether the numbers count from 1: lists do, unless there is a 0; maps do not. */
export function baseOf(roles) {
  if (roles.map) return 0;
  return Object.values(roles).some((numbers) => numbers.includes(0)) ? 0 : 1;
}

/**
 * @param roles {source, target, mirrored, map}: arrays of numbers, those that are there
 * @returns {{truth, base}|null} members of the request; null where something is missing. @throws Error with the reason
 */
export function truthOf(roles) {
  const base = baseOf(roles);
  if (roles.map) return {truth: roles.map, base};
  if (!roles.source || !roles.target) return null;
  for (const role of ['target', 'mirrored']) {
    if (roles[role] && roles[role].length !== roles.source.length) {
      throw new Error(`the ${role} list has ${roles[role].length} vertices, the source list ${roles.source.length}`);
    }
  }
  const {source, target, mirrored} = roles;
  return {truth: mirrored ? {source, target, mirrored} : {source, target}, base};
}

/** For each of `count` source vertices its true target vertex, or -1. */
export function truthArray(known, count) {
  const result = new Int32Array(count).fill(-1);
  if (known.truth === 'identity') return result.map((_, i) => i);
  const {source, target} = Array.isArray(known.truth) ? {source: known.truth.map((_, i) => i + known.base), target: known.truth} : known.truth;
  source.forEach((vertex, k) => {
    const i = vertex - known.base;
    if (i >= 0 && i < count) result[i] = target[k] < 0 ? -1 : target[k] - known.base;
  });
  return result;
}
