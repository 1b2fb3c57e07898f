"""Uploads, listing, errors and limits through a real server."""
import gzip
import json
import re
import socket
import threading
import time
import unittest

import support

A = support.off(support.bumpy(2))


class ServerTest(support.TestCase):
    @classmethod
    def setUpClass(cls):
        import tempfile
        cls.temporary = tempfile.TemporaryDirectory(prefix='spherematch-e2e-')
        cls.server = support.Server(cls.temporary.name + '/store/s.db', '--max-body-mib', '1', '--max-vertices', '3000')

    @classmethod
    def tearDownClass(cls):
        code = cls.server.stop()
        cls.temporary.cleanup()
        assert code == 0, code

    def test_upload_wait_and_again(self):
        mesh = support.bumpy(2, 0.3)
        body = support.off(mesh)
        first = self.server.post(body, name='first', wait=60)
        self.assertEqual(first.status, 201, first.body)
        shape = first.json()
        self.assertEqual(first.headers['Location'], '/shapes/' + shape['id'])
        self.assertEqual((shape['state'], shape['name'], shape['progress']), ('ready', 'first', 1))
        self.assertEqual((shape['vertices'], shape['faces']), (len(mesh[0]), len(mesh[1])))
        self.assertEqual(shape['sphere']['flipped'], 0)
        self.assertGreater(shape['seconds']['total'], 0)
        self.assertIsNone(shape['error'])
        again = self.server.post(body, name='second', wait=60)
        self.assertEqual((again.status, again.json()), (200, shape))
        # The form content type is what `curl --data-binary` sends.
        form = self.server.post(body, headers={'Content-Type': 'application/x-www-form-urlencoded'})
        self.assertEqual((form.status, form.json()), (200, shape))
        boundary = 'xYzZy'
        multipart = (f'--{boundary}\r\nContent-Disposition: form-data; name="file"; filename="a.off"\r\n\r\n'.encode() + body +
                     f'\r\n--{boundary}--\r\n'.encode())
        sent = self.server.post(multipart, headers={'Content-Type': f'multipart/form-data; boundary={boundary}'})
        self.assertEqual((sent.status, sent.json()), (200, shape))
        self.assertEqual(self.server.get('/shapes/' + shape['id']).json(), shape)

    def test_simplify(self):
        body = support.off(support.bumpy(4))
        whole = self.server.post(body, wait=60).json()
        coarse = self.server.post(body, wait=60, simplify=600).json()
        self.assertNotEqual(whole['id'], coarse['id'])
        self.assertEqual((whole['simplified'], coarse['simplified']), (None, 600))
        self.assertEqual((coarse['state'], coarse['vertices'], coarse['sphere']['flipped']), ('ready', 2562, 0))
        self.assertIn('simplify', coarse['seconds'])
        self.assertNotIn('simplify', whole['seconds'])
        sphere = support.read_npy(self.server.get(f"/shapes/{coarse['id']}/sphere").body)[1]
        self.assertEqual((len(sphere), len(sphere[0])), (2562, 3))
        found = support.read_npz(self.server.get('/match', src=coarse['id'], tgt=whole['id'], format='npz').body)
        # Of 2562 vertices most find themselves, though a quarter of them were matched.
        self.assertGreater(sum(v == i for i, v in enumerate(found['vertex'][1])), 1200)
        self.assert_problem(self.server.post(body, simplify=499), 400, 'invalid-parameter')

    def test_concurrent_uploads_compute_once(self):
        body = support.off(support.bumpy(2, 0.7))
        responses = []
        threads = [threading.Thread(target=lambda: responses.append(self.server.post(body, wait=60))) for _ in range(16)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual({r.json()['state'] for r in responses}, {'ready'})
        self.assertEqual(sorted(r.status for r in responses), [200] * 15 + [201])
        self.assertEqual(len({json.dumps(r.json()) for r in responses}), 1)
        started = [line for line in self.server.log if 'job_started' in line and responses[0].json()['id'] in line]
        self.assertEqual(len(started), 1, started)

    def test_the_queue_of_preparations_is_bounded(self):
        server = self.serve(self.directory() + '/s.db', '--max-queued-jobs', '2')
        running = server.post(support.off(support.bumpy(5))).json()['id']
        deadline = time.monotonic() + 20
        while server.get('/healthz').json()['jobs_processing'] != 1 and time.monotonic() < deadline:
            time.sleep(0.01)
        queued = [support.off(support.bumpy(1, 0.1 * i)) for i in range(3)]
        self.assertEqual([server.post(body).status for body in queued[:2]], [202, 202])
        refused = server.post(queued[2], wait=1)
        problem = self.assert_problem(refused, 503, 'overloaded')
        self.assertIs(problem['retryable'], True)
        self.assertGreater(int(refused.headers['Retry-After']), 0)
        self.assertEqual(server.post(queued[1]).status, 200)  # a known one needs no place
        self.assertEqual(len(server.get('/shapes').json()['items']), 3)
        # All at once are not let in either, but for those that were asked while there was room.
        statuses = []
        self.assertEqual(server.request('DELETE', '/shapes/' + server.get('/shapes').json()['items'][0]['id']).status, 204)
        threads = [threading.Thread(target=lambda i=i: statuses.append(server.post(support.off(support.bumpy(1, 3 + i))).status))
                   for i in range(12)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertLessEqual(set(statuses), {202, 503})
        self.assertLessEqual(1, statuses.count(202))
        self.assertLessEqual(statuses.count(202), 4)  # --concurrent-uploads
        self.assertEqual(server.request('DELETE', '/shapes/' + running).status, 204)
        self.assertEqual(server.finished(server.get('/shapes').json()['items'][0]['id'])['state'], 'ready')
        self.assertEqual(server.stop(), 0)

    def test_progress_is_visible_and_never_falls(self):
        shape = self.server.post(support.off(support.bumpy(4, 0.5))).json()
        self.assertIn(shape['state'], ('queued', 'processing'))
        seen, states = [], []
        while shape['state'] in ('queued', 'processing'):
            if not seen or seen[-1] != (shape['stage'], shape['progress']):
                seen.append((shape['stage'], shape['progress']))
            states.append(shape['state'])
            time.sleep(0.02)
            shape = self.server.get('/shapes/' + shape['id']).json()
        self.assertEqual(shape['state'], 'ready', shape)
        progress = [p for _, p in seen]
        self.assertEqual(progress, sorted(progress))
        self.assertEqual(states, sorted(states, reverse=True))  # queued, then processing
        self.assertGreaterEqual(len({stage for stage, _ in seen if stage}), 2, seen)
        self.assertGreaterEqual(len(set(progress)), 3, seen)

    def test_unusable_meshes_say_why_and_are_not_stored(self):
        before = self.server.get('/shapes', limit=200).json()['items']
        vertices, faces = support.bumpy(2)
        self.assertIn('detail', self.assert_problem(self.server.post(support.off(support.torus())), 422, 'wrong-genus'))
        open_mesh = self.server.post(support.off((vertices, faces[:-1])), repair='none')
        self.assertTrue(self.assert_problem(open_mesh, 422, 'not-closed')['elements'])
        two = (vertices + [(x + 9, y, z) for x, y, z in vertices], faces + [tuple(i + len(vertices) for i in f) for f in faces])
        self.assert_problem(self.server.post(support.off(two), repair='none'), 422, 'disconnected')
        turned = [(a, c, b) if i == 0 else (a, b, c) for i, (a, b, c) in enumerate(faces)]
        self.assert_problem(self.server.post(support.off((vertices, turned)), repair='none'), 422, 'inconsistent-orientation')
        joined = (two[0], faces + [tuple(i + len(vertices) if i else 0 for i in f) for f in faces])  # at vertex 0 only
        self.assert_problem(self.server.post(support.off(joined), repair='none'), 422, 'non-manifold')
        self.assert_problem(self.server.post(support.off(([(0, 0, 0)] * len(vertices), faces))), 422, 'degenerate')
        self.assert_problem(self.server.post(support.off(support.icosphere(5))), 422, 'too-many-vertices')
        self.assert_problem(self.server.post(b'OFF\n3 1 0\n0 0 0\n1 0 0\n'), 400, 'malformed-mesh')
        self.assert_problem(self.server.post(b'OFF\n99999999 99999999 0\n'), 400, 'malformed-mesh')
        self.assert_problem(self.server.post(bytes(range(256))), 415, 'unsupported-format')
        after = self.server.get('/shapes', limit=200).json()['items']
        self.assertEqual([s['id'] for s in after if s['id'] not in {b['id'] for b in before}], [])

    def test_errors_of_paths_methods_and_parameters(self):
        request = self.server.request
        self.assert_problem(request('GET', '/nowhere'), 404, 'not-found')
        self.assert_problem(request('GET', '/shapes/' + '0' * 32), 404, 'not-found')
        self.assert_problem(request('DELETE', '/shapes/' + '0' * 32), 404, 'not-found')
        wrong = request('PUT', '/shapes', body=b'x')
        self.assert_problem(wrong, 405, 'method-not-allowed')
        self.assertEqual(wrong.headers['Allow'], 'POST, GET, HEAD')
        self.assert_problem(request('POST', '/healthz', body=b'x'), 405, 'method-not-allowed')
        self.assert_problem(self.server.post(A, wait=61), 400, 'invalid-parameter')
        unknown = self.assert_problem(self.server.post(A, colour='red'), 400, 'invalid-parameter')
        self.assertIn('name, repair, simplify, wait', unknown['detail'])
        self.assert_problem(self.server.get('/shapes', cursor='bogus'), 400, 'invalid-parameter')

    def test_bodies_that_are_refused(self):
        chunked = self.server.request('POST', '/shapes', body=iter([A]), headers={'Transfer-Encoding': 'chunked'})
        self.assert_problem(chunked, 411, 'length-required')
        encoded = self.server.post(A, headers={'Content-Encoding': 'gzip'})
        self.assert_problem(encoded, 415, 'content-encoding')
        large = self.assert_problem(self.server.post(b'x' * (3 << 20)), 413, 'payload-too-large')
        self.assertEqual((large['limit'], large['actual']), (1 << 20, 3 << 20))
        mixed = self.server.post(A, headers={'Content-Type': 'multipart/mixed; boundary=x'})
        self.assert_problem(mixed, 415, 'unsupported-media-type')

    def test_listing_and_deleting(self):
        ids = [self.server.ready(support.off(support.bumpy(1, 0.1 * i)), name=f'n{i}') for i in range(3)]
        page = self.server.get('/shapes', limit=2).json()
        self.assertEqual(len(page['items']), 2)
        seen = [s['id'] for s in page['items']]
        while page['next_cursor']:
            page = self.server.get('/shapes', limit=2, cursor=page['next_cursor']).json()
            seen += [s['id'] for s in page['items']]
        self.assertEqual(len(seen), len(set(seen)))
        self.assertTrue(set(ids) <= set(seen))
        self.assertEqual(self.server.request('DELETE', '/shapes/' + ids[0]).status, 204)
        self.assert_problem(self.server.get('/shapes/' + ids[0]), 404, 'not-found')
        self.assert_problem(self.server.get('/match', src=ids[0], tgt=ids[1]), 404, 'not-found')
        self.assert_problem(self.server.request('DELETE', '/shapes/' + ids[0]), 404, 'not-found')
        # The bytes are forgotten as well: the same upload is new.
        self.assertEqual(self.server.post(support.off(support.bumpy(1, 0.0)), wait=60).status, 201)

    def test_system_routes(self):
        self.assertEqual(self.server.get('/healthz').json()['status'], 'ok')
        version = self.server.get('/version').json()
        self.assertEqual(version['limits']['body_bytes'], 1 << 20)
        self.assertEqual(version['limits']['vertices'], 3000)
        self.assertTrue(version['engine'])

    def test_page_comes_compressed_once(self):
        document = self.server.get('/').body.decode()
        self.assertIn('href="/docs"', document)
        script = re.search(r'/page/page\.js\?v=[0-9a-f]+', document).group()
        plain = self.server.get(script)
        packed = self.server.get(script, headers={'Accept-Encoding': 'gzip, br'})
        self.assertEqual(packed.headers['Content-Encoding'], 'gzip')
        self.assertEqual(int(packed.headers['Content-Length']), len(packed.body))
        self.assertEqual(gzip.decompress(packed.body), plain.body)
        self.assertIn('immutable', packed.headers['Cache-Control'])
        self.assertEqual(self.server.request('HEAD', script, headers={'Accept-Encoding': 'gzip'}).body, b'')
        head = self.server.request('HEAD', '/version')
        self.assertEqual((head.status, head.body), (200, b''))
        self.assertGreater(int(head.headers['Content-Length']), 0)
        self.assertEqual(self.server.get('/healthz', headers={'X-Request-Id': 'me-1'}).headers['X-Request-Id'], 'me-1')

    def test_health_answers_beside_idle_connections(self):
        idle = [socket.create_connection(('127.0.0.1', self.server.port)) for _ in range(10)]
        start = time.monotonic()
        self.assertEqual(self.server.get('/healthz').status, 200)
        self.assertLess(time.monotonic() - start, 5)
        for connection in idle:
            connection.close()


if __name__ == '__main__':
    unittest.main()
