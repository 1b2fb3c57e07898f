#!/usr/bin/python3
"""Is a vertex's confidence the share of images that are right? Asks a running server, and compares with the truth.

    confidence.py URL pairs.json --data DATA --scorer FOLDER [--only WORD]

FOLDER has the scorer as score_server.py, the program that the main README speaks of, whose points are drawn here and measured by its
geodesic_errors(). An image is right within 3 percent of the square root of the target's area. Prints for each tenth of confidence how many
points there are and what share of them is right, for each set the means of both, and the chance that a right point has more confidence than
a wrong one. Needs numpy and what the scorer needs.
"""
import argparse
import json
import sys

import numpy as np

RIGHT = 0.03


def points_of(scorer, data, pair, match, samples=300):
    """Confidence and error at the points that the scorer draws."""
    corners, bary = np.array(match['corners']), np.array(match['bary'])
    rng = np.random.default_rng(0)
    if pair['truth'] == 'identity':
        weights = scorer.vertex_areas(*scorer.mesh(data, pair['set'], pair['src']))
        source = truth = rng.choice(len(weights), samples, replace=False, p=weights / weights.sum())
    else:
        landmarks = scorer.vts(data, pair['set'], pair['src'])
        rows = rng.choice(len(landmarks), min(samples, len(landmarks)), replace=False)
        source, truth = landmarks[rows], scorer.vts(data, pair['set'], pair['tgt'])[rows]
    mapped = corners[source].min(axis=1) >= 0
    source, truth = source[mapped], truth[mapped]
    vertices, _, graph, _ = scorer.target(data, pair['set'], pair['tgt'])
    errors = scorer.geodesic_errors(vertices, graph, corners[source], bary[source], truth)
    return np.array(match['confidence'])[source], errors


def chance_of_order(confidence, right):
    """That a right point has more confidence than a wrong one: the area under the receiver operating characteristic."""
    ranks = np.argsort(np.argsort(confidence)) + 1.0
    count = right.sum()
    return (ranks[right].sum() - count * (count + 1) / 2) / (count * (~right).sum())


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('url')
    parser.add_argument('pairs')
    parser.add_argument('--data', required=True)
    parser.add_argument('--scorer', required=True)
    parser.add_argument('--only', default='', help='pairs whose SET/SRC has this in it')
    options = parser.parse_args()
    sys.path.insert(0, options.scorer)
    import score_server as scorer
    server = scorer.Server(options.url, options.data, False, 1, None)
    found = {}
    with open(options.pairs) as file:
        pairs = [pair for pair in json.load(file)['pairs'] if options.only in f"{pair['set']}/{pair['src']}"]
    for pair in pairs:
        a, b = (server.upload(pair['set'], pair[end])['id'] for end in ('src', 'tgt'))
        match = json.loads(server.call('GET', f'/match?src={a}&tgt={b}&fields=corners,bary,confidence')[0])
        found.setdefault(pair['set'], []).append(points_of(scorer, options.data, pair, match))
    sets = {name: [np.concatenate(column) for column in zip(*points)] for name, points in found.items()}
    confidence, errors = (np.concatenate(column) for column in zip(*sets.values()))
    right = errors < RIGHT
    tenth = np.minimum((10 * confidence).astype(int), 9)
    for i in range(10):
        here = tenth == i
        print(f'confidence {i / 10:.1f} to {(i + 1) / 10:.1f}: {here.sum():5d} points' + (f', right {right[here].mean():.2f}' if here.any() else ''))
    for name, (value, error) in sets.items():
        print(f'{name}: mean confidence {value.mean():.2f}, right {(error < RIGHT).mean():.2f}')
    print(f'{len(confidence)} points of {len(pairs)} pairs: a right one has more confidence than a wrong one in {chance_of_order(confidence, right):.2f} of cases')


if __name__ == '__main__':
    main()
