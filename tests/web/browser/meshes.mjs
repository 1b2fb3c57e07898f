// Meshes that the tests make themselves.
import {off} from './harness.mjs';

/** A closed strip with half a turn: no orientation fits it. */
export function moebius(n = 20) {
  const vertices = [], faces = [];
  for (let i = 0; i < n; ++i) {
    const t = (2 * Math.PI * i) / n;
    for (const s of [-1, 1]) {
      const r = 1 + 0.3 * s * Math.cos(t / 2);
      vertices.push([r * Math.cos(t), r * Math.sin(t), 0.3 * s * Math.sin(t / 2)]);
    }
    const [a, b] = [2 * i, 2 * i + 1];
    const [c, d] = i < n - 1 ? [a + 2, b + 2] : [1, 0];
    faces.push([a, b, c], [b, d, c]);
  }
  return off(vertices, faces);
}

export function torus(n = 24, m = 12) {
  const vertices = [], faces = [];
  for (let i = 0; i < n; ++i) {
    for (let j = 0; j < m; ++j) {
      const [u, v] = [(2 * Math.PI * i) / n, (2 * Math.PI * j) / m];
      vertices.push([(2 + Math.cos(v)) * Math.cos(u), (2 + Math.cos(v)) * Math.sin(u), Math.sin(v)]);
      const at = (k, l) => ((i + k) % n) * m + ((j + l) % m);
      faces.push([at(0, 0), at(1, 0), at(1, 1)], [at(0, 0), at(1, 1), at(0, 1)]);
    }
  }
  return off(vertices, faces);
}

/** A lumpy ball of 6 n² + 2 vertices: the sides of a cube, blown up. `pose` leans its lumps. */
export function lumpyBall(n, pose) {
  const numbers = new Map();
  const vertices = [], faces = [];
  const lumps = [[[0.6, 0.64, 0.48], 0.7 + 0.2 * pose], [[-0.8, 0, 0.6], 0.4], [[0, -0.28, -0.96], 0.6 - 0.2 * pose], [[-0.3, 0.9, -0.3], 0.5]];
  const vertex = (p) => {
    const key = p.join();
    if (!numbers.has(key)) {
      numbers.set(key, vertices.length);
      // Tangents keep the squares even.
      const q = p.map((value) => Math.tan(((value / n - 0.5) * Math.PI) / 2));
      const u = q.map((value) => value / Math.hypot(...q));
      const r = lumps.reduce((sum, [c, height]) => sum + height * Math.exp(-5 * u.reduce((d, value, k) => d + (value - c[k]) ** 2, 0)), 1);
      vertices.push([1.0 * r * u[0], 1.3 * r * u[1], (1.7 + 0.1 * pose) * r * u[2]].map((value) => value.toPrecision(7)));
    }
    return numbers.get(key);
  };
  for (const axis of [0, 1, 2]) {
    for (const side of [0, n]) {
      for (let i = 0; i < n; ++i) {
        for (let j = 0; j < n; ++j) {
          const at = (k, l) => {
            const p = [0, 0, 0];
            p[axis] = side;
            p[(axis + 1) % 3] = i + k;
            p[(axis + 2) % 3] = j + l;
            return vertex(p);
          };
          const square = [at(0, 0), at(1, 0), at(1, 1), at(0, 1)];
          const [a, b, c, d] = side === 0 ? square.reverse() : square;
          faces.push([a, b, c], [a, c, d]);
        }
      }
    }
  }
  return off(vertices, faces);
}
