"""What the end-to-end tests share: meshes, a server process, requests, and readers of the result formats."""
import contextlib
import http.client
import io
import json
import math
import os
import queue
import re
import signal
import struct
import subprocess
import tempfile
import threading
import time
import unittest
import urllib.parse
import zipfile

SERVER = os.environ['SPHEREMATCH_SERVER']
CLI = os.environ['SPHEREMATCH_CLI']


# Meshes

def icosphere(level):
    g = (1 + math.sqrt(5)) / 2
    vertices = [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g), (0, 1, -g),
                (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6),
             (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10),
             (8, 6, 7), (9, 8, 1)]

    def unit(p):
        length = math.sqrt(sum(x * x for x in p))
        return tuple(x / length for x in p)

    vertices = [unit(p) for p in vertices]
    for _ in range(level):
        middles = {}

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                middles[key] = len(vertices)
                vertices.append(unit(tuple((x + y) / 2 for x, y in zip(vertices[a], vertices[b]))))
            return middles[key]

        finer = []
        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        faces = finer
    return vertices, faces


def bumpy(level, seed=0.0):
    """An ellipsoid with bumps, without symmetry, so that a map between two of them is well defined."""
    vertices, faces = icosphere(level)
    bumps = [((0.6, 0.64, 0.48), 0.5 + 0.2 * seed), ((-0.8, 0.0, 0.6), 0.3), ((0.0, -0.28, -0.96), 0.4 - 0.1 * seed)]

    def place(p):
        r = 1 + sum(h * math.exp(-4 * sum((x - y) ** 2 for x, y in zip(p, c))) for c, h in bumps)
        return (1.0 * r * p[0], 1.3 * r * p[1], (1.7 + 0.1 * seed) * r * p[2])

    return [place(p) for p in vertices], faces


def torus(n=24, m=12):
    vertices = [((2 + math.cos(2 * math.pi * j / m)) * math.cos(2 * math.pi * i / n),
                 (2 + math.cos(2 * math.pi * j / m)) * math.sin(2 * math.pi * i / n), math.sin(2 * math.pi * j / m))
                for i in range(n) for j in range(m)]
    faces = []
    for i in range(n):
        for j in range(m):
            a, b, c, d = i * m + j, (i + 1) % n * m + j, (i + 1) % n * m + (j + 1) % m, i * m + (j + 1) % m
            faces += [(a, b, c), (a, c, d)]
    return vertices, faces


def off(mesh):
    vertices, faces = mesh
    lines = ['OFF', f'{len(vertices)} {len(faces)} 0']
    lines += ['%.17g %.17g %.17g' % p for p in vertices] + ['%d %s' % (len(f), ' '.join(map(str, f))) for f in faces]
    return ('\n'.join(lines) + '\n').encode()


# Results

def read_npy(data):
    """A list of numbers or of rows."""
    assert data[:6] == b'\x93NUMPY' and data[6] == 1, data[:8]
    size = struct.unpack('<H', data[8:10])[0]
    header = data[10:10 + size].decode()
    kind = re.search(r"'descr': '([^']+)'", header).group(1)
    shape = tuple(int(x) for x in re.search(r"'shape': \(([^)]*)\)", header).group(1).split(',') if x.strip())
    assert "'fortran_order': False" in header, header
    code = {'<i4': 'i', '<f4': 'f', '<f8': 'd'}[kind]
    count = math.prod(shape)
    values = struct.unpack(f'<{count}{code}', data[10 + size:])
    if len(shape) == 1:
        return kind, list(values)
    return kind, [list(values[i * shape[1]:(i + 1) * shape[1]]) for i in range(shape[0])]


def read_npz(data):
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        return {name.removesuffix('.npy'): read_npy(archive.read(name)) for name in archive.namelist()}


# The server

class Response:
    def __init__(self, status, headers, body):
        self.status, self.headers, self.body = status, headers, body

    def json(self):
        return json.loads(self.body)


