# SPDX-License-Identifier: MIT
"""Arrays to and from the bytes that travel."""
import io
import os

import numpy as np


def mesh_bytes(mesh):
    """The bytes to upload and a file name that tells their format: of a path, of bytes, or of (vertices, faces)."""
    if isinstance(mesh, (str, os.PathLike)):
        with open(mesh, 'rb') as file:
            return file.read(), os.path.basename(os.fspath(mesh))
    if isinstance(mesh, (bytes, bytearray, memoryview)):
        return bytes(mesh), ''
    vertices, faces = mesh
    return _ply(np.asarray(vertices, float), np.asarray(faces)), ''


def _ply(vertices, faces):
    """Binary PLY with double coordinates: every bit of the vertices arrives."""
    if vertices.ndim != 2 or vertices.shape[1] != 3:
        raise ValueError(f'vertices must be of shape (n, 3), not {vertices.shape}')
    if faces.ndim != 2 or not 3 <= faces.shape[1] <= 255 or not np.issubdtype(faces.dtype, np.integer):
        raise ValueError('faces must be integers of shape (m, corners)')
    header = (f'ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\nproperty double x\nproperty double y\n'
              f'property double z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n')
    rows = np.empty(len(faces), [('count', 'u1'), ('corners', '<i4', (faces.shape[1],))])
    rows['count'], rows['corners'] = faces.shape[1], faces
    return header.encode() + vertices.astype('<f8').tobytes() + rows.tobytes()


def npy_bytes(array):
    file = io.BytesIO()
    np.save(file, np.asarray(array), allow_pickle=False)
    return file.getvalue()


def load(data):
    """An array of NPY, or the arrays by name of NPZ."""
    return np.load(io.BytesIO(data), allow_pickle=False)
