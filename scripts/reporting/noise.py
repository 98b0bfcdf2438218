"""The one rule for noise: whether two timings differ, and the interval of a figure.

`claim` judges unpaired repetitions, such as the rows of two runs, by the exact rank-sum test (Mann and Whitney, "On a test of
whether one of two random variables is stochastically larger than the other", 1947). It judges rounds in which each side ran
once by the exact signed-rank test (Wilcoxon, "Individual comparisons by ranking methods", 1945) on the logarithms of the
rounds' ratios. Both count ties against the claim.

Guarantee: if neither side is faster, a claim is `settled` in at most LEVEL of all cases. The rank-sum test needs repetitions
that are exchangeable, the signed-rank test rounds that are independent of one another. Neither needs a normal distribution.
`family` gives the same guarantee for several claims together.

Pairs too small for the rank-sum test to reach LEVEL count as different only across a gap of GAP. This assumes that noise
seldom doubles a time, which a unit test checks against the repetitions in results/.
"""
import math
import random
from functools import cache, reduce
from operator import truediv
from statistics import median

LEVEL = 0.01  # of false alarms
CONFIDENCE = 0.95  # of intervals
GAP = 2.0
# The machine drifts between runs at different times, so smaller changes of a median are not reported.
DRIFT = 0.03
RESAMPLES = 2000


def p_value(cases, value):
    """Two-sided. `cases`: in how many equally probable cases the statistic is 0, 1, …"""
    return min(1.0, 2 * sum(cases[:value + 1]) / sum(cases))


@cache
def orders(n, m):
    """In how many orders of n + m repetitions the side with n loses 0, 1, … n·m of the pairs of one repetition of each side."""
    cases = [1] + [0] * (n * m)  # by generating functions: the product of (1 - q^(m+i)) / (1 - q^i) for i up to n
    for i in range(1, n + 1):
        for lost in range(n * m, m + i - 1, -1):
            cases[lost] -= cases[lost - m - i]
        for lost in range(i, n * m + 1):
            cases[lost] += cases[lost - i]
    return cases


@cache
def signs(rounds):
    """In how many choices of signs the ranks of the negative rounds add up to 0, 1, …"""
    cases = [1]
    for rank in range(1, rounds + 1):
        cases = [a + b for a, b in zip(cases + [0] * rank, [0] * rank + cases)]
    return cases


def rank_sum(before, after):
    n, m = len(before), len(after)
    if p_value(orders(n, m), 0) > LEVEL:
        gap = 0 if n + m < 3 else (max(before) * GAP < min(after)) - (max(after) * GAP < min(before))
        return gap, 0.0 if gap else 1.0
    longer = sum(x < y for x in before for y in after)
    shorter = sum(x > y for x in before for y in after)
    return (-1 if shorter > longer else 1), p_value(orders(n, m), n * m - max(shorter, longer))


def ratios(before, after):
    """Of each round: the time after over the time before."""
    return [b / a for a, b in zip(before, after, strict=True)]


def signed_rank(before, after):
    logs = [math.log(ratio) for ratio in ratios(before, after)]

    def against(sign):
        """The ranks of the rounds that contradict sign * log > 0. Of equal distances from 0, they have the higher ranks."""
        ranked = sorted((sign * log for log in logs), key=lambda log: (abs(log), log <= 0))
        return sum(rank for rank, log in enumerate(ranked, 1) if log <= 0)

    lost, sign = min((against(1), 1), (against(-1), -1))
    return sign, p_value(signs(len(logs)), lost)


def claim(before, after, are_rounds):
    """(-1 if the times `after` are the shorter ones, 1 if the longer; the p-value of that claim). Fewer rounds than the signed-rank test
    needs are judged as repetitions."""
    return (signed_rank if are_rounds and len(before) >= fewest_rounds() else rank_sum)(before, after)


def settled(sign, p):
    """The sign of a claim, or 0 if it is too close to call."""
    return sign if p <= LEVEL else 0


def fewest_rounds(level=LEVEL):
    """The fewest rounds that can settle a pair: all have the same sign, which has a p-value of 2 / 2^rounds."""
    return math.ceil(1 - math.log2(level))


def family(claims):
    """The settled() signs of claims that are made together: the chance that any of them is false is at most LEVEL. (Holm, "A simple
    sequentially rejective multiple test procedure", 1979)"""
    found = [0] * len(claims)
    for rank, i in enumerate(sorted(range(len(claims)), key=lambda i: claims[i][1])):
        sign, p = claims[i]
        if p > LEVEL / (len(claims) - rank):
            break
        found[i] = sign
    return found


def median_ratio(before, after, are_rounds):
    """The median of the rounds' ratios, or the ratio of unpaired repetitions' medians."""
    return median(ratios(before, after)) if are_rounds else median(after) / median(before)


@cache
def bootstrap(*lists):
    """The interval of the median of the first list, or of its ratio to the second one's: the same each time."""
    generator = random.Random(1)
    found = sorted(reduce(truediv, [median(generator.choices(values, k=len(values))) for values in lists]) for _ in range(RESAMPLES))
    outside = int(RESAMPLES * (1 - CONFIDENCE) / 2)  # at each end
    return found[outside], found[-1 - outside]


def interval(values):
    """The bootstrap interval of the median; with up to five repetitions, from the fastest to the slowest."""
    return bootstrap(tuple(values))


def ratio_interval(before, after, are_rounds=False):
    """The bootstrap interval of median_ratio()."""
    return interval(ratios(before, after)) if are_rounds else bootstrap(tuple(after), tuple(before))
