// Colour maps of even perceptual steps, as a few of their colours with linear steps between, and the colours of places and directions.

const MAPS = {
  // viridis, by Stéfan van der Walt and Nathaniel Smith (CC0)
  viridis: ['440154', '472d7b', '3b528b', '2c728e', '21918c', '28ae80', '5ec962', 'addc30', 'fde725'],
  // Light where all is well; after "rocket" and "mako" of seaborn (BSD)
  rocket: ['faebdd', 'f7cfb3', 'f6b48f', 'f37651', 'e13342', 'ad1759', '701f57', '35193e', '1c0e24'],
  mako: ['0b0405', '2e1e3c', '413d7b', '37659e', '348fa7', '40b7ad', '8bdab2', 'def5e5'],
};

export const MAP_OF_PAINT = {signature: 'mako', distortion: 'rocket', confidence: 'viridis', error: 'rocket'};

const parse = (hex) => [0, 2, 4].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255);

/** @returns r, g, b from 0 to 1 */
export function mapColour(name, share) {
  const stops = MAPS[name].map(parse);
  const at = Math.max(0, Math.min(1, share)) * (stops.length - 1);
  const low = Math.min(Math.floor(at), stops.length - 2);
  return stops[low].map((value, k) => value + (at - low) * (stops[low + 1][k] - value));
}

/** A row of `count` RGBA texels. */
export function mapTexels(name, count = 256) {
  const texels = new Uint8Array(count * 4);
  for (let i = 0; i < count; ++i) texels.set([...mapColour(name, i / (count - 1)).map((value) => Math.round(value * 255)), 255], i * 4);
  return texels;
}

export function mapGradient(name) {
  return `linear-gradient(to right, ${MAPS[name].map((hex) => '#' + hex).join(', ')})`;
}

/**
 * Colours of places: x, y, z within the box are red, green, blue as in the server's files, a little less glaring. The step is affine, so
 * that the colour of a point between vertices is what the map gives its preimage.
 */
export function placeColours(positions, {low, high}) {
  const result = new Float32Array(positions.length);
  const widest = Math.max(...high.map((value, k) => value - low[k])) || 1;
  for (let i = 0; i < positions.length; i += 3) {
    const rgb = [0, 1, 2].map((k) => (positions[i + k] - low[k]) / (high[k] - low[k] || widest));
    result.set(calmer(rgb), i);
  }
  return result;
}

export function normalColours(normals) {
  const result = new Float32Array(normals.length);
  for (let i = 0; i < normals.length; i += 3) result.set(calmer([0, 1, 2].map((k) => 0.5 + 0.5 * normals[i + k])), i);
  return result;
}

function calmer(rgb) {
  const gray = 0.3 * rgb[0] + 0.5 * rgb[1] + 0.2 * rgb[2];
  return rgb.map((value) => 0.1 + 0.84 * (0.86 * value + 0.14 * gray));
}
