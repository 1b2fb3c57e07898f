"""The command without a server, and beside one."""
import subprocess
import unittest

import support


class CliTest(support.TestCase):
    def setUp(self):
        self.place = self.directory()
        self.store = self.place + '/s.db'
        for name, seed in (('a', 0.0), ('b', 1.0)):
            with open(f'{self.place}/{name}.off', 'wb') as file:
                file.write(support.off(support.bumpy(2, seed)))

    def run_cli(self, *arguments):
        return subprocess.run([support.CLI, *arguments], capture_output=True, text=True, timeout=120, cwd=self.place)

    def test_prepare_then_match(self):
        first = self.run_cli('prepare', 'a.off', '--store', self.store)
        self.assertEqual((first.returncode, first.stderr), (0, ''))
        self.assertRegex(first.stdout, r'a\.off: 162 vertices, 320 faces, id [0-9a-f]{32}\n')
        self.assertRegex(first.stdout, r'\n  total +\d+\.\d{3} s\n')
        self.assertIn('flipped 0', first.stdout)
        self.assertIn('already in the store', self.run_cli('prepare', 'a.off', '--store', self.store).stdout)

        done = self.run_cli('match', 'a.off', 'b.off', '--store', self.store, '-o', 'map.npz')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('a.off: 162 vertices, already in the store', done.stdout)
        self.assertIn('chosen', done.stdout)
        for extension in ('npy', 'txt'):
            self.assertEqual(self.run_cli('match', 'a.off', 'b.off', '--store', self.store, '-o', 'map.' + extension).returncode, 0)
        with open(self.place + '/map.npz', 'rb') as file:
            vertex = support.read_npz(file.read())['vertex'][1]
        with open(self.place + '/map.npy', 'rb') as file:
            self.assertEqual(support.read_npy(file.read())[1], vertex)
        with open(self.place + '/map.txt') as file:
            self.assertEqual([int(line) for line in file], vertex)

    def test_shares_its_store_with_a_server(self):
        self.run_cli('prepare', 'a.off', '--store', self.store)
        server = self.serve(self.store)
        with open(self.place + '/a.off', 'rb') as file:
            known = server.post(file.read())
        self.assertEqual((known.status, known.json()['state'], known.json()['name']), (200, 'ready', 'a.off'))
        with open(self.place + '/b.off', 'rb') as file:
            b = server.ready(file.read())
        done = self.run_cli('match', 'a.off', 'b.off', '--store', self.store, '-o', 'map.npz')
        self.assertIn('b.off: 162 vertices, already in the store', done.stdout)
        with open(self.place + '/map.npz', 'rb') as file:
            self.assertEqual(file.read(), server.get('/match', src=known.json()['id'], tgt=b, format='npz').body)

    def test_errors_and_exit_codes(self):
        def fails(code, message, *arguments):
            done = self.run_cli(*arguments)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertIn(message, done.stderr)
            return done

        with open(self.place + '/torus.off', 'wb') as file:
            file.write(support.off(support.torus()))
        fails(2, 'subcommand')
        fails(2, 'subcommand', 'bogus')
        fails(2, 'SRC', 'match')
        fails(2, '.npz, .npy, .txt', 'match', 'a.off', 'b.off', '-o', 'map.ply', '--store', self.store)
        fails(3, 'torus.off: ', 'prepare', 'torus.off', '--store', self.store)
        fails(4, 'nowhere.off: ', 'prepare', 'nowhere.off', '--store', self.store)
        fails(4, '', 'prepare', 'a.off', '--store', self.place + '/a.off')
        fails(4, 'cannot be written', 'match', 'a.off', 'b.off', '--store', self.store, '-o', 'nowhere/map.npz')
        # One bad mesh does not keep the others from being prepared.
        self.assertIn('a.off: 162 vertices', fails(3, 'torus.off', 'prepare', 'torus.off', 'a.off', '--store', self.store).stdout)

    def test_help(self):
        for arguments in (['--help'], ['prepare', '--help'], ['match', '--help']):
            done = self.run_cli(*arguments)
            self.assertEqual(done.returncode, 0)
            self.assertIn('Exit codes', done.stdout)
        self.assertNotIn('evaluate', self.run_cli('--help').stdout)


if __name__ == '__main__':
    unittest.main()
