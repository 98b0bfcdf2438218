"""noise.py: how often it takes noise for a difference, and whether it finds known ones."""
import json
import random
import unittest
from itertools import combinations, product

from support import ROOT, FolderTest
import bench_rows
import noise
from bench_rows import Row, read_bench


def order(a, b, rounds=False):
    """Of repetitions, or of rounds."""
    return bench_rows.order(*(Row("", "", "", {}, list(times), rounds=rounds) for times in (a, b)))


class NoiseTest(FolderTest):
    def test_equal_sides_differ_in_at_most_one_case_of_a_hundred(self):
        """Each order of repetitions that chance may give, and each choice of the rounds' signs, once."""
        cases = {(n, m, least): [order(some, set(range(n + m)) - set(some)) for some in combinations(range(n + m), n)]
                 for n, m, least in ((5, 5, 0), (3, 9, 0), (5, 9, 0), (6, 7, 0), (7, 7, 0.006))}
        cases |= {(rounds, rounds, 0.004): [order([1.01 ** (sign * rank) for rank, sign in enumerate(signs, 1)], [1.0] * rounds, True)
                                            for signs in product((1, -1), repeat=rounds)] for rounds in (8, 11)}
        for (n, m, least), claims in cases.items():
            self.assertLessEqual(sum(map(abs, claims)), noise.LEVEL * len(claims), (n, m))
            self.assertGreater(sum(map(abs, claims)), least * len(claims), (n, m, "a stricter test finds less"))
            self.assertTrue(n != m or sum(claims) == 0)

    def assert_orders(self, *cases, rounds=False):
        for a, b, sign in cases:
            self.assertEqual((order(a, b, rounds), order(b, a, rounds)), (sign, -sign), (a, b))

    def test_signs_outliers_and_ties_that_count_against_a_claim(self):
        self.assert_orders(([1, 2, 3, 4, 5], [6, 7, 8, 9, 10], -1), ([1, 2, 3, 4, 6.5], [6, 7, 8, 9, 10], 0),
                           ([*range(8), 99], [*range(10, 19)], -1), ([1, 2, 3, 4, 5], [5, 6, 7, 8, 9], 0), ([1.0] * 9, [1.0] * 9, 0))

    def test_few_repetitions_settle_only_a_gap(self):
        for n, m in ((3, 3), (1, 5), (2, 9), (4, 5)):
            self.assert_orders(([1.9] * n, [1.0] * m, 0), ([2.1] * n, [1.0] * m, 1))
        self.assertEqual(order([9.0], [1.0]), 0, "one repetition each settles nothing")

    def test_noise_seldom_makes_a_gap_between_few_repetitions(self):
        """The assumption behind GAP, on the repetitions of the results."""
        generator, cases = random.Random(1), {(1, 2): [], (1, 4): [], (2, 2): [], (2, 3): []}
        for bench in ROOT.glob("results/*/bench.json"):
            for row in read_bench(bench).rows.values():
                for (n, m), claims in cases.items():
                    if n + m <= len(row.times_ms):
                        some = generator.sample(row.times_ms, n + m)
                        claims.append(order(some[:n], some[n:]))
        for sizes, claims in cases.items():
            self.assertGreater(len(claims), 500, sizes)
            self.assertLessEqual(sum(map(abs, claims)), noise.LEVEL * len(claims), sizes)

    def test_one_side_of_every_round_decides(self):
        drift = [1.0 + i / 10 for i in range(11)]
        slower = [1.01 * time for time in drift]
        self.assert_orders((drift, slower, -1), (drift, drift, 0), (drift, slower[:-1], -1),  # of the rounds that timed both
                           ([1.01] * 7 + [1.0], [1.0] * 8, 0),  # an equal round counts against the claim
                           ([2.0] * 10 + [0.5] * 2, [1.0] * 12, 0),  # two contradictions have the higher ranks of rounds of the same size
                           (drift[:5], slower[:5], 0), (drift[:5], drift[5:10], -1), rounds=True)  # few rounds are judged as repetitions
        self.assertEqual(order(drift, slower), 0, "shuffled repetitions")

    def test_rows_that_were_repeated_in_each_round_are_paired(self):
        entries = [{"name": f"tiled/{n}/threads:1", "real_time": 1.0, "time_unit": "ms"} for n in (9, 1) for _ in range(n)]
        for context, rounds in (({"rounds": "9"}, [True, False]), ({}, [False, False])):
            path = self.file("run.json", json.dumps({"context": context, "benchmarks": entries}))
            self.assertEqual([row.rounds for row in read_bench(path).rows.values()], rounds)

    def test_a_claim_needs_more_the_more_others_are_made(self):
        self.assertEqual(noise.family([(1, 0.009), (-1, 0.5)]), [0, 0], "above half of the level")
        self.assertEqual(noise.family([(1, 0.009), (-1, 0.004)]), [1, -1], "the second needs the whole level")
        self.assertEqual(noise.family([(1, 0.002), (1, 0.009), (-1, 0.006)]), [1, 0, 0], "none after the first that fails")
        self.assertEqual([noise.fewest_rounds(noise.LEVEL / rows) for rows in (1, 2, 8)], [8, 9, 11])

    def test_an_interval_holds_the_median_of_most_samples(self):
        generator = random.Random(3)
        for size, least in ((5, 0.9), (30, 0.92)):
            intervals = [noise.interval([generator.lognormvariate(0.0, 0.1) for _ in range(size)]) for _ in range(300)]
            held = sum(low <= 1.0 <= high for low, high in intervals) / 300
            self.assertTrue(least < held < 0.995, held)

    def test_an_interval_is_that_of_the_median_or_of_a_ratio(self):
        values = [1.0 + i * i / 100 for i in range(9)]
        low, high = noise.interval(values)
        self.assertTrue(min(values) < low < noise.median(values) < high < max(values))
        self.assertEqual(noise.interval(values[:5]), (values[0], values[4]))
        low, high = noise.ratio_interval([1.0, 1.1, 1.2, 1.05, 1.15], [2.0, 2.2, 2.4, 2.1, 2.3])
        self.assertTrue(1.6 < low < 2 < high, "after over before")


if __name__ == "__main__":
    unittest.main()
