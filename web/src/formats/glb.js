// GLB files. The server's own have one mesh, perhaps in a node with place and size; those of others are read to draw them next to
// their problem, with every mesh of the default scene.

/**
 * @returns {{positions: Float32Array, normals: Float32Array|null, index: Uint32Array}} in the order of docs/http.md: nodes depth
 *   first, of each node's mesh all primitives
 */
export function readGlb(buffer) {
  const view = new DataView(buffer);
  if (buffer.byteLength < 20 || view.getUint32(0, true) !== 0x46546c67) throw new Error('this is no GLB file');
  const jsonSize = view.getUint32(12, true);
  const document = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 20, jsonSize)));
  return collect(document, buffer, 28 + jsonSize);
}

function collect(document, buffer, binary) {
  const parts = [];
  const visit = (index, parent) => {
    const node = document.nodes[index];
    const place = multiply(parent, localTransform(node));
    for (const primitive of document.meshes?.[node.mesh]?.primitives ?? []) {
      if ((primitive.mode ?? 4) === 4) parts.push(readPrimitive(document, buffer, binary, primitive, place));
    }
    for (const child of node.children ?? []) visit(child, place);
  };
  const scene = document.scenes?.[document.scene ?? 0];
  for (const root of scene?.nodes ?? document.nodes?.map((_, i) => i) ?? []) visit(root, IDENTITY);
  if (parts.length === 0) throw new Error('the file has no triangles');
  return parts.length === 1 ? parts[0] : joined(parts);
}

function joined(parts) {
  const sum = (name) => parts.reduce((count, part) => count + part[name].length, 0);
  const result = {positions: new Float32Array(sum('positions')), normals: null, index: new Uint32Array(sum('index'))};
  let vertices = 0, corners = 0;
  for (const part of parts) {
    result.positions.set(part.positions, vertices * 3);
    for (const corner of part.index) result.index[corners++] = corner + vertices;
    vertices += part.positions.length / 3;
  }
  return result;
}

const COMPONENTS = {5120: Int8Array, 5121: Uint8Array, 5122: Int16Array, 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array};
const WIDTHS = {SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4};

function readAccessor(document, buffer, binary, number) {
  const accessor = document.accessors[number];
  const slice = document.bufferViews[accessor.bufferView];
  const kind = COMPONENTS[accessor.componentType];
  const width = WIDTHS[accessor.type];
  const from = binary + (slice.byteOffset ?? 0) + (accessor.byteOffset ?? 0);
  const stride = slice.byteStride ?? 0;
  if (stride === 0 || stride === width * kind.BYTES_PER_ELEMENT) {
    return new kind(buffer.slice(from, from + accessor.count * width * kind.BYTES_PER_ELEMENT));
  }
  const result = new kind(accessor.count * width);
  for (let i = 0; i < accessor.count; ++i) {
    const row = buffer.slice(from + i * stride, from + i * stride + width * kind.BYTES_PER_ELEMENT);
    result.set(new kind(row), i * width);
  }
  return result;
}

function readPrimitive(document, buffer, binary, primitive, place) {
  const read = (number) => readAccessor(document, buffer, binary, number);
  const positions = Float32Array.from(read(primitive.attributes.POSITION));
  const moved = place.some((value, i) => value !== IDENTITY[i]);
  if (moved) transform(positions, place);
  const index = primitive.indices === undefined ? Uint32Array.from({length: positions.length / 3}, (_, i) => i) : Uint32Array.from(read(primitive.indices));
  // The server's nodes only move and scale evenly, which leaves normals as they are.
  const normals = primitive.attributes.NORMAL === undefined ? null : Float32Array.from(read(primitive.attributes.NORMAL));
  return {positions, normals, index};
}

// Matrices of 4 x 4 numbers, column after column, as in glTF.
const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

function localTransform(node) {
  if (node.matrix) return node.matrix;
  const [x, y, z, w] = node.rotation ?? [0, 0, 0, 1];
  const [sx, sy, sz] = node.scale ?? [1, 1, 1];
  const [tx, ty, tz] = node.translation ?? [0, 0, 0];
  return [
    (1 - 2 * (y * y + z * z)) * sx, 2 * (x * y + z * w) * sx, 2 * (x * z - y * w) * sx, 0,
    2 * (x * y - z * w) * sy, (1 - 2 * (x * x + z * z)) * sy, 2 * (y * z + x * w) * sy, 0,
    2 * (x * z + y * w) * sz, 2 * (y * z - x * w) * sz, (1 - 2 * (x * x + y * y)) * sz, 0,
    tx, ty, tz, 1,
  ];
}

function multiply(a, b) {
  const product = new Array(16).fill(0);
  for (let column = 0; column < 4; ++column)
    for (let row = 0; row < 4; ++row)
      for (let k = 0; k < 4; ++k) product[column * 4 + row] += a[k * 4 + row] * b[column * 4 + k];
  return product;
}

function transform(positions, m) {
  for (let i = 0; i < positions.length; i += 3) {
    const [x, y, z] = [positions[i], positions[i + 1], positions[i + 2]];
    for (let row = 0; row < 3; ++row) positions[i + row] = m[row] * x + m[4 + row] * y + m[8 + row] * z + m[12 + row];
  }
}
