// NumPy's .npy arrays and .npz archives, as the server writes them: little-endian, C order, stored without compression.

const KINDS = {'<i4': Int32Array, '<f4': Float32Array, '<f8': Float64Array};

/** @returns {{shape: number[], data: TypedArray}} */
export function readNpy(buffer, from = 0, size = buffer.byteLength - from) {
  const bytes = new Uint8Array(buffer, from, size);
  if (size < 10 || bytes[0] !== 0x93 || ascii(bytes, 1, 6) !== 'NUMPY') throw new Error('this is no NPY array');
  const view = new DataView(buffer, from, size);
  const wide = bytes[6] > 1;
  const start = (wide ? 12 : 10) + (wide ? view.getUint32(8, true) : view.getUint16(8, true));
  const header = ascii(bytes, 10, start);
  const kind = KINDS[/'descr': '([^']+)'/.exec(header)?.[1]];
  if (!kind || !header.includes("'fortran_order': False")) throw new Error('an array of another kind: ' + header);
  const shape = /'shape': \(([^)]*)\)/.exec(header)[1].split(',').filter((part) => part.trim()).map(Number);
  const count = shape.reduce((product, length) => product * length, 1);
  if (start + count * kind.BYTES_PER_ELEMENT > size) throw new Error('the array ends early');
  // A copy, since a typed array must begin at a multiple of its element's size.
  return {shape, data: new kind(buffer.slice(from + start, from + start + count * kind.BYTES_PER_ELEMENT))};
}

/** @returns {Object<string, {shape, data}>} the arrays by name, without ".npy" */
export function readNpz(buffer) {
  const view = new DataView(buffer);
  const bytes = new Uint8Array(buffer);
  const arrays = {};
  // Sizes stand in the central directory; local headers may leave them out.
  let end = buffer.byteLength - 22;
  while (end >= 0 && view.getUint32(end, true) !== 0x06054b50) --end;
  if (end < 0) throw new Error('this is no NPZ archive');
  let at = view.getUint32(end + 16, true);
  for (let left = view.getUint16(end + 10, true); left > 0; --left) {
    if (view.getUint32(at, true) !== 0x02014b50) throw new Error('the archive is damaged');
    if (view.getUint16(at + 10, true) !== 0) throw new Error('a compressed archive');
    const size = view.getUint32(at + 24, true);
    const nameLength = view.getUint16(at + 28, true);
    const name = ascii(bytes, at + 46, at + 46 + nameLength);
    const local = view.getUint32(at + 42, true);
    const data = local + 30 + view.getUint16(local + 26, true) + view.getUint16(local + 28, true);
    arrays[name.replace(/\.npy$/, '')] = readNpy(buffer, data, size);
    at += 46 + nameLength + view.getUint16(at + 30, true) + view.getUint16(at + 32, true);
  }
  return arrays;
}

function ascii(bytes, from, to) {
  return String.fromCharCode(...bytes.subarray(from, to));
}
