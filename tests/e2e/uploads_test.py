"""Meshes as real tools write them: odd but fine. Each is accepted, its repair is reported, and maps speak of every uploaded vertex."""
import json
import math
import re
import struct
import tempfile
import unittest

import formats
import support

BASE = formats.in_order_of_appearance(formats.exact(support.bumpy(2)))
N, F = len(BASE[0]), len(BASE[1])
REPAIR = ('filled_loops', 'added_vertices', 'added_faces', 'dropped_vertices', 'welded_vertices', 'split_vertices', 'flipped_faces',
          'removed_faces', 'dropped_components')


def moved(mesh, offset, scale=1.0):
    return [tuple(scale * x + o for x, o in zip(p, offset)) for p in mesh[0]], mesh[1]


def joined(*meshes):
    vertices, faces = [], []
    for mesh in meshes:
        faces += [tuple(v + len(vertices) for v in face) for face in mesh[1]]
        vertices += mesh[0]
    return vertices, faces


def disk(n=12):
    rim = [(math.cos(2 * math.pi * i / n), math.sin(2 * math.pi * i / n), 0.0) for i in range(n)]
    return [(0.0, 0.0, 0.0)] + rim, [(0, 1 + i, 1 + (i + 1) % n) for i in range(n)]


def dual(mesh):
    """A polygon around each vertex: pentagons and hexagons on an icosphere."""
    vertices, faces = mesh
    centres = [tuple(sum(vertices[v][k] for v in face) / 3 for k in range(3)) for face in faces]
    after = {}  # vertex -> {next vertex around it: face}
    for i, (a, b, c) in enumerate(faces):
        for p, q, r in ((a, b, c), (b, c, a), (c, a, b)):
            after.setdefault(p, {})[q] = (r, i)
    polygons = []
    for around in after.values():
        start = at = next(iter(around))
        polygon = []
        while True:
            at, face = around[at]
            polygon.append(face)
            if at == start:
                break
        polygons.append(tuple(polygon))
    return centres, polygons


def quads(n=8):
    """A cube of n x n squares on each side, blown up to an ellipsoid."""
    points, faces, places = [], [], {}

    def vertex(p):
        if p not in places:
            places[p] = len(points)
            length = math.sqrt(sum(x * x for x in p))
            points.append(tuple(s * x / length for s, x in zip((1.0, 1.3, 1.7), p)))
        return places[p]

    for axis in range(3):
        for side in (-n, n):
            for i in range(-n, n, 2):
                for j in range(-n, n, 2):
                    corners = [(i, j), (i + 2, j), (i + 2, j + 2), (i, j + 2)]
                    ring = [tuple(side if k == axis else (u, v)[(k - axis - 1) % 3] for k in range(3)) for u, v in corners]
                    faces.append(tuple(map(vertex, ring if side > 0 else ring[::-1])))
    return points, faces


def seamed(mesh):
    """Cut open along a path of edges, as texture coordinates do: vertices on the cut appear twice. Returns the mesh and how many do."""
    vertices, faces = mesh
    left = {f for f, face in enumerate(faces) if sum(vertices[v][0] for v in face) < 0}
    both = {v for f in left for v in faces[f]} & {v for f, face in enumerate(faces) if f not in left for v in face}
    copy = {v: len(vertices) + i for i, v in enumerate(sorted(both))}
    cut = [tuple(copy.get(v, v) for v in face) if f in left else face for f, face in enumerate(faces)]
    return (vertices + [vertices[v] for v in sorted(both)], cut), len(both)


