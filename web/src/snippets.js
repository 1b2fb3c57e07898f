// The lines that do with curl, Python or C++ what the page shows.

/** @param query of GET /match, a URLSearchParams; @param files {source, target}: names of the two meshes */
export function snippets(origin, query, files) {
  const options = [...query].filter(([name]) => name !== 'src' && name !== 'tgt');
  return {curl: curl(origin, query, files), python: python(origin, query, options, files), cpp: cpp(origin, query, options)};
}

function curl(origin, query, {source, target}) {
  return [
    `# the shapes were uploaded as ${source} and ${target}`,
    `curl '${origin}/match?${query}&format=npz' -o map.npz`,
    `curl '${origin}/match?${query}&format=glb' -o map.glb`,
    `curl '${origin}/match?${query}&fields=vertex,corners,bary' -o map.json`,
  ].join('\n');
}

function python(origin, query, options, {source, target}) {
  const keywords = options.map(([name, value]) => `, ${name}=${name === 'candidate' ? value : `'${value}'`}`).join('');
  return [
    'import spherematch',
    '',
    `client = spherematch.Client('${origin}')`,
    `source = client.shape('${query.get('src')}')  # ${source}`,
    `target = client.shape('${query.get('tgt')}')  # ${target}`,
    `result = client.match(source, target${keywords})`,
    'print(result.vertex[:10], result.corners.shape, result.bary.shape)',
  ].join('\n');
}

function cpp(origin, query, options) {
  const order = ['method', 'refine', 'orientation', 'candidate'];
  const members = options.sort(([a], [b]) => order.indexOf(a) - order.indexOf(b)).map(([name, value]) => `.${name} = ${name === 'candidate' ? value : `"${value}"`}`);
  const given = members.length ? `, {${members.join(', ')}}` : '';
  return [
    '#include <spherematch/client/client.h>',
    '',
    `const spherematch::client::Client client("${origin}");`,
    `const auto map = client.match("${query.get('src')}",`,
    `                              "${query.get('tgt')}"${given});`,
    '// map.vertex, map.corners, map.bary: a row for each source vertex',
  ].join('\n');
}
