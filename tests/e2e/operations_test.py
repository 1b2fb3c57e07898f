"""What those who run a server rely on: keys, configuration, readiness, metrics, logs."""
import json
import os
import re
import signal
import socket
import sqlite3
import subprocess
import time
import unittest

import support

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..')
A = support.off(support.bumpy(2))


def run(*arguments, environment=None):
    return subprocess.run([support.SERVER, *arguments], capture_output=True, text=True, timeout=30,
                          env={**os.environ, **(environment or {})})


class KeysTest(support.TestCase):
    def setUp(self):
        self.place = self.directory()
        self.keys = self.place + '/keys'
        self.key = {scope: self.add(scope, scope) for scope in ('read', 'write', 'admin')}

    def add(self, name, scope):
        done = run('keys', 'add', '--keys', self.keys, '--name', name, '--scope', scope)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.strip()

    def bearer(self, scope):
        return {'Authorization': 'Bearer ' + self.key[scope]}

    def test_every_scope_may_do_what_it_should(self):
        server = self.serve(self.place + '/s.db', '--keys', self.keys)
        for path in ('/', '/healthz', '/readyz', '/version'):
            self.assertEqual(server.get(path).status, 200, path)
        refused = server.get('/shapes')
        self.assert_problem(refused, 401, 'unauthorized')
        self.assertTrue(refused.headers['WWW-Authenticate'].startswith('Bearer '))
        self.assert_problem(server.get('/shapes', headers={'Authorization': 'Bearer sm_' + '0' * 64}), 401, 'unauthorized')
        self.assertEqual(server.get('/shapes', headers=self.bearer('read')).status, 200)
        self.assertEqual(server.get('/shapes', headers={'X-API-Key': self.key['read']}).status, 200)
        self.assert_problem(server.post(A, headers=self.bearer('read')), 403, 'forbidden')
        made = server.post(A, headers=self.bearer('write'), wait=60)
        self.assertEqual(made.status, 201, made.body)
        path = '/shapes/' + made.json()['id']
        # A stranger does not learn what exists.
        self.assertEqual({server.get(p).status for p in (path, path[:-1] + '0', '/nowhere')}, {401})
        self.assert_problem(server.request('DELETE', path, headers=self.bearer('read')), 403, 'forbidden')
        self.assert_problem(server.get('/metrics', headers=self.bearer('write')), 403, 'forbidden')
        self.assertEqual(server.get('/metrics', headers=self.bearer('admin')).status, 200)
        self.assertEqual(server.request('DELETE', path, headers=self.bearer('admin')).status, 204)
        self.assertEqual(server.stop(), 0)
        log = ''.join(server.log)
        self.assertIn('key=write', log)
        for key in self.key.values():
            self.assertNotIn(key, log)

    def test_a_body_is_not_asked_for_from_strangers(self):
        server = self.serve(self.place + '/s.db', '--keys', self.keys, '--max-body-mib', '1')
        with socket.create_connection(('127.0.0.1', server.port), timeout=10) as connection:
            connection.sendall(b'POST /shapes HTTP/1.1\r\nHost: x\r\nContent-Length: 1000\r\nExpect: 100-continue\r\n\r\n')
            self.assertEqual(connection.recv(100)[:12], b'HTTP/1.1 401')
        # Nothing of the body is sent, and the answer comes all the same; its size is not spoken of either.
        with socket.create_connection(('127.0.0.1', server.port), timeout=5) as connection:
            connection.sendall(b'POST /shapes HTTP/1.1\r\nHost: x\r\nContent-Length: 99999999\r\n\r\n')
            self.assertEqual(connection.recv(100)[:12], b'HTTP/1.1 401')
        self.assert_problem(server.request('POST', '/shapes', body=A), 401, 'unauthorized')

    def test_changes_are_taken_up_while_it_runs(self):
        server = self.serve(self.place + '/s.db', '--keys', self.keys)
        self.assertEqual(server.get('/shapes', headers=self.bearer('read')).status, 200)
        self.assertEqual(run('keys', 'remove', '--keys', self.keys, '--name', 'read').returncode, 0)
        self.assertEqual(server.get('/shapes', headers=self.bearer('read')).status, 401)
        self.key['later'] = self.add('later', 'read')
        self.assertEqual(server.get('/shapes', headers=self.bearer('later')).status, 200)
        with open(self.keys, 'a') as file:
            file.write('nonsense\n')
        self.assertEqual(server.get('/shapes', headers=self.bearer('later')).status, 200)
        self.assertEqual(server.stop(), 0)
        self.assertEqual(len([line for line in server.log if 'event=keys_not_read' in line and 'line 5' in line]), 1)
        broken = run('--port', '0', '--store', self.place + '/s.db', '--keys', self.keys)
        self.assertEqual(broken.returncode, 1)
        self.assertIn('line 5', broken.stderr)

    def test_no_start_for_other_machines_without_keys(self):
        store = self.place + '/other.db'
        self.assertEqual(run('--port', '0', '--store', store, '--host', '0.0.0.0').returncode, 2)
        missing = run('--port', '0', '--store', store, '--host', '0.0.0.0', '--keys', self.place + '/missing')
        self.assertEqual(missing.returncode, 1)
        self.assertIn('missing', missing.stderr)


