// The page as a person meets it: in a browser, before the real server.
import assert from 'node:assert/strict';
import {readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {after, before, describe, test} from 'node:test';
import {goTo, launch, listedPoint, markers, open, openPage, picture, prepare, sample, settled, stageState, startServer} from './harness.mjs';
import {moebius, torus} from './meshes.mjs';

let server, browser, page, stand, leap;

before(async () => {
  server = await startServer();
  browser = await launch();
  page = await openPage(browser);
});

after(async () => {
  await browser?.close();
  await server?.stop();
});

/** Whether a marker is well within its pane, off the captions and buttons. */
async function inside(page, side, {x, y}) {
  const box = await page.locator(`.pane.${side}`).boundingBox();
  return x > box.x + 20 && x < box.x + box.width - 20 && y > box.y + 60 && y < box.y + box.height - 70;
}

const pair = (rest = '') => `#src=${stand}&tgt=${leap}${rest}`;
const match = async (src, tgt, rest = '') => (await fetch(`${server.url}/match?src=${src}&tgt=${tgt}&fields=vertex,corners,bary${rest}`)).json();

describe('uploads', () => {
  test('two files are sent, prepared with progress, listed and matched', async () => {
    await page.addInitScript(() => {
      window.seen = [];
      new MutationObserver(() => {
        for (const element of document.querySelectorAll('.upload, .card')) {
          const word = `${element.dataset.name} ${element.dataset.state}${element.querySelector('progress') ? ' with progress' : ''}`;
          if (!window.seen.includes(word)) window.seen.push(word);
        }
      }).observe(document, {subtree: true, childList: true, attributes: true});
    });
    await open(page, server.url, '', 'empty');
    await page.setInputFiles('#files', [sample('hound/stand.off'), sample('hound/leap.glb')]);
    await stageState(page, 'matched', 60_000);
    const seen = await page.evaluate(() => window.seen);
    for (const name of ['stand.off', 'leap.glb']) {
      assert.ok(seen.includes(`${name} sending with progress`), seen.join(', '));
      assert.ok(seen.some((word) => new RegExp(`^${name} (queued|processing) with progress$`).test(word)), seen.join(', '));
      assert.ok(seen.includes(`${name} ready`), seen.join(', '));
    }
    assert.equal(await page.locator('#shapes .card.ready').count(), 2);
    assert.equal(await page.locator('#uploads > *').count(), 0);
    const shapes = (await (await fetch(`${server.url}/shapes`)).json()).items;
    stand = shapes.find(({name}) => name === 'stand.off').id;
    leap = shapes.find(({name}) => name === 'leap.glb').id;
    assert.deepEqual(new Set(new URL(page.url()).hash.slice(1).split('&').map((part) => part.split('=')[1])), new Set([stand, leap]));
  });

  test('a refused mesh gives the server\u2019s words, and the offending edge on the mesh', async () => {
    page.expected = /status of 422/;
    const file = join(server.place, 'strip.off');
    writeFileSync(file, moebius());
    const refusal = await (await fetch(`${server.url}/shapes`, {method: 'POST', body: moebius()})).json();
    assert.equal(refusal.elements.length, 1);
    await page.setInputFiles('#files', file);
    const row = page.locator('.upload[data-state="refused"]');
    await row.waitFor();
    assert.equal(await row.getAttribute('data-code'), refusal.code);
    assert.ok((await row.textContent()).includes(refusal.detail));
    await row.getByRole('button', {name: 'Show where'}).click();
    const dialog = page.getByRole('dialog');
    assert.ok((await dialog.textContent()).includes(`edge ${refusal.elements[0].edge.join('–')}`));
    // One edge and its two ends.
    assert.equal(await dialog.locator('.problem-view').getAttribute('data-marks'), '3');
    const box = await dialog.locator('canvas').boundingBox();
    const {at} = await picture(page);
    let red = 0, mesh = 0;
    for (let x = box.x; x < box.x + box.width; x += 2) {
      for (let y = box.y; y < box.y + box.height; y += 2) {
        const [r, g, b] = at(x, y);
        if (r > 180 && g < 90 && b < 90) ++red;
        if (Math.max(r, g, b) < 190) ++mesh;
      }
    }
    assert.ok(red > 10, `${red} red pixels`);
    assert.ok(mesh > 1000, `${mesh} pixels of the mesh`);
    await page.keyboard.press('Escape');
    await row.getByRole('button', {name: 'Dismiss'}).click();
    assert.equal(await page.locator('.upload').count(), 0);
  });

  test('a handle is named, where no edge can be', async () => {
    const file = join(server.place, 'ring.off');
    writeFileSync(file, torus());
    await page.setInputFiles('#files', file);
    const row = page.locator('.upload[data-code="wrong-genus"]');
    await row.getByRole('button', {name: 'Details'}).click();
    assert.match(await page.getByRole('dialog').textContent(), /genus 1/);
    await page.keyboard.press('Escape');
    await row.getByRole('button', {name: 'Dismiss'}).click();
    page.expected = null;
  });
});

describe('the match', () => {
  test('corresponding pixels have one colour, different ones different colours', async () => {
    await open(page, server.url, pair('&shade=0'));
    const colours = [];
    const {vertex} = await match(stand, leap);
    for (let v = 1000; v < vertex.length && colours.length < 4; v += 131) {
      await goTo(page, 'source', v);
      const [[own], [image]] = await Promise.all([markers(page, 'source'), markers(page, 'target')]);
      if (own.hidden || image.hidden || !(await inside(page, 'source', own)) || !(await inside(page, 'target', image))) continue;
      const {at} = await picture(page);
      const [a, b] = [at(own.x, own.y), at(image.x, image.y)];
      // At the rim of a shape a pixel is partly of what is behind.
      if ([own, image].some(({x, y}) => [[-3, 0], [3, 0], [0, -3], [0, 3]].some(([u, v]) => at(x + u, y + v).some((value, k) => Math.abs(value - at(x, y)[k]) > 12)))) continue;
      a.forEach((value, k) => assert.ok(Math.abs(value - b[k]) <= 5, `vertex ${v}: ${a} and ${b}`));
      if (colours.every((other) => other.some((value, k) => Math.abs(value - a[k]) > 24))) colours.push(a);
    }
    assert.equal(colours.length, 4, 'too few colours are visible on both sides');
  });

  for (const side of ['source', 'target']) {
    test(`a click on the ${side} shows what GET /match says`, async () => {
      await open(page, server.url, pair());
      const [own, other] = side === 'source' ? [stand, leap] : [leap, stand];
      const map = await match(own, other);
      let clicked = 0;
      for (let v = 100; v < map.vertex.length && clicked < 3; v += 397) {
        await goTo(page, side, v);
        const [marker] = await markers(page, side, '.own');
        if (marker.hidden || !(await inside(page, side, marker))) continue;
        await page.click('text=Clear points');
        await page.mouse.click(marker.x, marker.y);
        await page.waitForSelector('.point.pin[data-image]');
        const point = await listedPoint(page);
        const i = Number(point.vertex);
        assert.equal(point.side, side);
        const [found] = await markers(page, side, '.own');
        assert.ok(Math.hypot(found.x - marker.x, found.y - marker.y) < 12, 'the vertex is under the pointer');
        assert.equal(Number(point.image), map.vertex[i]);
        assert.deepEqual(point.corners.split(',').map(Number), map.corners[i]);
        // The archive has weights as 32-bit numbers.
        point.bary.split(',').map(Number).forEach((weight, k) => assert.ok(Math.abs(weight - map.bary[i][k]) < 1e-6));
        ++clicked;
      }
      assert.equal(clicked, 3);
    });
  }

  test('hovering shows the image without keeping it', async () => {
    await open(page, server.url, pair());
    await goTo(page, 'source', 100);
    const [marker] = await markers(page, 'source', '.own');
    await page.click('text=Clear points');
    await page.mouse.move(marker.x, marker.y);
    await page.waitForSelector('.point.hover[data-image]');
    assert.equal((await markers(page, 'target', '.image')).length, 1);
    await page.mouse.move(5, 5);
    await page.waitForSelector('.point.hover', {state: 'detached'});
    assert.ok(!page.url().includes('pins'));
  });

  test('another candidate is another map', async () => {
    await open(page, server.url, pair('&pins=s700'));
    await page.waitForSelector('.point.pin[data-image]');
    await page.getByRole('group', {name: 'Candidate'}).getByRole('button').nth(1).click();
    await page.waitForFunction(() => location.hash.includes('candidate=1') && document.getElementById('stage').dataset.state === 'matched');
    const second = await match(stand, leap, '&candidate=1');
    await page.waitForFunction((expected) => document.querySelector('.point.pin')?.dataset.image === expected, String(second.vertex[700]));
    assert.notEqual(second.vertex[700], (await match(stand, leap)).vertex[700]);
  });

  test('swapped, the pins change sides', async () => {
    await open(page, server.url, pair('&pins=s700'));
    await page.getByRole('button', {name: 'Swap source and target'}).click();
    await page.waitForFunction((src) => location.hash.startsWith(`#src=${src}`) && document.getElementById('stage').dataset.state === 'matched', leap);
    await page.waitForSelector('.point.pin[data-side="target"][data-vertex="700"][data-image]');
  });
});

describe('the address', () => {
  test('holds the whole view: another window shows the same', async () => {
    await open(page, server.url, pair());
    await page.getByRole('button', {name: 'Checker'}).click();
    await page.getByLabel('Light').uncheck();
    await goTo(page, 'source', 321);
    await page.locator('.pane.source').focus();
    for (const key of ['ArrowLeft', 'ArrowLeft', 'ArrowUp', '+']) await page.keyboard.press(key);
    await page.locator('#slider-morph').fill('0.35');
    await page.waitForFunction(() => location.hash.includes('camera=') && location.hash.includes('morph=0.35'));
    const address = page.url();
    const before = await markers(page, 'target');
    const first = await picture(page);
    const other = await openPage(browser);
    await open(other, server.url, new URL(address).hash);
    await other.waitForSelector('.point.pin[data-image]');
    const second = await picture(other);
    assert.equal(other.url(), address);
    assert.equal(await other.getByRole('button', {name: 'Checker'}).getAttribute('aria-pressed'), 'true');
    assert.equal(await other.getByLabel('Light').isChecked(), false);
    assert.equal(await other.locator('#slider-morph').inputValue(), '0.35');
    const after = await markers(other, 'target');
    assert.ok(Math.abs(before[0].x - after[0].x) < 1 && Math.abs(before[0].y - after[0].y) < 1, JSON.stringify([before, after]));
    const stage = await page.locator('#stage').boundingBox();
    let different = 0, painted = 0;
    for (let x = stage.x + 3; x < stage.x + stage.width; x += 5) {
      for (let y = stage.y + 3; y < stage.y + stage.height; y += 5) {
        const [a, b] = [first.at(x, y), second.at(x, y)];
        if (a.some((value, k) => Math.abs(value - b[k]) > 24)) ++different;
        if (Math.min(...a) < 150) ++painted;
      }
    }
    assert.ok(painted > 200, `${painted} painted pixels`);
    assert.ok(different < 0.05 * painted, `${different} of ${painted} pixels differ`);
    assert.deepEqual(other.complaints, []);
    await other.close();
  });

  test('remembers the pair before: back leads there', async () => {
    await open(page, server.url, pair());
    await page.getByRole('button', {name: 'Swap source and target'}).click();
    await page.waitForFunction((src) => location.hash.startsWith(`#src=${src}`), leap);
    await page.goBack();
    await page.waitForFunction((src) => location.hash.startsWith(`#src=${src}`) && document.getElementById('stage').dataset.state === 'matched', stand);
    assert.match(await page.title(), /^stand\.off → leap\.glb/);
  });

  test('with nonsense shows the page all the same', async () => {
    await open(page, server.url, '#src=nonsense&paint=rainbow', 'empty');
    await page.waitForSelector('#shapes .card.ready');
  });

  test('of a shape that is gone says so', async () => {
    page.expected = /status of 404/;
    await open(page, server.url, `#src=${'0'.repeat(32)}&tgt=${leap}`, 'failed');
    assert.equal(await page.locator('#notice').getAttribute('data-code'), 'not-found');
    page.expected = null;
  });
});

describe('views', () => {
  test('sphere, morph, symmetry and edges each change the picture', async () => {
    await open(page, server.url, pair());
    const look = async () => {
      const stage = await page.locator('#stage').boundingBox();
      const {at} = await picture(page);
      const samples = [];
      for (let x = stage.x + 5; x < stage.x + stage.width; x += 9) for (let y = stage.y + 50; y < stage.y + stage.height - 60; y += 9) samples.push(at(x, y));
      return samples;
    };
    const differ = (a, b) => a.filter((colour, i) => colour.some((value, k) => Math.abs(value - b[i][k]) > 20)).length;
    let before = await look();
    const steps = [
      ['[data-form="sphere"]', () => page.getByRole('button', {name: 'Sphere'}).click()],
      ['[data-form="surface"][data-symmetry="true"]', async () => {
        await page.getByRole('button', {name: 'Surface'}).click();
        await page.getByLabel('Symmetry').check();
      }],
      ['[data-morph="1"]', () => page.locator('#slider-morph').fill('1')],
      ['[data-wire="true"]', () => page.getByLabel('Edges').check()],
    ];
    for (const [mark, step] of steps) {
      await step();
      await page.waitForSelector('#stage' + mark);
      const now = await look();
      assert.ok(differ(before, now) > 60, `${mark}: ${differ(before, now)} of ${now.length} samples differ`);
      before = now;
    }
  });

  test('every paint shows itself or says why not', async () => {
    await open(page, server.url, pair());
    const buttons = page.getByRole('group', {name: 'Colour by'}).getByRole('button');
    for (let k = 0; k < (await buttons.count()); ++k) {
      await buttons.nth(k).click();
      const paint = await buttons.nth(k).getAttribute('data-value');
      await page.waitForSelector(`#stage[data-paint="${paint}"]`);
      assert.notEqual((await page.locator('#legend').textContent()).trim(), '', paint);
    }
    assert.equal(await page.locator('#notice').isVisible(), false);
  });

  test('confidence and distortion are those of GET /match', async () => {
    const query = `src=${stand}&tgt=${leap}`;
    const values = await (await fetch(`${server.url}/match?${query}&fields=confidence,distortion`)).json();
    await open(page, server.url, pair('&paint=confidence&pins=s1234'));
    const percent = `confidence ${(100 * values.confidence[1234]).toFixed(0)} %`;
    await page.waitForFunction((text) => document.querySelector('.point.pin .confidence')?.textContent === text, percent);
    assert.match(await page.locator('#legend').textContent(), /Confidence/);
    await page.waitForSelector('#legend .ramp');
    await page.getByRole('button', {name: 'Distortion'}).click();
    await page.waitForFunction(() => document.querySelector('#legend strong')?.textContent === 'Distortion');
  });

  test('ground truth gives the server\u2019s figures, a curve and coloured errors', async () => {
    await open(page, server.url, pair('&paint=error'));
    assert.match(await page.locator('#legend').textContent(), /Drop ground truth/);
    await page.setInputFiles('#truth-files', ['stand.vts', 'leap.vts', 'leap.sym.vts'].map((name) => sample(`hound/${name}`)));
    await page.waitForSelector('#evaluation[data-mean]');
    const read = (name) => readFileSync(sample(`hound/${name}`), 'utf8').trim().split('\n').map(Number);
    const body = {src: stand, tgt: leap, base: 1, both: false, biharmonic: false, truth: {source: read('stand.vts'), target: read('leap.vts'), mirrored: read('leap.sym.vts')}};
    const {geodesic} = await (await fetch(`${server.url}/evaluations`, {method: 'POST', body: JSON.stringify(body)})).json();
    assert.equal(Number(await page.locator('#evaluation').getAttribute('data-mean')), geodesic.mean);
    const path = await page.locator('#evaluation .line.first').getAttribute('d');
    assert.equal(path.match(/[ML]/g).length, geodesic.curve.length);
    await page.waitForSelector('#legend .ramp');
    assert.match(await page.locator('#legend').textContent(), /straight distance/);
    await goTo(page, 'source', body.truth.source[7] - 1);
    assert.match(await page.locator('.point.pin .error').textContent(), /^error [\d.]+ \([\d.]+ %\)$/);
  });
});

describe('taking things along', () => {
  test('every download is there, in its format', async () => {
    await open(page, server.url, pair());
    await page.waitForSelector('#downloads a');
    const links = await page.$$eval('#downloads a', (all) => all.map((link) => [link.textContent, link.href]));
    const {formats} = await (await fetch(`${server.url}/version`)).json();
    assert.ok(formats.match.length > 7);
    assert.deepEqual(links.map(([name]) => name), [...formats.match.map((name) => name.toUpperCase()), 'Scene']);
    for (const [name, href] of links) {
      const answer = await fetch(href);
      assert.equal(answer.status, 200, name);
      assert.ok((await answer.arrayBuffer()).byteLength > 1000, name);
    }
  });

  test('the lines to copy ask for this match', async () => {
    for (const [language, words] of [['curl', 'curl'], ['Python', 'spherematch.Client'], ['C++', '#include <spherematch/client/client.h>']]) {
      await page.getByRole('group', {name: 'Language'}).getByRole('button', {name: language, exact: true}).click();
      const text = await page.locator('#lines code').textContent();
      for (const part of [words, stand, leap, server.url]) assert.ok(text.includes(part), `${language}: ${part}`);
    }
  });
});

test('keys do what the help says', async () => {
  await open(page, server.url, pair());
  await page.keyboard.press('3');
  await page.waitForSelector('#stage[data-paint="checker"]');
  await page.keyboard.press('s');
  await page.waitForSelector('#stage[data-form="sphere"]');
  await page.keyboard.press('m');
  await page.waitForSelector('#stage[data-form="surface"][data-morph="1"]');
  await page.keyboard.press('g');
  await page.keyboard.type('42');
  await page.keyboard.press('Enter');
  await page.waitForSelector('.point.pin[data-vertex="42"]');
  assert.equal(await page.locator('#stage').getAttribute('data-paint'), 'checker', 'digits typed into a field are no keys');
  await page.locator('#vertex').evaluate((element) => element.blur());
  await page.keyboard.press('Escape');
  await page.waitForSelector('.point', {state: 'detached'});
  await page.keyboard.press('?');
  await page.waitForSelector('dialog[data-name="help"]');
  await page.keyboard.press('Escape');
  await page.waitForSelector('dialog', {state: 'detached'});
  await page.keyboard.press('x');
  await page.waitForFunction((src) => location.hash.startsWith(`#src=${src}`), leap);
});

test('a deleted shape leaves the list and the stage', async () => {
  const crouch = await prepare(server.url, 'imp/crouch.off');
  await open(page, server.url, `#src=${crouch}`, 'shown');
  page.once('dialog', (dialog) => dialog.accept());
  const card = page.locator(`.card[data-id="${crouch}"]`);
  await card.hover();
  await card.getByRole('button', {name: /^Delete/}).click();
  await card.waitFor({state: 'detached'});
  await stageState(page, 'empty');
  assert.equal((await fetch(`${server.url}/shapes/${crouch}`)).status, 404);
});

test('nothing was complained about', async () => {
  await settled(page);
  assert.deepEqual(page.complaints, []);
});
