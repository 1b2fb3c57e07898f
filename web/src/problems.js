// A problem of the server in words, and where the file can be read here, on its mesh: the offending elements in red.

import {BufferAttribute, BufferGeometry, Group, LineSegments, Mesh, PerspectiveCamera, Points, Scene, ShaderMaterial, WebGLRenderer} from 'three';
import {openDialog} from './dialog.js';
import {h} from './dom.js';
import {readMesh} from './formats/meshes.js';
import {broadSide, measure, normalised, radiusOf} from './map/geometry.js';
import {Camera, control} from './view/camera.js';
import {surfaceMaterial, wireMaterial} from './view/material.js';
import {hasWebGl} from './view/stage.js';

const ADVICE = {
  'wrong-genus': 'The map is one of spheres: a surface with a handle has none. Cut the handle and close both ends.',
  'not-closed': 'Close the holes, or upload with repair=fill.',
  'non-manifold': 'Each edge should have two faces. Upload with repair=fill, or split the parts that touch.',
  disconnected: 'Upload with repair=fill to keep the largest part.',
  'compressed-geometry': 'Export without Draco or meshopt compression.',
  'external-reference': 'Export as GLB, with everything in one file.',
};

/** @param file the refused upload, or null where only the words are known */
export async function explain(file, problem) {
  const elements = problem.elements ?? [];
  const view = h('div', {class: 'problem-view', tabIndex: 0, role: 'application', 'aria-label': 'The refused mesh. Arrow keys turn it.'}, h('canvas', {'aria-hidden': 'true'}));
  const body = [h('p', {}, h('strong', {text: problem.detail}))];
  if (ADVICE[problem.code]) body.push(h('p', {text: ADVICE[problem.code]}));
  let mesh = null;
  if (file && hasWebGl()) {
    try {
      mesh = readMesh(await file.arrayBuffer(), file.name);
      if (mesh.index.length > 0) body.push(view);
      else mesh = null;
    } catch {
      mesh = null;
    }
  }
  if (elements.length > 0) {
    body.push(h('div', {class: 'elements', 'aria-label': 'Offending elements'}, ...elements.map((element) => h('span', {text: nameOf(element)}))));
    if (elements.length === 20) body.push(h('p', {class: 'hint', text: 'The first 20 are listed.'}));
  }
  let drawing = null;
  openDialog({title: file ? `${file.name}: ${problem.title}` : problem.title, name: 'problem', body, closed: () => drawing?.dispose()});
  if (mesh) drawing = draw(view, mesh, elements);
}

function nameOf(element) {
  const [kind, value] = Object.entries(element)[0];
  return `${kind} ${[].concat(value).join('–')}`;
}

/** Vertices, edges and the borders of faces that the problem names. */
export function marksOf({places, index}, elements) {
  const at = (vertex) => Array.from(places.subarray(3 * vertex, 3 * vertex + 3));
  const lines = [], points = [];
  for (const {vertex, edge, face} of elements) {
    if (vertex !== undefined) points.push(...at(vertex));
    if (edge) {
      lines.push(...at(edge[0]), ...at(edge[1]));
      points.push(...at(edge[0]), ...at(edge[1]));
    }
    const corners = face === undefined ? [] : Array.from(index.subarray(3 * face, 3 * face + 3));
    corners.forEach((corner, k) => lines.push(...at(corner), ...at(corners[(k + 1) % 3])));
  }
  return {lines, points};
}

function redMaterial(alpha, depthTest) {
  return new ShaderMaterial({
    vertexShader: 'void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); gl_PointSize = 9.0; }',
    fragmentShader: `void main() { gl_FragColor = vec4(0.86, 0.12, 0.10, ${alpha}); }`,
    transparent: true,
    depthTest,
  });
}

function draw(view, mesh, elements) {
  const places = normalised(mesh.positions, measure(mesh));
  const renderer = new WebGLRenderer({canvas: view.querySelector('canvas'), antialias: true, alpha: true});
  const camera = new Camera();
  camera.set([...broadSide(places), 1, 0, 0]);
  const scene = new Scene();
  const group = new Group();
  scene.add(group);
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(places, 3));
  geometry.setIndex(new BufferAttribute(mesh.index, 1));
  geometry.computeVertexNormals();
  const material = surfaceMaterial();
  group.add(new Mesh(geometry, material), new Mesh(geometry, wireMaterial(material)));
  const {lines, points} = marksOf({places, index: mesh.index}, elements);
  for (const [Kind, values] of [[LineSegments, lines], [Points, points]]) {
    if (values.length === 0) continue;
    const marks = new BufferGeometry().setAttribute('position', new BufferAttribute(Float32Array.from(values), 3));
    // Faintly through the surface, and firmly in front of it.
    group.add(new Kind(marks, redMaterial('0.45', false)), new Kind(marks, redMaterial('1.0', true)));
  }
  view.dataset.marks = String(lines.length / 6 + points.length / 3);
  const eye = new PerspectiveCamera(24, 1, 0.01, 100);
  const radius = radiusOf(places);
  const render = () => {
    const {width, height} = view.getBoundingClientRect();
    renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    renderer.setSize(width, height, false);
    eye.aspect = width / height;
    eye.zoom = camera.zoom;
    const distance = (radius * 1.1) / Math.tan((12 * Math.PI) / 180);
    eye.position.set(-camera.shift[0] * distance * 0.42, -camera.shift[1] * distance * 0.42, distance);
    eye.updateProjectionMatrix();
    group.quaternion.copy(camera.turn);
    renderer.render(scene, eye);
  };
  control(view, {camera: () => camera, changed: render, hover: () => {}, click: () => {}, leave: () => {}});
  render();
  return renderer;
}
