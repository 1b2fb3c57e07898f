"""The C++ client as its users get it: installed, found by a project of its own, built, run."""
import os
import subprocess
import unittest

import support

ROOT = os.path.realpath(os.path.join(os.path.dirname(__file__), '..', '..'))
BUILD = os.environ['SPHEREMATCH_BUILD']


def run(*command, **options):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=280, **options)
    assert done.returncode == 0, done.stdout
    return done.stdout


class ClientTest(support.TestCase):
    def test_an_empty_project_uses_the_installed_package(self):
        place = self.directory()
        run('cmake', '--install', BUILD, '--component', 'client', '--prefix', place + '/prefix')
        installed = {os.path.relpath(os.path.join(where, name), place + '/prefix')
                     for where, _, names in os.walk(place + '/prefix') for name in names}
        self.assertIn('include/spherematch/client/client.h', installed)
        self.assertFalse([name for name in installed if 'engine' in name or 'server' in name], 'more than the client is installed')

        run('cmake', '-G', 'Ninja', '-S', ROOT + '/client/example', '-B', place + '/build', '-DCMAKE_PREFIX_PATH=' + place + '/prefix')
        run('cmake', '--build', place + '/build')
        for name, seed in (('a', 0.0), ('b', 1.0)):
            with open(f'{place}/{name}.off', 'wb') as file:
                file.write(support.off(support.bumpy(2, seed)))
        server = self.serve(place + '/s.db')
        url = f'http://127.0.0.1:{server.port}'
        said = run(place + '/build/match', url, 'a.off', 'b.off', 'map.txt', cwd=place)
        self.assertIn('162 vertices matched', said)
        ids = [shape['id'] for shape in server.all_shapes()]  # newest first
        expected = server.get(f'/match?src={ids[1]}&tgt={ids[0]}&format=txt').body
        with open(place + '/map.txt', 'rb') as file:
            self.assertEqual(file.read(), expected)

        with open(place + '/bad.off', 'w') as file:
            file.write('OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 9\n')
        done = subprocess.run([place + '/build/match', url, 'bad.off', 'b.off', 'x'], cwd=place, capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 1)
        self.assertIn('the server refused with 400', done.stderr)


if __name__ == '__main__':
    unittest.main()
