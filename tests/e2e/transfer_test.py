"""Arrays carried along a map, scenes, and changes of names and tags, through a real server. Needs NumPy, as those who send arrays have it."""
import io
import json
import struct
import tempfile
import unittest

import numpy as np

import result_files
import support

SRC = support.bumpy(2)
# A stray triangle behind the surface: its three vertices are dropped.
TGT = (lambda v, f: (v + [(9, 9, 9), (9.1, 9, 9), (9, 9.1, 9)], f + [(len(v), len(v) + 1, len(v) + 2)]))(*support.bumpy(3, 1.0))
N_SRC, N_TGT = len(SRC[0]), len(TGT[0])


def npy(array, **options):
    file = io.BytesIO()
    np.lib.format.write_array(file, np.asanyarray(array), **options)
    return file.getvalue()


class TransferTest(support.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix='spherematch-e2e-')
        cls.server = support.Server(cls.temporary.name + '/s.db')
        cls.src, cls.tgt = cls.server.ready(support.off(SRC), name='source'), cls.server.ready(support.off(TGT), name='target')
        with np.load(io.BytesIO(cls.server.get('/match', src=cls.src, tgt=cls.tgt, format='npz').body)) as match:
            cls.vertex, cls.corners, cls.bary = match['vertex'], match['corners'], match['bary'].astype(float)

    @classmethod
    def tearDownClass(cls):
        code = cls.server.stop()
        cls.temporary.cleanup()
        assert code == 0, code

    def post(self, body, src=None, tgt=None, **query):
        return self.server.request('POST', '/transfer', body=body, query={'src': src or self.src, 'tgt': tgt or self.tgt, **query})

    def carried(self, array, options=None, **query):
        response = self.post(npy(array, **(options or {})), **query)
        self.assertEqual((response.status, response.headers['Content-Type']), (200, 'application/x-npy'), response.body[:300])
        result = np.load(io.BytesIO(response.body), allow_pickle=False)
        self.assertEqual((result.dtype, result.shape[1:]), (array.dtype, array.shape[1:]))
        return result

    def interpolated(self, array):
        weights = self.bary.reshape(self.bary.shape + (1,) * (array.ndim - 1))
        return (weights * array[self.corners].astype(float)).sum(axis=1)

    def test_linear_on_positions_gives_the_images(self):
        positions = np.array(TGT[0], dtype=float)
        images = self.carried(positions)
        np.testing.assert_allclose(images, self.interpolated(positions), rtol=0, atol=1e-12)
        rows, _ = result_files.read_ply(self.server.get('/match', src=self.src, tgt=self.tgt, format='ply').body)
        np.testing.assert_allclose(images, [(row['tx'], row['ty'], row['tz']) for row in rows], rtol=0, atol=1e-5)

    def test_every_shape_and_order_and_floating_type(self):
        random = np.random.default_rng(1)
        for shape in ((N_TGT,), (N_TGT, 1), (N_TGT, 4), (N_TGT, 2, 3), (N_TGT, 0), (N_TGT, 2, 0, 3)):
            for dtype, error in (('<f8', 1e-12), ('>f8', 1e-12), ('<f4', 1e-5), ('>f4', 1e-5), ('<f2', 1e-2)):
                values = random.normal(size=shape).astype(dtype)
                for array in (values, np.asfortranarray(values)):
                    np.testing.assert_allclose(self.carried(array).astype(float), self.interpolated(values), rtol=0, atol=error)
                    np.testing.assert_array_equal(self.carried(array, interp='nearest'), values[self.vertex])

    def test_every_version_of_the_format(self):
        values = np.arange(N_TGT, dtype='f4')
        for version in ((1, 0), (2, 0), (3, 0)):
            np.testing.assert_array_equal(self.carried(values, {'version': version}, interp='nearest'), values[self.vertex])

    def test_nearest_moves_rows_of_any_plain_dtype(self):
        numbers = np.arange(N_TGT)
        for array in (numbers.astype('u1'), numbers.astype('>i8'), numbers % 2 == 0, numbers.astype('<c16') * 1j, numbers.astype('S5'),
                      numbers.astype('<U4'), numbers.astype('>U4'), numbers.astype('M8[s]'), numbers.astype('m8[ns]'),
                      np.array([bytes([i % 256, 1, 2]) for i in numbers], dtype='V3'), numbers.reshape(-1, 1) * np.ones((1, 5), dtype='i2')):
            np.testing.assert_array_equal(self.carried(array), array[self.vertex])

    def test_dropped_vertices_have_no_row(self):
        """Against the direction of the other tests: the stray triangle is of the source now."""
        for dtype in ('<f8', '>f4', '<f2'):
            for interp in ('linear', 'nearest'):
                result = self.carried(np.ones((N_SRC, 2), dtype=dtype), src=self.tgt, tgt=self.src, interp=interp)
                self.assertEqual(len(result), N_TGT)
                np.testing.assert_array_equal(np.isnan(result).all(axis=1), np.arange(N_TGT) >= N_TGT - 3)
        result = self.carried(np.ones(N_SRC, dtype='u2'), src=self.tgt, tgt=self.src)
        np.testing.assert_array_equal(result, np.arange(N_TGT) < N_TGT - 3)

    def test_what_does_not_fit_is_refused(self):
        good = np.arange(N_TGT, dtype='f4')
        mismatch = self.assert_problem(self.post(npy(good[1:])), 422, 'length-mismatch')
        self.assertEqual((mismatch['limit'], mismatch['actual']), (N_TGT, N_TGT - 1))
        self.assert_problem(self.post(npy(np.float32(3))), 400, 'malformed-array')
        self.assert_problem(self.post(npy(np.array([None] * N_TGT), allow_pickle=True)), 400, 'malformed-array')
        self.assert_problem(self.post(npy(np.zeros(N_TGT, dtype=[('a', 'f4'), ('b', 'i4')]))), 400, 'malformed-array')
        self.assert_problem(self.post(npy(np.zeros(N_TGT, dtype=np.longdouble))), 400, 'malformed-array')
        for body in (b'', b'1 2 3', npy(good)[:-1], npy(good) + b'x', npy(good)[:20]):
            self.assert_problem(self.post(body), 400, 'malformed-array')
        problem = self.assert_problem(self.post(npy(np.arange(N_TGT)), interp='linear'), 400, 'invalid-parameter')
        self.assertIn('nearest works', problem['detail'])
        self.assert_problem(self.post(npy(good), interp='cubic'), 400, 'invalid-parameter')
        self.assert_problem(self.post(npy(good), tgt='0' * 32), 404, 'not-found')
        self.assertEqual(self.server.get('/healthz').json()['status'], 'ok')

    def test_a_few_wide_rows_do_not_become_too_many(self):
        tetrahedron = [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)], [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)]
        small = self.server.ready(support.off(tetrahedron))
        wide = np.zeros((4, 2_000_000), dtype='u1')
        problem = self.assert_problem(self.post(npy(wide), tgt=small), 413, 'payload-too-large')
        self.assertEqual(problem['actual'], N_SRC * 2_000_000)

    def test_the_scene(self):
        response = self.server.get('/scene', src=self.src, tgt=self.tgt)
        self.assertEqual((response.status, response.headers['Content-Type']), (200, 'model/gltf-binary'))
        length, = struct.unpack_from('<I', response.body, 12)
        document = json.loads(response.body[20:20 + length])
        self.assertEqual([node['name'] for node in document['nodes']], ['source', 'target'])
        binary = response.body[28 + length:]

        def rows(mesh, attribute):
            accessor = document['accessors'][document['meshes'][mesh]['primitives'][0]['attributes'][attribute]]
            view = document['bufferViews'][accessor['bufferView']]
            dtype, width = {'POSITION': ('<f4', 3), 'COLOR_0': ('u1', 4)}[attribute]
            return np.frombuffer(binary, dtype, accessor['count'] * width, view['byteOffset']).reshape(-1, width)

        places = [rows(mesh, 'POSITION') + np.array(document['nodes'][mesh].get('translation', (0, 0, 0))) for mesh in (0, 1)]
        np.testing.assert_allclose(places[0], SRC[0], atol=1e-5)
        self.assertGreater(places[1][:, 0].min(), places[0][:, 0].max())
        used = np.array(TGT[0][:-3])
        normalized = (np.array(TGT[0]) - used.min(axis=0)) / (used.max(axis=0) - used.min(axis=0))
        colours = rows(1, 'COLOR_0')[:, :3].astype(float)
        self.assertLess(np.abs(colours[:-3] - 255 * normalized[:-3]).max(), 0.51)
        self.assertTrue((colours[-3:] == 128).all())
        self.assertLess(np.abs(rows(0, 'COLOR_0')[:, :3] - 255 * self.interpolated(normalized)).max(), 0.6)

        tag = {'If-None-Match': response.headers['ETag']}
        self.assertEqual(self.server.get('/scene', headers=tag, src=self.src, tgt=self.tgt).status, 304)
        uploaded_again = self.server.post(response.body, wait=60, repair='fill').json()
        self.assertEqual(uploaded_again['vertices'], N_SRC + N_TGT)

    def test_names_and_tags_change(self):
        shape_id = self.server.ready(support.off(support.bumpy(1)), name='before', tags='old')
        path = '/shapes/' + shape_id
        tag = self.server.get(path).headers['ETag']

        def patch(body, **headers):
            return self.server.request('PATCH', path, body=body, headers={key.replace('_', '-'): value for key, value in headers.items()})

        changed = patch(json.dumps({'name': 'nach her \u00e4', 'tags': ['new', 'b']}), If_Match=tag, Content_Type='application/merge-patch+json')
        self.assertEqual(changed.status, 200, changed.body)
        self.assertEqual((changed.json()['name'], changed.json()['tags']), ('nach her \u00e4', ['b', 'new']))
        self.assertEqual(self.server.get(path).json(), changed.json())
        self.assertEqual(self.server.get(path).headers['ETag'], changed.headers['ETag'])
        self.assert_problem(patch('{"name": "late"}', If_Match=tag), 412, 'precondition-failed')
        self.assert_problem(patch('{"colour": "red"}'), 400, 'invalid-parameter')
        self.assert_problem(patch('{"tags": ["not this"]}'), 400, 'invalid-parameter')
        self.assertEqual(patch('{"name": null}').json()['name'], '')
        self.assertEqual([item['id'] for item in self.server.get('/shapes', tag='new').json()['items']], [shape_id])
        self.assertEqual(self.server.get('/shapes', tag='old').json()['items'], [])
        self.assertIn('PATCH', self.server.request('PUT', path, body=b'').headers['Allow'])


if __name__ == '__main__':
    unittest.main()
