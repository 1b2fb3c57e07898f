# SPDX-License-Identifier: MIT
"""The calls of the service."""
import json
import time

import numpy as np

from . import interop, meshes
from .errors import JobFailed, TransportError
from .transport import Transport

_LONGEST_WAIT = 60  # of one request
_STREAM_PAUSE = 3600  # between two lines of a stream, one long match


class _Record:
    """An object of the server as it was last heard of: `info` as JSON has it; its members are attributes too."""

    def __init__(self, info):
        self.info = info

    def __getattr__(self, name):
        try:
            return self.__dict__['info'][name]
        except KeyError:
            raise AttributeError(name) from None


class Shape(_Record):
    """A shape, with the members of the shape object."""

    def __repr__(self):
        return f"<Shape {self.id} {self.name!r} {self.state}, {self.vertices} vertices>"


class Match:
    """The map from a source to a target: row i is uploaded source vertex i.

    vertex      int32 (n,): the corner nearest to the image; -1 for a dropped vertex
    corners     int32 (n, 3): uploaded target vertices around the image
    bary        float32 (n, 3): the image's weights in them
    confidence  float32 (n,): the probability that the image is right; None where `fields` did not ask for it
    distortion  float32 (n,): how much the map stretches, 0 for an isometry; None where `fields` did not ask for it
    reverse     the same for the target's vertices, where `both` was asked for, else None
    """

    def __init__(self, arrays, prefix=''):
        self.vertex = arrays[prefix + 'vertex']
        self.corners = arrays[prefix + 'corners']
        self.bary = arrays[prefix + 'bary']
        self.confidence = arrays.get(prefix + 'confidence')
        self.distortion = arrays.get(prefix + 'distortion')
        self.reverse = Match(arrays, 'reverse_') if prefix + 'reverse_vertex' in arrays else None

    def points(self, target_vertices):
        """The images in space, (n, 3), given the target's vertices as uploaded; not-a-number for dropped source vertices."""
        return self.apply(np.asarray(target_vertices, float))

    def apply(self, values):
        """Rows of target values moved along the map, linearly: the same as Client.transfer, without the server."""
        values = np.asarray(values, float)
        weights = self.bary.astype(float).reshape(self.bary.shape + (1,) * (values.ndim - 1))
        moved = (values[self.corners] * weights).sum(axis=1)
        moved[self.vertex < 0] = np.nan
        return moved

    def __len__(self):
        return len(self.vertex)


class Job(_Record):
    """A job, with the members of the job object."""

    @property
    def active(self):
        return self.state in ('queued', 'processing')

    def __repr__(self):
        return f'<Job {self.id} {self.kind} {self.state} {self.progress:.0%}>'


def _id(shape):
    return shape if isinstance(shape, str) else shape.id


def _hints(hints):
    return ','.join(f'{int(source)}:{int(target)}' for source, target in hints) if hints else None


def _indices(vertices):
    return [int(vertex) for vertex in vertices]


