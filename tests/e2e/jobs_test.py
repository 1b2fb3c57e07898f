"""Many pairs through one job: streamed as they finish, across a kill of the server, nothing computed twice.

SPHEREMATCH_JOB_PAIRS sets the number of pairs (at most 1000), for a measurement beyond what a test should take."""
import json
import os
import re
import signal
import threading
import time
import unittest

import support

PAIRS = int(os.environ.get('SPHEREMATCH_JOB_PAIRS', '40'))


class JobsTest(support.TestCase):
    def shapes(self, server, count):
        return [server.ready(support.off(support.bumpy(2, seed / count))) for seed in range(count)]

    def pairs(self, server):
        side = 2
        while side * side < PAIRS:
            side += 1
        ids = self.shapes(server, side)
        return [[a, b] for a in ids for b in ids][:PAIRS]

    def create(self, server, body):
        response = server.request('POST', '/match', json.dumps(body).encode())
        self.assertEqual(response.status, 202, response.body)
        self.assertEqual(response.headers['Location'], '/jobs/' + response.json()['id'])
        return response.json()['id']

    def lines(self, server, job, after=0):
        body = server.get(f'/jobs/{job}/results?after={after}').body
        return [json.loads(line) for line in body.decode().splitlines()]

    def test_a_job_survives_a_kill_and_computes_nothing_twice(self):
        place = self.directory()
        server = first = self.serve(place + '/s.db')
        pairs = self.pairs(server)
        job = self.create(server, {'pairs': pairs, 'fields': 'vertex'})

        seen = []
        with server.stream(f'/jobs/{job}/results') as stream:
            while len(seen) < PAIRS // 2:
                seen.append(json.loads(stream.readline()))
            state = server.get('/jobs/' + job).json()
            self.assertEqual(state['state'], 'processing')
            self.assertGreaterEqual(state['pairs']['succeeded'], len(seen))
            server.stop(signal.SIGKILL)

        server = self.serve(place + '/s.db')
        rest = self.lines(server, job, after=len(seen))  # until the end of the job
        self.assertEqual(sorted(line['index'] for line in seen + rest), list(range(PAIRS)))
        for line in seen + rest:
            self.assertEqual([line['src'], line['tgt']], pairs[line['index']])
            self.assertEqual(len(line['match']['vertex']), line['match']['n_src'])
        self.assertEqual(server.get('/jobs/' + job).json()['state'], 'succeeded')

        computed = re.findall(r'event=match_computed src=(\w+) tgt=(\w+)', ''.join(first.log + server.log))
        self.assertEqual(len(computed), len(set(computed)), 'a pair was computed twice')
        self.assertLessEqual(len(computed), PAIRS)
        self.assertGreaterEqual(len(computed), PAIRS - 2)  # those that were kept just before the kill were not logged

        # The same bytes as one by one.
        line = rest[-1]
        alone = server.get(f'/match?src={line["src"]}&tgt={line["tgt"]}').json()
        self.assertTrue(alone['cached'])
        self.assertEqual({k: v for k, v in alone.items() if k != 'cached'}, {k: v for k, v in line['match'].items() if k != 'cached'})

    def test_others_do_not_wait_behind_a_job(self):
        server = self.serve(self.directory() + '/s.db')
        ids = self.shapes(server, 4)
        one, other = (server.ready(support.off(support.bumpy(2, seed))) for seed in (2.0, 3.0))
        job = self.create(server, {'pairs': [[a, b] for a in ids for b in ids]})
        answers = []
        clients = [threading.Thread(target=lambda pair=pair: answers.append(server.get('/match?src=%s&tgt=%s' % pair)))
                   for pair in ((one, other), (other, one))]
        for client in clients:
            client.start()
        for client in clients:
            client.join()
        self.assertEqual([answer.status for answer in answers], [200, 200])
        self.assertNotEqual(server.get('/jobs/' + job).json()['state'], 'succeeded')
        self.assertEqual(server.request('DELETE', '/jobs/' + job).status, 202)
        self.assertEqual(server.get('/jobs/' + job).json()['state'], 'cancelled')

    def test_a_client_that_leaves_does_not_hold_the_server(self):
        server = self.serve(self.directory() + '/s.db')
        ids = self.shapes(server, 2)
        job = self.create(server, {'pairs': [ids, ids[::-1]]})
        for _ in range(40):  # more than there are places for streams
            with server.stream(f'/jobs/{job}/results'):
                pass
        deadline = time.monotonic() + 20
        while server.get(f'/jobs/{job}/results').status == 503 and time.monotonic() < deadline:
            time.sleep(0.1)
        self.assertEqual(len(self.lines(server, job)), 2)


if __name__ == '__main__':
    unittest.main()
