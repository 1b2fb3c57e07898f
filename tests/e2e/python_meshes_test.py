"""The Python client on meshes of meshio, which is Debian's, and of trimesh, which Debian lacks: a stand-in has the members that the client
uses, as trimesh 4 has them (Trimesh.vertices, faces, vertex_attributes, visual; ColorVisuals.kind, vertex_colors; TextureVisuals.kind, uv,
material)."""
import os
import sys
import types
import unittest
from unittest import mock

import meshio
import numpy as np

import support

ROOT = os.path.realpath(os.path.join(os.path.dirname(__file__), '..', '..'))
sys.path.insert(0, ROOT + '/client/python')

import spherematch  # noqa: E402
from spherematch import meshes  # noqa: E402

A, B = support.bumpy(2), support.bumpy(2, 1.0)


class ColorVisuals:
    kind = 'vertex'

    def __init__(self, vertex_colors=None):
        self.vertex_colors = vertex_colors


class TextureVisuals:
    kind = 'texture'

    def __init__(self, uv=None, material=None):
        self.uv, self.material = uv, material


class Trimesh:
    def __init__(self, vertices=None, faces=None, process=True, visual=None, vertex_attributes=None):
        assert not process, 'the real one would merge vertices'
        self.vertices, self.faces = np.asarray(vertices), np.asarray(faces)
        self.visual = visual or ColorVisuals()
        self.vertex_attributes = dict(vertex_attributes or {})


def triangles(mesh, **data):
    return meshio.Mesh(mesh[0], [('triangle', np.array(mesh[1]))], point_data=data)


class PythonMeshesTest(support.TestCase):
    @classmethod
    def setUpClass(cls):
        import tempfile
        cls.place = tempfile.TemporaryDirectory(prefix='spherematch-e2e-')
        cls.server = support.Server(cls.place.name + '/s.db')
        cls.client = spherematch.Client(f'http://127.0.0.1:{cls.server.port}')
        cls.a, cls.b = cls.client.upload(A, name='a'), cls.client.upload(B, name='b')

    @classmethod
    def tearDownClass(cls):
        cls.server.stop()
        cls.place.cleanup()

    def test_every_kind_of_mesh_is_the_same_shape(self):
        self.assertEqual(self.client.upload(triangles(A)).id, self.a.id)
        self.assertEqual(self.client.upload(Trimesh(*A, process=False)).id, self.a.id)

    def test_meshio_reads_what_was_uploaded_and_what_is_answered(self):
        mesh = self.client.meshio(self.a)
        self.assertIsInstance(mesh, meshio.Mesh)
        self.assertEqual(mesh.points.tolist(), [list(p) for p in A[0]])
        self.assertEqual(mesh.cells_dict['triangle'].tolist(), [list(f) for f in A[1]])
        for name, data in (('map.ply', self.client.match_file(self.a, self.b, 'ply')),
                           ('labels.ply', self.client.transfer_file(self.a, self.b, np.arange(162), 'ply')),
                           ('texture.ply', self.client.transfer_file(self.a, self.b, np.array(B[0])[:, :2], 'ply')),
                           ('mesh.obj', self.client.mesh(self.a, 'obj')), ('mesh.stl', self.client.mesh(self.a, 'stl'))):
            path = f'{self.place.name}/{name}'
            with open(path, 'wb') as file:
                file.write(data)
            read = meshio.read(path)
            self.assertEqual(len(read.cells_dict['triangle']), len(A[1]), name)
            if name == 'labels.ply':
                self.assertTrue((read.point_data['label'] == self.client.match(self.a, self.b).vertex).all())
            if name == 'texture.ply':
                self.assertTrue((read.point_data['s'] == read.point_data['texture_u']).all())

    def test_meshio_point_data_is_carried(self):
        result = self.client.match(self.a, self.b)
        source = triangles(A, mine=np.arange(162.0))
        moved = self.client.carry(source, triangles(B, height=np.array(B[0])[:, 2], label=np.arange(162)))
        self.assertTrue((moved.point_data['label'] == result.vertex).all())
        np.testing.assert_allclose(moved.point_data['height'], result.points(B[0])[:, 2], atol=1e-6)
        self.assertIn('mine', moved.point_data)
        self.assertNotIn('label', source.point_data, 'the source itself stays as it is')
        nearest = self.client.carry(source, triangles(B, height=np.array(B[0])[:, 2]), interp='nearest')
        np.testing.assert_allclose(nearest.point_data['height'], np.array(B[0])[result.vertex, 2])

    def test_polygons_of_meshio(self):
        corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
        quads = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4]])
        mesh = meshio.Mesh(corners, [('line', np.array([[0, 1]])), ('quad', quads), ('triangle', np.array([[1, 5, 7], [1, 7, 3]]))])
        shape = self.client.upload(mesh)
        self.assertEqual((shape.vertices, shape.faces, shape.repair['flipped_faces']), (8, 7, 0))
        back = self.client.meshio(shape)
        self.assertEqual([(block.type, block.data.tolist()) for block in back.cells],
                         [('quad', quads.tolist()), ('triangle', [[1, 5, 7], [1, 7, 3]])])
        vertices, faces = self.client.arrays(shape)
        self.assertEqual((vertices.tolist(), faces.shape), (corners.tolist(), (12, 3)))
        ring = meshes.read_ply(meshes.mesh_bytes((corners, np.array([[0, 1, 3, 7, 6, 4]])))[0])[1]
        self.assertEqual([block.tolist() for block in ring], [[[0, 1, 3, 7, 6, 4]]])

    def test_what_is_no_surface_is_refused(self):
        for cells in ([('tetra', np.array([[0, 1, 2, 3]]))], [('line', np.array([[0, 1]]))]):
            with self.assertRaises(ValueError):
                self.client.upload(meshio.Mesh(np.eye(4)[:, :3], cells))
        with self.assertRaises(TypeError):
            self.client.carry(A, triangles(B))

    def test_trimesh_stand_in(self):
        colors = np.random.default_rng(1).integers(0, 255, (162, 4), np.uint8)
        target = Trimesh(*B, process=False, visual=ColorVisuals(colors), vertex_attributes={'height': np.array(B[0])[:, 2]})
        source = Trimesh(*A, process=False)
        moved = self.client.carry(source, target)
        result = self.client.match(self.a, self.b)
        self.assertTrue((moved.visual.vertex_colors == colors[result.vertex]).all())
        np.testing.assert_allclose(moved.vertex_attributes['height'], result.points(B[0])[:, 2], atol=1e-6)
        self.assertIsNone(source.visual.vertex_colors)

        textured = Trimesh(*B, process=False, visual=TextureVisuals(np.array(B[0])[:, :2], material='wood'))
        moved = self.client.carry(source, textured)
        self.assertEqual((type(moved.visual), moved.visual.material), (TextureVisuals, 'wood'))
        np.testing.assert_allclose(moved.visual.uv, result.points(B[0])[:, :2], atol=1e-6)

        with mock.patch.dict(sys.modules, {'trimesh': types.SimpleNamespace(Trimesh=Trimesh)}):
            made = self.client.trimesh(self.a)
        self.assertEqual((made.vertices.tolist(), made.faces.tolist()), ([list(p) for p in A[0]], [list(f) for f in A[1]]))
        with mock.patch.dict(sys.modules, {'trimesh': None}), self.assertRaises(ImportError):
            self.client.trimesh(self.a)


if __name__ == '__main__':
    unittest.main()
