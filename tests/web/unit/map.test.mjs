import assert from 'node:assert/strict';
import test from 'node:test';
import {droppedBy, imageOf, percentiles, pullBack, row, sampleGrid, spread, straightErrors} from '../../../web/src/map/correspondence.js';
import {broadSide, closestRotation, measure, normalised, symmetricEigen, turn} from '../../../web/src/map/geometry.js';
import {baseOf, guessRole, readVertices, truthArray, truthOf} from '../../../web/src/map/truth.js';
import {snippets} from '../../../web/src/snippets.js';
import {mapColour, placeColours} from '../../../web/src/view/colours.js';

const close = (a, b, tolerance, what) => a.forEach((value, i) => assert.ok(Math.abs(value - b[i]) < tolerance, `${what}: ${a} is not ${b}`));
const MAP = {vertex: Int32Array.of(1, -1), corners: Int32Array.of(0, 1, 2, -1, -1, -1), bary: Float32Array.of(0.25, 0.5, 0.25, 0, 0, 0)};

test('values come along the map, and dropped vertices have none', () => {
  const values = pullBack(MAP, Float32Array.of(0, 0, 4, 0, 0, 8), 2);
  assert.deepEqual([...values.slice(0, 2)], [2, 2]);
  assert.ok(values.slice(2).every(Number.isNaN));
  assert.deepEqual(row(MAP, 0), {vertex: 1, corners: [0, 1, 2], bary: [0.25, 0.5, 0.25], confidence: null, distortion: null});
  assert.equal(row(MAP, 1), null);
  assert.equal(row(MAP, 2), null);
  assert.deepEqual([...droppedBy(MAP)], [0, 1]);
  assert.deepEqual(imageOf(row(MAP, 0), [0, 0, 0, 4, 0, 0, 0, 8, 0]), [2, 2, 0]);
});

test('a missing value at a corner of weight 0 does no harm', () => {
  const map = {vertex: Int32Array.of(0), corners: Int32Array.of(0, 1, 2), bary: Float32Array.of(1, 0, 0)};
  assert.deepEqual([...pullBack(map, Float32Array.of(3, NaN, NaN), 1)], [3]);
});

test('the colour of an image is the mean of its corners\u2019 colours', () => {
  const positions = Float32Array.of(0, 0, 0, 4, 0, 1, 0, 8, 2);
  const box = {low: [0, 0, 0], high: [4, 8, 2]};
  const image = Float32Array.from(imageOf(row(MAP, 0), positions));
  close([...placeColours(image, box)], [...pullBack(MAP, placeColours(positions, box)).slice(0, 3)], 1e-6, 'colour');
});

test('a turned cloud is turned back', () => {
  const q = [0.1, -0.4, 0.2, 0.0];
  q[3] = Math.sqrt(1 - 0.01 - 0.16 - 0.04);
  const from = Float32Array.from({length: 60}, (_, i) => Math.sin(i * 1.7) + 0.3 * Math.cos(i));
  const to = new Float32Array(60);
  for (let i = 0; i < 60; i += 3) to.set(turn(q, [...from.slice(i, i + 3)]), i);
  from[3] = NaN;
  const found = closestRotation(from, to);
  close(found.map((value) => value * Math.sign(found[3])), q, 1e-5, 'rotation');
});

test('eigenvectors are orthonormal and solve their equation', () => {
  const a = [[4, 1, 0.5], [1, 3, -0.2], [0.5, -0.2, 1]];
  const {values, vectors} = symmetricEigen(a);
  for (let k = 0; k < 3; ++k) {
    const v = vectors.map((line) => line[k]);
    close(a.map((line) => line.reduce((sum, value, j) => sum + value * v[j], 0)), v.map((value) => value * values[k]), 1e-9, 'eigenvector');
    assert.ok(Math.abs(Math.hypot(...v) - 1) < 1e-9);
  }
});

test('a shape is brought to unit area around the origin', () => {
  const mesh = {positions: Float32Array.of(1, 1, 0, 3, 1, 0, 3, 3, 0, 1, 3, 0), index: Uint32Array.of(0, 1, 2, 0, 2, 3)};
  const size = measure(mesh);
  assert.equal(size.area, 4);
  close(size.centre, [2, 2, 0], 1e-9, 'centre');
  close([...normalised(mesh.positions, size)], [-0.5, -0.5, 0, 0.5, -0.5, 0, 0.5, 0.5, 0, -0.5, 0.5, 0], 1e-6, 'places');
});

test('the broad side faces the eye, upright', () => {
  const flat = Float32Array.from([0.1, 1.9, 1, 0.1, -2, -1, -0.1, -2, 1, -0.1, 2, -1]); // thin in x, tall in y
  const q = broadSide(flat);
  close(turn(q, [0, 1, 0]), [0, 1, 0], 0.2, 'up');
  assert.ok(Math.abs(turn(q, [1, 0, 0])[2]) > 0.95, 'x is the line of sight');
});

test('a shape that stands along z is shown standing', () => {
  // A table: thin in x, long in y, four feet at the bottom of z.
  const table = [[-0.2, -2, 0], [0.2, -2, 0], [-0.2, 2, 0], [0.2, 2, 0], [-0.2, -2, 1.5], [0.2, -2, 1.5], [-0.2, 2, 1.5], [0.2, 2, 1.5], [0, 2.6, 1.8], [0, -2.9, 1.6]];
  const around = Float32Array.from(table.flatMap(([x, y, z]) => [x, y, z - 0.9]));
  close(turn(broadSide(around), [0, 0, 1]), [0, 1, 0], 0.2, 'up is z');
  const laid = Float32Array.from(table.flatMap(([x, y, z]) => [x, z - 0.9, y]));
  close(turn(broadSide(laid), [0, 1, 0]), [0, 1, 0], 0.2, 'up is y');
});

