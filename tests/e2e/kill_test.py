"""A server that is killed at random moments under load loses nothing it acknowledged, and makes nothing twice."""
import contextlib
import http.client
import random
import signal
import sqlite3
import tempfile
import threading
import time
import unittest

import support

KILLS = 20
MOST_UPLOADS = 60
SECONDS_BETWEEN_KILLS = 1.2


class Clients:
    """Several clients of one server at a time. What they were told outlives it."""

    def __init__(self):
        self.lock = threading.Lock()
        self.random = random.Random(5)
        self.body_of = {}  # id -> bytes, of acknowledged uploads
        self.kept = set()  # acknowledged, and nobody has tried to remove it
        self.removed = set()  # acknowledged removals
        self.unclear = set()  # a removal was sent, but no answer came
        self.sent = 0
        self.refused = []
        self.maps = set()
        self.pair = None

    def run(self, server):
        """Works until the server is gone."""
        self.server = server
        self.claimed = set(self.pair)  # shapes that nobody else may repost or remove now
        threads = [threading.Thread(target=self.repeat, args=(work,))
                   for work in (self.upload, self.upload, self.upload, self.repost, self.match, self.remove)]
        for thread in threads:
            thread.start()
        return threads

    def repeat(self, work):
        # A cut connection is no answer; an answer that was cut is none either.
        with contextlib.suppress(OSError, http.client.HTTPException):
            while self.server.process.poll() is None:
                if not work():
                    time.sleep(0.02)

    def expect(self, response, *statuses):
        if response.status not in statuses + (503,):
            self.refused.append((response.status, response.body[:300]))
        return response.status in statuses

    def upload(self):
        with self.lock:
            if self.sent >= MOST_UPLOADS or len(self.kept) > 25:
                return False
            self.sent += 1
            number, wait = self.sent, self.random.choice((0, 0, 2))
        body = support.off(support.bumpy(3, 0.01 * number))
        response = self.server.post(body, name=f'n{number}', wait=wait)
        if self.expect(response, 201, 202):
            with self.lock:
                self.body_of[response.json()['id']] = body
                self.kept.add(response.json()['id'])
        return True

    def claim(self, at_least):
        with self.lock:
            candidates = sorted(self.kept - self.claimed)
            if len(candidates) < at_least:
                return None
            shape_id = self.random.choice(candidates)
            self.claimed.add(shape_id)
            return shape_id

    def repost(self):
        shape_id = self.claim(at_least=1)
        if not shape_id:
            return False
        response = self.server.post(self.body_of[shape_id])
        if self.expect(response, 200) and response.json()['id'] != shape_id:
            self.refused.append(('another id', shape_id, response.json()['id']))
        self.claimed.discard(shape_id)
        time.sleep(0.05)
        return True

    def match(self):
        response = self.server.get('/match', src=self.pair[0], tgt=self.pair[1], format='npz', cache='no')
        if self.expect(response, 200):
            self.maps.add(response.body)
        return True

    def remove(self):
        time.sleep(0.4)
        shape_id = self.claim(at_least=14)
        if not shape_id:
            return False
        self.kept.discard(shape_id)
        self.unclear.add(shape_id)
        if self.expect(self.server.request('DELETE', '/shapes/' + shape_id), 204):
            self.unclear.discard(shape_id)
            self.removed.add(shape_id)
        return True


class KillTest(support.TestCase):
    def check(self, clients, server, store):
        """What the clients were told is what the server has."""
        shapes = server.all_shapes()
        ids = [shape['id'] for shape in shapes]
        self.assertEqual(len(ids), len(set(ids)), 'a shape is listed twice')
        self.assertEqual(len(shapes), len({shape['sha256'] for shape in shapes}), 'an upload is stored twice')
        self.assertEqual(clients.kept - set(ids), set(), 'an acknowledged upload is gone')
        self.assertEqual(clients.removed & set(ids), set(), 'an acknowledged removal came back')
        self.assertEqual([shape for shape in shapes if shape['state'] == 'failed'], [])
        self.assertEqual(clients.refused, [])
        with contextlib.closing(sqlite3.connect(store)) as database:
            self.assertEqual(database.execute('PRAGMA integrity_check').fetchall(), [('ok',)])
            self.assertEqual(database.execute('PRAGMA foreign_key_check').fetchall(), [])

    def test_twenty_kills_under_uploads_matches_and_removals(self):
        with tempfile.TemporaryDirectory(prefix='spherematch-e2e-') as place:
            self.kill_and_check(place + '/s.db')

    def kill_and_check(self, store):
        clients = Clients()
        server = self.serve(store)
        for seed in (2.0, 3.0):
            body = support.off(support.bumpy(2, seed))
            clients.body_of[server.ready(body)] = body
        clients.pair = tuple(clients.body_of)
        clients.kept.update(clients.pair)
        clients.server = server
        clients.match()
        states_at_kill = []
        for _ in range(KILLS):
            threads = clients.run(server)
            time.sleep(random.uniform(0, SECONDS_BETWEEN_KILLS))
            self.assertIsNone(server.process.poll(), 'the server ended by itself')
            states_at_kill.append(bool(server.preparations()))
            self.assertEqual(server.stop(signal.SIGKILL), -signal.SIGKILL)
            for thread in threads:
                thread.join()
            server = self.serve(store)
            self.check(clients, server, store)
        for shape in server.all_shapes():
            self.assertEqual(server.finished(shape['id'])['state'], 'ready')
        clients.server = server
        clients.match()
        self.check(clients, server, store)
        self.assertEqual(len(clients.maps), 1, 'matches differ')
        # The test was worth something.
        self.assertGreater(sum(states_at_kill), 5)
        self.assertGreater(len(clients.removed), 5)
        self.assertGreater(len(clients.kept), 5)
        print(f'\n{clients.sent} uploads sent, {len(clients.kept)} kept, {len(clients.removed)} removed, {len(clients.unclear)} unclear; '
              f'a preparation under way at {sum(states_at_kill)} of {KILLS} kills')
        self.assertEqual(server.stop(), 0)


if __name__ == '__main__':
    unittest.main()
