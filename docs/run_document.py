#!/usr/bin/env python3
"""run_document.py DOCUMENT URL FOLDER [--update]: runs the commands of a document in order, as its reader would.

Blocks marked sh run in bash and those marked python in one session, in FOLDER, where the sources' samples, client and build must be found;
http://127.0.0.1:8080 stands for URL. What a block prints must be what the text block behind it says: the words the same, the numbers
within a tenth or two units of their last digit, as processors differ. --update writes what is printed into the document instead.
"""
import contextlib
import io
import os
import re
import subprocess
import sys

BLOCK = re.compile(r'^```(sh|python)\n(.*?)^```\n(?:\n```text\n(.*?)^```\n)?', re.MULTILINE | re.DOTALL)
NUMBER = re.compile(r'-?\d+(?:\.\d+)?')


class Disagreement(Exception):
    """A document says something else than what happens."""


def run_block(kind, code, session):
    if kind == 'sh':
        done = subprocess.run(['bash', '-euc', code], capture_output=True, text=True)
        if done.returncode != 0:
            raise Disagreement(f'{code}\nended with {done.returncode}: {done.stderr}')
        return done.stdout
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(code, '<document>', 'exec'), session)
    return printed.getvalue()


def agrees(said, printed):
    """Whether two texts have the same words, and numbers that are nearly the same."""
    def words(text):
        return NUMBER.sub('#', re.sub(r'[ \t]+', ' ', text)).strip()
    if words(said) != words(printed):
        return False
    for a, b in zip(NUMBER.findall(said), NUMBER.findall(printed)):
        unit = 10.0 ** -len(a.partition('.')[2])
        if '.' not in a and a != b or abs(float(a) - float(b)) > max(0.1 * abs(float(a)), 2 * unit):
            return False
    return True


def run(document, url, update=False, kinds=('sh', 'python')):
    """Runs the blocks of these kinds in the current folder. Returns how many there were. Raises Disagreement."""
    with open(document) as file:
        text = file.read()
    session = {'__name__': '__main__'}
    count = 0

    def replaced(match):
        nonlocal count
        kind, code, said = match.groups()
        if kind not in kinds:
            return match.group(0)
        count += 1
        printed = run_block(kind, code.replace('http://127.0.0.1:8080', url), session)
        if update or said is None:
            return match.group(0) if said is None else match.group(0)[:match.start(3) - match.start(0)] + printed + '```\n'
        if not agrees(said, printed):
            raise Disagreement(f'{code}\nis said to print\n{said}\nand printed\n{printed}')
        return match.group(0)

    result = BLOCK.sub(replaced, text)
    if update:
        with open(document, 'w') as file:
            file.write(result)
    return count


if __name__ == '__main__':
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    path = os.path.abspath(sys.argv[1])
    os.chdir(sys.argv[3])
    sys.path.insert(0, os.path.abspath('client/python'))
    print(run(path, sys.argv[2].rstrip('/'), '--update' in sys.argv), 'blocks ran')
