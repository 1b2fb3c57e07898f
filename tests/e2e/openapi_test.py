"""The running server and docs/openapi.yaml agree: every route, parameter, status and schema."""
import copy
import io
import json
import os
import unittest

import numpy as np
import yaml

import support
from openapi_checker import Checker, Disagreement

DOCUMENT = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'docs', 'openapi.yaml')


class OpenApiTest(support.TestCase):
    @classmethod
    def setUpClass(cls):
        import tempfile
        cls.place = tempfile.TemporaryDirectory(prefix='spherematch-e2e-')
        cls.server = support.Server(cls.place.name + '/s.db')
        with open(DOCUMENT) as file:
            cls.document = yaml.safe_load(file)
        cls.a, cls.b = (cls.server.ready(support.off(support.bumpy(2, seed)), name=f'{seed}.off') for seed in (0.0, 1.0))

    @classmethod
    def tearDownClass(cls):
        cls.server.stop()
        cls.place.cleanup()

    def checker(self, document=None):
        return Checker(document or self.document, lambda method, target, body, headers: self.server.request(method, target, body, headers))

    def target(self, path):
        if path.startswith('/page'):
            return '/page/page.js'
        return path.replace('{id}', self.a if path.startswith('/shapes') else 'p' + self.a)

    def body(self, method, path):
        return {('post', '/shapes'): b'x', ('patch', '/shapes/{id}'): b'{}', ('post', '/match'): b'{}', ('post', '/transfer'): b'x', ('post', '/evaluations'): b'{}'}.get((method, path))

    def check_interface(self, checker):
        """What can be asked of the server without knowing what a route does."""
        for path, item in checker.document['paths'].items():
            checker.check_methods(path, self.target(path))
            for method in item:
                if method != 'parameters':
                    checker.check_parameters(method, path, self.target(path), self.body(method, path))
        pair = f'src={self.a}&tgt={self.b}'
        array = npy(np.zeros(162))
        for method, path, body, rest in (('get', '/shapes', None, ''), ('get', '/jobs', None, ''), ('get', '/match', None, pair),
                                         ('get', '/scene', None, pair), ('post', '/transfer', array, pair),
                                         ('post', '/evaluations', json.dumps({'src': self.a, 'tgt': self.b}).encode(), ''),
                                         ('post', '/shapes', b'x', ''), ('get', '/shapes/{id}/mesh', None, ''),
                                         ('get', '/shapes/{id}/sphere', None, ''), ('get', '/shapes/{id}/hks', None, ''),
                                         ('get', '/shapes/{id}/symmetry', None, ''), ('get', '/shapes/{id}/thumbnail.png', None, '')):
            checker.check_values(method, path, self.target(path), body, rest)

    def walk(self, checker):
        """A session that meets every operation and most of its answers."""
        call, a, b = checker.call, self.a, self.b
        for path in ('/', '/healthz', '/readyz', '/version', '/metrics', '/docs'):
            call('get', path)
        for name in ('page.js', 'page.css', 'icon.svg', 'licences.txt', 'none'):
            call('get', '/page/{id}', '/page/' + name)
        for path in ('/', '/page/page.js'):
            tag = call('get', path.replace('page.js', '{id}'), path).headers['ETag']
            self.assertEqual(call('get', path.replace('page.js', '{id}'), path, headers={'If-None-Match': tag}).status, 304)
        document = call('get', '/openapi.json')
        self.assertEqual(document.json(), self.document)
        call('get', '/openapi.json', headers={'If-None-Match': document.headers['ETag']})

        mesh = support.off(support.bumpy(1, 0.5))
        created = call('post', '/shapes', '/shapes?name=c&wait=60&tags=x,y', mesh)
        self.assertIn(created.status, (201, 202))
        c = created.json()['id']
        call('post', '/shapes', '/shapes?wait=60', mesh)
        for target, bad in (('/shapes', b'x'), ('/shapes', b'OFF\n3 1 0\n0 0 0\n1 0 0\n'), ('/shapes?repair=none', support.off(open_mesh())),
                            ('/shapes?repair=x', b'x')):
            self.assertGreaterEqual(call('post', '/shapes', target, bad).status, 400)
        call('get', '/shapes', '/shapes?limit=1')
        call('get', '/shapes', '/shapes?limit=0')
        one = call('get', '/shapes/{id}', '/shapes/' + c)
        call('get', '/shapes/{id}', '/shapes/' + c, headers={'If-None-Match': one.headers['ETag']})
        changed = call('patch', '/shapes/{id}', '/shapes/' + c, b'{"name": "d", "tags": ["z"]}')
        self.assertEqual((changed.json()['name'], changed.json()['tags']), ('d', ['z']))
        self.assertEqual(call('patch', '/shapes/{id}', '/shapes/' + c, b'{}', {'If-Match': one.headers['ETag']}).status, 412)
        call('patch', '/shapes/{id}', '/shapes/' + c, b'[')
        for part, formats in (('mesh', ('original', 'off', 'obj', 'ply', 'stl', 'glb', 'x')), ('sphere', ('npy', 'ply')), ('hks', ('npz', 'npy')),
                              ('symmetry', ('json', 'npz', 'npy', 'txt', 'map', 'ply', 'glb', 'obj', 'png')), ('thumbnail.png', ())):
            path = '/shapes/{id}/' + part
            for name in formats:
                call('get', path, f'/shapes/{a}/{part}?format={name}')
            tagged = call('get', path, f'/shapes/{a}/{part}')
            self.assertEqual(call('get', path, f'/shapes/{a}/{part}', headers={'If-None-Match': tagged.headers['ETag']}).status, 304)
            self.assertEqual(call('get', path, f'/shapes/{a}/{part}', headers={'Accept': 'video/mp4'}).status, 406)
            self.assertEqual(call('get', path, f'/shapes/{"0" * 32}/{part}').status, 404)
        self.matches(checker)
        self.evaluations(checker)
        self.jobs(checker)
        self.assertEqual(call('delete', '/shapes/{id}', '/shapes/' + c).status, 204)
        for method in ('get', 'delete'):
            self.assertEqual(call(method, '/shapes/{id}', '/shapes/' + c).status, 404)
        self.assertEqual(call('patch', '/shapes/{id}', '/shapes/' + c, b'{}').status, 404)

    def matches(self, checker):
        call, pair = checker.call, f'src={self.a}&tgt={self.b}'
        for rest in ('fields=vertex,corners,bary,confidence,distortion&both=yes', 'format=npz', 'format=npy', 'format=txt', 'format=map', 'format=ply', 'format=glb', 'format=obj',
                     'format=png', 'format=npz&fields=confidence', 'format=txt&fields=confidence', 'fields=faces', 'orientation=any', 'refine=none',
                     'refine=x', 'candidate=0', 'candidate=7', 'hints=0:0', 'hints=0:99999'):
            tagged = call('get', '/match', f'/match?{pair}&{rest}')
        tagged = call('get', '/match', '/match?' + pair)
        self.assertEqual(call('get', '/match', '/match?' + pair, headers={'If-None-Match': tagged.headers['ETag']}).status, 304)
        self.assertEqual(call('get', '/match', '/match?' + pair, headers={'Accept': 'video/mp4'}).status, 406)
        self.assertEqual(call('get', '/match', f'/match?src={self.a}&tgt={"0" * 32}').status, 404)
        points = {'src': self.a, 'tgt': self.b, 'points': [0, {'corners': [0, 1, 2], 'bary': [1, 0, 0]}], 'landmarks': {'x': {'position': [1, 2, 3]}}}
        checker.validate(points, {'$ref': '#/components/schemas/PointsRequest'}, 'the request')
        self.assertEqual(call('post', '/match', '/match', json.dumps(points).encode()).status, 200)
        call('post', '/match', '/match', b'{}')
        for array in (np.arange(162.0), np.zeros((162, 4), 'u1'), np.zeros(3)):
            call('post', '/transfer', '/transfer?' + pair, npy(array))
        call('post', '/transfer', '/transfer?' + pair, b'x')
        for rest in ('format=ply', 'format=glb&as=value', 'format=png', 'format=png&as=x'):
            call('post', '/transfer', f'/transfer?{pair}&{rest}', npy(np.arange(162)))
        call('post', '/transfer', '/transfer?' + pair, npy(np.arange(162)), {'Accept': 'video/mp4'})
        scene = call('get', '/scene', '/scene?' + pair)
        call('get', '/scene', '/scene?' + pair, headers={'If-None-Match': scene.headers['ETag']})

    def evaluations(self, checker):
        call, every = checker.call, list(range(162))
        for truth in (None, 'identity', every, {'source': every, 'target': every}, {'source': [0, 5], 'target': [0, 5], 'mirrored': [5, 0]}):
            body = {'src': self.a, 'tgt': self.b, 'truth': truth, 'refine': 'none', 'orientation': 'preserve'}
            checker.validate(body, {'$ref': '#/components/schemas/EvaluationRequest'}, 'the request')
            self.assertEqual(call('post', '/evaluations', '/evaluations', json.dumps(body).encode()).status, 200)
            call('post', '/evaluations', '/evaluations?format=svg', json.dumps(body).encode())
        for wrong in ({'truth': [0]}, {'truth': 'x'}, {'tgt': '0' * 32}):
            call('post', '/evaluations', '/evaluations', json.dumps({'src': self.a, 'tgt': self.b, **wrong}).encode())
        call('post', '/evaluations', '/evaluations', json.dumps(body).encode(), {'Accept': 'video/mp4'})

    def jobs(self, checker):
        call = checker.call
        body = {'pairs': [[self.a, self.b], [self.b, self.a]], 'fields': 'vertex,bary', 'both': True, 'refine': 'none'}
        checker.validate(body, {'$ref': '#/components/schemas/PairsRequest'}, 'the request')
        job = call('post', '/match', '/match', json.dumps(body).encode()).json()['id']
        lines = call('get', '/jobs/{id}/results', f'/jobs/{job}/results')
        self.assertEqual(len(lines.body.splitlines()), 2)
        for target in (job, 'p' + self.a, 'x'):
            call('get', '/jobs/{id}', f'/jobs/{target}?wait=10')
        call('get', '/jobs', '/jobs?limit=1')
        call('get', '/jobs', '/jobs?state=done')
        call('get', '/jobs/{id}/results', f'/jobs/p{self.a}/results')
        self.assertEqual(call('delete', '/jobs/{id}', '/jobs/' + job).status, 204)
        self.assertEqual(call('delete', '/jobs/{id}', '/jobs/' + job).status, 404)
        self.assertEqual(call('delete', '/jobs/{id}', '/jobs/p' + self.a).status, 409)

    def test_the_server_is_as_documented(self):
        checker = self.checker()
        checker.check_references()
        self.check_interface(checker)
        self.walk(checker)
        for path, item in self.document['paths'].items():
            for method in item:
                if method == 'parameters':
                    continue
                self.assertTrue([seen for seen in checker.seen if seen[:2] == (method, path) and seen[2] < 300], f'{method} {path} never succeeded')

    def test_what_is_taken_out_of_the_document_is_missed(self):
        def without(*place):
            document = copy.deepcopy(self.document)
            holder = document
            for part in place[:-1]:
                holder = holder[part]
            del holder[place[-1]]
            return document

        def renamed_parameter():
            document = copy.deepcopy(self.document)
            document['paths']['/shapes']['get']['parameters'].pop()
            return document

        for what, document in (('an operation', without('paths', '/shapes/{id}', 'patch')),
                               ('a parameter', renamed_parameter()),
                               ('a status', without('paths', '/shapes/{id}', 'get', 'responses', '304')),
                               ('a media type', without('paths', '/match', 'get', 'responses', '200', 'content', 'image/png')),
                               ('a member of an answer', without('components', 'schemas', 'Match', 'properties', 'cached')),
                               ('a member within', without('components', 'schemas', 'Repair', 'properties', 'filled_loops')),
                               ('a member of a request', without('components', 'schemas', 'PointsRequest', 'properties', 'landmarks'))):
            checker = self.checker(document)
            with self.subTest(what), self.assertRaises(Disagreement):
                self.check_interface(checker)
                self.walk_parts(checker)

    def walk_parts(self, checker):
        one = checker.call('get', '/shapes/{id}', '/shapes/' + self.a)
        checker.call('get', '/shapes/{id}', '/shapes/' + self.a, headers={'If-None-Match': one.headers['ETag']})
        self.matches(checker)


def npy(array):
    file = io.BytesIO()
    np.save(file, array)
    return file.getvalue()


def open_mesh():
    vertices, faces = support.bumpy(1)
    return vertices, faces[1:]


if __name__ == '__main__':
    unittest.main()
