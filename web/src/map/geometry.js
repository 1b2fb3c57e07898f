// Sizes, places and rotations of shapes, on flat arrays of coordinates.

/** Area, centroid of the surface, and the place and size that make its area 1 around the origin. */
export function measure({positions, index}) {
  let area = 0;
  const centre = [0, 0, 0];
  for (let i = 0; i < index.length; i += 3) {
    const [a, b, c] = [index[i] * 3, index[i + 1] * 3, index[i + 2] * 3];
    const part = triangleArea(positions, a, b, c);
    area += part;
    for (let k = 0; k < 3; ++k) centre[k] += (part * (positions[a + k] + positions[b + k] + positions[c + k])) / 3;
  }
  for (let k = 0; k < 3; ++k) centre[k] /= area || 1;
  const scale = area > 0 ? 1 / Math.sqrt(area) : 1;
  return {area, centre, scale};
}

function triangleArea(p, a, b, c) {
  const [ux, uy, uz] = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]];
  const [vx, vy, vz] = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
  return Math.hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx) / 2;
}

/** Positions moved by -centre and scaled. */
export function normalised(positions, {centre, scale}) {
  const result = new Float32Array(positions.length);
  for (let i = 0; i < positions.length; ++i) result[i] = (positions[i] - centre[i % 3]) * scale;
  return result;
}

export function boundingBox(positions, dropped = null) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; ++i) {
    if (dropped?.[Math.floor(i / 3)]) continue;
    low[i % 3] = Math.min(low[i % 3], positions[i]);
    high[i % 3] = Math.max(high[i % 3], positions[i]);
  }
  return {low, high};
}

export function radiusOf(positions) {
  let square = 0;
  for (let i = 0; i < positions.length; i += 3) {
    square = Math.max(square, positions[i] ** 2 + positions[i + 1] ** 2 + positions[i + 2] ** 2);
  }
  return Math.sqrt(square);
}

/**
 * The rotation (x, y, z, w) that brings the points of `from` closest to those of `to`, both around the origin; rows that are not
 * finite are left out. Horn, "Closed-form solution of absolute orientation using unit quaternions", 1987: the eigenvector of the
 * largest eigenvalue of a symmetric 4 x 4 matrix.
 */
export function closestRotation(from, to) {
  const s = new Array(9).fill(0);
  for (let i = 0; i < from.length; i += 3) {
    if (!Number.isFinite(from[i]) || !Number.isFinite(to[i])) continue;
    for (let a = 0; a < 3; ++a) for (let b = 0; b < 3; ++b) s[a * 3 + b] += from[i + a] * to[i + b];
  }
  const [xx, xy, xz, yx, yy, yz, zx, zy, zz] = s;
  const matrix = [
    [xx + yy + zz, yz - zy, zx - xz, xy - yx],
    [yz - zy, xx - yy - zz, xy + yx, zx + xz],
    [zx - xz, xy + yx, yy - xx - zz, yz + zy],
    [xy - yx, zx + xz, yz + zy, zz - xx - yy],
  ];
  const {values, vectors} = symmetricEigen(matrix);
  const best = values.indexOf(Math.max(...values));
  const [w, x, y, z] = vectors.map((row) => row[best]);
  return [x, y, z, w];
}

/** Eigenvalues and the matrix whose columns are the eigenvectors, by Jacobi rotations. */
export function symmetricEigen(input) {
  const n = input.length;
  const a = input.map((row) => [...row]);
  const vectors = a.map((_, i) => a.map((_, j) => (i === j ? 1 : 0)));
  for (let sweep = 0; sweep < 50; ++sweep) {
    let off = 0;
    for (let p = 0; p < n; ++p) for (let q = p + 1; q < n; ++q) off += a[p][q] ** 2;
    if (off < 1e-22 * a.reduce((sum, row, i) => sum + row[i] ** 2, 0)) break;
    for (let p = 0; p < n; ++p) for (let q = p + 1; q < n; ++q) if (a[p][q] !== 0) rotate(a, vectors, p, q);
  }
  return {values: a.map((row, i) => row[i]), vectors};
}

