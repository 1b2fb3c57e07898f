// Mesh files as they are, before any repair: to draw a refused file beside what is wrong with it. Vertices stand in the order in which
// the server numbers them (docs/http.md). What cannot be read here gives an error, and the problem is told in words alone.

import {readGlb} from './glb.js';

/** @returns {{positions: Float32Array, index: Uint32Array}} */
export function readMesh(buffer, name) {
  const head = new TextDecoder('latin1').decode(new Uint8Array(buffer, 0, Math.min(400, buffer.byteLength)));
  const text = () => new TextDecoder('latin1').decode(buffer);
  if (head.startsWith('glTF')) return readGlb(buffer);
  if (/^ply\r?\n/.test(head)) return readPly(buffer);
  if (/^\s*(#[^\n]*\n\s*)*(ST|C|N|4|n)*OFF\b/.test(head)) return readOff(text());
  if (isBinaryStl(buffer)) return fromSoup(binaryStlCorners(buffer));
  if (/^\s*solid\b/.test(head)) return fromSoup(asciiStlCorners(text()));
  if (/\.obj$/i.test(name) || /^\s*(v|o|g|mtllib|#)/m.test(head)) return readObj(text());
  throw new Error('this file is not drawn here');
}

class Builder {
  constructor() {
    this.positions = [];
    this.index = [];
  }

  face(corners) {
    for (let k = 2; k < corners.length; ++k) this.index.push(corners[0], corners[k - 1], corners[k]);
  }

  done() {
    const count = this.positions.length / 3;
    if (count === 0) throw new Error('the file has no vertices');
    const index = [];
    for (let i = 0; i < this.index.length; i += 3) {
      const corners = this.index.slice(i, i + 3);
      if (corners.every((corner) => corner >= 0 && corner < count)) index.push(...corners);
    }
    return {positions: Float32Array.from(this.positions), index: Uint32Array.from(index)};
  }
}

function readOff(text) {
  const words = text.replace(/#[^\n]*/g, ' ').split(/\s+/).filter(Boolean);
  let at = /OFF$/.test(words[0]) ? 1 : 0;
  const [vertices, faces] = [Number(words[at]), Number(words[at + 1])];
  at += 3;
  // Rows may be longer than three numbers, as of COFF; then the lines tell.
  if (words[0] !== 'OFF') return readOffByLines(text);
  const builder = new Builder();
  for (let i = 0; i < vertices * 3; ++i) builder.positions.push(Number(words[at++]));
  for (let i = 0; i < faces && at < words.length; ++i) {
    const size = Number(words[at++]);
    builder.face(words.slice(at, at + size).map(Number));
    at += size;
  }
  return builder.done();
}

function readOffByLines(text) {
  const lines = text.split('\n').map((line) => line.replace(/#.*/, '').trim()).filter(Boolean);
  const [vertices, faces] = lines[1].split(/\s+/).map(Number);
  const builder = new Builder();
  for (const line of lines.slice(2, 2 + vertices)) builder.positions.push(...line.split(/\s+/).slice(0, 3).map(Number));
  for (const line of lines.slice(2 + vertices, 2 + vertices + faces)) {
    const [size, ...corners] = line.split(/\s+/).map(Number);
    builder.face(corners.slice(0, size));
  }
  return builder.done();
}

function readObj(text) {
  const builder = new Builder();
  for (const line of text.split('\n')) {
    const [kind, ...words] = line.trim().split(/\s+/);
    if (kind === 'v') builder.positions.push(...words.slice(0, 3).map(Number));
    if (kind !== 'f') continue;
    const count = builder.positions.length / 3;
    builder.face(words.map((word) => parseInt(word, 10)).map((number) => (number < 0 ? count + number : number - 1)));
  }
  return builder.done();
}

function isBinaryStl(buffer) {
  return buffer.byteLength >= 84 && buffer.byteLength === 84 + 50 * new DataView(buffer).getUint32(80, true);
}

function binaryStlCorners(buffer) {
  const view = new DataView(buffer);
  const corners = [];
  for (let at = 84; at < buffer.byteLength; at += 50) for (let k = 0; k < 9; ++k) corners.push(view.getFloat32(at + 12 + 4 * k, true));
  return corners;
}

function asciiStlCorners(text) {
  return [...text.matchAll(/vertex\s+(\S+)\s+(\S+)\s+(\S+)/g)].flatMap(([, x, y, z]) => [Number(x), Number(y), Number(z)]);
}

/** Equal positions are one vertex, numbered as they first appear. */
function fromSoup(corners) {
  const builder = new Builder();
  const known = new Map();
  for (let i = 0; i < corners.length; i += 3) {
    const place = corners.slice(i, i + 3).map((value) => value + 0); // -0 and 0 are equal numbers
    const key = place.join(' ');
    if (!known.has(key)) {
      known.set(key, known.size);
      builder.positions.push(...place);
    }
    builder.index.push(known.get(key));
  }
  return builder.done();
}

const PLY_READERS = {
  char: ['getInt8', 1], int8: ['getInt8', 1], uchar: ['getUint8', 1], uint8: ['getUint8', 1],
  short: ['getInt16', 2], int16: ['getInt16', 2], ushort: ['getUint16', 2], uint16: ['getUint16', 2],
  int: ['getInt32', 4], int32: ['getInt32', 4], uint: ['getUint32', 4], uint32: ['getUint32', 4],
  float: ['getFloat32', 4], float32: ['getFloat32', 4], double: ['getFloat64', 8], float64: ['getFloat64', 8],
};

function readPly(buffer) {
  const head = new TextDecoder('latin1').decode(new Uint8Array(buffer, 0, Math.min(8192, buffer.byteLength)));
  const end = /end_header\r?\n/.exec(head);
  if (!end) throw new Error('the header of the PLY file has no end');
  const {format, elements} = plyHeader(head.slice(0, end.index));
  const start = end.index + end[0].length;
  const next = format === 'ascii' ? asciiNumbers(buffer, start) : binaryNumbers(buffer, start, format === 'binary_little_endian');
  const builder = new Builder();
  for (const {name, count, properties} of elements) {
    for (let i = 0; i < count; ++i) {
      const row = {};
      for (const property of properties) {
        row[property.name] = property.list ? Array.from({length: next(property.list)}, () => next(property.type)) : next(property.type);
      }
      if (name === 'vertex') builder.positions.push(row.x, row.y, row.z);
      if (name === 'face') builder.face(row.vertex_indices ?? row.vertex_index ?? []);
    }
  }
  return builder.done();
}

function plyHeader(text) {
  const elements = [];
  let format = '';
  for (const line of text.split(/\r?\n/)) {
    const words = line.trim().split(/\s+/);
    if (words[0] === 'format') format = words[1];
    if (words[0] === 'element') elements.push({name: words[1], count: Number(words[2]), properties: []});
    if (words[0] === 'property') {
      const list = words[1] === 'list';
      elements.at(-1).properties.push(list ? {list: words[2], type: words[3], name: words[4]} : {list: null, type: words[1], name: words[2]});
    }
  }
  return {format, elements};
}

function asciiNumbers(buffer, start) {
  const words = new TextDecoder('latin1').decode(new Uint8Array(buffer, start)).split(/\s+/).filter(Boolean);
  let at = 0;
  return () => Number(words[at++]);
}

function binaryNumbers(buffer, start, little) {
  const view = new DataView(buffer);
  let at = start;
  return (type) => {
    const [method, size] = PLY_READERS[type];
    const value = view[method](at, little);
    at += size;
    return value;
  };
}
