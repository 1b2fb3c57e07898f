// The cumulative error curve: for each threshold the share of errors that are at most as large.

import {svg} from '../dom.js';

const [WIDTH, HEIGHT, LEFT, BOTTOM, TOP, RIGHT] = [256, 158, 26, 30, 6, 12];

/** `curves`: [{values, class, name}] over the same thresholds */
export function curveFigure(thresholds, curves, description) {
  const last = thresholds[thresholds.length - 1];
  const x = (threshold) => LEFT + (threshold / last) * (WIDTH - LEFT - RIGHT);
  const y = (share) => TOP + (1 - share) * (HEIGHT - TOP - BOTTOM);
  const figure = svg('svg', {class: 'curve', viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: 'img', 'aria-label': description});
  for (const share of [0, 0.25, 0.5, 0.75, 1]) {
    figure.append(svg('path', {class: 'frame', d: `M${LEFT} ${y(share)}H${WIDTH - RIGHT}`}), text(LEFT - 4, y(share) + 3, `${share * 100}`, 'end'));
  }
  for (let k = 0; k <= 5; ++k) figure.append(text(x((last * k) / 5), HEIGHT - 17, (Math.round(last * 20 * k) / 100).toString(), 'middle'));
  figure.append(text((LEFT + WIDTH) / 2, HEIGHT - 4, 'geodesic error over √area', 'middle'));
  for (const {values, kind} of curves) {
    figure.append(svg('path', {class: `line ${kind}`, d: values.map((share, i) => `${i ? 'L' : 'M'}${x(thresholds[i]).toFixed(1)} ${y(share).toFixed(1)}`).join('')}));
  }
  return figure;
}

function text(x, y, content, anchor) {
  const element = svg('text', {x, y, 'text-anchor': anchor});
  element.textContent = content;
  return element;
}
