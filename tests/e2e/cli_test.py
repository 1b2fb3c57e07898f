"""The command without a server, and beside one."""
import json
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

    def test_writes_what_the_server_sends(self):
        self.assertEqual(self.run_cli('prepare', 'a.off', 'b.off', '--store', self.store).returncode, 0)
        server = self.serve(self.store)
        ids = []
        for name in ('a', 'b'):
            with open(f'{self.place}/{name}.off', 'rb') as file:
                ids.append(server.ready(file.read()))
        for extension in ('npz', 'npy', 'txt', 'map', 'ply', 'glb', 'obj', 'png'):
            done = self.run_cli('match', 'a.off', 'b.off', '--store', self.store, '-o', 'map.' + extension)
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(f'{self.place}/map.{extension}', 'rb') as file:
                self.assertEqual(file.read(), server.get('/match', src=ids[0], tgt=ids[1], format=extension).body, extension)

    def test_confidence_and_distortion(self):
        self.assertEqual(self.run_cli('prepare', 'a.off', 'b.off', '--store', self.store).returncode, 0)
        server = self.serve(self.store)
        with open(self.place + '/a.off', 'rb') as a, open(self.place + '/b.off', 'rb') as b:
            ids = server.ready(a.read()), server.ready(b.read())
        for fields in ('confidence,distortion', 'distortion'):
            for extension in ('npz', 'ply'):
                done = self.run_cli('match', '--fields', fields, 'a.off', 'b.off', '--store', self.store, '-o', 'map.' + extension)
                self.assertEqual(done.returncode, 0, done.stderr)
                with open(f'{self.place}/map.{extension}', 'rb') as file:
                    self.assertEqual(file.read(), server.get('/match', src=ids[0], tgt=ids[1], format=extension, fields=fields).body)
        done = self.run_cli('symmetry', 'a.off', '--fields', 'confidence', '--store', self.store, '-o', 'map.npz')
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.place + '/map.npz', 'rb') as file:
            self.assertEqual(file.read(), server.get(f'/shapes/{ids[0]}/symmetry', format='npz', fields='confidence').body)
        # An archive with more than the map is still a map.
        self.assertEqual(self.run_cli('evaluate', 'a.off', 'a.off', 'map.npz').returncode, 0)
        for words, *arguments in (("'map.txt' has no room", '-o', 'map.txt', '--fields', 'confidence'),
                                  ('vertex', '-o', 'map.npz', '--fields', 'confidence,vertex'),
                                  ('--fields requires --output', '--fields', 'confidence')):
            wrong = self.run_cli('match', 'a.off', 'b.off', '--store', self.store, *arguments)
            self.assertEqual(wrong.returncode, 2, wrong.stdout)
            self.assertIn(words, wrong.stderr)

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

    def test_mirror_image_and_hints(self):
        vertices, faces = support.bumpy(2, 0.0)
        with open(self.place + '/mirrored.off', 'wb') as file:
            file.write(support.off(([(-x, y, z) for x, y, z in vertices], [f[::-1] for f in faces])))
        done = self.run_cli('match', 'a.off', 'mirrored.off', '--store', self.store, '--orientation', 'any', '--hints', '0:0,40:40,90:90',
                            '-o', 'map.txt')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("match of the source's mirror image", done.stdout)
        with open(self.place + '/map.txt') as file:
            found = [int(line) for line in file]
        self.assertGreater(sum(v == i for i, v in enumerate(found)), 120)
        for hints, words in (('0', 'pair of vertex numbers'), ('1:2,3', 'pair of vertex numbers'), (','.join(['1:1'] * 65), 'at most 64')):
            wrong = self.run_cli('match', 'a.off', 'b.off', '--store', self.store, '--hints', hints)
            self.assertEqual(wrong.returncode, 2, hints)
            self.assertIn(words, wrong.stderr)
        outside = self.run_cli('match', 'a.off', 'b.off', '--store', self.store, '--hints', '162:0')
        self.assertEqual(outside.returncode, 3)
        self.assertIn('vertex 162 of the source does not exist', outside.stderr)

    def test_symmetry(self):
        done = self.run_cli('symmetry', 'a.off', '--store', self.store, '-o', 'map.npz')
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        self.assertEqual(done.stdout.count('a.off: '), 1)
        self.assertIn("match of the source's mirror image", done.stdout)
        self.assertRegex(done.stdout, r'quality: involution_mean 0\.\d+\n')
        server = self.serve(self.store)
        with open(self.place + '/a.off', 'rb') as file:
            shape = server.ready(file.read())
        for extension in ('npz', 'npy', 'txt', 'map', 'ply', 'glb', 'obj', 'png'):
            done = self.run_cli('symmetry', 'a.off', '--store', self.store, '-o', 'map.' + extension, '--hints', '3:4')
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(f'{self.place}/map.{extension}', 'rb') as file:
                self.assertEqual(file.read(), server.get(f'/shapes/{shape}/symmetry', format=extension, hints='3:4').body, extension)
        done = self.run_cli('symmetry', 'a.off', '--store', self.store, '-o', 'map.npz', '--refine', 'none')
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.place + '/map.npz', 'rb') as file:
            plain = file.read()
        self.assertEqual(plain, server.get(f'/shapes/{shape}/symmetry', format='npz', refine='none').body)
        self.assertNotEqual(plain, server.get(f'/shapes/{shape}/symmetry', format='npz').body)
        self.assertEqual(self.run_cli('symmetry', 'a.off', '--refine', 'x', '--store', self.store).returncode, 2)
        self.assertEqual(self.run_cli('symmetry', 'a.off', '--candidate', '8', '--store', self.store).returncode, 2)
        missing = self.run_cli('symmetry', 'a.off', '--candidate', '7', '--store', self.store)
        self.assertEqual(missing.returncode, 3)
        self.assertIn('there is no candidate 7', missing.stderr)
        self.assertEqual(self.run_cli('symmetry', 'a.off', '--orientation', 'any', '--store', self.store).returncode, 2)

    def test_simplify(self):
        with open(self.place + '/fine.off', 'wb') as file:
            file.write(support.off(support.bumpy(4, 0.0)))
        done = self.run_cli('prepare', 'fine.off', '--store', self.store, '--simplify', '600')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('fine.off: 2562 vertices', done.stdout)
        self.assertIn('simplified to 600 vertices', done.stdout)
        self.assertRegex(done.stdout, r'\n  simplify +\d')
        done = self.run_cli('match', 'fine.off', 'a.off', '--store', self.store, '--simplify', '600', '-o', 'map.npz')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('fine.off: 2562 vertices, already in the store', done.stdout)
        with open(self.place + '/map.npz', 'rb') as file:
            vertex = support.read_npz(file.read())['vertex'][1]
        self.assertEqual(len(vertex), 2562)
        self.assertEqual(self.run_cli('prepare', 'a.off', '--store', self.store, '--simplify', '499').returncode, 2)

    def test_evaluate(self):
        for target in ('a', 'b'):
            self.assertEqual(self.run_cli('match', 'a.off', target + '.off', '--store', self.store, '-o', target + '.npz').returncode, 0)
        done = self.run_cli('evaluate', 'a.off', 'a.off', 'a.npz')
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        self.assertRegex(done.stdout, r'^error: mean 0\.0\d, median 0\.0\d, .* 162 landmarks\n  mean by area 0\.0\d\nedges: .*; 0 of 480 torn\nfaces: .*\ncoverage: .*\n$')
        with open(self.place + '/some.vts', 'w') as file:
            file.write('1\n20\n162\n')
        with open(self.place + '/others.vts', 'w') as file:
            file.write('162\n1\n20\n')
        done = self.run_cli('evaluate', 'a.off', 'b.off', 'b.npz', '--landmarks', 'some.vts', 'some.vts', '--mirrored', 'others.vts')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r'3 landmarks\nagainst the mirrored truth: .*\nflipped: no\nedges: ')

        def fails(code, message, *arguments):
            done = self.run_cli('evaluate', *arguments)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertIn(message, done.stderr)

        fails(2, '--reverse requires MAP', 'a.off', 'b.off', '--reverse', 'b.npz')
        fails(2, 'excludes', 'a.off', 'b.off', 'b.npz', '--truth', 'none', '--landmarks', 'some.vts', 'some.vts')
        fails(2, 'does not end in .svg', 'a.off', 'b.off', 'b.npz', '--curve', 'curve.jpg')
        fails(3, 'some.vts has 3 entries', 'a.off', 'b.off', 'b.npz', '--truth', 'some.vts')
        fails(3, 'not an NPZ', 'a.off', 'b.off', 'some.vts')
        fails(3, 'have 3 and 0 entries', 'a.off', 'b.off', 'b.npz', '--landmarks', 'some.vts', '/dev/null')
        fails(4, 'nowhere.npz', 'a.off', 'b.off', 'nowhere.npz')

    def test_evaluate_matches_by_itself(self):
        """What it measures of its own match is what it measures of the maps that match writes."""
        def measured(*arguments):
            done = self.run_cli('evaluate', 'a.off', 'b.off', *arguments, '--store', self.store, '--json', '-')
            self.assertEqual((done.returncode, done.stderr), (0, ''))
            result = json.loads(done.stdout)
            self.assertEqual(len(result['thresholds']), 101)
            return result

        whole = measured('--curve', 'curve.svg')
        with open(self.place + '/curve.svg') as file:
            self.assertIn('geodesic, mean ' + format(whole['geodesic']['mean'], '.4f'), file.read())
        self.assertEqual(len(whole['geodesic']['curve']), 101)
        for name in ('biharmonic', 'bijectivity', 'bijectivity_biharmonic'):
            self.assertEqual(whole[name]['scored'], 162)
        self.assertGreater(whole['symmetric_integral'], 0)
        self.assertGreater(whole['coverage']['area'], 0.95)
        self.assertIsNone(whole['flipped'])
        for source, target in ('ab', 'ba'):
            done = self.run_cli('match', source + '.off', target + '.off', '--store', self.store, '-o', source + target + '.npz')
            self.assertEqual(done.returncode, 0, done.stderr)
        given = measured('ab.npz', '--reverse', 'ba.npz', '--biharmonic')
        for name in ('geodesic', 'biharmonic', 'continuity', 'coverage'):
            self.assertEqual(given[name], whole[name], name)
        self.assertIsNone(measured('ab.npz')['biharmonic'])
        self.assertIsNone(measured('ab.npz', '--truth', 'none')['geodesic'])

        with open(self.place + '/list.txt', 'w') as file:
            file.write('\n'.join(map(str, [-1, *range(1, 162)])))
        from_zero = measured('ab.npz', '--truth', 'list.txt')['geodesic']
        self.assertEqual(from_zero['scored'], 161)
        with open(self.place + '/list.map', 'w') as file:
            file.write('\n'.join(map(str, [0, *range(2, 163)])))
        self.assertEqual(measured('ab.npz', '--truth', 'list.map')['geodesic'], from_zero)
        with open(self.place + '/points.vts', 'w') as file:
            file.write('3\n8\n')
        at_points = measured('ab.npz', '--points', 'points.vts')['geodesic']
        self.assertEqual(at_points['scored'], 2)
        self.assertLess(abs(at_points['median'] - at_points['mean']), 1e-12)

    def test_evaluate_measures_symmetries_and_candidates(self):
        def measured(*arguments):
            done = self.run_cli('evaluate', 'a.off', 'a.off', *arguments, '--store', self.store, '--json', '-')
            self.assertEqual((done.returncode, done.stderr), (0, ''))
            return json.loads(done.stdout)

        for candidate in ('0', '1'):
            done = self.run_cli('symmetry', 'a.off', '--candidate', candidate, '--store', self.store, '-o', 'symmetry.npz')
            self.assertEqual(done.returncode, 0, done.stderr)
            itself = measured('--orientation', 'reverse', '--candidate', candidate)
            given = measured('symmetry.npz')
            for name in ('geodesic', 'continuity', 'coverage'):
                self.assertEqual(given[name], itself[name], (name, candidate))
        missing = self.run_cli('evaluate', 'a.off', 'a.off', '--candidate', '7', '--store', self.store)
        self.assertEqual(missing.returncode, 3)
        self.assertIn('there is no candidate 7', missing.stderr)

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
        fails(2, '.npz, .npy, .txt, .map, .ply, .glb, .obj, .png', 'match', 'a.off', 'b.off', '-o', 'map.xyz', '--store', self.store)
        fails(3, 'torus.off: ', 'prepare', 'torus.off', '--store', self.store)
        fails(4, 'nowhere.off: ', 'prepare', 'nowhere.off', '--store', self.store)
        fails(4, '', 'prepare', 'a.off', '--store', self.place + '/a.off')
        fails(4, 'cannot be written', 'match', 'a.off', 'b.off', '--store', self.store, '-o', 'nowhere/map.npz')
        # One bad mesh does not keep the others from being prepared.
        self.assertIn('a.off: 162 vertices', fails(3, 'torus.off', 'prepare', 'torus.off', 'a.off', '--store', self.store).stdout)

    def test_help(self):
        for arguments in (['--help'], ['prepare', '--help'], ['match', '--help'], ['symmetry', '--help'], ['evaluate', '--help']):
            done = self.run_cli(*arguments)
            self.assertEqual(done.returncode, 0)
            self.assertIn('Exit codes', done.stdout)


if __name__ == '__main__':
    unittest.main()