function rotate(a, vectors, p, q) {
  const theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const t = (theta >= 0 ? 1 : -1) / (Math.abs(theta) + Math.hypot(theta, 1));
  const c = 1 / Math.hypot(t, 1);
  const s = t * c;
  for (const row of a) [row[p], row[q]] = [c * row[p] - s * row[q], s * row[p] + c * row[q]];
  for (let k = 0; k < a.length; ++k) [a[p][k], a[q][k]] = [c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]];
  for (const row of vectors) [row[p], row[q]] = [c * row[p] - s * row[q], s * row[p] + c * row[q]];
}

/** v turned by the quaternion q = (x, y, z, w). */
export function turn([x, y, z, w], [vx, vy, vz]) {
  const [tx, ty, tz] = [2 * (y * vz - z * vy), 2 * (z * vx - x * vz), 2 * (x * vy - y * vx)];
  return [vx + w * tx + y * tz - z * ty, vy + w * ty + z * tx - x * tz, vz + w * tz + x * ty - y * tx];
}

export const conjugate = ([x, y, z, w]) => [-x, -y, -z, w];

/**
 * The rotation that shows a shape from its broad side: its least extent along the line of sight, and upright as far as the file tells.
 */
export function broadSide(positions) {
  const moments = [[0, 0, 0], [0, 0, 0], [0, 0, 0]];
  const step = 3 * Math.max(1, Math.floor(positions.length / 30000));
  for (let i = 0; i < positions.length; i += step) {
    for (let a = 0; a < 3; ++a) for (let b = 0; b < 3; ++b) moments[a][b] += positions[i + a] * positions[i + b];
  }
  const {values, vectors} = symmetricEigen(moments);
  const column = (k) => vectors.map((row) => row[k]);
  let sight = column(values.indexOf(Math.min(...values)));
  if (sight[2] < -0.1 || (Math.abs(sight[2]) <= 0.1 && sight[0] < 0)) sight = sight.map((value) => -value);
  const axis = [0, 0, 0];
  axis[uprightAxis(positions, [1, 2].filter((k) => Math.abs(sight[k]) < 0.8))] = 1;
  const along = axis.reduce((sum, value, k) => sum + value * sight[k], 0);
  const up = unit(axis.map((value, k) => value - along * sight[k]));
  const right = cross(up, sight);
  return quaternionOfRows([right, up, sight]);
}

/**
 * Files have y or z upwards. y, unless the shape, of which the origin is the centre, would fall over that way and stand on z: unless its
 * centre is above what touches the ground.
 */
function uprightAxis(positions, axes) {
  if (axes.length < 2) return axes[0] ?? 1;
  const {low, high} = boundingBox(positions);
  const stands = (axis) => {
    const ground = low[axis] + 0.04 * (high[axis] - low[axis]);
    return [0, 1, 2].filter((k) => k !== axis).every((side) => {
      let [least, most] = [Infinity, -Infinity];
      for (let i = 0; i < positions.length; i += 3) {
        if (positions[i + axis] > ground) continue;
        least = Math.min(least, positions[i + side]);
        most = Math.max(most, positions[i + side]);
      }
      return least <= 0 && most >= 0;
    });
  };
  return !stands(1) && stands(2) ? 2 : 1;
}

const unit = (v) => v.map((value) => value / Math.hypot(...v));
const cross = ([a, b, c], [x, y, z]) => [b * z - c * y, c * x - a * z, a * y - b * x];

/** Of a rotation matrix given by its rows. */
export function quaternionOfRows([[a, b, c], [d, e, f], [g, hh, i]]) {
  // The largest of four equivalent formulas, for accuracy.
  const options = [[1 + a - e - i, b + d, c + g, hh - f], [b + d, 1 - a + e - i, f + hh, c - g], [c + g, f + hh, 1 - a - e + i, d - b], [hh - f, c - g, d - b, 1 + a + e + i]];
  const best = options.reduce((max, row, k) => (row[k] > options[max][max] ? k : max), 0);
  return unit(options[best]);
}