test('a grid on the sphere is sampled at the middles of its cells, around and over the poles', () => {
  const n = 8;
  const grid = Float32Array.from({length: n * n}, (_, i) => Math.cos((Math.PI * (Math.floor(i / n) + 0.5)) / n));
  const angle = (Math.PI * 2.5) / n;
  const points = [Math.sin(angle), 0, Math.cos(angle), 0, 0, 1, -Math.sin(angle), -1e-9, Math.cos(angle)];
  close([...sampleGrid(grid, n, points)], [Math.cos(angle), Math.cos(Math.PI / 16), Math.cos(angle)], 1e-3, 'samples');
});

test('errors are distances to the true vertex, where it is known', () => {
  const errors = straightErrors([0, 0, 0, 1, 1, 1], [3, 4, 0], [0, -1], 0.5);
  assert.equal(errors[0], 2.5);
  assert.ok(Number.isNaN(errors[1]));
  assert.deepEqual(percentiles([5, NaN, 1, 3], 0, 0.99), [1, 5]);
  assert.deepEqual(percentiles([NaN], 0, 1), [0, 1]);
});

test('a few values are spread over the mesh, and kept where they are known', () => {
  // A strip of squares, 0 at one end and 1 at the other.
  const n = 9, index = [];
  for (let i = 0; i < n - 1; ++i) index.push(2 * i, 2 * i + 2, 2 * i + 1, 2 * i + 1, 2 * i + 2, 2 * i + 3);
  const values = new Float32Array(2 * n).fill(NaN);
  values[0] = values[1] = 0;
  values[2 * n - 2] = values[2 * n - 1] = 1;
  const all = spread(values, index, 400);
  assert.ok(all.every((value) => value >= 0 && value <= 1));
  assert.deepEqual([all[0], all[1], all[2 * n - 1]], [0, 0, 1]);
  assert.ok(all[4] < 0.45 && all[2 * n - 5] > 0.55, [...all].join());
  assert.equal(spread(Float32Array.of(1, 2, NaN), [0, 1, 2])[2], NaN);
});

test('lists of vertices become the truth of each source vertex', () => {
  const lists = {source: [1, 3], target: [2, 4]};
  assert.equal(baseOf(lists), 1);
  assert.deepEqual(truthOf(lists), {truth: {source: [1, 3], target: [2, 4]}, base: 1});
  assert.deepEqual([...truthArray(truthOf(lists), 4)], [1, -1, 3, -1]);
  assert.equal(baseOf({source: [0, 3], target: [2, 4]}), 0);
  assert.deepEqual([...truthArray(truthOf({map: [2, -1, 0]}), 3)], [2, -1, 0]);
  assert.deepEqual([...truthArray({truth: 'identity', base: 0}, 3)], [0, 1, 2]);
  assert.equal(truthOf({source: [1]}), null);
  assert.throws(() => truthOf({source: [1], target: [1, 2]}), /2 vertices/);
});

test('files are read, and taken for what they look like', () => {
  assert.deepEqual(readVertices('a.vts', Buffer.from('51\n5809\n')), [51, 5809]);
  assert.throws(() => readVertices('a.vts', Buffer.from('1.5\n')), /no list/);
  const scene = {source: {info: {name: 'stand.off', vertices: 3}}, target: {info: {name: 'leap.glb', vertices: 4}}};
  const role = (file, numbers = [1, 2], taken = []) => guessRole(file, numbers, scene, new Set(taken));
  assert.equal(role('stand.vts'), 'source');
  assert.equal(role('leap.vts'), 'target');
  assert.equal(role('leap.sym.vts'), 'mirrored');
  assert.equal(role('truth.txt', [0, 1, 2]), 'map');
  assert.equal(role('x.vts'), 'source');
  assert.equal(role('y.vts', [1, 2], ['source']), 'target');
});

test('lines to copy carry the view\u2019s options in each language', () => {
  const plain = snippets('http://h', new URLSearchParams({src: 'a', tgt: 'b'}), {source: 'x', target: 'y'});
  assert.match(plain.curl, /curl 'http:\/\/h\/match\?src=a&tgt=b&format=npz' -o map\.npz/);
  assert.match(plain.python, /client\.match\(source, target\)/);
  const full = snippets('http://h', new URLSearchParams({src: 'a', tgt: 'b', candidate: 1, orientation: 'any', refine: 'none', method: 'paper'}), {source: 'x', target: 'y'});
  assert.match(full.python, /match\(source, target, candidate=1, orientation='any', refine='none', method='paper'\)/);
  // Members of a C++ struct are named in their order.
  assert.match(full.cpp, /\{\.method = "paper", \.refine = "none", \.orientation = "any", \.candidate = 1\}/);
});

test('colour maps go from end to end', () => {
  close(mapColour('viridis', 0), [0x44 / 255, 1 / 255, 0x54 / 255], 1e-9, 'low');
  close(mapColour('viridis', 2), [0xfd / 255, 0xe7 / 255, 0x25 / 255], 1e-9, 'high');
});
