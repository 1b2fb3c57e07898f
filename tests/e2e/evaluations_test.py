"""POST /evaluations: the same figures as the command, under load and on large shapes too."""
import json
import subprocess
import unittest

import support


class EvaluationsTest(support.TestCase):
    def setUp(self):
        self.place = self.directory()
        for name, seed in (('a', 0.0), ('b', 1.0)):
            with open(f'{self.place}/{name}.off', 'wb') as file:
                file.write(support.off(support.bumpy(3, seed)))
        self.server = self.serve(self.place + '/s.db')
        self.a, self.b = (self.server.ready(support.off(support.bumpy(3, seed)), name=name) for name, seed in (('a', 0.0), ('b', 1.0)))

    def evaluate(self, query='', **members):
        body = json.dumps({'src': self.a, 'tgt': self.b, **members}).encode()
        return self.server.request('POST', '/evaluations' + query, body)

    def test_the_command_measures_the_same(self):
        answer = self.evaluate(truth='identity')
        self.assertEqual(answer.status, 200, answer.body)
        served = json.loads(answer.body)
        done = subprocess.run([support.CLI, 'evaluate', 'a.off', 'b.off', '--store', 'cli.db', '--json', '-'], cwd=self.place,
                              capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        printed = json.loads(done.stdout)
        for name in set(printed) - {'src', 'tgt', 'seconds'}:
            self.assertEqual(served[name], printed[name], name)
        self.assertEqual(set(served) - set(printed), {'orientation', 'cached'})
        self.assertLess(served['geodesic']['mean'], 0.1)
        self.assertGreater(served['coverage']['area'], 0.95)
        self.assertLess(served['bijectivity']['median'], 0.02)

    def test_a_perfect_and_a_flipped_match(self):
        itself = json.loads(self.evaluate(tgt=self.a, truth='identity').body)
        self.assertLess(itself['geodesic']['p95'], 0.01)
        self.assertLess(itself['symmetric_integral'], 0.01)
        self.assertEqual(itself['continuity']['torn'], 0)
        every = list(range(642))
        turned = every[321:] + every[:321]
        flipped = json.loads(self.evaluate(tgt=self.a, truth={'source': every, 'target': turned, 'mirrored': every}).body)
        self.assertIs(flipped['flipped'], True)

    def test_the_match_is_kept_and_shared(self):
        self.assertFalse(json.loads(self.evaluate().body)['cached'])
        again = self.evaluate()
        self.assertTrue(json.loads(again.body)['cached'])
        self.assertIn('cache;desc=memory', again.headers['Server-Timing'])
        match = self.server.request('GET', f'/match?src={self.a}&tgt={self.b}&both=yes&fields=')
        self.assertTrue(json.loads(match.body)['cached'])

    def test_the_next_best_match_can_be_measured(self):
        best, next_best = (json.loads(self.evaluate(truth='identity', candidate=candidate).body) for candidate in (0, 1))
        self.assertLess(best['geodesic']['mean'], next_best['geodesic']['mean'])

    def test_refusals(self):
        for body, code, status in ((b'', 'invalid-parameter', 400), (b'[', 'invalid-parameter', 400), (b'[' * 100, 'invalid-parameter', 400),
                                   (json.dumps({'src': self.a, 'tgt': '0' * 32}).encode(), 'not-found', 404),
                                   (json.dumps({'src': self.a, 'tgt': self.b, 'truth': [1]}).encode(), 'length-mismatch', 422)):
            response = self.server.request('POST', '/evaluations', body)
            self.assertEqual((response.status, json.loads(response.body)['code']), (status, code))
            self.assertEqual(response.headers['Content-Type'], 'application/problem+json')


if __name__ == '__main__':
    unittest.main()
