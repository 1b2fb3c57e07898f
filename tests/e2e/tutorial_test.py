"""docs/tutorial.md and docs/gallery.md: every block runs, prints what the document says, and makes the pictures that the document shows."""
import contextlib
import io
import os
import re
import sys
import unittest

import numpy as np
from PIL import Image

import support

ROOT = os.path.realpath(os.path.join(os.path.dirname(__file__), '..', '..'))
DOCS = os.path.join(ROOT, 'docs')
sys.path[:0] = [DOCS, os.path.join(ROOT, 'client', 'python')]

import run_document  # noqa: E402


class TutorialTest(support.TestCase):
    def enter(self, place):
        """Makes a reader's folder of `place` and goes there."""
        for name in ('samples', 'client'):
            os.symlink(os.path.join(ROOT, name), os.path.join(place, name))
        os.symlink(os.environ['SPHEREMATCH_BUILD'], os.path.join(place, 'build'))
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(place)

    def check_pictures(self, text, place):
        """Those of the document are those that its commands made, but for what processors differ in."""
        shown = re.findall(r'!\[[^]]*\]\(([^)]+)\)', text)
        self.assertGreater(len(shown), 3)
        for image in set(shown):
            made = os.path.join(place, 'match.png' if image == 'images/hound.png' else os.path.basename(image))
            with Image.open(os.path.join(DOCS, image)) as a, Image.open(made) as b:
                self.assertEqual((a.size, a.mode), (b.size, b.mode), image)
                difference = np.abs(np.asarray(a, float) - np.asarray(b, float)).mean()
            self.assertLess(difference, 3, f'{image} is not what the document makes: run docs/make-images.sh')

    def check_document(self, name):
        place = self.directory()
        self.enter(place)
        server = self.serve(place + '/s.db')
        with open(os.path.join(DOCS, name)) as file:
            text = file.read()
        blocks = run_document.run(os.path.join(DOCS, name), f'http://127.0.0.1:{server.port}')
        fences = re.findall(r'^```(\w+)$', text, re.MULTILINE)
        self.assertLessEqual(set(fences), {'sh', 'python', 'text'})
        self.assertEqual(blocks, sum(kind != 'text' for kind in fences))
        self.check_pictures(text, place)

    def test_the_tutorial(self):
        self.check_document('tutorial.md')

    def test_the_gallery(self):
        self.check_document('gallery.md')

    def test_the_python_of_the_client(self):
        place = self.directory()
        self.enter(place)
        server = self.serve(place + '/s.db')
        with contextlib.redirect_stdout(io.StringIO()):
            blocks = run_document.run(os.path.join(ROOT, 'client', 'README.md'), f'http://127.0.0.1:{server.port}', kinds=('python',))
        self.assertEqual(blocks, 2)

    def test_pictures_are_small(self):
        total = 0
        for document in ('tutorial', 'gallery'):
            with open(os.path.join(DOCS, document + '.md')) as file:
                text = file.read()
            for name in os.listdir(os.path.join(DOCS, 'images', document)):
                total += os.path.getsize(os.path.join(DOCS, 'images', document, name))
                self.assertIn(f'images/{document}/{name}', text, 'nobody shows it')
        self.assertGreater(total, 0)
        self.assertLess(total, 1 << 20)


class RunDocumentTest(support.TestCase):
    """What the test above stands on."""

    def run_text(self, text, update=False):
        place = self.directory()
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(place)
        with open('document.md', 'w') as file:
            file.write(text)
        count = run_document.run('document.md', 'http://example.invalid', update)
        with open('document.md') as file:
            return count, file.read()

    def test_blocks_share_their_session_and_the_folder(self):
        text = '```sh\necho 3 > n\n```\n\n```python\nimport pathlib\nn = int(pathlib.Path("n").read_text())\n```\n\n```python\nprint(n + 1)\n```\n\n```text\n4\n```\n'
        self.assertEqual(self.run_text(text), (3, text))

    def test_the_address_is_replaced(self):
        self.run_text('```sh\necho http://127.0.0.1:8080/x\n```\n\n```text\nhttp://example.invalid/x\n```\n')

    def test_what_is_wrong_is_told(self):
        for text in ('```sh\nfalse\n```\n', '```sh\nexit 3\n```\n', '```python\nprint("one")\n```\n\n```text\ntwo\n```\n',
                     '```python\nprint(1.5)\n```\n\n```text\n1.9\n```\n', '```python\nprint(5)\n```\n\n```text\n6\n```\n',
                     '```python\nprint("1 2")\n```\n\n```text\n1 2 3\n```\n'):
            with self.subTest(text), self.assertRaises(run_document.Disagreement):
                self.run_text(text)
        with self.assertRaises(ZeroDivisionError):
            self.run_text('```python\n1 / 0\n```\n')

    def test_numbers_may_differ_a_little(self):
        self.run_text('```python\nprint("a  1.04 and 20.9, 7")\n```\n\n```text\na 1.03 and 20.0, 7\n```\n')

    def test_update_writes_what_is_printed(self):
        text = 'before\n\n```python\nprint(2)\n```\n\n```text\n1\n```\n\nafter\n'
        self.assertEqual(self.run_text(text, update=True), (1, text.replace('\n1\n', '\n2\n')))


if __name__ == '__main__':
    unittest.main()
