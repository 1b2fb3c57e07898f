"""The examples of docs/http.md work by copy and paste."""
import os
import re
import subprocess
import unittest

import support

DOCS = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'docs', 'http.md')


class DocsTest(support.TestCase):
    def test_examples_run(self):
        place = self.directory()
        for name, seed in (('a', 0.0), ('b', 1.0)):
            with open(f'{place}/{name}.off', 'wb') as file:
                file.write(support.off(support.bumpy(2, seed)))
        server = self.serve(place + '/s.db')
        with open(DOCS) as file:
            blocks = re.findall(r'```sh\n(.*?)```', file.read(), re.DOTALL)
        self.assertGreater(len(blocks), 5)
        script = 'set -eu\n' + '\n'.join(blocks).replace('URL=http://127.0.0.1:8080', f'URL=http://127.0.0.1:{server.port}')
        self.assertIn(str(server.port), script)
        done = subprocess.run(['bash', '-c', script], cwd=place, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ('map.npz', 'map.txt', 'map.ply', 'map.png', 'sphere.npy', 'mesh.glb', 'sphere.ply', 'hks.npz', 'carried.ply', 'carried.png', 'thumbnail.png', 'carried.npy', 'curve.svg', 'scene.glb', 'symmetry.npz', 'judged.npz'):
            self.assertGreater(os.path.getsize(f'{place}/{name}'), 100, name)
        self.assertIn('\n304\n', done.stdout)
        problems = re.findall(r'"code":"([^"]+)"', done.stdout)
        self.assertEqual(problems, ['not-found'])  # the DELETE of an id that does not exist


if __name__ == '__main__':
    unittest.main()