class Server:
    """A running server on a free port; `stop` ends it and returns its exit code."""

    def __init__(self, store, *flags):
        self.process = subprocess.Popen([SERVER, '--port', '0', '--store', store, *flags], stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True)
        self.log = []
        self.reader = threading.Thread(target=lambda: self.log.extend(self.process.stderr), daemon=True)
        self.reader.start()
        lines = queue.Queue()
        threading.Thread(target=lambda: lines.put(self.process.stdout.readline()), daemon=True).start()
        line = lines.get(timeout=20)
        match = re.fullmatch(r'listening on http://127\.0\.0\.1:(\d+)\n', line)
        if not match:
            self.process.kill()
            raise AssertionError(f'first line: {line!r}')
        self.port = int(match.group(1))

    def request(self, method, path, body=None, headers=None, query=None, timeout=120):
        if query:
            path += '?' + urllib.parse.urlencode(query)
        connection = http.client.HTTPConnection('127.0.0.1', self.port, timeout=timeout)
        try:
            connection.request(method, path, body=body, headers=headers or {})
            response = connection.getresponse()
            return Response(response.status, response.headers, response.read())
        finally:
            connection.close()

    @contextlib.contextmanager
    def stream(self, path, timeout=120):
        """The response, to be read as it comes."""
        connection = http.client.HTTPConnection('127.0.0.1', self.port, timeout=timeout)
        try:
            connection.request('GET', path)
            yield connection.getresponse()
        finally:
            connection.close()

    def get(self, path, headers=None, **query):
        return self.request('GET', path, headers=headers, query=query)

    def post(self, body, headers=None, **query):
        return self.request('POST', '/shapes', body=body, headers=headers, query=query)

    def ready(self, body, **query):
        """Uploads, waits, returns the id."""
        shape = self.finished(self.post(body, wait=60, **query).json()['id'])
        assert shape['state'] == 'ready', shape
        return shape['id']

    def finished(self, shape_id):
        """Waits; returns the shape."""
        deadline = time.monotonic() + 120
        shape = self.get('/shapes/' + shape_id).json()
        while shape['state'] in ('queued', 'processing') and time.monotonic() < deadline:
            time.sleep(0.1)
            shape = self.get('/shapes/' + shape_id).json()
        return shape

    def all_shapes(self):
        page = self.get('/shapes', limit=200).json()
        shapes = page['items']
        while page['next_cursor']:
            page = self.get('/shapes', limit=200, cursor=page['next_cursor']).json()
            shapes += page['items']
        return shapes

    def preparations(self):
        """The ids of the processes in which the server prepares shapes now."""
        with open(f'/proc/{self.process.pid}/task/{self.process.pid}/children') as file:
            children = file.read().split()
        for task in os.listdir(f'/proc/{self.process.pid}/task'):
            with contextlib.suppress(OSError), open(f'/proc/{self.process.pid}/task/{task}/children') as file:
                children += file.read().split()
        return sorted(set(map(int, children)))

    def stop(self, how=signal.SIGTERM):
        if self.process.poll() is None:
            self.process.send_signal(how)
        code = self.process.wait(timeout=30)
        self.reader.join(timeout=10)
        self.process.stdout.close()
        self.process.stderr.close()
        return code


class TestCase(unittest.TestCase):
    def directory(self):
        directory = tempfile.TemporaryDirectory(prefix='spherematch-e2e-')
        self.addCleanup(directory.cleanup)
        return directory.name

    def serve(self, store, *flags):
        server = Server(store, *flags)
        self.addCleanup(lambda: server.process.returncode is None and server.stop(signal.SIGKILL))
        return server

    def assert_problem(self, response, status, code):
        self.assertEqual(response.status, status, response.body[:500])
        self.assertEqual(response.headers['Content-Type'], 'application/problem+json')
        problem = response.json()
        self.assertEqual(problem['code'], code, problem)
        self.assertEqual(problem['status'], status)
        self.assertEqual(problem['type'], '/problems/' + code)
        self.assertEqual(problem['request_id'], response.headers['X-Request-Id'])
        self.assertLessEqual(len(problem['elements']), 20)
        return problem
