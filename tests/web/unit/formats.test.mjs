import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import test from 'node:test';
import {readGlb} from '../../../web/src/formats/glb.js';
import {readMesh} from '../../../web/src/formats/meshes.js';
import {readNpy, readNpz} from '../../../web/src/formats/npy.js';

const bufferOf = (bytes) => bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
const text = (lines) => bufferOf(Buffer.from(lines.join('\n') + '\n'));

function npy(descr, shape, array) {
  const header = `{'descr': '${descr}', 'fortran_order': False, 'shape': (${shape.join(', ')},), }\n`;
  const head = Buffer.alloc(10);
  head.write('\x93NUMPY', 'latin1');
  head[6] = 1;
  head.writeUInt16LE(header.length, 8);
  return Buffer.concat([head, Buffer.from(header), Buffer.from(array.buffer)]);
}

/** A zip archive without compression, as the server writes them. */
function zip(entries) {
  const locals = [], central = [];
  let at = 0;
  for (const [name, data] of entries) {
    const local = Buffer.alloc(30);
    local.writeUInt32LE(0x04034b50, 0);
    local.writeUInt32LE(data.length, 18);
    local.writeUInt32LE(data.length, 22);
    local.writeUInt16LE(name.length, 26);
    const row = Buffer.alloc(46);
    row.writeUInt32LE(0x02014b50, 0);
    row.writeUInt32LE(data.length, 20);
    row.writeUInt32LE(data.length, 24);
    row.writeUInt16LE(name.length, 28);
    row.writeUInt32LE(at, 42);
    locals.push(local, Buffer.from(name), data);
    central.push(row, Buffer.from(name));
    at += 30 + name.length + data.length;
  }
  const directory = Buffer.concat(central);
  const end = Buffer.alloc(22);
  end.writeUInt32LE(0x06054b50, 0);
  end.writeUInt16LE(entries.length, 10);
  end.writeUInt32LE(at, 16);
  return bufferOf(Buffer.concat([...locals, directory, end]));
}

test('arrays of each kind are read', () => {
  const {shape, data} = readNpy(bufferOf(npy('<f4', [2, 3], Float32Array.of(1, 2, 3, 4, 5, 6.5))));
  assert.deepEqual(shape, [2, 3]);
  assert.deepEqual([...data], [1, 2, 3, 4, 5, 6.5]);
  assert.ok(readNpy(bufferOf(npy('<f8', [1], Float64Array.of(0.1)))).data instanceof Float64Array);
});

test('arrays that are none are refused', () => {
  assert.throws(() => readNpy(new ArrayBuffer(4)), /no NPY/);
  assert.throws(() => readNpy(bufferOf(npy('|O', [1], Int32Array.of(1)))), /another kind/);
  assert.throws(() => readNpy(bufferOf(npy('<i4', [9], Int32Array.of(1)))), /ends early/);
});

test('an archive gives its arrays by name', () => {
  const arrays = readNpz(zip([['vertex.npy', npy('<i4', [2], Int32Array.of(7, -1))], ['bary.npy', npy('<f4', [1, 3], Float32Array.of(0.5, 0.25, 0.25))]]));
  assert.deepEqual([...arrays.vertex.data], [7, -1]);
  assert.deepEqual(arrays.bary.shape, [1, 3]);
  assert.throws(() => readNpz(new ArrayBuffer(100)), /no NPZ/);
});

test('a shipped GLB file is read whole', () => {
  const {positions, index} = readGlb(bufferOf(readFileSync(new URL('../../../samples/hound/leap.glb', import.meta.url))));
  assert.ok(positions.length > 3000 && positions.every(Number.isFinite));
  assert.equal(index.length % 3, 0);
  assert.equal(Math.max(...index), positions.length / 3 - 1);
});

const TETRAHEDRON = {vertices: ['0 0 0', '1 0 0', '0 1 0', '0 0 1'], faces: ['0 2 1', '0 1 3', '0 3 2', '1 2 3']};
const POSITIONS = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1];
const INDEX = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3];

