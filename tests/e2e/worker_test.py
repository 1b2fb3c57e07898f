"""Preparations run in processes of their own: what becomes of a shape, and of the server, when one of these dies."""
import os
import random
import resource
import signal
import time
import unittest

import support

SLOW = support.off(support.bumpy(6))
MEDIUM = support.off(support.bumpy(4))


def is_alive(pid):
    try:
        with open(f'/proc/{pid}/stat') as file:
            return file.read().rsplit(')', 1)[1].split()[0] not in 'ZX'
    except OSError:
        return False


def wait_until(condition, seconds=20, what=''):
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        result = condition()
        if result:
            return result
        time.sleep(0.002)
    raise AssertionError(f'not within {seconds} s: {what}')


class WorkerTest(support.TestCase):
    def setUp(self):
        self.store = self.directory() + '/s.db'
        self.server = self.serve(self.store)

    def next_preparation(self, other_than=None):
        """Waits for a process that has begun to compute, so that it is past its start."""
        def begun():
            pids = [pid for pid in self.server.preparations() if pid != other_than]
            started = [line for line in self.server.log if 'stage_started' in line]
            return pids and started and pids[0]
        return wait_until(begun, what='a preparation')

    def lose(self, shape_id, times, end):
        """Ends the preparation so often; checks that nothing of it is seen to go back."""
        pid, progress = None, 0
        for _ in range(times):
            pid = self.next_preparation(other_than=pid)
            time.sleep(0.05)
            shape = self.server.get('/shapes/' + shape_id).json()
            self.assertEqual(shape['state'], 'processing')
            self.assertGreaterEqual(shape['progress'], progress)
            progress = shape['progress']
            end(pid)
            wait_until(lambda pid=pid: not is_alive(pid), what='the end of a preparation')

    def test_a_crash_costs_an_attempt_and_not_the_server(self):
        shape_id = self.server.post(MEDIUM).json()['id']
        self.lose(shape_id, 2, lambda pid: os.kill(pid, signal.SIGSEGV))
        self.assertEqual(self.server.finished(shape_id)['state'], 'ready')
        self.assertEqual(len([line for line in self.server.log if 'signal 11' in line]), 2)

    def test_a_third_crash_is_a_failure_with_its_reason(self):
        shape_id = self.server.post(MEDIUM).json()['id']
        self.lose(shape_id, 3, lambda pid: os.kill(pid, signal.SIGABRT))
        shape = self.server.finished(shape_id)
        self.assertEqual((shape['state'], shape['error']['code']), ('failed', 'internal'))
        self.assertIn('signal 6 (Aborted)', shape['error']['detail'])
        small = self.server.ready(support.off(support.bumpy(1)))
        self.assert_problem(self.server.get('/match', src=small, tgt=shape_id), 422, 'shape-failed')
        # Still so after a restart, and an upload tries again.
        self.server.stop(signal.SIGKILL)
        self.server = self.serve(self.store)
        self.assertEqual(self.server.get('/shapes/' + shape_id).json()['state'], 'failed')
        self.assertEqual(self.server.post(MEDIUM, wait=60).status, 201)

    def test_want_of_memory_is_an_error_of_the_preparation(self):
        shape_id = self.server.post(SLOW).json()['id']
        scores = []

        def starve(pid):
            with open(f'/proc/{pid}/oom_score_adj') as file:
                scores.append(file.read().strip())
            self.assertLess(resource.prlimit(pid, resource.RLIMIT_DATA)[0], 1 << 50)  # it limits itself to what there is
            resource.prlimit(pid, resource.RLIMIT_DATA, (1 << 20, 1 << 20))

        self.lose(shape_id, 3, starve)
        shape = self.server.finished(shape_id)
        self.assertEqual(shape['state'], 'failed')
        self.assertIn('not enough memory', shape['error']['detail'])
        self.assertEqual(scores, ['1000'] * 3)

    def test_a_shape_that_crashes_does_not_hold_up_the_others(self):
        bad = self.server.post(MEDIUM).json()['id']
        pid = self.next_preparation()
        good = self.server.post(support.off(support.bumpy(2))).json()['id']
        os.kill(pid, signal.SIGKILL)
        self.assertEqual(self.server.finished(good)['state'], 'ready')
        self.assertNotEqual(self.server.get('/shapes/' + bad).json()['state'], 'ready')
        self.assertEqual(self.server.finished(bad)['state'], 'ready')

    def test_preparations_end_with_their_server(self):
        self.server.post(SLOW)
        for how in (signal.SIGKILL, signal.SIGTERM):
            pid = wait_until(self.server.preparations, what='a preparation')[0]
            self.server.stop(how)
            wait_until(lambda pid=pid: not is_alive(pid), 3, 'the end of the orphan')
            self.server = self.serve(self.store)

    def test_twenty_kills_do_not_fail_a_healthy_shape(self):
        shape_id = self.server.post(MEDIUM).json()['id']
        for _ in range(20):
            wait_until(self.server.preparations, what='a preparation')
            time.sleep(random.uniform(0, 0.2))
            self.server.stop(signal.SIGKILL)
            self.server = self.serve(self.store)
        self.assertEqual(self.server.finished(shape_id)['state'], 'ready')

    def test_deleting_frees_the_worker_at_once(self):
        worst = 0
        for i in range(20):
            shape_id = self.server.post(SLOW).json()['id']
            pid = wait_until(self.server.preparations, what='a preparation')[0]
            time.sleep(random.uniform(0, 0.6))
            self.assertEqual(self.server.get('/shapes/' + shape_id).json()['state'], 'processing')
            start = time.monotonic()
            self.assertEqual(self.server.request('DELETE', '/shapes/' + shape_id).status, 204)
            wait_until(lambda: not self.server.get('/healthz').json()['jobs_processing'], what='a free worker')
            worst = max(worst, time.monotonic() - start)
            self.assertFalse(is_alive(pid))
        print(f'\nworst of 20: {worst:.3f} s from DELETE to a free worker')
        self.assertLess(worst, 0.5)

    def test_descriptors_and_processes_do_not_leak(self):
        def descriptors():
            return len(os.listdir(f'/proc/{self.server.process.pid}/fd'))

        self.server.ready(support.off(support.bumpy(1)))
        before = descriptors()
        for i in range(10):
            shape_id = self.server.post(support.off(support.bumpy(3, 0.1 * i))).json()['id']
            wait_until(lambda: self.server.preparations() or self.server.get('/shapes/' + shape_id).json()['state'] == 'ready')
            for pid in self.server.preparations() if i % 2 else ():
                os.kill(pid, signal.SIGKILL)
            self.server.finished(shape_id)
        self.assertEqual(self.server.preparations(), [])
        self.assertLessEqual(descriptors(), before + 6)  # a database connection for each thread that ever needed one


if __name__ == '__main__':
    unittest.main()
