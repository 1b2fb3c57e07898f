// node build.mjs OUTPUT [--watch]: bundles src/ into OUTPUT and compresses it. The server holds these files in its program.
import {createHash} from 'node:crypto';
import {mkdirSync, readFileSync, readdirSync, writeFileSync} from 'node:fs';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';
import {gzipSync} from 'node:zlib';
import * as esbuild from 'esbuild';

const here = dirname(fileURLToPath(import.meta.url));
const output = process.argv[2] ?? join(here, 'dist');

const options = {
  absWorkingDir: here,
  entryPoints: {page: 'src/main.js', style: 'src/styles/page.css'},
  entryNames: '[name]',
  outdir: output,
  bundle: true,
  minify: true,
  format: 'esm',
  target: ['es2022', 'chrome110', 'firefox110', 'safari16'],
  legalComments: 'none',
  write: false,
};

/** The licences of what the bundle holds of others, named by the files that went into it. */
function licences(metafile) {
  const packages = new Set(Object.keys(metafile.inputs).map((path) => /^node_modules\/((?:@[^/]+\/)?[^/]+)/.exec(path)?.[1]).filter(Boolean));
  return [...packages].sort().map((name) => {
    const folder = join(here, 'node_modules', name);
    const {version, license} = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
    const file = readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
    return `${name} ${version} (${license})\n\n${file ? readFileSync(join(folder, file), 'utf8').trim() : ''}\n`;
  }).join('\n' + '-'.repeat(80) + '\n\n');
}

function write(name, content) {
  writeFileSync(join(output, name), content);
  writeFileSync(join(output, name + '.gz'), gzipSync(content, {level: 9}));
}

mkdirSync(output, {recursive: true});
const result = await esbuild.build({...options, metafile: true});
const files = Object.fromEntries(result.outputFiles.map(({path, contents}) => [path.endsWith('.css') ? 'page.css' : 'page.js', Buffer.from(contents)]));
const version = createHash('sha256').update(files['page.js']).update(files['page.css']).digest('hex').slice(0, 16);
write('page.js', files['page.js']);
write('page.css', files['page.css']);
write('index.html', readFileSync(join(here, 'src/index.html'), 'utf8').replaceAll('@VERSION@', version));
write('icon.svg', readFileSync(join(here, 'src/icon.svg')));
write('licences.txt', licences(result.metafile));
