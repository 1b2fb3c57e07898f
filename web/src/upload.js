// Sends mesh files, several one after the other, and tells how far each is.

import {Problem, keyHeaders, obtainKey} from './api.js';

export const MESH = /\.(off|obj|ply|stl|gltf|glb)$/i;
export const TRUTH = /\.(vts|txt|npy|json)$/i;

/**
 * @param progress called with the share of the bytes that are sent
 * @returns the shape object; @throws Problem
 */
export async function upload(file, progress, options = {}) {
  const query = new URLSearchParams({name: file.name, ...options});
  const answer = await send(`/shapes?${query}`, file, progress);
  if (answer.status < 300) return JSON.parse(answer.text);
  let problem;
  try {
    problem = JSON.parse(answer.text);
  } catch {
    problem = {code: 'no-answer', title: 'No answer', detail: 'the server did not answer', elements: []};
  }
  if (answer.status === 401 && (await obtainKey(problem))) return upload(file, progress, options);
  throw new Problem(problem);
}

/** fetch() does not tell how much of a body is sent. */
function send(path, file, progress) {
  return new Promise((resolve) => {
    const request = new XMLHttpRequest();
    request.open('POST', path);
    for (const [name, value] of Object.entries(keyHeaders())) request.setRequestHeader(name, value);
    request.setRequestHeader('Content-Type', 'application/octet-stream');
    request.upload.addEventListener('progress', ({loaded, total}) => progress(total ? loaded / total : 1));
    request.addEventListener('loadend', () => resolve({status: request.status || 599, text: request.responseText}));
    request.send(file);
  });
}
