// One key for each of the page's everyday steps. Nothing is taken while a person types.

import {openHelp} from './dialog.js';
import {PAINTS} from './state.js';

const FLIPS = {l: 'linked', a: 'align', y: 'symmetry', e: 'wire', h: 'shade'};

/** `actions`: {swap(), home()} */
export function listen(store, actions) {
  addEventListener('keydown', (event) => {
    const {target, key} = event;
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    if (target.closest('input:not([type=checkbox]):not([type=range]), select, textarea, dialog')) return;
    const {view} = store;
    const name = key.toLowerCase();
    const paint = /^[1-8]$/.test(key) ? PAINTS[Number(key) - 1] : null;
    if (paint) store.set({paint});
    else if (FLIPS[name]) store.set({[FLIPS[name]]: !view[FLIPS[name]]});
    else if (key === '?') openHelp();
    else if (name === 'x') actions.swap();
    else if (name === 'r') actions.home();
    else if (name === 'c') store.set({candidate: view.candidate === 0 ? 1 : 0});
    else if (name === 's') store.set({form: view.form === 'surface' ? 'sphere' : 'surface'});
    else if (name === 'm') actions.morph();
    else if (name === 'g') document.getElementById('vertex')?.focus();
    else if (key === 'Escape') store.set({pins: []});
    else return;
    event.preventDefault();
  });
}
