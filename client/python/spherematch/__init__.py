# SPDX-License-Identifier: MIT
"""Dense correspondence between genus-zero surfaces, from a Spherematch server.

    import spherematch

    client = spherematch.Client('http://127.0.0.1:8080')
    source = client.upload('left.obj')                   # a file, bytes, a mesh of trimesh or meshio, or (vertices, faces)
    target = client.upload((vertices, faces), name='right')
    result = client.match(source, target)
    result.vertex                                        # for each source vertex the nearest target vertex, -1 where dropped
    result.points(vertices)                              # the images as points in space
    client.transfer(source, target, skin_weights)        # one row for each target vertex -> one for each source vertex

Needs Python 3.8 and numpy. A Client keeps no connection and may be shared by threads.
"""
from .client import Client, Job, Match, Shape
from .errors import Error, JobFailed, ProblemError, TransportError

__all__ = ['Client', 'Error', 'Job', 'JobFailed', 'Match', 'ProblemError', 'Shape', 'TransportError']
__version__ = '0.1.0'
