"""What belongs to a shape: names, tags, files; and what a map carries from one shape to another."""
import json
import struct
import tempfile
import unittest
import zipfile

import formats
import result_files
import support

SRC = support.bumpy(2)
TGT = support.bumpy(3, 1.0)


class ResourcesTest(support.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix='spherematch-e2e-')
        cls.server = support.Server(cls.temporary.name + '/s.db')
        cls.src = cls.server.ready(support.off(SRC), name='left "one"', tags='pair,left')
        cls.tgt = cls.server.ready(support.off(TGT), name='right', tags='pair')

    @classmethod
    def tearDownClass(cls):
        code = cls.server.stop()
        cls.temporary.cleanup()
        assert code == 0, code

    def names(self, **query):
        response = self.server.get('/shapes', **query)
        self.assertEqual(response.status, 200, response.body)
        return [item['name'] for item in response.json()['items']]

    def test_filters(self):
        self.assertEqual(self.names(tag='pair'), ['right', 'left "one"'])
        self.assertEqual(self.names(tag='left'), ['left "one"'])
        self.assertEqual(self.names(q='ONE"', state='ready'), ['left "one"'])
        shape = self.server.get('/shapes/' + self.tgt).json()
        self.assertEqual(self.names(sha256=shape['sha256'].upper()), ['right'])
        self.assertEqual(self.names(sha256='0' * 64), [])
        first = self.server.get('/shapes', tag='pair', q='t', limit=1)
        self.assertIn('&tag=pair&q=t>; rel="next"', first.headers['Link'])
        following = self.server.request('GET', first.headers['Link'].split('>')[0][1:]).json()
        self.assertEqual([item['name'] for item in following['items']], ['left "one"'])
        self.assert_problem(self.server.get('/shapes', state='done'), 400, 'invalid-parameter')

    def test_the_mesh_in_every_format(self):
        path = f'/shapes/{self.src}/mesh'
        original = self.server.get(path)
        self.assertEqual((original.body, original.headers['Content-Type']), (support.off(SRC), 'application/x-off'))
        vertices, faces = SRC
        for form in ('off', 'obj', 'ply', 'stl', 'glb'):
            response = self.server.get(path, format=form)
            self.assertEqual(response.status, 200, form)
            again = self.server.post(response.body, wait=60).json()
            self.assertEqual((again['state'], again['vertices'], again['faces']), ('ready', len(vertices), len(faces)), form)
            self.assertEqual(again['repair'], self.server.get('/shapes/' + self.src).json()['repair'], form)
        lines = self.server.get(path, format='off').body.decode().split('\n')
        self.assertEqual([tuple(map(float, line.split())) for line in lines[2:2 + len(vertices)]], vertices)
        rows, polygons = result_files.read_ply(self.server.get(path, format='ply').body)
        self.assertEqual([(row['x'], row['y'], row['z']) for row in rows], vertices)
        self.assertEqual(polygons, [list(face) for face in faces])

    def test_head_answers_without_the_body(self):
        for part in ('mesh?format=ply', 'hks', 'sphere?format=ply'):
            whole = self.server.request('GET', f'/shapes/{self.src}/{part}')
            head = self.server.request('HEAD', f'/shapes/{self.src}/{part}')
            self.assertEqual((head.status, head.body), (200, b''))
            self.assertEqual(head.headers['ETag'], whole.headers['ETag'])
            self.assertEqual(head.headers['Content-Length'], str(len(whole.body)))

    def test_the_sphere_as_ply(self):
        _, expected = support.read_npy(self.server.get(f'/shapes/{self.src}/sphere').body)
        rows, faces = result_files.read_ply(self.server.get(f'/shapes/{self.src}/sphere', format='ply').body)
        self.assertEqual([[row['x'], row['y'], row['z']] for row in rows], expected)
        self.assertEqual(faces, [list(face) for face in SRC[1]])

    def test_signals(self):
        body = self.server.get(f'/shapes/{self.src}/hks').body
        with zipfile.ZipFile(__import__('io').BytesIO(body)) as archive:
            self.assertEqual(archive.namelist(), ['times.npy', 'grids.npy'])
            kind, times = support.read_npy(archive.read('times.npy'))
            grids = archive.read('grids.npy')
        self.assertEqual((kind, times), ('<f8', sorted(times, reverse=True)))
        self.assertEqual(self.server.get(f'/shapes/{self.src}/hks', format='npy').body, grids)
        count = len(times)
        self.assertIn(b"'shape': (%d, 128, 128)" % count, grids)
        values = struct.unpack(f'<{count * 128 * 128}f', grids[-4 * count * 128 * 128:])
        self.assertGreater(min(values), 0)

    def test_a_format_told_by_the_file_name_alone_survives_a_rename(self):
        """OFF without its keyword: the content does not tell, the multipart file name does, and the shape has another name."""
        body = support.off(SRC).removeprefix(b'OFF\n') + b'# alone\n'
        form = (b'--x\r\nContent-Disposition: form-data; name="file"; filename="scan.off"\r\n\r\n' + body + b'\r\n--x--\r\n')
        posted = self.server.request('POST', '/shapes', body=form, headers={'Content-Type': 'multipart/form-data; boundary=x'},
                                     query={'name': 'leg', 'wait': 60})
        self.assertEqual(posted.status, 201, posted.body)
        shape = posted.json()
        self.assertEqual(shape['name'], 'leg')
        for path, query in ((f'/shapes/{shape["id"]}/mesh', {'format': 'ply'}),
                            ('/match', {'src': shape['id'], 'tgt': self.tgt, 'format': 'ply'})):
            response = self.server.get(path, **query)
            self.assertEqual(response.status, 200, response.body[:300])
            self.assertEqual(len(result_files.read_ply(response.body)[0]), len(SRC[0]))
        self.assertEqual(self.server.get(f'/shapes/{shape["id"]}/mesh').headers['Content-Type'], 'application/x-off')


if __name__ == '__main__':
    unittest.main()
