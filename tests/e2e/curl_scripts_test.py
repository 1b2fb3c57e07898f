"""The scripts of client/curl do their jobs."""
import json
import os
import subprocess
import unittest

import support

SCRIPTS = os.path.realpath(os.path.join(os.path.dirname(__file__), '..', '..', 'client', 'curl'))


class CurlScriptsTest(support.TestCase):
    def setUp(self):
        self.place = self.directory()
        self.server = self.serve(self.place + '/s.db')
        for name, seed in (('a', 0.0), ('b', 1.0)):
            with open(f'{self.place}/{name}.off', 'wb') as file:
                file.write(support.off(support.bumpy(2, seed)))

    def run_script(self, name, *arguments, code=0):
        done = subprocess.run([f'{SCRIPTS}/{name}.sh', *arguments], cwd=self.place, capture_output=True, text=True, timeout=120,
                              env={**os.environ, 'SPHEREMATCH_URL': f'http://127.0.0.1:{self.server.port}'})
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout if code == 0 else done.stderr

    def test_a_day_of_work(self):
        a = self.run_script('upload', 'a.off', 'tags=left').strip()
        b = self.run_script('upload', 'b.off').strip()
        self.assertEqual(self.run_script('list', 'tag=left').split('\t')[0], a)
        self.assertEqual(len(self.run_script('list').splitlines()), 2)

        self.run_script('match', a, b, 'map.txt', 'orientation=any')
        with open(self.place + '/map.txt', 'rb') as file:
            self.assertEqual(file.read(), self.server.get(f'/match?src={a}&tgt={b}&format=txt&orientation=any').body)

        lines = [json.loads(line) for line in self.run_script('match-all', a, b).splitlines()]
        self.assertEqual(sorted((line['src'], line['tgt']) for line in lines), sorted([(a, b), (b, a)]))
        self.assertEqual(len(lines[0]['match']['vertex']), 162)

        array = self.server.get(f'/match?src={b}&tgt={a}&format=npy').body  # any array with a row for each vertex of b
        with open(self.place + '/in.npy', 'wb') as file:
            file.write(array)
        self.run_script('transfer', a, b, 'in.npy', 'out.npy')
        with open(self.place + '/out.npy', 'rb') as file:
            descr, values = support.read_npy(file.read())
        self.assertEqual((descr, len(values)), ('<i4', 162))

        self.run_script('delete', a, b)
        self.assertEqual(self.run_script('list'), '')

    def test_refusals_have_their_reason(self):
        with open(self.place + '/bad.off', 'w') as file:
            file.write('nothing')
        self.assertIn('malformed-mesh', self.run_script('upload', 'bad.off', code=1))
        self.assertIn('not-found', self.run_script('match', '0' * 32, '0' * 32, 'map.npz', code=1))
        self.assertFalse(os.path.exists(self.place + '/map.npz'))
        self.assertFalse(os.path.exists(self.place + '/map.npz.part'))
        self.assertIn('cannot read', self.run_script('upload', 'missing.off', code=1))
        for name in ('upload', 'match', 'match-all', 'transfer', 'delete'):
            self.assertIn('usage: ', self.run_script(name, code=1))
        self.server.stop()
        self.assertIn('no answer', self.run_script('list', code=1))


if __name__ == '__main__':
    unittest.main()
