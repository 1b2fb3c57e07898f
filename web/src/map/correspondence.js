// The map of GET /match: row i is where source vertex i lies on the target.

/** Images of all source vertices in the target's `values` (any number of columns); NaN for dropped vertices. */
export function pullBack({vertex, corners, bary}, values, columns = 3) {
  const result = new Float32Array(vertex.length * columns);
  for (let i = 0; i < vertex.length; ++i) {
    for (let k = 0; k < columns; ++k) {
      let sum = vertex[i] < 0 ? NaN : 0;
      // A corner of weight 0 has no part, so that a value that is missing there does no harm.
      for (let c = 0; c < 3 && vertex[i] >= 0; ++c) {
        if (bary[3 * i + c] !== 0) sum += bary[3 * i + c] * values[corners[3 * i + c] * columns + k];
      }
      result[i * columns + k] = sum;
    }
  }
  return result;
}

/** What there is to say of one source vertex. */
export function row(map, i) {
  if (!map || i < 0 || i >= map.vertex.length || map.vertex[i] < 0) return null;
  return {
    vertex: map.vertex[i],
    corners: Array.from(map.corners.subarray(3 * i, 3 * i + 3)),
    bary: Array.from(map.bary.subarray(3 * i, 3 * i + 3)),
    confidence: map.confidence ? map.confidence[i] : null,
    distortion: map.distortion ? map.distortion[i] : null,
  };
}

export function pointOf(positions, i) {
  return [positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]];
}

export function imageOf(place, positions) {
  return [0, 1, 2].map((k) => place.corners.reduce((sum, corner, c) => sum + place.bary[c] * positions[3 * corner + k], 0));
}

/** Which vertices the map leaves out: the ones that repair dropped. */
export function droppedBy(map) {
  return Uint8Array.from(map.vertex, (image) => (image < 0 ? 1 : 0));
}

/**
 * Straight distance between the image of each source vertex and its true place, in units of the square root of the target's area; NaN
 * where the truth is not known. `truth[i]` is a target vertex or -1.
 */
export function straightErrors(images, positions, truth, scale) {
  const errors = new Float32Array(truth.length).fill(NaN);
  for (let i = 0; i < truth.length; ++i) {
    const t = truth[i];
    if (t < 0 || 3 * t >= positions.length) continue;
    errors[i] = scale * Math.hypot(images[3 * i] - positions[3 * t], images[3 * i + 1] - positions[3 * t + 1], images[3 * i + 2] - positions[3 * t + 2]);
  }
  return errors;
}

/** The values at shares `low` and `high` of the finite ones, in order: a range that outliers do not stretch. */
export function percentiles(values, low, high) {
  const finite = Float32Array.from(values).filter(Number.isFinite).sort();
  if (finite.length === 0) return [0, 1];
  const at = (share) => finite[Math.min(finite.length - 1, Math.floor(share * finite.length))];
  return [at(low), at(high)];
}

/** The value of a grid over the sphere (rows of colatitude, columns of longitude, values at the middles of cells) at points on it. */
export function sampleGrid(grid, n, points) {
  const result = new Float32Array(points.length / 3);
  for (let i = 0; i < result.length; ++i) {
    const [x, y, z] = [points[3 * i], points[3 * i + 1], points[3 * i + 2]];
    const r = (Math.acos(Math.max(-1, Math.min(1, z))) / Math.PI) * n - 0.5;
    const c = ((Math.atan2(y, x) / (2 * Math.PI) + 1) % 1) * n - 0.5;
    const [r0, c0] = [Math.floor(r), Math.floor(c)];
    const [u, v] = [r - r0, c - c0];
    const at = (row, column) => {
      // Beyond a pole lies the other side of the globe.
      if (row < 0 || row >= n) return grid[(row < 0 ? 0 : n - 1) * n + (((column + n / 2) % n) + n) % n];
      return grid[row * n + ((column % n) + n) % n];
    };
    result[i] = (1 - u) * ((1 - v) * at(r0, c0) + v * at(r0, c0 + 1)) + u * ((1 - v) * at(r0 + 1, c0) + v * at(r0 + 1, c0 + 1));
  }
  return result;
}

/**
 * Values at all vertices of a mesh from those at a few: first that of the nearest known one, by steps along edges, then means over
 * neighbours with the known values held. Where most values are known, or none, they come back as they are.
 */
export function spread(values, index, rounds = 60) {
  const known = values.reduce((count, value) => count + (Number.isFinite(value) ? 1 : 0), 0);
  if (known === 0 || known > values.length / 2) return values;
  const {from, to} = neighbours(values.length, index);
  let current = Float32Array.from(values);
  let front = [...current.keys()].filter((i) => Number.isFinite(current[i]));
  while (front.length > 0) {
    const next = [];
    for (const i of front) {
      for (let k = from[i]; k < from[i + 1]; ++k) {
        if (Number.isFinite(current[to[k]])) continue;
        current[to[k]] = current[i];
        next.push(to[k]);
      }
    }
    front = next;
  }
  for (let round = 0; round < rounds; ++round) {
    current = current.map((value, i) => {
      if (Number.isFinite(values[i]) || from[i] === from[i + 1]) return value;
      let sum = 0;
      for (let k = from[i]; k < from[i + 1]; ++k) sum += current[to[k]];
      return sum / (from[i + 1] - from[i]);
    });
  }
  return current;
}

/** The neighbours of vertex i are to[from[i]] … to[from[i + 1] - 1]; of a closed mesh each edge is named by one face from either end. */
function neighbours(count, index) {
  const from = new Uint32Array(count + 1);
  for (const corner of index) ++from[corner + 1];
  for (let i = 0; i < count; ++i) from[i + 1] += from[i];
  const at = from.slice();
  const to = new Uint32Array(index.length);
  for (let f = 0; f < index.length; f += 3) for (let k = 0; k < 3; ++k) to[at[index[f + k]]++] = index[f + ((k + 1) % 3)];
  return {from, to};
}