class OperationsTest(support.TestCase):
    def test_a_configuration_file_and_a_log_in_json(self):
        place = self.directory()
        with open(place + '/s.toml', 'w') as file:
            file.write('# for the test\nmax-body-mib = 3\nworkers = 2\nlog-format = json\n')
        server = self.serve(place + '/s "1".db', '--config', place + '/s.toml', '--workers', '1')
        limits = server.get('/version').json()['limits']
        self.assertEqual((limits['body_bytes'], limits['workers']), (3 << 20, 1))
        server.ready(A, name='an "odd" name')
        self.assertEqual(server.stop(), 0)
        events = [json.loads(line) for line in server.log]
        self.assertLessEqual({'started', 'request', 'job_started', 'job_finished', 'stopped'}, {e['event'] for e in events})
        self.assertEqual(events[0]['store'], place + '/s "1".db')
        for event in events:
            self.assertRegex(event['time'], r'^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z$')
            self.assertIn(event['level'], ('info', 'warning', 'error'))

    def test_metrics_count_what_was_done(self):
        server = self.serve(self.directory() + '/s.db')
        ids = [server.ready(support.off(support.bumpy(2, seed))) for seed in (0.0, 1.0)]
        for _ in range(3):
            self.assertEqual(server.get('/match', src=ids[0], tgt=ids[1]).status, 200)
        server.get('/shapes/' + '0' * 32)
        # A request is counted after its last byte is sent, which the client may have before.
        deadline = time.monotonic() + 10
        response = server.get('/metrics')
        while b'code="404"' not in response.body and time.monotonic() < deadline:
            time.sleep(0.05)
            response = server.get('/metrics')
        self.assertEqual(response.headers['Content-Type'], 'text/plain; version=0.0.4; charset=utf-8')
        values = {}
        for line in response.body.decode().splitlines():
            if not line.startswith('#'):
                name, value = line.rsplit(' ', 1)
                self.assertNotIn(name, values)
                values[name] = float(value)
        self.assertEqual(values['spherematch_http_requests_total{code="200",method="GET",route="/match"}'], 3)
        self.assertEqual(values['spherematch_http_requests_total{code="404",method="GET",route="/shapes/{id}"}'], 1)
        self.assertEqual(values['spherematch_preparation_stage_duration_seconds_count{stage="conformal"}'], 2)
        self.assertEqual(values['spherematch_jobs{kind="preprocess",state="queued"}'], 0)
        self.assertGreater(values['spherematch_cache_bytes{cache="shapes"}'], 1000)
        self.assertGreater(values['spherematch_store_bytes'], 10000)
        self.assertAlmostEqual(values['process_start_time_seconds'], time.time(), delta=120)
        self.assertFalse([name for name in values if ids[0] in name])  # patterns, never paths

    def test_ready_and_not_ready(self):
        place = self.directory()
        server = self.serve(place + '/s.db')
        ready = server.get('/readyz')
        self.assertEqual((ready.status, ready.headers['Cache-Control']), (200, 'no-store'))
        self.assertEqual([c['name'] for c in ready.json()['checks']], ['store', 'disk', 'preparations', 'matches', 'stopping'])
        self.assertEqual(run('--check', '--port', str(server.port)).returncode, 0)
        full = self.serve(place + '/t.db', '--min-free-mib', '99999999')
        problem = self.assert_problem(full.get('/readyz'), 503, 'not-ready')
        self.assertEqual([c['name'] for c in problem['checks'] if not c['ok']], ['disk'])
        self.assertEqual(full.get('/healthz').status, 200)
        checked = run('--check', '--host', '0.0.0.0', environment={'SPHEREMATCH_PORT': str(full.port)})
        self.assertEqual(checked.returncode, 1)
        self.assertIn('not-ready', checked.stdout)
        self.assertEqual(full.stop(), 0)
        self.assertEqual(run('--check', '--port', str(full.port)).returncode, 1)

    def test_a_store_that_takes_no_writes_is_noticed_and_forgotten(self):
        path = self.directory() + '/s.db'
        server = self.serve(path)
        other = sqlite3.connect(path, isolation_level=None)
        other.execute('BEGIN IMMEDIATE')
        # The server waits for its turn to write, as long as a large write of another process may take; that is too long to be ready.
        deadline = time.monotonic() + 30
        while (answer := server.get('/readyz')).status == 200 and time.monotonic() < deadline:
            time.sleep(0.2)
        problem = self.assert_problem(answer, 503, 'not-ready')
        self.assertEqual([c['name'] for c in problem['checks'] if not c['ok']], ['store'])
        other.execute('ROLLBACK')
        other.close()
        while server.get('/readyz').status != 200 and time.monotonic() < deadline:
            time.sleep(0.2)
        self.assertEqual(server.get('/readyz').status, 200)
        self.assertEqual(server.stop(), 0)

    def test_a_preparation_that_hangs_is_noticed(self):
        server = self.serve(self.directory() + '/s.db', '--stall-seconds', '1')
        shape = server.post(support.off(support.bumpy(5))).json()['id']
        deadline = time.monotonic() + 30
        while not server.preparations() and time.monotonic() < deadline:
            time.sleep(0.01)
        worker = server.preparations()[0]
        os.kill(worker, signal.SIGSTOP)
        while (answer := server.get('/readyz')).status == 200 and time.monotonic() < deadline:
            time.sleep(0.1)
        problem = self.assert_problem(answer, 503, 'not-ready')
        self.assertEqual([c['name'] for c in problem['checks'] if not c['ok']], ['preparations'])
        self.assertEqual(server.request('DELETE', '/shapes/' + shape).status, 204)
        while server.get('/readyz').status != 200 and time.monotonic() < deadline:
            time.sleep(0.1)
        self.assertEqual(server.get('/readyz').status, 200)

    def test_preparations_leave_the_processors_to_requests(self):
        server = self.serve(self.directory() + '/s.db')
        server.post(support.off(support.bumpy(5)))
        deadline = time.monotonic() + 30
        nice = []
        while (not nice or nice[0] < 10) and time.monotonic() < deadline:
            nice = [os.getpriority(os.PRIO_PROCESS, worker) for worker in server.preparations()]
        self.assertEqual(nice, [max(10, os.getpriority(os.PRIO_PROCESS, 0))])
        self.assertEqual(os.getpriority(os.PRIO_PROCESS, server.process.pid), os.getpriority(os.PRIO_PROCESS, 0))

    def test_version_and_help(self):
        self.assertRegex(run('--version').stdout, r'^\d+\.\d+\.\d+\n$')
        text = run('--help').stdout
        flags = re.findall(r'^  (?:-\w,)?--([a-z-]+)', text, re.MULTILINE)
        self.assertGreater(len(flags), 15)
        with open(os.path.join(ROOT, 'docker', 'spherematch.toml')) as file:
            sample = file.read()
        with open(os.path.join(ROOT, 'docs', 'operations.md')) as file:
            manual = file.read()
        for flag in set(flags) - {'help', 'version', 'check'}:
            self.assertIn('SPHEREMATCH_' + flag.upper().replace('-', '_'), text)
            self.assertIn(f'`--{flag}`', manual)
            if flag != 'config':
                self.assertRegex(sample, rf'(?m)^# {flag} = ')

    def test_the_sample_configuration_is_the_defaults(self):
        place = self.directory()
        with open(os.path.join(ROOT, 'docker', 'spherematch.toml')) as file:
            lines = re.findall(r'(?m)^# ([a-z-]+ = .*)$', file.read())
        # Threads and matches depend on the machine, and the server's place and keys are the test's.
        own = ('threads', 'concurrent-matches', 'host', 'port', 'store', 'keys')
        with open(place + '/s.toml', 'w') as file:
            file.write('\n'.join(line for line in lines if line.split(' ')[0] not in own) + '\n')
        plain = self.serve(place + '/a.db').get('/version').json()
        configured = self.serve(place + '/b.db', '--config', place + '/s.toml').get('/version').json()
        self.assertEqual(configured, plain)


class ContainerTest(support.TestCase):
    def test_the_image_has_the_libraries_of_the_programs(self):
        """Both ways: one that is missing is found by the build of the image alone, and one too many by nobody."""
        packages = set()
        for program in (support.SERVER, support.CLI):
            listing = subprocess.run(['objdump', '-p', program], capture_output=True, text=True, check=True).stdout
            paths = subprocess.run(['ldd', program], capture_output=True, text=True, check=True).stdout
            for name in re.findall(r'NEEDED\s+(\S+)', listing):
                path = re.search(rf'{re.escape(name)} => (\S+)', paths)
                if path is None:
                    continue  # the loader
                real = os.path.realpath(path.group(1))
                found = subprocess.run(['dpkg-query', '-S', real, real.removeprefix('/usr')], capture_output=True, text=True).stdout
                packages.add(found.split(':')[0])
        with open(os.path.join(ROOT, 'scripts', 'packages', 'runtime.txt')) as file:
            listed = {line.strip() for line in file if not line.startswith('#')}
        self.assertEqual(packages - {'libc6', 'libgcc-s1', 'libstdc++6'}, listed)


if __name__ == '__main__':
    unittest.main()
