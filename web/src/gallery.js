// The list of stored shapes, and above it the uploads that are under way or were refused.

import {api} from './api.js';
import {announce, debounced, h, icon, number} from './dom.js';
import {fallbackTile, thumbnail} from './thumbnails.js';
import {upload} from './upload.js';

const POLL = 400;
const isActive = ({state}) => state === 'queued' || state === 'processing';

/** What is asked for with an upload beyond the server's defaults. */
function chosenOptions() {
  const options = {repair: document.getElementById('repair').value, simplify: document.getElementById('simplify').value};
  return Object.fromEntries(Object.entries(options).filter(([, value]) => value && value !== 'fill'));
}

export class Gallery {
  /** `actions`: {choose(side, shape), uploaded(shape), removed(id), explain(file, problem), failed(error)} */
  constructor(store, actions) {
    this.store = store;
    this.actions = actions;
    this.shapes = new Map();
    this.cards = new Map();
    this.list = document.getElementById('shapes');
    this.uploads = document.getElementById('uploads');
    this.more = document.getElementById('more');
    this.more.addEventListener('click', () => this.load(this.cursor));
    const search = document.getElementById('search');
    search.addEventListener('input', debounced(() => this.find(search.value.trim()), 200));
    store.subscribe((view, changed) => {
      if (changed.has('src') || changed.has('tgt')) this.mark();
    });
  }

  async find(text) {
    this.query = text;
    this.shapes.clear();
    this.cards.clear();
    this.list.replaceChildren();
    await this.load();
    announce(`${this.shapes.size} shapes`);
  }

  async load(cursor) {
    try {
      const query = this.query;
      const page = await api.shapes(cursor, query);
      if (query !== this.query) return;
      for (const shape of page.items) this.show(shape, false);
      this.cursor = page.next_cursor;
      this.more.hidden = !this.cursor;
      this.list.dataset.loaded = 'true';
      this.follow();
    } catch (error) {
      this.actions.failed(error);
    }
  }

  /** Adds a shape's card or brings it up to date. */
  show(shape, first = true) {
    const known = this.shapes.get(shape.id);
    this.shapes.set(shape.id, shape);
    if (known && JSON.stringify(known) === JSON.stringify(shape)) return;
    const card = this.card(shape);
    const before = this.cards.get(shape.id);
    if (before) before.replaceWith(card);
    else if (first) this.list.prepend(card);
    else this.list.append(card);
    this.cards.set(shape.id, card);
    this.mark();
  }

  card(shape) {
    const ready = shape.state === 'ready';
    const name = shape.name || shape.id.slice(0, 8);
    const picture = ready ? thumbnail(shape) : fallbackTile(shape);
    const side = (which) => h('button', {type: 'button', class: 'side', data: {side: which}, 'aria-pressed': 'false', disabled: !ready,
      title: `Show ${name} as the ${which}`, 'aria-label': `${name} as ${which}`, text: which === 'source' ? 'Source' : 'Target',
      on: {click: () => this.actions.choose(which, shape)}});
    return h('li', {class: `card ${shape.state}`, data: {id: shape.id, state: shape.state, name}},
      h('div', {class: 'picture'}, picture),
      h('div', {class: 'about'},
        h('div', {class: 'title'}, h('span', {class: 'name', text: name, title: name}),
          h('button', {type: 'button', class: 'bare', title: 'Rename', 'aria-label': `Rename ${name}`, on: {click: () => this.rename(shape)}}, icon('pencil')),
          h('button', {type: 'button', class: 'bare', title: 'Delete', 'aria-label': `Delete ${name}`, on: {click: () => this.remove(shape)}}, icon('trash'))),
        this.stateLine(shape),
        ready && h('div', {class: 'sides'}, side('source'), side('target'))));
  }

