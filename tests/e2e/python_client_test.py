"""The Python client against a real server."""
import os
import sys
import unittest

import numpy as np

import support

ROOT = os.path.realpath(os.path.join(os.path.dirname(__file__), '..', '..'))
sys.path.insert(0, ROOT + '/client/python')

import spherematch  # noqa: E402

A, B = support.bumpy(2), support.bumpy(2, 1.0)


def _area(vertices, faces):
    corners = np.array(vertices)[np.array(faces)]
    return np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2


class PythonClientTest(support.TestCase):
    @classmethod
    def setUpClass(cls):
        import tempfile
        cls.place = tempfile.TemporaryDirectory(prefix='spherematch-e2e-')
        cls.server = support.Server(cls.place.name + '/s.db')
        cls.client = spherematch.Client(f'http://127.0.0.1:{cls.server.port}')

    @classmethod
    def tearDownClass(cls):
        cls.server.stop()
        cls.place.cleanup()

    def setUp(self):
        self.a = self.client.upload(A, name='a', tags=['pair'])
        self.b = self.client.upload(support.off(B), name='b')

    def test_shapes(self):
        self.assertEqual((self.a.state, self.a.vertices, self.a.name), ('ready', 162, 'a'))
        path = self.place.name + '/again.off'
        with open(path, 'wb') as file:
            file.write(support.off(B))
        self.assertEqual(self.client.upload(path).id, self.b.id)
        self.assertEqual({shape.id for shape in self.client.shapes()}, {self.a.id, self.b.id})
        self.assertEqual([shape.id for shape in self.client.shapes(tag='pair')], [self.a.id])
        self.assertEqual(self.client.update(self.b, name='other', tags=['x']).tags, ['x'])
        self.assertEqual(self.client.shape(self.b).name, 'other')
        self.assertEqual(self.client.mesh(self.b), support.off(B))
        sphere = self.client.sphere(self.a)
        self.assertLess(np.abs(np.linalg.norm(sphere, axis=1) - 1).max(), 1e-12)
        png = self.client.thumbnail(self.a, size=64)
        self.assertEqual((png[:4], png[16:24]), (b'\x89PNG', b'\0\0\0\x40' * 2))
        times, grids = self.client.heat_kernel_signatures(self.a)
        self.assertEqual(len(times), len(grids))

    def test_the_vertices_arrive_bit_for_bit(self):
        ply = self.client.mesh(self.a)
        start = ply.index(b'end_header\n') + len(b'end_header\n')
        self.assertEqual(np.frombuffer(ply[start:start + 162 * 24]).reshape(-1, 3).tolist(), [list(p) for p in A[0]])

    def test_match(self):
        both = self.client.match(self.a, self.b, both=True)
        self.assertEqual(both.corners.shape, (162, 3))
        self.assertEqual(len(both.reverse), 162)
        plain = self.client.match(self.a.id, self.b.id)
        self.assertIsNone(plain.reverse)
        self.assertTrue((plain.vertex == both.vertex).all())
        self.assertLess(np.linalg.norm(plain.points(B[0]) - np.array(A[0]), axis=1).mean(), 0.3)
        self.assertEqual(self.client.match_info(self.a, self.b)['orientation'], 'preserve')
        self.assertFalse((self.client.match(self.a, self.b, refine='none').bary == plain.bary).all())
        self.assertTrue(self.client.match_file(self.a, self.b, 'png').startswith(b'\x89PNG'))
        self.assertTrue(self.client.scene(self.a, self.b).startswith(b'glTF'))
        self.assertEqual(len(self.client.match(self.a, self.b, hints=[(0, 0), (5, 5)])), 162)

    def test_confidence_and_distortion(self):
        plain = self.client.match(self.a, self.b)
        self.assertEqual((plain.confidence, plain.distortion), (None, None))
        judged = self.client.match(self.a, self.b, both=True, fields='confidence,distortion')
        self.assertTrue((judged.bary == plain.bary).all())
        for result in (judged, judged.reverse):
            self.assertEqual((result.confidence.dtype, result.confidence.shape), (np.float32, (162,)))
            self.assertTrue((0 <= result.confidence).all() and (result.confidence <= 1).all())
            self.assertEqual((result.distortion.dtype, result.distortion.shape), (np.float32, (162,)))
        info = self.client.match_info(self.a, self.b, fields='confidence')
        np.testing.assert_array_equal(np.array(info['confidence'], np.float32), judged.confidence)
        self.assertIsNotNone(self.client.symmetry(self.a, fields='confidence').confidence)
        self.assertIn(b'property float distortion', self.client.match_file(self.a, self.b, 'ply', fields='distortion'))
        with self.assertRaises(spherematch.ProblemError):
            self.client.match_file(self.a, self.b, 'txt', fields='confidence')

    def test_symmetry(self):
        symmetry = self.client.symmetry(self.a)
        self.assertEqual((len(symmetry), symmetry.reverse), (162, None))
        self.assertTrue((symmetry.vertex == self.client.match(self.a, self.a, orientation='reverse').vertex).all())
        info = self.client.symmetry_info(self.a)
        self.assertEqual((info['src'], info['tgt'], info['orientation']), (self.a.id, self.a.id, 'reverse'))
        twice = symmetry.apply(symmetry.points(A[0])) - np.array(A[0])
        self.assertTrue(info['cached'])
        self.assertGreaterEqual(info['quality']['involution_max'], info['quality']['involution_mean'])
        area = _area(*A)
        self.assertAlmostEqual(np.linalg.norm(twice, axis=1).max() / area**0.5, info['quality']['involution_max'], places=5)
        self.assertTrue(self.client.symmetry_file(self.a, 'png').startswith(b'\x89PNG'))

    def test_points_and_transfer(self):
        image, = self.client.match_points(self.a, self.b, points=[7])
        result = self.client.match(self.a, self.b)
        self.assertEqual(image['vertex'], result.vertex[7])
        named = self.client.match_points(self.a, self.b, landmarks={'tip': {'position': [0.6, 0.64, 0.48]}})
        self.assertEqual(list(named), ['tip'])
        weights = np.random.default_rng(1).random((162, 4))
        moved = self.client.transfer(self.a, self.b, weights)
        np.testing.assert_allclose(moved, result.apply(weights), atol=1e-6)
        labels = np.arange(162, dtype=np.uint8)
        self.assertEqual(self.client.transfer(self.a, self.b, labels).dtype, np.uint8)
        self.assertTrue((self.client.transfer(self.a, self.b, labels) == labels[result.vertex]).all())

    def test_transfer_file(self):
        labels = np.arange(162) % 3
        self.assertTrue(self.client.transfer_file(self.a, self.b, labels, 'png').startswith(b'\x89PNG'))
        ply = self.client.transfer_file(self.a, self.b, labels, 'ply', meaning='label')
        header, rows = ply.split(b'end_header\n', 1)
        self.assertIn(b'property int label', header)
        record = np.dtype([('place', '<f8', 3), ('color', 'u1', 3), ('label', '<i4')] if b'double' in header
                          else [('place', '<f4', 3), ('color', 'u1', 3), ('label', '<i4')])
        carried = np.frombuffer(rows[:162 * record.itemsize], record)['label']
        self.assertTrue((carried == labels[self.client.match(self.a, self.b).vertex]).all())
        with self.assertRaises(spherematch.ProblemError):
            self.client.transfer_file(self.a, self.b, labels, 'glb', meaning='texture')

    def test_evaluation(self):
        figures = self.client.evaluate(self.a, self.b, truth='identity')
        self.assertEqual(figures['geodesic']['scored'], 162)
        self.assertLess(figures['geodesic']['mean'], 0.1)
        self.assertGreater(figures['symmetric_integral'], 0)
        listed = self.client.evaluate(self.a, self.b, truth=np.arange(162))
        self.assertEqual(listed['geodesic'], figures['geodesic'])
        marked = self.client.evaluate(self.a, self.b, landmarks=([1, 2], [1, 2]), mirrored=[80, 90], base=1, both=False, biharmonic=False)
        self.assertIs(marked['flipped'], False)
        self.assertIsNone(marked['bijectivity'])
        self.assertIn(b'<polyline', self.client.evaluation_picture(self.a, self.b, truth='identity'))

    def test_jobs(self):
        job = self.client.match_many([(self.a, self.b), (self.b, self.a)], both=True)
        lines = list(self.client.results(job))
        self.assertEqual(sorted(line['index'] for line in lines), [0, 1])
        self.assertIn('reverse', lines[0]['match'])
        self.assertEqual(self.client.job(job, wait=10).state, 'succeeded')
        self.assertIn(job.id, [known.id for known in self.client.jobs(kind='match')])
        self.client.cancel(job)
        self.assertNotIn(job.id, [known.id for known in self.client.jobs(kind='match')])

    def test_errors(self):
        with self.assertRaises(spherematch.ProblemError) as caught:
            self.client.upload(b'nothing')
        self.assertEqual((caught.exception.status, caught.exception.code), (415, 'unsupported-format'))
        with self.assertRaises(spherematch.ProblemError) as caught:
            self.client.match(self.a, '0' * 32)
        self.assertEqual(caught.exception.code, 'not-found')
        for bad in ((np.zeros((4, 2)), np.zeros((4, 3), int)), (np.zeros((4, 3)), np.zeros((4, 3)))):
            with self.assertRaises(ValueError):
                self.client.upload(bad)
        with self.assertRaises(spherematch.TransportError):
            spherematch.Client('http://127.0.0.1:1', retries=0).health()
        self.assertEqual(self.client.health()['status'], 'ok')
        self.assertIn('limits', self.client.version())


if __name__ == '__main__':
    unittest.main()