function same(mesh, what) {
  assert.deepEqual([...mesh.positions], POSITIONS, what);
  assert.deepEqual([...mesh.index], INDEX, what);
}

test('OFF, OBJ and PLY keep the order of the file', () => {
  const {vertices, faces} = TETRAHEDRON;
  same(readMesh(text(['OFF', '# a comment', '4 4 0', ...vertices, ...faces.map((face) => `3 ${face}`)]), 'a.off'), 'OFF');
  same(readMesh(text(['COFF', '4 4 0', ...vertices.map((row) => `${row} 255 0 0 255`), ...faces.map((face) => `3 ${face} 1 0 0`)]), 'a.off'), 'COFF');
  same(readMesh(text(['# a comment', ...vertices.map((row) => `v ${row}`), ...faces.map((face) => 'f ' + face.split(' ').map((i) => `${+i + 1}/1/1`).join(' '))]), 'a.obj'), 'OBJ');
  same(readMesh(text([...vertices.map((row) => `v ${row}`), ...faces.map((face) => 'f ' + face.split(' ').map((i) => i - 4).join(' '))]), 'a.obj'), 'OBJ backwards');
  const header = ['ply', 'format ascii 1.0', 'element vertex 4', 'property float x', 'property float y', 'property float z', 'element face 4', 'property list uchar int vertex_indices', 'end_header'];
  same(readMesh(text([...header, ...vertices, ...faces.map((face) => `3 ${face}`)]), 'a.ply'), 'PLY');
});

test('binary PLY is read in both byte orders', () => {
  for (const little of [true, false]) {
    const header = ['ply', `format binary_${little ? 'little' : 'big'}_endian 1.0`, 'element vertex 4', 'property double x', 'property double y', 'property double z', 'property uchar red', 'element face 4', 'property list uchar uint vertex_index', 'end_header', ''].join('\n');
    const body = new DataView(new ArrayBuffer(4 * 25 + 4 * 13));
    let at = 0;
    POSITIONS.forEach((value, i) => {
      body.setFloat64(at, value, little);
      at += i % 3 === 2 ? 9 : 8;
    });
    for (let f = 0; f < 4; ++f) {
      body.setUint8(at, 3);
      for (let k = 0; k < 3; ++k) body.setUint32(at + 1 + 4 * k, INDEX[3 * f + k], little);
      at += 13;
    }
    same(readMesh(bufferOf(Buffer.concat([Buffer.from(header), Buffer.from(body.buffer)])), 'a.ply'), String(little));
  }
});

test('STL gives one vertex for each position, as they first appear', () => {
  const corners = INDEX.map((i) => POSITIONS.slice(3 * i, 3 * i + 3));
  const order = [0, 2, 1, 3];
  const expected = order.flatMap((i) => POSITIONS.slice(3 * i, 3 * i + 3));
  const lines = ['solid x', ...corners.map((corner) => `vertex ${corner.join(' ')}`), 'endsolid x'];
  const ascii = readMesh(text(lines), 'a.stl');
  assert.deepEqual([...ascii.positions], expected);
  assert.deepEqual([...ascii.index].map((k) => order[k]), INDEX);
  const binary = new DataView(new ArrayBuffer(84 + 4 * 50));
  binary.setUint32(80, 4, true);
  corners.forEach((corner, c) => corner.forEach((value, k) => binary.setFloat32(84 + 50 * Math.floor(c / 3) + 12 + 12 * (c % 3) + 4 * k, value, true)));
  assert.deepEqual([...readMesh(binary.buffer, 'a.stl').index], [...ascii.index]);
});

test('polygons are fans, and corners that do not exist are left out', () => {
  assert.deepEqual([...readMesh(text(['OFF', '4 1 0', ...TETRAHEDRON.vertices, '4 0 1 2 3']), 'a.off').index], [0, 1, 2, 0, 2, 3]);
  assert.deepEqual([...readMesh(text(['OFF', '4 2 0', ...TETRAHEDRON.vertices, '3 0 1 9', '3 0 1 2']), 'a.off').index], [0, 1, 2]);
  assert.throws(() => readMesh(text(['nothing']), 'a.bin'));
});
