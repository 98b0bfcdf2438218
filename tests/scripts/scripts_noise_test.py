"""noise.py: how often it takes noise for a difference, and whether it finds known ones."""
import json
import random
import unittest
from itertools import combinations, product

from support import ROOT, FolderTest
import noise
import bench_rows
from bench_rows import Row, read_bench


def noisy(generator):
    """A time with skewed noise of about 1 %, and now and then a burst of other load."""
    return generator.lognormvariate(0.0, 0.01) * (1 + generator.expovariate(5) * (generator.random() < 0.1))


class UnpairedTest(unittest.TestCase):
    def test_equal_sides_differ_in_at_most_one_case_of_a_hundred(self):
        for n, m, least in ((5, 5, 0), (3, 9, 0), (5, 9, 0), (6, 7, 0), (7, 7, 0.006)):  # in each order that chance may give, once
            every = set(range(n + m))
            claims = [noise.order(some, tuple(every - set(some))) for some in combinations(sorted(every), n)]
            self.assertLessEqual(sum(map(abs, claims)), noise.LEVEL * len(claims), (n, m))
            self.assertGreater(sum(map(abs, claims)), least * len(claims), (n, m, "a stricter test finds less"))
            self.assertTrue(n != m or sum(claims) == 0)

    def test_signs_outliers_and_ties_that_count_against_a_claim(self):
        for a, b, order in (([1, 2, 3, 4, 5], [6, 7, 8, 9, 10], -1), ([1, 2, 3, 4, 6.5], [6, 7, 8, 9, 10], 0), ([*range(8), 99], [*range(10, 19)], -1),
                            ([1, 2, 3, 4, 5], [5, 6, 7, 8, 9], 0), ([1.0] * 9, [1.0] * 9, 0)):
            self.assertEqual((noise.order(a, b), noise.order(b, a)), (order, -order))

    def test_few_repetitions_settle_only_a_gap(self):
        for n, m in ((3, 3), (1, 5), (2, 9), (4, 5)):
            self.assertFalse(noise.enough(n, m))
            for factor, settled in ((1.9, 0), (2.1, 1)):
                self.assertEqual(noise.order([factor] * n, [1.0] * m), settled, (n, m))
                self.assertEqual(noise.order([1.0] * m, [factor] * n), -settled, (n, m))
        self.assertTrue(noise.enough(5, 5) and noise.enough(3, 9))
        self.assertEqual(noise.order([9.0], [1.0]), 0, "one repetition each settles nothing")

    def test_noise_seldom_makes_a_gap_between_few_repetitions(self):
        """The assumption behind GAP, on the repetitions of the results."""
        generator, cases = random.Random(1), {(1, 2): [], (1, 4): [], (2, 2): [], (2, 3): []}
        for bench in ROOT.glob("results/*/bench.json"):
            for row in read_bench(bench).rows.values():
                for (n, m), claims in cases.items():
                    if n + m <= len(row.times_ms):
                        some = generator.sample(row.times_ms, n + m)
                        claims.append(noise.order(some[:n], some[n:]))
        for sizes, claims in cases.items():
            self.assertGreater(len(claims), 500, sizes)
            self.assertLessEqual(sum(map(abs, claims)), noise.LEVEL * len(claims), sizes)


