"""Uploads that are wrong, each with the refusal that it must get: status, code, and words that name the trouble."""
import base64
import dataclasses
import gzip
import json
import math
import random
import struct

import formats
import support

MALFORMED, UNKNOWN = (400, 'malformed-mesh'), (415, 'unsupported-format')
TOO_MANY, DEGENERATE = (422, 'too-many-vertices'), (422, 'degenerate')
OPEN, GENUS, MANIFOLD, PIECES = (422, 'not-closed'), (422, 'wrong-genus'), (422, 'non-manifold'), (422, 'disconnected')
TURNED = (422, 'inconsistent-orientation')
COMPRESSED, EXTERNAL = (415, 'compressed-geometry'), (422, 'external-reference')

BALL = formats.exact(support.bumpy(2, 0.4))


@dataclasses.dataclass
class Case:
    name: str
    body: bytes
    refusal: tuple  # status and code
    words: str  # a regular expression that the detail must contain
    query: dict = dataclasses.field(default_factory=dict)
    headers: dict = dataclasses.field(default_factory=dict)


def with_vertex(mesh, i, p):
    return mesh[0][:i] + [p] + mesh[0][i + 1:], mesh[1]


def with_face(mesh, face):
    return mesh[0], mesh[1][:5] + [face] + mesh[1][6:]


def klein_bottle(n=24, m=12):
    """The figure-eight immersion; its square grid closes with a twist."""
    vertices = []
    for i in range(n):
        for j in range(m):
            u, v = 2 * math.pi * i / n, 2 * math.pi * j / m
            r = 3 + math.cos(u / 2) * math.sin(v) - math.sin(u / 2) * math.sin(2 * v)
            z = math.sin(u / 2) * math.sin(v) + math.cos(u / 2) * math.sin(2 * v)
            vertices.append((r * math.cos(u), r * math.sin(u), z))
    faces = []
    for i in range(n):
        for j in range(m):
            def at(k, l):
                return k * m + l % m if k < n else (-l) % m
            faces += [(at(i, j), at(i + 1, j), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i, j + 1))]
    return vertices, faces


