#!/usr/bin/python3
"""Do `spherematch evaluate` and another scorer of maps agree, on the points that the other one draws?

    agreement.py --scorer FOLDER pairs.json --data DATA [--only WORD] [--store FILE] [--out result.json]

FOLDER has the scorer as score_server.py, the program that the main README speaks of: its score() is called with the map that
`spherematch match` wrote, and its way of drawing points is repeated here, so that both measure at the same ones. Ends with 1 where
a mean differs by more than 3 percent, or a verdict on flips differs. Needs numpy and what the scorer needs.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile

import numpy as np

LARGEST_DIFFERENCE = 0.03


def drawn_points(scorer, data, pair, samples=300):
    """The source vertices that the scorer draws, and their rows in the landmark lists."""
    rng = np.random.default_rng(0)
    if pair['truth'] == 'identity':
        weights = scorer.vertex_areas(*scorer.mesh(data, pair['set'], pair['src']))
        return rng.choice(len(weights), samples, replace=False, p=weights / weights.sum()), None
    landmarks = scorer.vts(data, pair['set'], pair['src'])
    rows = rng.choice(len(landmarks), min(samples, len(landmarks)), replace=False)
    return landmarks[rows], rows


def write_list(place, name, vertices):
    path = os.path.join(place, name)
    np.savetxt(path, np.asarray(vertices) + 1, fmt='%d')
    return path


def measured(options, scorer, pair, source, target, place):
    points, rows = drawn_points(scorer, options.data, pair)
    command = [options.spherematch, 'evaluate', source, target, place + '/map.npz', '--json', '-']
    if rows is None:
        command += ['--points', write_list(place, 'points.vts', points)]
    else:
        lists = [scorer.vts(options.data, pair['set'], name)[rows] for name in (pair['tgt'], pair['tgt'] + '.sym')]
        command += ['--landmarks', write_list(place, 'a.vts', points), write_list(place, 'b.vts', lists[0]),
                    '--mirrored', write_list(place, 'c.vts', lists[1])]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def compare(options, scorer, pair):
    source, target = (os.path.join(options.data, pair['set'], pair[end] + '.off') for end in ('src', 'tgt'))
    with tempfile.TemporaryDirectory() as place:
        subprocess.run([options.spherematch, 'match', source, target, '--store', options.store, '-o', place + '/map.npz'], check=True,
                       stdout=subprocess.DEVNULL)
        ours = measured(options, scorer, pair, source, target, place)
        with np.load(place + '/map.npz') as arrays:
            theirs = scorer.score(options.data, pair, dict(arrays))
    row = {'set': pair['set'], 'src': pair['src'], 'tgt': pair['tgt'], 'scorer': theirs['direct'], 'evaluate': 100 * ours['geodesic']['mean']}
    row['difference'] = row['evaluate'] / row['scorer'] - 1
    row['p95'] = {'scorer': theirs['p95'], 'evaluate': 100 * ours['geodesic']['p95']}
    row['agree'] = abs(row['difference']) <= LARGEST_DIFFERENCE and bool(ours['flipped']) == theirs['flipped']
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('pairs')
    parser.add_argument('--scorer', required=True)
    parser.add_argument('--data', required=True)
    parser.add_argument('--only', default='', help='pairs whose SET/SRC has this in it')
    parser.add_argument('--store', default='data/experiments.db')
    parser.add_argument('--spherematch', default='build/bin/spherematch')
    parser.add_argument('--out')
    options = parser.parse_args()
    sys.path.insert(0, options.scorer)
    import score_server as scorer
    with open(options.pairs) as file:
        pairs = [pair for pair in json.load(file)['pairs'] if options.only in f"{pair['set']}/{pair['src']}"]
    os.makedirs(os.path.dirname(options.store) or '.', exist_ok=True)
    rows = []
    for pair in pairs:
        rows.append(compare(options, scorer, pair))
        row = rows[-1]
        print(f"{row['set']:>14} {row['src']:>12} -> {row['tgt']:<12} scorer {row['scorer']:7.4f}  evaluate {row['evaluate']:7.4f}  "
              f"{100 * row['difference']:+.2f}%{'' if row['agree'] else '  DIFFERS'}", flush=True)
    print(f"{len(rows)} pairs, largest difference {100 * max(abs(row['difference']) for row in rows):.2f}%")
    if options.out:
        with open(options.out, 'w') as file:
            json.dump(rows, file, indent=1)
    return 0 if all(row['agree'] for row in rows) else 1


if __name__ == '__main__':
    sys.exit(main())