  stateLine(shape) {
    if (shape.state === 'failed') {
      return h('div', {class: 'meta bad'}, shape.error?.detail ?? 'failed', ' ',
        h('button', {type: 'button', class: 'link', text: 'Details', on: {click: () => this.actions.explain(null, shape.error)}}));
    }
    if (isActive(shape)) {
      const words = shape.state === 'queued' ? 'waiting' : shape.stage ?? 'preparing';
      return h('div', {class: 'meta'}, h('progress', {max: 1, value: shape.progress, 'aria-label': `Preparing ${shape.name}`}), h('span', {class: 'stage-name', text: words}));
    }
    const mended = Object.entries(shape.repair ?? {}).filter(([, count]) => typeof count === 'number' && count > 0);
    return h('div', {class: 'meta'}, `${number(shape.vertices)} vertices`,
      mended.length > 0 && h('span', {class: 'mended', text: 'mended', title: mended.map(([what, count]) => `${what.replaceAll('_', ' ')}: ${count}`).join('\n')}));
  }

  mark() {
    const {src, tgt} = this.store.view;
    for (const [id, card] of this.cards) {
      for (const button of card.querySelectorAll('.side')) button.setAttribute('aria-pressed', String(id === (button.dataset.side === 'source' ? src : tgt)));
      card.classList.toggle('chosen', id === src || id === tgt);
    }
  }

  /** Asks after shapes that are being prepared, until all have ended. */
  follow() {
    if (this.following) return;
    const active = () => [...this.shapes.values()].filter(isActive);
    const step = async () => {
      await Promise.all(active().map(({id}) => api.shape(id).then((shape) => this.progress(shape), () => this.drop(id))));
      this.following = active().length > 0 ? setTimeout(step, POLL) : 0;
    };
    if (active().length > 0) this.following = setTimeout(step, POLL);
  }

  progress(shape) {
    const ended = isActive(this.shapes.get(shape.id)) && !isActive(shape);
    this.show(shape);
    if (!ended) return;
    announce(`${shape.name} is ${shape.state}`);
    if (shape.state === 'ready') this.actions.uploaded(shape);
    else this.actions.explain(null, shape.error);
  }

  async send(files) {
    await Promise.all([...files].map((file) => this.sendOne(file)));
  }

  async sendOne(file) {
    const bar = h('progress', {max: 1, value: 0, 'aria-label': `Sending ${file.name}`});
    const line = h('div', {class: 'meta'}, bar, h('span', {text: 'sending'}));
    const row = h('li', {class: 'upload', data: {name: file.name, state: 'sending'}}, h('span', {class: 'name', text: file.name}), line);
    this.uploads.append(row);
    try {
      const shape = await upload(file, (share) => {
        bar.value = share;
        if (share === 1) line.lastChild.textContent = 'checking';
      }, chosenOptions());
      row.remove();
      this.show(shape);
      if (shape.state === 'ready') this.actions.uploaded(shape);
      this.follow();
    } catch (error) {
      const problem = error.problem ?? {title: 'The upload failed', detail: error.message, elements: []};
      row.dataset.state = 'refused';
      row.dataset.code = problem.code;
      line.replaceWith(h('div', {class: 'meta bad'}, h('strong', {text: problem.title + '. '}), problem.detail),
        h('div', {class: 'sides'},
          h('button', {type: 'button', text: problem.elements?.length ? 'Show where' : 'Details', on: {click: () => this.actions.explain(file, problem)}}),
          h('button', {type: 'button', text: 'Dismiss', on: {click: () => row.remove()}})));
      announce(`${file.name} was refused: ${problem.detail}`);
    }
  }

  async rename(shape) {
    const name = prompt('Name', shape.name);
    if (name === null || name === shape.name) return;
    await api.rename(shape.id, name).then((renamed) => this.show(renamed), this.actions.failed);
  }

  async remove(shape) {
    if (!confirm(`Delete ${shape.name || shape.id} and everything derived from it?`)) return;
    try {
      await api.remove(shape.id);
      this.drop(shape.id);
    } catch (error) {
      this.actions.failed(error);
    }
  }

  drop(id) {
    this.cards.get(id)?.remove();
    this.cards.delete(id);
    this.shapes.delete(id);
    this.actions.removed(id);
  }
}
