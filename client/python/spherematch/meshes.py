# SPDX-License-Identifier: MIT
"""Arrays to and from the bytes that travel."""
import io
import os

import numpy as np

from . import interop


def mesh_bytes(mesh):
    """The bytes to upload and a file name that tells their format: of a path, of bytes, of a mesh of trimesh or meshio, or of
    (vertices, faces)."""
    if isinstance(mesh, (str, os.PathLike)):
        with open(mesh, 'rb') as file:
            return file.read(), os.path.basename(os.fspath(mesh))
    if isinstance(mesh, (bytes, bytearray, memoryview)):
        return bytes(mesh), ''
    if interop.is_trimesh(mesh) or interop.is_meshio(mesh):
        return _ply(*interop.surface_of(mesh)), ''
    vertices, faces = mesh
    return _ply(np.asarray(vertices, float), [np.asarray(faces)]), ''


def _ply(vertices, blocks):
    """Binary PLY with double coordinates: every bit of the vertices arrives."""
    if vertices.ndim != 2 or vertices.shape[1] != 3:
        raise ValueError(f'vertices must be of shape (n, 3), not {vertices.shape}')
    for faces in blocks:
        if faces.ndim != 2 or not 3 <= faces.shape[1] <= 255 or not np.issubdtype(faces.dtype, np.integer):
            raise ValueError('faces must be integers of shape (m, corners)')
    header = (f'ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\nproperty double x\nproperty double y\n'
              f'property double z\nelement face {sum(map(len, blocks))}\nproperty list uchar int vertex_indices\nend_header\n')
    parts = [header.encode(), vertices.astype('<f8').tobytes()]
    for faces in blocks:
        rows = np.empty(len(faces), [('count', 'u1'), ('corners', '<i4', (faces.shape[1],))])
        rows['count'], rows['corners'] = faces.shape[1], faces
        parts.append(rows.tobytes())
    return b''.join(parts)


def read_ply(data):
    """The vertices, float64 (n, 3), and the faces in blocks of equally many corners, in their order, of a PLY file as the server writes
    the mesh of a shape."""
    header, body = data.split(b'end_header\n', 1)
    words = [line.split() for line in header.decode().splitlines()]
    counts = {word[1]: int(word[2]) for word in words if word[0] == 'element'}
    real = '<f8' if ['property', 'double', 'x'] in words else '<f4'
    vertices = np.frombuffer(body, real, 3 * counts['vertex']).reshape(-1, 3)
    length = {'uchar': 'u1', 'int': '<i4'}[next(word[2] for word in words if word[:2] == ['property', 'list'])]
    blocks, at, left = [], vertices.nbytes, counts['face']
    while left:
        corners = int(np.frombuffer(body, length, 1, at)[0])
        row = np.dtype([('count', length), ('corners', '<i4', (corners,))])
        rows = np.frombuffer(body, row, min(left, (len(body) - at) // row.itemsize), at)
        other = np.flatnonzero(rows['count'] != corners)
        rows = rows[:other[0]] if len(other) else rows
        blocks.append(rows['corners'].astype(int))
        at += rows.nbytes
        left -= len(rows)
    return vertices.astype(float), blocks


def npy_bytes(array):
    file = io.BytesIO()
    np.save(file, np.asarray(array), allow_pickle=False)
    return file.getvalue()


def load(data):
    """An array of NPY, or the arrays by name of NPZ."""
    return np.load(io.BytesIO(data), allow_pickle=False)