def off_cases():
    text = support.off(BALL)
    lines = text.split(b'\n')
    n = len(BALL[0])
    nan, inf = float('nan'), float('inf')
    return [
        Case('empty', b'', MALFORMED, 'empty'),
        Case('OFF without counts', b'OFF\n', MALFORMED, 'line 2.*number of vertices'),
        Case('OFF cut in the counts', b'OFF\n162 3', MALFORMED, 'line 2|count|ends'),
        Case('OFF cut in the vertices', b'\n'.join(lines[:50]), MALFORMED, 'line|size|ends|counts'),
        Case('OFF cut in the faces', b'\n'.join(lines[:-20]), MALFORMED, 'line|ends'),
        Case('OFF cut in a number', text[:len(text) // 3], MALFORMED, 'line|size|ends|counts'),
        Case('OFF with huge counts', b'OFF\n4000000000 4000000000 0\n0 0 0\n', MALFORMED, 'too short for 4000000000'),
        Case('OFF with counts beyond 64 bits', b'OFF\n99999999999999999999999 1 0\n0 0 0\n', MALFORMED, 'line 2'),
        Case('OFF with negative counts', b'OFF\n-5 -7 0\n0 0 0\n', MALFORMED, 'line 2'),
        Case('OFF with too small a count', text.replace(b'162', b'161', 1), MALFORMED, 'line'),
        Case('OFF with NaN', support.off(with_vertex(BALL, 7, (nan, 0, 0))), MALFORMED, 'line 10.*(finite|nan|number)'),
        Case('OFF with infinity', support.off(with_vertex(BALL, 7, (0, inf, 0))), MALFORMED, 'line 10.*(finite|inf|number)'),
        Case('OFF with a number beyond doubles', text.replace(lines[9], b'1e999 0 0', 1), MALFORMED, 'line 10'),
        Case('OFF with an index out of range', support.off(with_face(BALL, (0, 1, n))), MALFORMED, f'{n}'),
        Case('OFF with a negative index', support.off(with_face(BALL, (0, 1, -1))), MALFORMED, '-1'),
        Case('OFF with an index beyond 32 bits', support.off(with_face(BALL, (0, 1, 2**32))), MALFORMED, '4294967296|line'),
        Case('OFF with a list bomb', text.replace(lines[-2], b'2000000000 0 1 2', 1), TOO_MANY, 'line 484.*corners'),
        Case('OFF with text for numbers', text.replace(lines[9], b'here be dragons', 1), MALFORMED, 'line 10'),
    ]


def obj_cases():
    text = formats.obj(BALL)
    n = len(BALL[0])
    return [
        Case('OBJ cut in a vertex', text[:text.index(b'\n', 3000) - 20], MALFORMED, 'line', {'name': 'a.obj'}),
        Case('OBJ cut in the faces', text[:text.rindex(b'\n', 0, -300) + 1], OPEN, 'boundary', {'repair': 'none'}),
        Case('OBJ without faces', b'\n'.join(line for line in text.split(b'\n') if line[:1] == b'v'), DEGENERATE, 'faces'),
        Case('OBJ with NaN', text.replace(b'\nv ', b'\nv nan ', 1), MALFORMED, 'line 2.*(finite|nan|number)'),
        Case('OBJ with infinity', text.replace(b'\nv ', b'\nv -inf ', 1), MALFORMED, 'line 2.*(finite|inf|number)'),
        Case('OBJ with index zero', formats.obj(with_face(BALL, (0, 1, -1))), MALFORMED, 'line 168.*start at 1'),
        Case('OBJ with an index out of range', formats.obj(with_face(BALL, (0, 1, n))), MALFORMED, f'{n + 1}'),
        Case('OBJ with a relative index out of range', text + b'f -1 -2 -1000\n', MALFORMED, '-1000'),
        Case('OBJ with an index beyond 64 bits', text + b'f 1 2 99999999999999999999\n', MALFORMED, 'line'),
        Case('OBJ with a list bomb', text + b'f' + b' 1 2 3' * 2_000_000 + b'\n', TOO_MANY, 'corners'),
        Case('OBJ with a short face', text + b'f 1 2\n', MALFORMED, 'line'),
    ]


def ply_cases():
    ascii_text, binary = formats.ply_ascii(BALL), formats.ply_binary(BALL)
    body = binary.index(b'end_header\n') + 11
    n, f = len(BALL[0]), len(BALL[1])
    faces = body + 12 * n
    cases = [
        Case('PLY cut in the header', binary[:60], MALFORMED, 'header|line'),
        Case('PLY without an end of its header', b'ply\nformat ascii 1.0\n' + b'comment x\n' * 1000, MALFORMED, 'header|line|end'),
        Case('PLY cut in the text', ascii_text[:len(ascii_text) // 2], MALFORMED, 'line|vertex|size|ends'),
        Case('PLY cut in the vertices', binary[:body + 1000], MALFORMED, 'byte|vertex|size|ends'),
        Case('PLY cut in the faces', binary[:-17], MALFORMED, 'byte|face|ends'),
        Case('PLY with huge counts', binary.replace(b'vertex 162', b'vertex 4294967295'), MALFORMED, 'count|vertex|size'),
        Case('PLY with counts beyond 64 bits', binary.replace(b'vertex 162', b'vertex 99999999999999999999'), MALFORMED, 'line|count'),
        Case('PLY with a negative count', binary.replace(b'face 320', b'face -1'), MALFORMED, 'line|count'),
        Case('PLY of an unknown form', binary.replace(b'binary_little_endian', b'binary_middle_endian'), MALFORMED, 'middle|format'),
        Case('PLY without coordinates', binary.replace(b'float z', b'float w'), MALFORMED, 'z'),
    ]
    bomb = formats.ply_header('binary_little_endian', n, f, count='uint') + binary[body:faces] + struct.pack('<I3i', 2**32 - 1, 0, 1, 2)
    negative = formats.ply_header('binary_little_endian', n, f, count='int') + binary[body:faces]
    cases += [
        Case('PLY with a list bomb', bomb + bytes(13 * f), TOO_MANY, 'byte.*corners'),
        Case('PLY with a negative list', negative + struct.pack('<4i', -3, 0, 1, 2) * f, MALFORMED, '-3|list|byte'),
        Case('PLY with NaN', binary[:body] + struct.pack('<f', math.nan) + binary[body + 4:], MALFORMED, 'vertex|finite|byte'),
        Case('PLY with infinity', binary[:body] + struct.pack('<f', math.inf) + binary[body + 4:], MALFORMED, 'vertex|finite|byte'),
        Case('PLY with an index out of range', formats.ply_binary(with_face(BALL, (0, 1, n))), MALFORMED, f'{n}'),
        Case('PLY with a negative index', formats.ply_binary(with_face(BALL, (0, 1, -1))), MALFORMED, '-1'),
        Case('PLY with endless properties', b'ply\nformat ascii 1.0\nelement vertex 1\n' + b'property float x\n' * 500_000, MALFORMED,
             'property|header|line'),
        Case('PLY of wide elements', b'ply\nformat binary_little_endian 1.0\nelement junk 99999999\nproperty list uchar int junk\n' +
             binary[binary.index(b'element'):], MALFORMED, 'junk|size|byte|ends|count'),
    ]
    return cases


def stl_cases():
    text, binary = formats.stl_ascii(BALL), formats.stl_binary(BALL)
    return [
        Case('STL cut in a record', binary[:-30], MALFORMED, 'byte|size|triangle', {'name': 'a.stl'}),
        Case('STL cut in the header', binary[:82], MALFORMED, 'byte|header|size|short|ends', {'name': 'a.stl'}),
        Case('STL with a huge count', binary[:80] + struct.pack('<I', 2**32 - 1) + binary[84:], MALFORMED, '4294967295|size|byte',
             {'name': 'a.stl'}),
        Case('STL with a wrong count', binary[:80] + struct.pack('<I', 1000) + binary[84:], MALFORMED, '1000|size|byte', {'name': 'a.stl'}),
        Case('STL with NaN', binary[:96] + struct.pack('<f', math.nan) + binary[100:], MALFORMED, 'finite|number|byte'),
        Case('STL without triangles', binary[:80] + struct.pack('<I', 0), DEGENERATE, 'faces'),
        Case('STL text cut short', text[:len(text) // 2], MALFORMED, 'line'),
        Case('STL text with infinity', text.replace(b'vertex ', b'vertex inf ', 1), MALFORMED, 'line 4'),
        Case('STL text with words', text.replace(b'outer loop', b'other loop', 1), MALFORMED, 'line 3'),
    ]


def gltf_changed(name, refusal, words, change, data_change=lambda data: data):
    document, data = formats.gltf_parts(BALL)
    change(document)
    return Case(name, formats.glb(parts=(document, data_change(data))), refusal, words)


def gltf_cases():
    whole = formats.glb(BALL)
    draco = {'KHR_draco_mesh_compression': {'bufferView': 0, 'attributes': {'POSITION': 0}}}

    def set_in(path, value):
        def change(document):
            place = document
            for key in path[:-1]:
                place = place[key]
            place[path[-1]] = value
        return change

    def use_draco(document):
        document['extensionsRequired'] = document['extensionsUsed'] = list(draco)
        document['meshes'][0]['primitives'][0]['extensions'] = draco

    def use_meshopt(document):
        document['extensionsRequired'] = document['extensionsUsed'] = ['EXT_meshopt_compression']
        document['bufferViews'][0]['extensions'] = {'EXT_meshopt_compression': {'buffer': 0, 'byteLength': 10, 'byteStride': 12,
                                                                                  'count': 162, 'mode': 'ATTRIBUTES'}}

    def grow(document):  # 2^40 instances
        document['nodes'] = [{'children': [i + 1, i + 1]} for i in range(40)] + [{'mesh': 0}]

    def spread(document):  # 1000 instances of 100 copies each, every one of them allowed for itself
        document['nodes'] = [{'children': list(range(1, 3001))}] + [{'mesh': 0} for _ in range(3000)]

    def external(uri):
        document, data = formats.gltf_parts(BALL)
        document['buffers'][0]['uri'] = uri
        return formats.gltf(parts=(document, data))

    deep = b'{"asset":{"version":"2.0"},"extras":' + b'[' * 100_000 + b']' * 100_000 + b'}'
    wide = b'{"asset":{"version":"2.0"},"nodes":[' + b'{},' * 8_000_000 + b'{}]}'
    return [
        Case('GLB cut in the header', whole[:10], MALFORMED, 'byte|header|short|ends', {'name': 'a.glb'}),
        Case('GLB cut in the JSON', whole[:200], MALFORMED, 'length|byte|chunk|ends'),
        Case('GLB cut in the data', whole[:-1000], MALFORMED, 'length|byte|chunk|ends'),
        Case('GLB with a false chunk', whole[:12] + struct.pack('<I', 2**32 - 1) + whole[16:], MALFORMED, 'chunk|length|byte'),
        Case('GLB of version 1', whole[:4] + struct.pack('<I', 1) + whole[8:], UNKNOWN, 'version|glTF'),
        gltf_changed('glTF with a huge accessor', MALFORMED, 'accessor 0.*beyond', set_in(('accessors', 0, 'count'), 2**31 - 1)),
        gltf_changed('glTF with a view past the buffer', MALFORMED, 'bufferView|buffer', set_in(('bufferViews', 1, 'byteOffset'), 10**9)),
        gltf_changed('glTF with negative offsets', MALFORMED, '-8', set_in(('bufferViews', 1, 'byteOffset'), -8)),
        gltf_changed('glTF without its accessor', MALFORMED, 'accessor|POSITION',
                     set_in(('meshes', 0, 'primitives', 0, 'attributes'), {'POSITION': 99})),
        gltf_changed('glTF without positions', MALFORMED, 'POSITION', set_in(('meshes', 0, 'primitives', 0, 'attributes'), {})),
        gltf_changed('glTF with NaN', MALFORMED, 'finite|number', lambda d: None, lambda data: struct.pack('<f', math.nan) + data[4:]),
        gltf_changed('glTF with an index out of range', MALFORMED, '4294967295|ind', lambda d: None,
                     lambda data: data[:162 * 12] + struct.pack('<I', 2**32 - 1) + data[162 * 12 + 4:]),
        gltf_changed('glTF with a bomb of sparse values', TOO_MANY, '2147483647',
                     set_in(('accessors', 0), {'componentType': 5126, 'count': 2**31 - 1, 'type': 'VEC3', 'sparse': {
                         'count': 1, 'indices': {'bufferView': 0, 'componentType': 5125}, 'values': {'bufferView': 0}}})),
        gltf_changed('glTF with a node in itself', MALFORMED, 'node', set_in(('nodes', 0), {'mesh': 0, 'children': [0]})),
        gltf_changed('glTF with a bomb of instances', MALFORMED, 'node', grow),
        gltf_changed('glTF with too many instances', TOO_MANY, '300000', spread),
        gltf_changed('glTF with Draco', COMPRESSED, 'Draco|draco', use_draco),
        gltf_changed('glTF with meshopt', COMPRESSED, 'meshopt', use_meshopt),
        gltf_changed('glTF without meshes', MALFORMED, 'no mesh', set_in(('meshes',), [])),
        Case('glTF with a file', external('mesh.bin'), EXTERNAL, 'mesh.bin|buffer'),
        Case('glTF with a path', external('../../../../etc/passwd'), EXTERNAL, 'passwd|buffer'),
        Case('glTF with an address', external('http://127.0.0.1:1/mesh.bin'), EXTERNAL, 'buffer|http'),
        Case('glTF with false base64', external('data:application/octet-stream;base64,!!!!'), MALFORMED, 'base64|buffer|uri'),
        Case('glTF cut short', formats.gltf(BALL)[:3000], MALFORMED, 'byte|JSON'),
        Case('glTF nested deeply', deep, MALFORMED, 'nested|deep', {'name': 'a.gltf'}),
        Case('glTF of eight million nodes', wide, MALFORMED, 'memory|large|nodes|much|many|byte', {'name': 'a.gltf'}),
        Case('JSON that is no glTF', json.dumps({'vertices': [1, 2, 3]}).encode(), UNKNOWN, 'asset|glTF', {'name': 'a.gltf'}),
    ]


def surface_cases():
    vertices, faces = BALL
    n = len(vertices)
    wings = vertices + [(9.0, 9.0, 9.0)], faces + [(*faces[0][:2], n)]
    other = [(x + 9, y, z) for x, y, z in vertices]
    two = vertices + other, faces + [tuple(v + n for v in face) for face in faces]
    flat = [(x, 2 * x, 3 * x) for x, _, _ in vertices]
    crowd = b'OFF\n300001 300001 0\n' + b'0 0 0\n' * 300_001 + b'3 0 1 2\n' * 300_001
    return [
        Case('a torus', support.off(support.torus()), GENUS, 'genus|handle|Euler'),
        Case('a torus as STL', formats.stl_binary(support.torus()), GENUS, 'genus|handle|Euler'),
        Case('a Klein bottle', support.off(klein_bottle()), TURNED, 'orient'),
        Case('an edge of three faces', support.off(wings), MANIFOLD, 'edge', {'repair': 'none'}),
        Case('zero area', support.off((flat, faces)), DEGENERATE, 'area'),
        Case('one point', support.off(([(1.0, 2.0, 3.0)] * n, faces)), DEGENERATE, 'too small'),
        Case('a triangle', support.off(([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])), DEGENERATE, 'vert|area|four'),
        Case('more than 300000 vertices', crowd, TOO_MANY, '300001.*300000|300000'),
        Case('two spheres unrepaired', support.off(two), PIECES, 'component', {'repair': 'none'}),
        Case('an open disk unrepaired', support.off((vertices, faces[: len(faces) // 2])), OPEN, 'boundary', {'repair': 'none'}),
        Case('inward faces unrepaired', support.off((vertices, [f[::-1] for f in faces])), TURNED, 'inward', {'repair': 'none'}),
    ]


def other_cases():
    noise = random.Random(7).randbytes(20 << 20)
    bomb = gzip.compress(bytes(100 << 20), 9)
    form = {'Content-Type': 'application/x-www-form-urlencoded'}
    boundary = 'xYz'
    parts = f'--{boundary}\r\nContent-Disposition: form-data; name="mesh"\r\n\r\nOFF\r\n--{boundary}--\r\n'.encode()
    return [
        Case('noise', noise, UNKNOWN, 'recognised'),
        Case('noise called a mesh', noise[: 1 << 20], (400, 'malformed-mesh'), 'line|byte', {'name': 'a.off'}),
        Case('noise called an STL', noise[: 1 << 20], (400, 'malformed-mesh'), 'size|byte|triangle', {'name': 'a.stl'}),
        Case('zeros', bytes(1 << 20), UNKNOWN, 'recognised'),
        Case('text', b'Hello, is this the right place?\n', UNKNOWN, 'recognised'),
        Case('a gzip bomb', bomb, UNKNOWN, 'gzip'),
        Case('an encoded gzip bomb', bomb, (415, 'content-encoding'), 'Content-Encoding', headers={'Content-Encoding': 'gzip'}),
        Case('an encoded mesh', gzip.compress(support.off(BALL)), (415, 'content-encoding'), 'Content-Encoding',
             headers={'Content-Encoding': 'gzip'}),
        Case('a form', b'name=ball&mesh=' + base64.b64encode(support.off(BALL)), UNKNOWN, 'fields of a form.*--data-binary', headers=form),
        Case('a mesh whose line ends curl took', support.off(BALL).replace(b'\n', b''), MALFORMED, 'no line ends.*--data-binary',
             headers=form),
        Case('a form of another field', parts, (400, 'invalid-parameter'), 'mesh',
             headers={'Content-Type': f'multipart/form-data; boundary={boundary}'}),
        Case('parts without an end', parts.replace(b'"mesh"', b'"file"')[:60], (400, 'bad-request'), 'multipart',
             headers={'Content-Type': f'multipart/form-data; boundary={boundary}'}),
        Case('parts of another kind', parts, (415, 'unsupported-media-type'), 'form-data',
             headers={'Content-Type': f'multipart/mixed; boundary={boundary}'}),
    ]


def all_cases():
    return off_cases() + obj_cases() + ply_cases() + stl_cases() + gltf_cases() + surface_cases() + other_cases()
