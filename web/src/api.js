// Requests to the server that this page came from.

import {readGlb} from './formats/glb.js';
import {readNpy, readNpz} from './formats/npy.js';

/** A refusal of the server: `problem` is its application/problem+json. */
export class Problem extends Error {
  constructor(problem) {
    super(problem.detail || problem.title || 'the request failed');
    this.problem = problem;
  }
}

const KEY = 'spherematch-key';
let askForKey = null;

/** `ask(message)` resolves to a key, or to null where the person has none. */
export function onUnauthorized(ask) {
  askForKey = ask;
}

export function apiKey() {
  return sessionStorage.getItem(KEY) ?? '';
}

export function keyHeaders() {
  const key = apiKey();
  return key ? {Authorization: `Bearer ${key}`} : {};
}

/** Asks for a key after a 401, once for however many requests wait for it. @returns whether there is a new one */
let asking = null;
export async function obtainKey(problem) {
  if (!askForKey) return false;
  asking ??= askForKey(problem.detail).finally(() => (asking = null));
  const key = await asking;
  if (key) sessionStorage.setItem(KEY, key);
  return Boolean(key);
}

export async function readProblem(response) {
  try {
    return await response.json();
  } catch {
    return {code: 'unknown', status: response.status, title: response.statusText, detail: `the server answered ${response.status}`, elements: []};
  }
}

/** @throws Problem; also where no answer comes */
export async function request(path, options = {}) {
  let response;
  try {
    response = await fetch(path, {...options, headers: {...keyHeaders(), ...options.headers}});
  } catch (error) {
    if (error.name === 'AbortError') throw error;
    throw new Problem({code: 'no-answer', title: 'No answer', detail: 'the server does not answer', elements: []});
  }
  if (response.ok) return response;
  const problem = await readProblem(response);
  if (response.status === 401 && (await obtainKey(problem))) return request(path, options);
  throw new Problem(problem);
}

const json = async (path, options) => (await request(path, options)).json();
const bytes = async (path, options) => (await request(path, options)).arrayBuffer();

/** What this server can do beyond the first release, told by its own description. */
let described = null;
export function abilities() {
  described ??= json('/openapi.json').then(
    ({paths, components}) => ({
      thumbnails: Boolean(paths['/shapes/{id}/thumbnail.png']),
      quality: JSON.stringify(components.parameters ?? paths).includes('confidence') || JSON.stringify(paths['/match']).includes('confidence'),
    }),
    () => ({thumbnails: false, quality: false}),
  );
  return described;
}

export const api = {
  version: () => json('/version'),
  shapes: (cursor, query) => json('/shapes?' + new URLSearchParams({limit: 50, ...(cursor && {cursor}), ...(query && {q: query})})),
  shape: (id) => json(`/shapes/${id}`),
  rename: (id, name) => json(`/shapes/${id}`, {method: 'PATCH', body: JSON.stringify({name})}),
  remove: (id) => request(`/shapes/${id}`, {method: 'DELETE'}),
  mesh: async (id) => readGlb(await bytes(`/shapes/${id}/mesh?format=glb`)),
  sphere: async (id) => Float32Array.from(readNpy(await bytes(`/shapes/${id}/sphere?wait=30`)).data),
  signatures: async (id) => readNpz(await bytes(`/shapes/${id}/hks?wait=30`)),
  map: async (query, options) => readNpz(await bytes(`/match?${query}&format=npz`, options)),
  figures: (query, options) => json(`/match?${query}&fields=`, options),
  fields: (query, fields) => json(`/match?${query}&fields=${fields}`),
  symmetry: async (id) => readNpz(await bytes(`/shapes/${id}/symmetry?format=npz`)),
  symmetryFigures: (id) => json(`/shapes/${id}/symmetry?fields=`),
  evaluate: (body) => json('/evaluations', {method: 'POST', body: JSON.stringify(body)}),
  blob: async (path) => (await request(path)).blob(),
};
