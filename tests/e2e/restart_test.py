"""Stopping, killing and starting again."""
import signal
import time
import unittest

import support

LARGE = support.off(support.bumpy(5))


def wait_for_processing(server, shape_id):
    deadline = time.monotonic() + 20
    while time.monotonic() < deadline:
        shape = server.get('/shapes/' + shape_id).json()
        if shape['state'] == 'processing' and shape['stage']:
            return
        assert shape['state'] != 'ready', 'the mesh is too small for this test'
        time.sleep(0.01)
    raise AssertionError('never processed')


class RestartTest(support.TestCase):
    def test_sigterm_and_sigint_end_it_cleanly(self):
        for how in (signal.SIGTERM, signal.SIGINT):
            server = self.serve(self.directory() + '/s.db')
            start = time.monotonic()
            self.assertEqual(server.stop(how), 0)
            self.assertLess(time.monotonic() - start, 2.5)

    def test_a_stop_in_the_middle_of_a_preparation_loses_nothing(self):
        store = self.directory() + '/s.db'
        for how, code in ((signal.SIGTERM, 0), (signal.SIGKILL, -signal.SIGKILL)):
            server = self.serve(store)
            response = server.post(LARGE)
            self.assertIn(response.status, (200, 202))
            wait_for_processing(server, response.json()['id'])
            start = time.monotonic()
            self.assertEqual(server.stop(how), code)
            self.assertLess(time.monotonic() - start, 3.5)
        server = self.serve(store)
        shape_id = server.get('/shapes').json()['items'][0]['id']
        wait_for_processing(server, shape_id)  # taken up without being asked
        self.assertEqual(server.ready(LARGE), shape_id)
        self.assertEqual(server.stop(), 0)

    def test_waiting_requests_are_answered_when_it_stops(self):
        import threading
        server = self.serve(self.directory() + '/s.db')
        answers = []
        waiting = threading.Thread(target=lambda: answers.append(server.post(LARGE, wait=60)))
        waiting.start()
        deadline = time.monotonic() + 20
        while not server.get('/shapes').json()['items'] and time.monotonic() < deadline:
            time.sleep(0.02)
        self.assertEqual(server.stop(), 0)
        waiting.join(timeout=10)
        self.assertEqual([a.status for a in answers], [202])

    def test_deleting_cancels(self):
        server = self.serve(self.directory() + '/s.db')
        shape_id = server.post(LARGE).json()['id']
        wait_for_processing(server, shape_id)
        self.assertEqual(server.request('DELETE', '/shapes/' + shape_id).status, 204)
        deadline = time.monotonic() + 20
        while server.get('/healthz').json()['jobs_processing'] and time.monotonic() < deadline:
            time.sleep(0.02)
        self.assertEqual(server.stop(), 0)
        self.assertTrue(any('job_cancelled' in line for line in server.log), server.log)
        self.assertFalse(any('job_finished' in line for line in server.log), server.log)

    def test_a_store_that_cannot_be_opened_is_an_error(self):
        import subprocess
        path = self.directory() + '/s.db'
        with open(path, 'wb') as file:
            file.write(b'this is no database' * 1000)
        done = subprocess.run([support.SERVER, '--port', '0', '--store', path], capture_output=True, text=True, timeout=20)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stdout, '')
        self.assertIn('spherematch-server: ', done.stderr)


if __name__ == '__main__':
    unittest.main()
