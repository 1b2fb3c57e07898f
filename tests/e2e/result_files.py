"""Readers of the mesh and picture formats of a match, for the end-to-end tests."""
import json
import math
import struct
import zlib

NUMBERS = {'float': 'f', 'double': 'd', 'uchar': 'B', 'int': 'i'}


def read_ply(data):
    """Vertices as dictionaries of their properties, faces as lists of indices."""
    header, _, body = data.partition(b'end_header\n')
    lines = [line.split() for line in header.decode().splitlines() if not line.startswith('comment')]
    assert lines[:2] == [['ply'], ['format', 'binary_little_endian', '1.0']], lines
    names, codes, counts, listed = [], '<', {}, None
    for line in lines[2:]:
        if line[0] == 'element':
            counts[line[1]] = int(line[2])
        elif line[1] == 'list':
            listed = NUMBERS[line[2]], NUMBERS[line[3]]
        else:
            names.append(line[2])
            codes += NUMBERS[line[1]]
    size = struct.calcsize(codes) * counts['vertex']
    vertices = [dict(zip(names, row)) for row in struct.iter_unpack(codes, body[:size])]
    faces, at = [], size
    for _ in range(counts['face']):
        count, = struct.unpack_from('<' + listed[0], body, at)
        at += struct.calcsize(listed[0])
        faces.append(list(struct.unpack_from(f'<{count}{listed[1]}', body, at)))
        at += count * struct.calcsize(listed[1])
    assert at == len(body), (at, len(body))
    return vertices, faces


def read_obj(data):
    """Vertices as rows of six numbers, faces as lists of indices from 0."""
    lines = [line.split() for line in data.decode().splitlines() if not line.startswith('#')]
    assert {line[0] for line in lines} == {'v', 'f'}
    return ([[float(x) for x in line[1:]] for line in lines if line[0] == 'v'],
            [[int(x) - 1 for x in line[1:]] for line in lines if line[0] == 'f'])


def read_glb(data):
    """Positions, normals, colours and triangles as lists of rows; checks the container and the bounds on the way."""
    magic, version, length, json_length, json_type = struct.unpack_from('<4sIII4s', data)
    assert (magic, version, length, json_type, json_length % 4) == (b'glTF', 2, len(data), b'JSON', 0)
    document = json.loads(data[20:20 + json_length])
    binary_length, binary_type = struct.unpack_from('<I4s', data, 20 + json_length)
    assert (binary_type, 28 + json_length + binary_length) == (b'BIN\0', len(data))
    binary = data[28 + json_length:]
    assert len(document['buffers']) == 1 and document['buffers'][0]['byteLength'] <= binary_length

    def rows(index):
        accessor = document['accessors'][index]
        view = document['bufferViews'][accessor['bufferView']]
        code = {5121: 'B', 5125: 'I', 5126: 'f'}[accessor['componentType']]
        width = {'SCALAR': 1, 'VEC3': 3, 'VEC4': 4}[accessor['type']]
        start, size = view['byteOffset'], struct.calcsize(code) * width * accessor['count']
        assert start % 4 == 0 and size == view['byteLength'] and start + size <= document['buffers'][0]['byteLength']
        result = list(struct.iter_unpack(f'<{width}{code}', binary[start:start + size]))
        for bound, pick in (('min', min), ('max', max)):
            if bound in accessor:
                assert accessor[bound] == [pick(row[k] for row in result) for k in range(width)]
        return result

    primitive = document['meshes'][0]['primitives'][0]
    attributes = primitive['attributes']
    assert 'min' in document['accessors'][attributes['POSITION']]
    normals = rows(attributes['NORMAL'])
    assert all(abs(math.hypot(*normal) - 1) < 1e-5 for normal in normals)
    indices = [i for i, in rows(primitive['indices'])]
    return rows(attributes['POSITION']), normals, rows(attributes['COLOR_0']), [indices[i:i + 3] for i in range(0, len(indices), 3)]


def read_png(data):
    """Width, height and the rows of an eight-bit RGB picture, each row as bytes."""
    assert data[:8] == b'\x89PNG\r\n\x1a\n'
    at, packed, size = 8, b'', None
    while at < len(data):
        length, kind = struct.unpack_from('>I4s', data, at)
        content = data[at + 8:at + 8 + length]
        assert zlib.crc32(kind + content) == struct.unpack_from('>I', data, at + 8 + length)[0]
        if kind == b'IHDR':
            size = struct.unpack('>IIBBBBB', content)
        elif kind == b'IDAT':
            packed += content
        at += 12 + length
    width, height = size[:2]
    assert size[2:] == (8, 2, 0, 0, 0), size
    raw, stride, rows = zlib.decompress(packed), 3 * width + 1, []
    above = bytes(3 * width)
    for y in range(height):
        rows.append(unfiltered(raw[y * stride], raw[y * stride + 1:(y + 1) * stride], above))
        above = rows[-1]
    return width, height, rows


def unfiltered(kind, line, above):
    """The PNG specification, section 9."""
    row = bytearray(line)
    for i in range(len(row)):
        left = row[i - 3] if i >= 3 else 0
        corner = above[i - 3] if i >= 3 else 0
        if kind == 1:
            row[i] = (row[i] + left) & 255
        elif kind == 2:
            row[i] = (row[i] + above[i]) & 255
        elif kind == 3:
            row[i] = (row[i] + (left + above[i]) // 2) & 255
        elif kind == 4:
            estimate = left + above[i] - corner
            row[i] = (row[i] + min((left, above[i], corner), key=lambda value: abs(estimate - value))) & 255
    return bytes(row)