class Client:
    """Calls raise ProblemError where the server refuses, and TransportError where no answer comes. What can be repeated without harm is
    tried again up to `retries` times. `timeout` is in seconds, beyond the time that a call asks the server to wait."""

    def __init__(self, url='http://127.0.0.1:8080', api_key=None, timeout=60.0, retries=3):
        self._http = Transport(url, api_key, timeout, retries)

    # Shapes

    def upload(self, mesh, name=None, repair='fill', tags=None, simplify=None, wait=600.0):
        """Uploads a mesh, given as a path, as bytes, as a mesh of trimesh or meshio or as (vertices, faces), and waits up to `wait` seconds
        for its preparation. The same mesh twice is the same shape. Raises JobFailed where it cannot be prepared; check `state` where the
        wait may be too short."""
        data, file_name = meshes.mesh_bytes(mesh)
        query = {'name': file_name if name is None else name, 'repair': repair, 'wait': min(wait, _LONGEST_WAIT),
                 'tags': ','.join(tags) if tags else None, 'simplify': simplify}
        deadline = time.monotonic() + wait
        info = self._http.json_of_upload(query, data)
        return self.wait(Shape(info), max(0.0, deadline - time.monotonic()))

    def wait(self, shape, timeout=600.0):
        """The shape once its preparation has ended, or as it is when the time is over."""
        deadline = time.monotonic() + timeout
        while shape.state in ('queued', 'processing') and (left := deadline - time.monotonic()) > 0:
            wait = min(left, _LONGEST_WAIT)
            self._http.json('GET', f'/jobs/p{_id(shape)}', {'wait': wait}, extra_time=wait)
            shape = self.shape(shape)
        if shape.state == 'failed':
            raise JobFailed(shape.error)
        return shape

    def shape(self, shape):
        return Shape(self._http.json('GET', '/shapes/' + _id(shape)))

    def shapes(self, state=None, tag=None, q=None, sha256=None):
        """All shapes that fit, newest first, page by page as they are asked for."""
        query = {'limit': 200, 'state': state, 'tag': tag, 'q': q, 'sha256': sha256}
        while True:
            page = self._http.json('GET', '/shapes', query)
            yield from map(Shape, page['items'])
            if not page['next_cursor']:
                return
            query['cursor'] = page['next_cursor']

    def update(self, shape, **members):
        """Changes `name` or `tags` (a list of text)."""
        return Shape(self._http.json('PATCH', '/shapes/' + _id(shape), body=members))

    def delete(self, shape):
        """Removes the shape with everything derived from it."""
        self._http.request('DELETE', '/shapes/' + _id(shape), idempotent=False)

    def mesh(self, shape, format='original'):
        """The bytes of the mesh, as uploaded or as off, obj, ply, stl or glb."""
        return self._http.request('GET', f'/shapes/{_id(shape)}/mesh', {'format': format})[2]

    def arrays(self, shape):
        """The uploaded mesh as (vertices, faces): float64 (n, 3) and integers (m, 3), polygons as fans of triangles."""
        vertices, blocks = meshes.read_ply(self.mesh(shape, 'ply'))
        return vertices, interop.triangles_of(blocks)

    def trimesh(self, shape):
        """The uploaded mesh as a trimesh.Trimesh, which must be installed; the numbers of the vertices stay."""
        return interop.make_trimesh(*meshes.read_ply(self.mesh(shape, 'ply')))

    def meshio(self, shape):
        """The uploaded mesh as a meshio.Mesh, which must be installed."""
        return interop.make_meshio(*meshes.read_ply(self.mesh(shape, 'ply')))

    def thumbnail(self, shape, size=256, up=None, front=None):
        """A picture of the uploaded mesh, size x size pixels: the bytes of a PNG file with a transparent background. `up` and `front`,
        both or none, are directions such as 'y' and '-x': which is upward, and from where to look."""
        return self._http.request('GET', f'/shapes/{_id(shape)}/thumbnail.png', {'size': size, 'up': up, 'front': front})[2]

    def sphere(self, shape):
        """The spherical parametrisation: float64 (n, 3), not-a-number for dropped vertices."""
        return meshes.load(self._http.request('GET', f'/shapes/{_id(shape)}/sphere', {'format': 'npy'})[2])

    def heat_kernel_signatures(self, shape):
        """The times, float64 (t,), and the grids over the sphere, float32 (t, n, n)."""
        arrays = meshes.load(self._http.request('GET', f'/shapes/{_id(shape)}/hks', {'format': 'npz'})[2])
        return arrays['times'], arrays['grids']

    # Matches

    def match(self, source, target, both=False, orientation=None, hints=None, method=None, cache=None, candidate=None, refine=None, fields=None):
        """The map from source to target. `hints` are pairs (source vertex, target vertex). `candidate` 1 asks for the next best map, `refine`
        'none' for that of the optical flow alone, `fields` 'confidence,distortion' for these two beside the map."""
        return Match(meshes.load(self.match_file(source, target, 'npz', both, orientation, hints, method, cache, candidate, refine, fields)))

    def match_file(self, source, target, format, both=False, orientation=None, hints=None, method=None, cache=None, candidate=None, refine=None,
                   fields=None):
        """The same as the bytes of a file: npz, npy, txt, map, ply, glb, obj, png or json. `fields` are for npz, ply and json, where they
        name all arrays."""
        query = {'src': _id(source), 'tgt': _id(target), 'format': format, 'both': 'yes' if both else None, 'orientation': orientation,
                 'hints': _hints(hints), 'method': method, 'cache': cache, 'candidate': candidate, 'refine': refine, 'fields': fields,
                 'wait': _LONGEST_WAIT}
        return self._http.request('GET', '/match', query, extra_time=_LONGEST_WAIT)[2]

    def match_info(self, source, target, **options):
        """What there is to know of a match besides its arrays: quality, candidates, seconds."""
        query = {'src': _id(source), 'tgt': _id(target), 'fields': '', 'wait': _LONGEST_WAIT, **options}
        return self._http.json('GET', '/match', query, extra_time=_LONGEST_WAIT)

    def symmetry(self, shape, hints=None, method=None, cache=None, candidate=None, refine=None, fields=None):
        """The intrinsic bilateral symmetry of a shape, a map to itself. `hints` are pairs of vertices that mirror each other."""
        return Match(meshes.load(self.symmetry_file(shape, 'npz', hints, method, cache, candidate, refine, fields)))

    def symmetry_file(self, shape, format, hints=None, method=None, cache=None, candidate=None, refine=None, fields=None):
        """The same as the bytes of a file: npz, npy, txt, map, ply, glb, obj, png or json."""
        query = {'format': format, 'hints': _hints(hints), 'method': method, 'cache': cache, 'candidate': candidate, 'refine': refine, 'fields': fields,
                 'wait': _LONGEST_WAIT}
        return self._http.request('GET', f'/shapes/{_id(shape)}/symmetry', query, extra_time=_LONGEST_WAIT)[2]

    def symmetry_info(self, shape, **options):
        """What there is to know of a symmetry besides its arrays: quality, with the distance by which it fails to undo itself."""
        query = {'fields': '', 'wait': _LONGEST_WAIT, **options}
        return self._http.json('GET', f'/shapes/{_id(shape)}/symmetry', query, extra_time=_LONGEST_WAIT)

    def match_points(self, source, target, points=None, landmarks=None, orientation=None, hints=None, method=None, refine=None):
        """The images of points, a list, or of landmarks, by name. A point is a vertex number, {'corners', 'bary'} or {'position'}."""
        body = {'src': _id(source), 'tgt': _id(target), 'points': points, 'landmarks': landmarks, 'orientation': orientation,
                'hints': hints, 'method': method, 'refine': refine}
        body = {name: value for name, value in body.items() if value is not None}
        answer = self._http.json('POST', '/match', {'wait': _LONGEST_WAIT}, body, extra_time=_LONGEST_WAIT)
        return answer['points'] if landmarks is None else answer['landmarks'] if points is None else answer

    def evaluate(self, source, target, truth=None, landmarks=None, mirrored=None, **options):
        """How good the match is, as a dict; docs/evaluation.md explains the figures. What is known: `truth`, 'identity' or one target
        vertex for each source vertex (-1 where unknown), or `landmarks`, two lists of vertices that belong together, with `mirrored`, the
        second list with left and right exchanged. Options are base, both, biharmonic, orientation, hints, method, refine,
        candidate."""
        return json.loads(self._evaluation('json', source, target, truth, landmarks, mirrored, options))

    def evaluation_picture(self, source, target, truth=None, landmarks=None, mirrored=None, **options):
        """The cumulative curves of evaluate(), as the bytes of an SVG file."""
        return self._evaluation('svg', source, target, truth, landmarks, mirrored, options)

    def _evaluation(self, format, source, target, truth, landmarks, mirrored, options):
        if landmarks is not None:
            truth = {'source': _indices(landmarks[0]), 'target': _indices(landmarks[1])}
            if mirrored is not None:
                truth['mirrored'] = _indices(mirrored)
        elif truth is not None and not isinstance(truth, str):
            truth = _indices(truth)
        body = json.dumps({'src': _id(source), 'tgt': _id(target), 'truth': truth, **options}).encode()
        return self._http.request('POST', '/evaluations', {'wait': _LONGEST_WAIT, 'format': format}, body, extra_time=_LONGEST_WAIT)[2]

    def transfer(self, source, target, values, interp=None, **options):
        """One row of `values` for each target vertex becomes one for each source vertex: skin weights, labels, colours, fields."""
        return meshes.load(self.transfer_file(source, target, values, 'npy', interp=interp, **options))

    def transfer_file(self, source, target, values, format, meaning=None, interp=None, **options):
        """The same as the bytes of a file: ply or glb, the source's mesh with what was carried, or png, a picture of both shapes.
        `meaning` says what the columns are: 'color', 'texture', 'label', 'value' or 'weights'."""
        query = {'src': _id(source), 'tgt': _id(target), 'interp': interp, 'format': format, 'as': meaning, 'wait': _LONGEST_WAIT, **options}
        if 'hints' in options:
            query['hints'] = _hints(options['hints'])
        return self._http.request('POST', '/transfer', query, meshes.npy_bytes(values), extra_time=_LONGEST_WAIT)[2]

    def carry(self, source, target, **options):
        """A copy of the mesh `source` with all that the mesh `target` has at its vertices, both of trimesh or of meshio: point data;
        or vertex attributes and vertex colours or texture coordinates. Uploads what the server lacks. Options are those of transfer()."""
        for mesh in (source, target):
            if not (interop.is_trimesh(mesh) or interop.is_meshio(mesh)):
                raise TypeError(f'{type(mesh).__name__} is no mesh of trimesh or meshio')
        shapes = self.upload(source), self.upload(target)
        return interop.carried(source, target, lambda values: self.transfer(*shapes, values, **options))

    def scene(self, source, target, **options):
        """Both meshes in corresponding colours, as the bytes of one GLB file."""
        query = {'src': _id(source), 'tgt': _id(target), 'wait': _LONGEST_WAIT, **options}
        return self._http.request('GET', '/scene', query, extra_time=_LONGEST_WAIT)[2]

    # Jobs

    def match_many(self, pairs, fields='vertex', both=False, orientation=None, method=None, refine=None):
        """Starts a job for up to 1000 pairs (source, target); read it with results()."""
        body = {'pairs': [[_id(source), _id(target)] for source, target in pairs], 'fields': fields, 'both': both}
        options = {'orientation': orientation, 'method': method, 'refine': refine}
        body.update({name: value for name, value in options.items() if value is not None})
        return Job(self._http.json('POST', '/match', body=body, idempotent=False))

    def results(self, job, after=0):
        """The lines of a job, as its pairs finish: {'index', 'src', 'tgt', 'match'} or with 'error' in place of 'match'. A lost connection
        is taken up where it was."""
        job_id = job if isinstance(job, str) else job.id
        while True:
            finished = not self.job(job_id).active  # before the lines are read, so that the last ones are not missed
            try:
                with self._http.open('GET', f'/jobs/{job_id}/results', {'after': after}, extra_time=_STREAM_PAUSE) as response:
                    for line in response.lines():
                        result = json.loads(line)
                        after += 1
                        yield result
            except (TransportError, ValueError):  # broken off, perhaps within a line
                time.sleep(0.2)
                continue
            if finished:
                return

    def job(self, job, wait=0):
        return Job(self._http.json('GET', '/jobs/' + (job if isinstance(job, str) else job.id), {'wait': wait}, extra_time=wait))

    def jobs(self, kind=None, state=None):
        query = {'limit': 200, 'kind': kind, 'state': state}
        while True:
            page = self._http.json('GET', '/jobs', query)
            yield from map(Job, page['items'])
            if not page['next_cursor']:
                return
            query['cursor'] = page['next_cursor']

    def cancel(self, job):
        """Cancels a job, or forgets one that has ended."""
        self._http.request('DELETE', '/jobs/' + (job if isinstance(job, str) else job.id), idempotent=False)

    # The server

    def health(self):
        return self._http.json('GET', '/healthz')

    def version(self):
        return self._http.json('GET', '/version')