class UploadsTest(support.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix='spherematch-e2e-')
        cls.server = support.Server(cls.temporary.name + '/s.db')
        cls.other = formats.exact(support.bumpy(2, 1.0))
        cls.other_id = cls.server.ready(support.off(cls.other))

    @classmethod
    def tearDownClass(cls):
        code = cls.server.stop()
        cls.temporary.cleanup()
        assert code == 0, code

    def accepted(self, body, vertices, faces, dropped=(), **repair):
        """Uploads; checks the counts, the repair and the maps; returns the id and the NPZ."""
        response = self.server.post(body, wait=60)
        self.assertEqual(response.status, 201, response.body[:500])
        shape = response.json()
        self.assertEqual((shape['state'], shape['vertices'], shape['faces']), ('ready', vertices, faces), shape)
        self.assertEqual({key: shape['repair'][key] for key in REPAIR}, {key: repair.get(key, 0) for key in REPAIR})
        return shape['id'], self.check_maps(shape['id'], vertices, set(dropped))

    def check_maps(self, shape_id, n, dropped):
        forth = support.read_npz(self.server.get('/match', src=shape_id, tgt=self.other_id, format='npz').body)
        self.assertEqual([len(forth[name][1]) for name in ('vertex', 'corners', 'bary')], [n] * 3)
        for i, (vertex, corners, bary) in enumerate(zip(forth['vertex'][1], forth['corners'][1], forth['bary'][1])):
            if i in dropped:
                self.assertEqual((vertex, corners, bary), (-1, [-1, -1, -1], [0, 0, 0]), i)
            else:
                self.assertTrue(vertex in corners and all(0 <= c < len(self.other[0]) for c in corners), (i, vertex, corners))
                self.assertAlmostEqual(sum(bary), 1, places=5)
        back = support.read_npz(self.server.get('/match', src=self.other_id, tgt=shape_id, format='npz').body)
        named = {c for corners in back['corners'][1] for c in corners}
        self.assertTrue(named <= set(range(n)) - dropped, named & dropped)
        return forth

    def check_other_formats(self, shape_id, n, npz):
        def match(form, **query):
            response = self.server.get('/match', src=shape_id, tgt=self.other_id, format=form, **query)
            self.assertEqual(response.status, 200, (form, response.body[:300]))
            return response.body

        vertex = npz['vertex'][1]
        self.assertEqual(support.read_npy(match('npy'))[1], vertex)
        self.assertEqual([int(line) for line in match('txt').split()], vertex)
        whole = json.loads(match('json', fields='vertex,corners'))
        self.assertEqual((whole['vertex'], whole['corners'], whole['n_src']), (vertex, npz['corners'][1], n))
        self.assertIn(b'element vertex %d\n' % n, match('ply'))
        self.assertEqual(len(re.findall(rb'^v ', match('obj'), re.MULTILINE)), n)
        glb = match('glb')
        document = json.loads(glb[20:20 + struct.unpack('<I', glb[12:16])[0]])
        self.assertIn(n, {accessor['count'] for accessor in document['accessors'] if accessor['type'] == 'VEC3'})

    def test_every_format_gives_the_same_map(self):
        bodies = {'off': support.off(BASE), 'obj': formats.obj(BASE), 'ply ascii': formats.ply_ascii(BASE),
                  'ply little': formats.ply_binary(BASE), 'ply big': formats.ply_binary(BASE, '>'), 'stl ascii': formats.stl_ascii(BASE),
                  'stl binary': formats.stl_binary(BASE), 'gltf': formats.gltf(BASE), 'glb': formats.glb(BASE)}
        ids = {name: self.server.ready(body) for name, body in bodies.items()}
        self.assertEqual(len(set(ids.values())), len(bodies))
        forth = {self.server.get('/match', src=i, tgt=self.other_id, format='npz').body for i in ids.values()}
        back = {self.server.get('/match', src=self.other_id, tgt=i, format='npz').body for i in ids.values()}
        self.assertEqual((len(forth), len(back)), (1, 1))
        self.check_maps(ids['stl binary'], N, set())

    def test_two_spheres_and_a_disk(self):
        small = moved(support.icosphere(1), (5, 0, 0), 0.5)
        flat = moved(disk(), (0, 5, 0), 0.5)
        mesh = joined(small, BASE, flat)
        dropped = set(range(len(mesh[0]))) - set(range(len(small[0]), len(small[0]) + N))
        shape_id, npz = self.accepted(support.off(mesh), len(mesh[0]), len(mesh[1]), dropped, dropped_vertices=len(dropped),
                                      dropped_components=2, removed_faces=len(small[1]) + len(flat[1]))
        self.check_other_formats(shape_id, len(mesh[0]), npz)

    def test_quads_and_polygons(self):
        for mesh in (quads(), dual(support.bumpy(2))):
            self.accepted(formats.obj(mesh), len(mesh[0]), len(mesh[1]))
        mixed = dual(support.bumpy(2, 0.2))
        self.assertEqual({len(face) for face in mixed[1]}, {5, 6})
        self.accepted(formats.ply_ascii(mixed), len(mixed[0]), len(mixed[1]))

    def test_unreferenced_vertices(self):
        first = [(9.0, 9.0, 9.0)]
        mesh = (first + BASE[0] + [(0.0, 0.0, 0.0), BASE[0][0]], [tuple(v + 1 for v in face) for face in BASE[1]])
        self.accepted(support.off(mesh), N + 3, F, {0, N + 1, N + 2}, dropped_vertices=3)

    def test_duplicate_faces(self):
        doubled = BASE[1] + [BASE[1][3], BASE[1][7][1:] + BASE[1][7][:1], BASE[1][7]]
        self.accepted(support.off((BASE[0], doubled)), N, F + 3, removed_faces=3)

    def test_degenerate_faces(self):
        a, b, _ = BASE[1][0]
        self.accepted(support.off((BASE[0], BASE[1] + [(a, a, b), (b, b, b)])), N, F + 2, removed_faces=2)

    def test_a_seam_of_texture_coordinates(self):
        cut, twice = seamed(BASE)
        self.assertGreater(twice, 10)
        uvs = [(0.5 + p[0] / 8, 0.5 + p[1] / 8) for p in cut[0]]
        shape_id, npz = self.accepted(formats.glb(parts=formats.gltf_parts(cut, uvs)), N + twice, F, welded_vertices=twice)
        self.check_other_formats(shape_id, N + twice, npz)

    def test_stl(self):
        turned = moved(BASE, (0.5, 0.25, 0.125))
        for body in (formats.stl_ascii(turned), formats.stl_binary(turned)):
            self.accepted(body, N, F)

    def test_inward_faces(self):
        self.accepted(support.off((BASE[0], [face[::-1] for face in BASE[1]])), N, F, flipped_faces=F)
        turned = [face[::-1] if i in (3, 50, 51) else face for i, face in enumerate(BASE[1])]
        self.accepted(support.off((BASE[0], turned)), N, F, flipped_faces=3)

    def test_holes(self):
        a = BASE[1][100]
        far = next(face for face in BASE[1] if all(math.dist(BASE[0][u], BASE[0][v]) > 1 for u in a for v in face))
        open_mesh = [face for face in BASE[1] if face not in (a, far)]
        self.accepted(support.off((BASE[0], open_mesh)), N, F - 2, filled_loops=2, added_faces=2)

    def test_spheres_that_touch_in_a_vertex(self):
        joint = max(range(N), key=lambda v: BASE[0][v][0])
        small = moved(support.icosphere(1), (0, 0, 0), 0.3)
        end = min(range(len(small[0])), key=lambda v: small[0][v][0])
        offset = tuple(p - q for p, q in zip(BASE[0][joint], small[0][end]))
        number = {v: joint if v == end else N + v - (v > end) for v in range(len(small[0]))}
        vertices = BASE[0] + [p for v, p in enumerate(moved(small, offset)[0]) if v != end]
        mesh = (vertices, BASE[1] + [tuple(number[v] for v in face) for face in small[1]])
        self.accepted(support.off(mesh), len(vertices), len(mesh[1]), range(N, len(vertices)), split_vertices=1, dropped_components=1,
                      dropped_vertices=len(small[0]) - 1, removed_faces=len(small[1]))


if __name__ == '__main__':
    unittest.main()
