"""noise.py: how often it takes noise for a difference, and whether it finds known ones."""
import json
import random
import sys
import unittest
from itertools import combinations, product

from support import ROOT, SCRIPTS, FolderTest

sys.path.insert(0, str(SCRIPTS / "reporting"))
import noise  # noqa: E402
import bench_rows  # noqa: E402
from bench_rows import Row, read_bench  # noqa: E402
from compare_revisions import means  # noqa: E402


def noisy(generator):
    """A time with skewed noise of about 1 %, and now and then a burst of other load."""
    return generator.lognormvariate(0.0, 0.01) * (1 + generator.expovariate(5) * (generator.random() < 0.1))


class UnpairedTest(unittest.TestCase):
    def test_equal_sides_differ_in_at_most_one_case_of_a_hundred(self):
        for n, m in ((5, 5), (3, 9), (5, 9), (6, 7)):  # in each order that chance may give, once
            every = set(range(n + m))
            claims = [noise.order(some, tuple(every - set(some))) for some in combinations(sorted(every), n)]
            self.assertLessEqual(sum(map(abs, claims)), noise.LEVEL * len(claims), (n, m))
            self.assertGreater(sum(map(abs, claims)), 0, (n, m))
            if n == m:
                self.assertEqual(sum(claims), 0)

    def test_the_test_uses_its_level(self):
        every = set(range(14))
        claims = [noise.order(some, tuple(every - set(some))) for some in combinations(range(14), 7)]
        self.assertGreater(sum(map(abs, claims)), 0.006 * len(claims), "a stricter test finds less")

    def test_signs_and_outliers(self):
        self.assertEqual(noise.order([1, 2, 3, 4, 5], [6, 7, 8, 9, 10]), -1)
        self.assertEqual(noise.order([6, 7, 8, 9, 10], [1, 2, 3, 4, 5]), 1)
        self.assertEqual(noise.order([1, 2, 3, 4, 6.5], [6, 7, 8, 9, 10]), 0)
        # One repetition in nine that others slowed down hides nothing.
        self.assertEqual(noise.order([*range(8), 99], list(range(10, 19))), -1)

    def test_ties_count_against_a_claim(self):
        self.assertEqual(noise.order([1, 2, 3, 4, 5], [5, 6, 7, 8, 9]), 0)
        self.assertEqual(noise.order([1.0] * 9, [1.0] * 9), 0)

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
        self.assertTrue(all(abs(end - 1.01) < 1e-9 for end in bench_rows.gained_interval(slow, fast)))
        self.assertAlmostEqual(bench_rows.gained(slow, fast), 1.01)
        slow.times_ms.pop()
        self.assertEqual(bench_rows.order(fast, slow), -1, "of the rounds that timed both")
        self.assertAlmostEqual(bench_rows.gained(slow, fast), 1.01)
        self.assertEqual(bench_rows.order(*rows(False)), 0, "shuffled repetitions")
        self.assertLess(bench_rows.gained_interval(*rows(False))[0], 0.9)

    def test_rows_that_were_repeated_in_each_round_are_paired(self):
        entries = [{"name": f"tiled/{n}/threads:1", "real_time": 1.0, "time_unit": "ms"} for n in (9, 1) for _ in range(n)]
        for context, rounds in (({"rounds": "9"}, [True, False]), ({}, [False, False])):
            path = self.file("run.json", json.dumps({"context": context, "benchmarks": entries}))
            self.assertEqual([row.rounds for row in read_bench(path).rows.values()], rounds)

    def test_shuffled_repetitions_must_not_be_paired(self):
        """A drift of the machine that both rows share: the rank-sum test is right, pairs would not be."""
        generator, cases = random.Random(4), 1000
        claims = {noise.order: 0, noise.paired_order: 0}
        for _ in range(cases):
            before, after = ([(1 + 0.2 * moment) * noisy(generator) for moment in sorted(generator.random() for _ in range(9))] for _ in "ab")
            for judge in claims:
                claims[judge] += judge(before, after) != 0
        self.assertLessEqual(claims[noise.order], 0.015 * cases)
        self.assertGreater(claims[noise.paired_order], 0.1 * cases)


class FamilyTest(unittest.TestCase):
    def test_a_claim_needs_more_the_more_others_are_made(self):
        self.assertEqual(noise.family([(1, 0.009), (-1, 0.5)]), [0, 0], "above half of the level")
        self.assertEqual(noise.family([(1, 0.009), (-1, 0.004)]), [1, -1], "the second needs the whole level")
        self.assertEqual(noise.family([(1, 0.002), (1, 0.009), (-1, 0.006)]), [1, 0, 0], "none after the first that fails")
        self.assertEqual(noise.family([]), [])
        self.assertEqual([noise.fewest_rounds(noise.LEVEL / rows) for rows in (1, 2, 8)], [8, 9, 11])

    def test_any_false_claim_is_rare_among_many(self):
        generator, cases = random.Random(6), 300

        def claims():
            return [noise.paired_claim(*([noisy(generator) for _ in range(16)] for _ in "ab")) for _ in range(20)]

        families = [claims() for _ in range(cases)]
        self.assertLessEqual(sum(any(noise.family(of)) for of in families), 0.02 * cases)
        self.assertGreater(sum(any(p <= noise.LEVEL for _, p in of) for of in families), 0.1 * cases, "each judged alone")


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
        self.assertEqual(noise.interval(values), noise.interval(list(values)))
        low, high = noise.interval(values)
        self.assertTrue(min(values) < low < noise.median(values) < high < max(values))
        self.assertEqual(noise.interval(values[:5]), (values[0], values[4]))

    def test_ratios_have_the_direction_of_their_names(self):
        low, high = noise.ratio_interval([1.0, 1.1, 1.2, 1.05, 1.15], [2.0, 2.2, 2.4, 2.1, 2.3])
        self.assertLess(low, 2.0)
        self.assertGreater(high, 2.0)
        self.assertGreater(low, 1.6)
        self.assertEqual(noise.ratios([1.0, 2.0], [3.0, 1.0]), [3.0, 0.5])

    def test_each_backend_has_a_mean_and_so_have_all(self):
        rows = {"tiled/a": 1.0, "tiled+frontend/b": 4.0, "bands+edges/a": 0.5, "scanline+frontend/a": 1.25, "naive/a": 0.8}
        self.assertEqual(means(rows), "Geometric means of the ratios: bands+edges 0.500, naive 0.800, scanline 1.250, tiled 2.000, all 1.149")


if __name__ == "__main__":
    unittest.main()
