import assert from 'node:assert/strict';
import test from 'node:test';
import {MAX_PINS, PAINTS, Store, defaults, matchQuery, readAddress, writeAddress} from '../../../web/src/state.js';

const A = '0123456789abcdef0123456789abcdef';
const B = 'fedcba9876543210fedcba9876543210';

test('a view comes back from its address', () => {
  const view = {...defaults(), src: A, tgt: B, candidate: 1, orientation: 'any', refine: 'none', method: 'paper', paint: 'signature', time: 4, form: 'sphere', morph: 0.25,
    align: false, linked: false, shade: false, wire: true, symmetry: true, truth: 'identity', camera: [0, 0, 0, 1, 2, 0.125, -0.5], camera2: [0, 1, 0, 0, 1, 0, 0],
    pins: [{side: 'source', vertex: 12}, {side: 'target', vertex: 99999}]};
  assert.deepEqual(readAddress(writeAddress(view)), view);
});

test('defaults need no address', () => {
  assert.equal(writeAddress(defaults()), '');
  assert.deepEqual(readAddress(''), defaults());
});

test('what an address names wrongly has its default', () => {
  const bad = ['src=xyz', 'candidate=8', 'candidate=-1', 'paint=rainbow', 'time=1.5', 'morph=2', 'morph=', 'align=maybe', 'pins=s1.q2', 'pins=s', 'camera=1_2_3', 'camera=0_0_0_0_1_0_0', 'camera=0_0_0_1_0_0_0', 'camera=a_0_0_1_1_0_0',
    'orientation=Any', 'nothing=1', '__proto__=1', 'toString=1'];
  for (const part of bad) assert.deepEqual(readAddress('#' + part), defaults(), part);
  assert.deepEqual(readAddress('#pins=' + Array.from({length: MAX_PINS + 1}, (_, i) => `s${i}`).join('.')), defaults());
});

test('every paint can stand in an address', () => {
  for (const paint of PAINTS) assert.equal(readAddress(`#paint=${paint}`).paint, paint);
});

test('the query leaves out what is the default, and turns around', () => {
  const view = {...defaults(), src: A, tgt: B};
  assert.equal(String(matchQuery(view)), `src=${A}&tgt=${B}`);
  assert.equal(String(matchQuery({...view, candidate: 1, refine: 'none'}, true)), `src=${B}&tgt=${A}&candidate=1&refine=none`);
});

test('a store tells what has changed, and only that', () => {
  const store = new Store(defaults());
  const heard = [];
  store.subscribe((view, changed) => heard.push([...changed]));
  store.set({paint: 'plain', morph: 0});
  store.set({paint: 'plain'});
  store.set({pins: []});
  store.set({pins: [{side: 'source', vertex: 1}]});
  assert.deepEqual(heard, [['paint'], ['pins']]);
});
