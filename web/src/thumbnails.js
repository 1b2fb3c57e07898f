// Pictures of shapes in the list: the server's, or a quiet tile while there is none.

import {abilities, api, apiKey} from './api.js';
import {h} from './dom.js';

/** A tile in a colour of its own, told by the shape's id, with the first letter of its name. */
export function fallbackTile(shape) {
  const tile = h('div', {class: 'tile', 'aria-hidden': 'true', text: (shape.name || shape.id).slice(0, 1).toUpperCase()});
  tile.style.setProperty('--hue', String(parseInt(shape.id.slice(0, 4), 16) % 360));
  return tile;
}

/** An element that becomes the picture as soon as that is there. */
export function thumbnail(shape) {
  const tile = fallbackTile(shape);
  const path = `/shapes/${shape.id}/thumbnail.png`;
  abilities().then(async ({thumbnails}) => {
    if (!thumbnails) return;
    const image = h('img', {class: 'thumbnail', alt: '', width: 72, height: 72, decoding: 'async'});
    image.addEventListener('load', () => tile.replaceWith(image), {once: true});
    // An image element cannot send a key.
    image.src = apiKey() ? URL.createObjectURL(await api.blob(path)) : path;
  }).catch(() => {});
  return tile;
}
