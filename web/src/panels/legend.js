// What the colours mean, below the stage.

import {h, number} from '../dom.js';
import {mapGradient} from '../view/colours.js';

const WORDS = {
  coordinates: 'Corresponding points have one colour: the place of the image on the target.',
  normals: 'Corresponding points have one colour: the direction of the target’s surface at the image.',
  checker: 'A sheet of squares laid over the target and carried to the source by the map.',
  plain: 'No colours: form and light alone.',
};

export function showLegend(element, store, legend) {
  const {paint, time} = store.view;
  element.dataset.paint = paint;
  if (!legend) {
    element.replaceChildren(h('p', {text: WORDS[paint] ?? ''}));
    return;
  }
  if (legend.missing) {
    element.replaceChildren(h('p', {class: 'missing', text: legend.missing}));
    return;
  }
  const bar = h('span', {class: 'ramp', 'aria-hidden': 'true'});
  bar.style.backgroundImage = mapGradient(legend.map);
  const scale = h('div', {class: 'scale'}, h('span', {text: number(legend.low, 2)}), bar, h('span', {text: number(legend.high, 2)}));
  const children = [h('strong', {text: legend.title}), scale, h('p', {text: legend.note})];
  if (legend.times > 1) {
    const input = h('input', {type: 'range', id: 'time', min: 0, max: legend.times - 1, step: 1, value: Math.min(time, legend.times - 1), on: {input: () => store.set({time: Number(input.value)})}});
    children.splice(2, 0, h('label', {class: 'time', for: 'time'}, 'Time ', input));
  }
  const held = document.activeElement?.id === 'time';
  element.replaceChildren(...children);
  if (held) document.getElementById('time')?.focus();
}
