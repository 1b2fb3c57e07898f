// node serve.mjs PORT SERVER: the page for those who work on it: built anew at each load, everything else from a running server.
import {execFileSync} from 'node:child_process';
import {readFileSync} from 'node:fs';
import {createServer, request} from 'node:http';
import {tmpdir} from 'node:os';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const [port = '8111', server = 'http://127.0.0.1:8080'] = process.argv.slice(2);
const place = join(tmpdir(), `spherematch-page-${port}`);
const TYPES = {js: 'text/javascript', css: 'text/css', html: 'text/html', svg: 'image/svg+xml', txt: 'text/plain'};

function local(path, response) {
  const name = path === '/' ? 'index.html' : path.replace('/page/', '');
  try {
    if (path === '/') execFileSync(process.execPath, [join(here, 'build.mjs'), place], {stdio: ['ignore', 'inherit', 'inherit']});
    response.setHeader('Content-Type', `${TYPES[name.split('.').pop()]}; charset=utf-8`);
    response.end(readFileSync(join(place, name)));
  } catch (error) {
    response.statusCode = 500;
    response.end(String(error));
  }
}

createServer((from, to) => {
  const path = from.url.split('?')[0];
  if (path === '/' || path.startsWith('/page/')) return local(path, to);
  const passed = request(server + from.url, {method: from.method, headers: {...from.headers, connection: 'close'}}, (answer) => {
    to.writeHead(answer.statusCode, answer.headers);
    answer.pipe(to);
  });
  passed.on('error', () => to.destroy());
  from.pipe(passed);
}).listen(Number(port), '127.0.0.1');
