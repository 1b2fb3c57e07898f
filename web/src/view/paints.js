// What each paint puts on the source and on the target. Corresponding points get one colour: a function on the target, carried back to
// the source by the map, or one on the source, carried to the target by the map of the other direction.

import * as workspace from '../workspace.js';
import {percentiles, pullBack, sampleGrid, spread, straightErrors} from '../map/correspondence.js';
import {matchQuery} from '../state.js';
import {MAP_OF_PAINT, normalColours, placeColours} from './colours.js';

const PLAIN = {mode: 'plain'};

/**
 * @param scene {source, target, map}; map is null until it is there
 * @param truth array of target vertices, -1 where unknown, or null
 * @returns {{source, target, legend: {title, low, high, map, note}|null}}, paints as Surface.setPaint takes them
 */
export async function paintsOf(view, scene, truth) {
  const {source, target, map} = scene;
  if (view.paint === 'plain') return {source: PLAIN, target: PLAIN, legend: null};
  if (view.paint === 'signature') return signaturePaints(view, scene);
  if (!source || !target) return single(view, source ?? target);
  if (!map) return {source: PLAIN, target: PLAIN, legend: null};
  switch (view.paint) {
    case 'coordinates':
      return carried(map, placeColours(target.positions, target.box), 3, 'colour');
    case 'normals':
      return carried(map, normalColours(target.normals), 3, 'colour');
    case 'checker':
      return carried(map, checkerPlaces(target), 2, 'checker');
    case 'error':
      return errorPaints(view, scene, truth);
    default:
      return qualityPaints(view, scene);
  }
}

/** One shape alone: what it can show of itself. */
function single(view, shape) {
  let paint = PLAIN;
  if (shape && view.paint === 'coordinates') paint = {mode: 'colour', width: 3, values: placeColours(shape.positions, shape.box)};
  if (shape && view.paint === 'normals') paint = {mode: 'colour', width: 3, values: normalColours(shape.normals)};
  if (shape && view.paint === 'checker') paint = {mode: 'checker', width: 2, values: checkerPlaces(shape)};
  return {source: paint, target: paint, legend: null};
}

function carried(map, values, width, mode) {
  return {source: {mode, width, values: pullBack(map, values, width)}, target: {mode, width, values}, legend: null};
}

/** Places on a sheet of squares, seen from the side at which the shape is broadest. */
function checkerPlaces({positions, box}) {
  const size = box.high.map((value, k) => value - box.low[k]);
  const axes = [0, 1, 2].sort((a, b) => size[b] - size[a]).slice(0, 2);
  const square = size[axes[0]] / 16 || 1;
  const result = new Float32Array((positions.length / 3) * 2);
  for (let i = 0; i < positions.length / 3; ++i) {
    for (let k = 0; k < 2; ++k) result[2 * i + k] = (positions[3 * i + axes[k]] - box.low[axes[k]]) / square;
  }
  return result;
}

async function signaturePaints(view, {source, target}) {
  const sides = await Promise.all([source, target].map(async (shape) => {
    if (!shape) return null;
    const [points, {grids, times, n}] = await Promise.all([workspace.sphere(shape.id), workspace.signature(shape.id)]);
    const t = Math.min(view.time, grids.length - 1);
    return {values: sampleGrid(grids[t], n, points), time: times[t], count: grids.length};
  }));
  const known = sides.filter(Boolean);
  const range = percentiles(known.flatMap(({values}) => Array.from(values)), 0.02, 0.98);
  const [first, second] = sides.map((side) => side ? {mode: 'scalar', width: 1, values: side.values, range, map: MAP_OF_PAINT.signature} : PLAIN);
  const legend = {title: 'Heat kernel signature', low: range[0], high: range[1], map: MAP_OF_PAINT.signature, times: known[0].count, note: `diffusion time ${known[0].time.toPrecision(2)}, at unit area`};
  return {source: first, target: second, legend};
}

/** A number on each source vertex; on the target, that of the point which the other direction's map names. */
async function scalarPaints(view, values, range, paint, legend) {
  const made = (numbers) => ({mode: 'scalar', width: 1, values: numbers, range, map: MAP_OF_PAINT[paint]});
  const back = await workspace.map(matchQuery(view, true)).catch(() => null);
  return {
    source: made(values),
    target: back ? made(pullBack(back, values, 1)) : PLAIN,
    legend: {low: range[0], high: range[1], map: MAP_OF_PAINT[paint], ...legend},
  };
}

async function qualityPaints(view, {map}) {
  const known = await workspace.quality(matchQuery(view));
  if (!known) return {source: PLAIN, target: PLAIN, legend: {title: view.paint, missing: 'This server does not give it.'}};
  Object.assign(map, {confidence: known.confidence, distortion: known.distortion});
  if (view.paint === 'confidence') return scalarPaints(view, known.confidence, [0, 1], 'confidence', {title: 'Confidence', note: 'probability that the image is right'});
  const high = Math.max(percentiles(known.distortion, 0, 0.98)[1], 1e-3);
  return scalarPaints(view, known.distortion, [0, high], 'distortion', {title: 'Distortion', note: '0 where distances are kept'});
}

async function errorPaints(view, {source, target, map}, truth) {
  if (!truth) return {source: PLAIN, target: PLAIN, legend: {title: 'Error', missing: 'Drop ground truth to see errors.'}};
  const errors = straightErrors(pullBack(map, target.positions), target.positions, truth, target.scale);
  const high = Math.max(percentiles(errors, 0, 0.98)[1], 1e-3);
  const all = spread(errors, source.index);
  const note = 'straight distance to the true place over √area' + (all === errors ? '' : ', between the known points interpolated');
  return scalarPaints(view, all, [0, high], 'error', {title: 'Error', note});
}
