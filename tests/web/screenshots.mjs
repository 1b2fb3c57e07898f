// node tests/web/screenshots.mjs OUTPUT: the pictures of the README and of docs/page.md, taken of the page in a browser, before a server
// with the shipped samples. SPHEREMATCH_SERVER names the server's program; by default that of the build.
import {writeFileSync} from 'node:fs';
import {join, resolve} from 'node:path';
import {fileURLToPath} from 'node:url';

process.env.SPHEREMATCH_SERVER ??= fileURLToPath(new URL('../../build/bin/spherematch-server', import.meta.url));
const {launch, open, openPage, prepare, sample, settled, startServer} = await import('./browser/harness.mjs');
const {moebius} = await import('./browser/meshes.mjs');

const output = resolve(process.argv[2] ?? 'docs/images');
const server = await startServer();
const browser = await launch();
const ids = {};
for (const name of ['imp/stand.off', 'imp/dance.off', 'imp/wave.off', 'hound/sit.off', 'hound/bow.off', 'hound/stand.off', 'hound/leap.glb']) ids[name] = await prepare(server.url, name);

/** `prepared(page)` brings a page to what is to be seen. */
async function take(name, fragment, prepared = async () => {}, options = {}) {
  const page = await openPage(browser, {viewport: {width: 1320, height: 800}, ...options});
  await open(page, server.url, fragment);
  await prepared(page);
  await page.waitForTimeout(900);
  await settled(page);
  await page.screenshot({path: join(output, `${name}.jpg`), type: 'jpeg', quality: 88});
  await page.close();
}

const view = (source, target, rest) => `#src=${ids[source]}&tgt=${ids[target]}${rest}`;
const truth = async (page, ...files) => {
  await page.setInputFiles('#truth-files', files.map(sample));
  await page.waitForSelector('#evaluation[data-mean]');
};

try {
  await take('page', view('hound/stand.off', 'hound/leap.glb', '&pins=s4437.s100.s3152'));
  await take('page-error', view('imp/stand.off', 'imp/dance.off', '&paint=error'), async (page) => {
    await truth(page, 'imp/stand.vts', 'imp/dance.vts', 'imp/dance.sym.vts');
    await page.locator('#evaluation').scrollIntoViewIfNeeded();
    await page.locator('[data-section="truth"]').evaluate((element) => element.scrollIntoView({block: 'start'}));
  }, {colorScheme: 'dark'});
  await take('page-checker', view('imp/stand.off', 'imp/wave.off', '&paint=checker'));
  await take('page-sphere', view('hound/stand.off', 'hound/leap.glb', '&paint=coordinates&form=sphere'), undefined, {colorScheme: 'dark'});
  await take('page-symmetry', view('imp/stand.off', 'imp/wave.off', '&paint=normals&symmetry=1'), (page) => page.waitForTimeout(4000));
  await take('page-problem', view('hound/stand.off', 'hound/leap.glb', ''), async (page) => {
    const file = join(server.place, 'strip.off');
    writeFileSync(file, moebius());
    await page.setInputFiles('#files', file);
    await page.getByRole('button', {name: 'Show where'}).click();
  });
} finally {
  await browser.close();
  await server.stop();
}
