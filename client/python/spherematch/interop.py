# SPDX-License-Identifier: MIT
"""Meshes of trimesh and of meshio. Neither package is imported before a mesh of it is asked for: an object is known by its members."""
import copy

import numpy as np


def is_trimesh(mesh):
    """A trimesh.Trimesh, or what has its vertices and faces."""
    return hasattr(mesh, 'vertices') and hasattr(mesh, 'faces')


def is_meshio(mesh):
    """A meshio.Mesh, or what has its points and cells."""
    return hasattr(mesh, 'points') and hasattr(mesh, 'cells')


def surface_of(mesh):
    """The vertices, float64 (n, 3), and a list of blocks of faces, each (m, corners)."""
    if is_trimesh(mesh):
        return np.asarray(mesh.vertices, float), [np.asarray(mesh.faces)]
    points = np.asarray(mesh.points, float)
    if points.ndim == 2 and points.shape[1] == 2:
        points = np.column_stack([points, np.zeros(len(points))])
    blocks = []
    for block in mesh.cells:
        if block.type in ('triangle', 'quad', 'polygon'):
            blocks.append(np.asarray(block.data))
        elif block.type not in ('vertex', 'line'):
            raise ValueError(f'cells of the type {block.type!r} are no faces of a surface')
    if not blocks:
        raise ValueError('the mesh has no triangles, quads or polygons')
    return points, blocks


def make_trimesh(vertices, faces):
    """A trimesh.Trimesh that keeps the numbers of the vertices."""
    import trimesh
    return trimesh.Trimesh(vertices=vertices, faces=triangles_of(faces), process=False)


def make_meshio(vertices, faces):
    """A meshio.Mesh with a block of cells for each number of corners."""
    import meshio
    names = {3: 'triangle', 4: 'quad'}
    return meshio.Mesh(vertices, [(names.get(block.shape[1], 'polygon'), block) for block in faces])


def triangles_of(blocks):
    """Every polygon as the fan of its first corner."""
    fans = [block[:, [0, i, i + 1]] for block in blocks for i in range(1, block.shape[1] - 1)]
    return np.concatenate(fans) if fans else np.zeros((0, 3), int)


def carried(source, target, carry):
    """A copy of `source` with what `target` has at its vertices: point data of meshio; vertex attributes and vertex colours or texture
    coordinates of trimesh. `carry` takes an array from the target's vertices to the source's."""
    result = copy.deepcopy(source)
    found = _data_of(target)
    if is_meshio(result):
        result.point_data.update({name: carry(values) for name, values in found.items()})
        return result
    material = getattr(getattr(target, 'visual', None), 'material', None)
    for name, values in found.items():
        if name == 'color':
            result.visual.vertex_colors = carry(values)
        elif name == 'uv' and material is not None:
            result.visual = type(target.visual)(uv=carry(values), material=material)
        else:
            result.vertex_attributes[name] = carry(values)
    return result


def _data_of(mesh):
    """Arrays by name. What trimesh keeps apart, as the picture of a mesh, is called color and uv."""
    if is_meshio(mesh):
        return {name: np.asarray(values) for name, values in mesh.point_data.items()}
    found = {name: np.asarray(values) for name, values in getattr(mesh, 'vertex_attributes', {}).items()}
    visual = getattr(mesh, 'visual', None)
    if getattr(visual, 'kind', None) == 'vertex':
        found['color'] = np.asarray(visual.vertex_colors)
    elif getattr(visual, 'kind', None) == 'texture' and visual.uv is not None:
        found['uv'] = np.asarray(visual.uv)
    return found
