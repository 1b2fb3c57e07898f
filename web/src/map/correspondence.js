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
