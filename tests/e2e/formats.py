"""Writers of every format that the server reads. Meshes are (vertices, faces); faces may be polygons."""
import base64
import json
import struct


def exact(mesh):
    """Coordinates that text, single and double precision hold alike."""
    vertices, faces = mesh
    return [tuple(round(x * 4096) / 4096 for x in p) for p in vertices], faces


def in_order_of_appearance(mesh):
    """Numbered as the faces name the vertices, which is how a reader of STL has to number them."""
    vertices, faces = mesh
    order = list(dict.fromkeys(v for face in faces for v in face))
    place = {v: i for i, v in enumerate(order)}
    return [vertices[v] for v in order], [tuple(place[v] for v in face) for face in faces]


def triangles(faces):
    return [(face[0], face[i], face[i + 1]) for face in faces for i in range(1, len(face) - 1)]


def obj(mesh):
    vertices, faces = mesh
    lines = ['v %.17g %.17g %.17g' % p for p in vertices] + ['f ' + ' '.join(str(v + 1) for v in face) for face in faces]
    return ('\n'.join(lines) + '\n').encode()


def ply_header(form, n_vertices, n_faces, scalar='float', count='uchar', index='int'):
    return (f'ply\nformat {form} 1.0\nelement vertex {n_vertices}\nproperty {scalar} x\nproperty {scalar} y\nproperty {scalar} z\n'
            f'element face {n_faces}\nproperty list {count} {index} vertex_indices\nend_header\n').encode()


def ply_ascii(mesh):
    vertices, faces = mesh
    lines = ['%.17g %.17g %.17g' % p for p in vertices] + ['%d %s' % (len(f), ' '.join(map(str, f))) for f in faces]
    return ply_header('ascii', len(vertices), len(faces), 'double') + ('\n'.join(lines) + '\n').encode()


def ply_binary(mesh, order='<'):
    vertices, faces = mesh
    header = ply_header('binary_little_endian' if order == '<' else 'binary_big_endian', len(vertices), len(faces))
    body = b''.join(struct.pack(order + '3f', *p) for p in vertices)
    return header + body + b''.join(struct.pack(f'{order}B{len(f)}i', len(f), *f) for f in faces)


def stl_ascii(mesh):
    vertices, faces = mesh
    facets = ['facet normal 0 0 0\nouter loop\n' + '\n'.join('vertex %.17g %.17g %.17g' % vertices[v] for v in face) +
              '\nendloop\nendfacet' for face in triangles(faces)]
    return ('solid mesh\n' + '\n'.join(facets) + '\nendsolid mesh\n').encode()


def stl_binary(mesh):
    vertices, faces = mesh
    facets = triangles(faces)
    records = [struct.pack('<12fH', 0, 0, 0, *vertices[a], *vertices[b], *vertices[c], 0) for a, b, c in facets]
    return b'made by a test'.ljust(80) + struct.pack('<I', len(facets)) + b''.join(records)


def gltf_parts(mesh, uvs=None):
    """The document without its buffer's bytes, and these."""
    vertices, faces = mesh
    facets = triangles(faces)
    positions = b''.join(struct.pack('<3f', *p) for p in vertices)
    indices = b''.join(struct.pack('<3I', *f) for f in facets)
    texture = b''.join(struct.pack('<2f', *p) for p in uvs or [])
    data = positions + indices + texture
    views = [{'buffer': 0, 'byteOffset': 0, 'byteLength': len(positions)},
             {'buffer': 0, 'byteOffset': len(positions), 'byteLength': len(indices)}]
    accessors = [{'bufferView': 0, 'componentType': 5126, 'count': len(vertices), 'type': 'VEC3',
                  'min': [min(p[k] for p in vertices) for k in range(3)], 'max': [max(p[k] for p in vertices) for k in range(3)]},
                 {'bufferView': 1, 'componentType': 5125, 'count': 3 * len(facets), 'type': 'SCALAR'}]
    attributes = {'POSITION': 0}
    if uvs:
        views.append({'buffer': 0, 'byteOffset': len(positions) + len(indices), 'byteLength': len(texture)})
        accessors.append({'bufferView': 2, 'componentType': 5126, 'count': len(uvs), 'type': 'VEC2'})
        attributes['TEXCOORD_0'] = 2
    document = {'asset': {'version': '2.0'}, 'scene': 0, 'scenes': [{'nodes': [0]}], 'nodes': [{'mesh': 0}],
                'meshes': [{'primitives': [{'attributes': attributes, 'indices': 1}]}],
                'buffers': [{'byteLength': len(data)}], 'bufferViews': views, 'accessors': accessors}
    return document, data


def gltf(mesh=None, parts=None):
    document, data = parts or gltf_parts(mesh)
    document['buffers'][0].setdefault('uri', 'data:application/octet-stream;base64,' + base64.b64encode(data).decode())
    return json.dumps(document).encode()


def glb(mesh=None, parts=None):
    document, data = parts or gltf_parts(mesh)
    text = json.dumps(document).encode()
    text += b' ' * (-len(text) % 4)
    data += b'\0' * (-len(data) % 4)
    size = 12 + 8 + len(text) + 8 + len(data)
    return (struct.pack('<4sII', b'glTF', 2, size) + struct.pack('<I4s', len(text), b'JSON') + text +
            struct.pack('<I4s', len(data), b'BIN\0') + data)