class PairedTest(FolderTest):
    def test_equal_sides_differ_in_at_most_one_case_of_a_hundred(self):
        for rounds in (8, 11):  # with each choice of signs, once
            claims = [noise.paired_order([1.0] * rounds, [1.01 ** (sign * rank) for rank, sign in enumerate(signs, 1)])
                      for signs in product((1, -1), repeat=rounds)]
            self.assertLessEqual(sum(map(abs, claims)), noise.LEVEL * len(claims))
            self.assertEqual(sum(claims), 0)
            self.assertGreater(sum(map(abs, claims)), 0.004 * len(claims))

    def test_noise_is_no_difference_and_two_per_cent_are_one(self):
        """With bursts, with a drift of 20 % that both sides share, and with 40 rounds."""
        generator, cases = random.Random(2), 1000

        def claims(slowdown):
            for _ in range(cases):
                drift = [1 + 0.2 * i / 40 for i in range(40)]
                before, after = ([d * factor * noisy(generator) for d in drift] for factor in (1.0, slowdown))
                yield noise.paired_order(before, after)

        self.assertLessEqual(sum(map(abs, claims(1.0))), 0.015 * cases)  # 0.01 and the error of so few cases
        found = list(claims(1.02))
        self.assertGreater(found.count(1), 0.9 * cases)
        self.assertNotIn(-1, found)

    def test_one_side_of_every_round_decides(self):
        times = [1.0 + i / 10 for i in range(8)]
        slower = [1.001 * time for time in times]
        self.assertEqual((noise.paired_order(times, slower), noise.paired_order(slower, times)), (1, -1))
        self.assertEqual(noise.paired_order(times, times), 0)
        self.assertEqual(noise.paired_order([1.0] * 8, [1.01] * 7 + [1.0]), 0, "an equal round counts against the claim")
        # Two contradictions of the same size have the higher ranks of that size.
        self.assertEqual(noise.paired_order([1.0] * 12, [2.0] * 10 + [0.5] * 2), 0)

    def test_few_rounds_are_judged_as_repetitions(self):
        self.assertEqual(noise.fewest_rounds(), 8)
        self.assertEqual(noise.paired_order([1.0, 1.1, 1.2, 1.3, 1.4], [1.5, 1.6, 1.7, 1.8, 1.9]), 1)
        self.assertEqual(noise.paired_order([1.0, 1.1, 1.2, 1.3, 1.4], [1.1, 1.2, 1.3, 1.4, 1.5]), 0)

    def test_only_rounds_are_paired(self):
        drift = [1.0 + i / 10 for i in range(11)]

        def rows(rounds):
            return [Row("", "", False, "", {}, [factor * d for d in drift], rounds=rounds) for factor in (1.0, 1.01)]

        fast, slow = rows(True)
        self.assertEqual((bench_rows.order(fast, slow), bench_rows.order(slow, fast)), (-1, 1))
        self.assertAlmostEqual(bench_rows.gained(slow, fast), 1.01)
        slow.times_ms.pop()
        self.assertEqual(bench_rows.order(fast, slow), -1, "of the rounds that timed both")
        self.assertAlmostEqual(bench_rows.gained(slow, fast), 1.01)
        self.assertEqual(bench_rows.order(*rows(False)), 0, "shuffled repetitions")

    def test_rows_that_were_repeated_in_each_round_are_paired(self):
        entries = [{"name": f"tiled/{n}/threads:1", "real_time": 1.0, "time_unit": "ms"} for n in (9, 1) for _ in range(n)]
        for context, rounds in (({"rounds": "9"}, [True, False]), ({}, [False, False])):
            path = self.file("run.json", json.dumps({"context": context, "benchmarks": entries}))
            self.assertEqual([row.rounds for row in read_bench(path).rows.values()], rounds)


class FamilyTest(unittest.TestCase):
    def test_a_claim_needs_more_the_more_others_are_made(self):
        self.assertEqual(noise.family([(1, 0.009), (-1, 0.5)]), [0, 0], "above half of the level")
        self.assertEqual(noise.family([(1, 0.009), (-1, 0.004)]), [1, -1], "the second needs the whole level")
        self.assertEqual(noise.family([(1, 0.002), (1, 0.009), (-1, 0.006)]), [1, 0, 0], "none after the first that fails")
        self.assertEqual(noise.family([]), [])
        self.assertEqual([noise.fewest_rounds(noise.LEVEL / rows) for rows in (1, 2, 8)], [8, 9, 11])


class IntervalTest(unittest.TestCase):
    def test_it_holds_the_median_of_most_samples(self):
        generator = random.Random(3)
        for size, least in ((5, 0.9), (30, 0.92)):
            held = 0
            for _ in range(300):
                low, high = noise.interval([generator.lognormvariate(0.0, 0.1) for _ in range(size)])
                held += low <= 1.0 <= high
            self.assertGreater(held, least * 300)
            self.assertLess(held, 0.995 * 300)

    def test_it_is_the_same_each_time_and_narrows(self):
        values = [1.0 + i * i / 100 for i in range(9)]
        low, high = noise.interval(values)
        self.assertEqual(noise.interval(list(values)), (low, high))
        self.assertTrue(min(values) < low < noise.median(values) < high < max(values))
        self.assertEqual(noise.interval(values[:5]), (values[0], values[4]))
        low, high = noise.ratio_interval([1.0, 1.1, 1.2, 1.05, 1.15], [2.0, 2.2, 2.4, 2.1, 2.3])
        self.assertTrue(1.6 < low < 2 < high, "after over before")


if __name__ == "__main__":
    unittest.main()
