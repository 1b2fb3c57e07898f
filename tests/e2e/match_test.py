"""Matches in every format: what they contain, that they agree, and that their bytes stay the same."""
import json
import math
import struct
import threading
import time
import unittest

import result_files
import support

SRC = support.bumpy(3)
TGT = support.bumpy(3, 1.0)


def as_float(number):
    """As single precision has it."""
    return struct.unpack('<f', struct.pack('<f', number))[0]


class MatchTest(support.TestCase):
    @classmethod
    def setUpClass(cls):
        import tempfile
        cls.temporary = tempfile.TemporaryDirectory(prefix='spherematch-e2e-')
        cls.server = support.Server(cls.temporary.name + '/s.db', '--threads', '2')
        cls.src, cls.tgt = cls.server.ready(support.off(SRC)), cls.server.ready(support.off(TGT))

    @classmethod
    def tearDownClass(cls):
        code = cls.server.stop()
        cls.temporary.cleanup()
        assert code == 0, code

    def match(self, headers=None, server=None, **query):
        return (server or self.server).get('/match', headers=headers, src=self.src, tgt=self.tgt, **query)

    def test_formats_agree(self):
        whole = self.match(fields='vertex,corners,bary').json()
        npz = support.read_npz(self.match(format='npz').body)
        self.assertEqual({name: kind for name, (kind, _) in npz.items()}, {'vertex': '<i4', 'corners': '<i4', 'bary': '<f4'})
        self.assertEqual(npz['vertex'][1], whole['vertex'])
        self.assertEqual(npz['corners'][1], whole['corners'])
        self.assertEqual(npz['bary'][1], [[as_float(x) for x in row] for row in whole['bary']])
        self.assertEqual(support.read_npy(self.match(format='npy').body), ('<i4', whole['vertex']))
        self.assertEqual([int(line) for line in self.match(format='txt').body.split()], whole['vertex'])
        self.assertEqual([int(line) - 1 for line in self.match(format='map').body.split()], whole['vertex'])

    def test_confidence_and_distortion_in_every_format_that_has_them(self):
        names = ('confidence', 'distortion')
        for both in ('no', 'yes'):
            answer = self.match(fields='distortion,confidence', both=both).json()
            npz = support.read_npz(self.match(format='npz', fields='confidence,distortion', both=both).body)
            plain = support.read_npz(self.match(format='npz', both=both).body)
            for prefix, its in (('', answer),) + ((('reverse_', answer['reverse']),) if both == 'yes' else ()):
                for name in names:
                    kind, values = npz.pop(prefix + name)
                    self.assertEqual((kind, values), ('<f4', [as_float(x) for x in its[name]]))
                self.assertLess(max(its['confidence']), 1)
                self.assertGreater(min(its['distortion']), 0)
            self.assertEqual(npz, plain)
        vertices, _ = result_files.read_ply(self.match(format='ply', fields='confidence,distortion').body)
        for name in names:
            self.assertEqual([vertex[name] for vertex in vertices], [as_float(x) for x in answer[name]])
        # A pair is registered in one order: asked for from the other side, the map is the reverse, and so is what is thought of it.
        other = self.server.get('/match', src=self.tgt, tgt=self.src, fields='confidence,distortion').json()
        for name in names:
            self.assertEqual(other[name], answer['reverse'][name])
            self.assertNotEqual(other[name], answer[name])

    def test_the_map_is_sound(self):
        result = self.match(fields='vertex,corners,bary').json()
        self.assertEqual((result['src'], result['tgt']), (self.src, self.tgt))
        self.assertEqual((result['n_src'], result['n_tgt']), (len(SRC[0]), len(TGT[0])))
        faces = {frozenset(face) for face in TGT[1]}
        for vertex, corners, bary in zip(result['vertex'], result['corners'], result['bary'], strict=True):
            self.assertIn(frozenset(corners), faces)
            self.assertAlmostEqual(sum(bary), 1, places=5)
            self.assertGreaterEqual(min(bary), 0)
            image = [sum(w * TGT[0][c][k] for w, c in zip(bary, corners)) for k in range(3)]
            distance = {c: math.dist(image, TGT[0][c]) for c in corners}
            self.assertLessEqual(distance[vertex], min(distance.values()) + 1e-6)
        self.assertEqual([c['chosen'] for c in result['candidates']].count(True), 1)
        self.assertIs(self.match(cache='no').json()['cached'], False)
        self.assertGreater(result['seconds']['total'], 0)
        for stage in ('rotation', 'flow', 'correspondence'):
            self.assertIn(stage, result['seconds'])

    def test_the_map_is_good(self):
        """Both meshes share their numbering and differ little, so that vertex i belongs near vertex i."""
        vertex = self.match().json()['vertex']
        errors = sorted(math.dist(TGT[0][i], TGT[0][j]) for i, j in enumerate(vertex))
        self.assertLess(errors[len(errors) // 2], 0.25)

    def test_meshes_are_the_source_in_the_colours_of_its_images(self):
        result = self.match(fields='corners,bary').json()
        box = [(min(p[k] for p in TGT[0]), max(p[k] for p in TGT[0])) for k in range(3)]
        ply = self.match(format='ply')
        self.assertEqual(ply.headers['Content-Type'], 'application/x-ply')
        vertices, faces = result_files.read_ply(ply.body)
        self.assertEqual(faces, [list(face) for face in SRC[1]])
        self.assertEqual(len(vertices), len(SRC[0]))
        colours = []
        for vertex, place, corners, bary in zip(vertices, SRC[0], result['corners'], result['bary'], strict=True):
            image = [sum(w * TGT[0][c][k] for w, c in zip(bary, corners)) for k in range(3)]
            for k, (own, its) in enumerate((('x', 'tx'), ('y', 'ty'), ('z', 'tz'))):
                self.assertAlmostEqual(vertex[own], place[k], places=5)
                self.assertAlmostEqual(vertex[its], image[k], places=5)
            colours.append((vertex['red'], vertex['green'], vertex['blue']))
            for colour, x, (low, high) in zip(colours[-1], image, box):
                self.assertLessEqual(abs(colour - 255 * (x - low) / (high - low)), 0.51)

        obj_vertices, obj_faces = result_files.read_obj(self.match(format='obj').body)
        self.assertEqual(obj_faces, faces)
        self.assertEqual([tuple(round(255 * c) for c in row[3:]) for row in obj_vertices], colours)
        for row, place in zip(obj_vertices, SRC[0], strict=True):
            for a, b in zip(row, place):
                self.assertAlmostEqual(a, b, places=7)

        positions, normals, rgba, triangles = result_files.read_glb(self.match(format='glb').body)
        self.assertEqual(triangles, faces)
        self.assertEqual([c[:3] for c in rgba], colours)
        self.assertEqual(positions, [(v['x'], v['y'], v['z']) for v in vertices])
        self.assertEqual(len(normals), len(positions))

    def test_polygons_and_dropped_vertices_reach_the_mesh_files(self):
        """A box of quadrilaterals and a stray triangle, whose three vertices repair drops."""
        corners = [(x, 1.3 * y, 1.7 * z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
        quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        box = self.server.ready(support.off((corners + [(9, 9, 9), (9.1, 9, 9), (9, 9.1, 9)], quads + [(8, 9, 10)])))
        get = lambda form: self.server.get('/match', src=box, tgt=self.tgt, format=form).body
        vertices, faces = result_files.read_ply(get('ply'))
        self.assertEqual(faces, [list(face) for face in quads + [(8, 9, 10)]])
        self.assertEqual([math.isnan(v['tx']) for v in vertices], [False] * 8 + [True] * 3)
        self.assertEqual({(v['red'], v['green'], v['blue']) for v in vertices[8:]}, {(128, 128, 128)})
        self.assertEqual(result_files.read_obj(get('obj'))[1], faces)
        _, _, rgba, triangles = result_files.read_glb(get('glb'))
        self.assertEqual((len(rgba), len(triangles)), (11, 13))
        self.assertEqual(set(rgba[8:]), {(128, 128, 128, 255)})
        self.assertEqual(result_files.read_png(get('png'))[0], 1200)

    def test_the_picture_shows_both_shapes_in_the_same_colours(self):
        picture = self.match(format='png')
        self.assertEqual(picture.headers['Content-Type'], 'image/png')
        width, height, rows = result_files.read_png(picture.body)
        self.assertEqual((width, height), (1200, 600))

        def colours(start):
            """The colours, coarsely, with the number of their pixels; without the background."""
            counts = {}
            for row in rows:
                for x in range(start, start + 600):
                    colour = tuple(c // 32 for c in row[3 * x:3 * x + 3])
                    counts[colour] = counts.get(colour, 0) + 1
            del counts[(7, 7, 7)]
            return counts

        left, right = colours(0), colours(600)
        for side in (left, right):
            self.assertGreater(sum(side.values()), 0.1 * 600 * 600)
            self.assertGreater(len(side), 20)
        shared = sum(min(count, right.get(colour, 0)) for colour, count in left.items())
        self.assertGreater(shared, 0.7 * min(sum(left.values()), sum(right.values())))

    def test_the_accept_header_negotiates(self):
        self.assertEqual(self.match(headers={'Accept': 'text/plain'}).headers['Content-Type'], 'text/plain')
        self.assertEqual(self.match(headers={'Accept': 'application/x-npz;q=0.5, application/x-npy'}).headers['Content-Type'],
                         'application/x-npy')
        self.assertEqual(self.match(headers={'Accept': 'text/html,*/*;q=0.8'}).headers['Content-Type'], 'application/json')
        problem = self.assert_problem(self.match(headers={'Accept': 'image/gif'}), 406, 'not-acceptable')
        self.assertIn('application/x-npz', problem['detail'])
        self.assertEqual(self.match(headers={'Accept': 'image/gif'}, format='txt').status, 200)
        self.assertEqual(self.match(headers={'Accept': 'model/*'}).headers['Content-Type'], 'model/gltf-binary')
        # What a browser sends for an <img>.
        self.assertEqual(self.match(headers={'Accept': 'image/avif,image/webp,image/*,*/*;q=0.8'}).headers['Content-Type'], 'image/png')

    def test_parameters_are_checked(self):
        for wrong in ({'bogus': '1'}, {'format': 'exe'}, {'fields': 'x'}, {'wait': 'x'}, {'cache': 'x'}, {'method': 'x'}, {'refine': 'x'}):
            self.assert_problem(self.match(**wrong), 400, 'invalid-parameter')
        self.assert_problem(self.server.get('/match', src=self.src), 400, 'invalid-parameter')
        self.assertEqual(self.match(cache='no', method='paper', wait='1').status, 200)

    def test_the_refinement_can_be_left_out(self):
        refined, plain = self.match(format='npz', refine='default'), self.match(format='npz', refine='none')
        self.assertEqual(refined.body, self.match(format='npz').body)
        self.assertNotEqual(plain.body, refined.body)
        self.assertNotEqual(plain.headers['ETag'], refined.headers['ETag'])

    def test_a_tag_spares_the_computation(self):
        first = self.match(format='npz')
        tag = first.headers['ETag']
        self.assertTrue(tag.startswith('W/"'))
        spared = self.match(format='npz', headers={'If-None-Match': tag})
        self.assertEqual((spared.status, spared.body, spared.headers['ETag']), (304, b'', tag))
        self.assertEqual(self.match(format='npy', headers={'If-None-Match': tag}).status, 200)
        self.assertIn('rotation;dur=', first.headers['Server-Timing'])
        self.assertIsNone(spared.headers['Server-Timing'])

    def test_sphere(self):
        kind, rows = support.read_npy(self.server.get(f'/shapes/{self.src}/sphere', format='npy').body)
        self.assertEqual((kind, len(rows)), ('<f8', len(SRC[0])))
        for row in rows:
            self.assertAlmostEqual(math.hypot(*row), 1, places=9)

    def test_the_same_bytes_again_after_a_restart_and_with_another_thread_count(self):
        formats = ('npz', 'npy', 'txt', 'map', 'ply', 'glb', 'obj', 'png')
        fields = 'vertex,corners,bary,confidence,distortion'

        def stable(server):
            answer = json.loads(self.match(server=server, fields=fields).body)
            del answer['seconds'], answer['cached']
            return [self.match(server=server, format=f).body for f in formats] + [json.dumps(answer)]

        expected = stable(self.server)
        self.assertEqual(stable(self.server), expected)
        store = self.directory() + '/s.db'
        for threads in ('1', '2'):
            server = self.serve(store, '--threads', threads)
            self.assertEqual((server.ready(support.off(SRC)), server.ready(support.off(TGT))), (self.src, self.tgt))
            self.assertEqual(stable(server), expected)
            self.assertEqual(server.stop(), 0)
            prepared = [line for line in server.log if 'job_started' in line]
            self.assertEqual(len(prepared), 2 if threads == '1' else 0)

    def test_health_answers_while_matches_run(self):
        stop = threading.Event()

        def load():
            while not stop.is_set():
                self.match(format='npz')

        threads = [threading.Thread(target=load) for _ in range(6)]
        for thread in threads:
            thread.start()
        slowest = 0
        for _ in range(20):
            start = time.monotonic()
            self.assertEqual(self.server.get('/healthz').status, 200)
            slowest = max(slowest, time.monotonic() - start)
        stop.set()
        for thread in threads:
            thread.join()
        self.assertLess(slowest, 2)


if __name__ == '__main__':
    unittest.main()
