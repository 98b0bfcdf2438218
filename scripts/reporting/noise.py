"""The one rule for noise: whether two timings differ, and the interval of a figure.

`order` judges unpaired repetitions, such as the rows of two runs. It is the exact rank-sum test (Mann and Whitney, "On a
test of whether one of two random variables is stochastically larger than the other", 1947). `paired_order` judges rounds in
which each side ran once. It is the exact signed-rank test (Wilcoxon, "Individual comparisons by ranking methods", 1945) on
the logarithms of the rounds' ratios. Both count ties against the claim.

Guarantee: if neither side is faster, a test claims a difference in at most LEVEL of all cases. `order` needs repetitions
that are exchangeable, `paired_order` rounds that are independent of one another. Neither needs a normal distribution. `family`
gives the same guarantee for several claims together.

Pairs too small for the rank-sum test to reach LEVEL count as different only across a gap of GAP. This assumes that noise
seldom doubles a time, which a unit test checks against the repetitions in results/.
"""
import math
import random
import statistics
from functools import cache
from itertools import accumulate, count

LEVEL = 0.01  # of false alarms
CONFIDENCE = 0.95  # of intervals
GAP = 2.0
# The machine drifts between runs at different times, so smaller changes of a median are not reported.
DRIFT = 0.03
RESAMPLES = 2000

median = statistics.median


def chances(counts):
    """Two-sided p-value of each value of a statistic; `counts`: the number of equally probable cases with each value."""
    total = sum(counts)
    return [min(1.0, 2 * cases / total) for cases in accumulate(counts)]


@cache
def chances_of_pairs(n, m):
    """The p-value by how many of the n·m pairs of repetitions, one of each side, the faster side fails to win."""
    counts = [1] + [0] * (n * m)  # by generating functions: the product of (1 - q^(m+i)) / (1 - q^i) for i up to n
    for i in range(1, n + 1):
        for lost in range(n * m, m + i - 1, -1):
            counts[lost] -= counts[lost - m - i]
        for lost in range(i, n * m + 1):
            counts[lost] += counts[lost - i]
    return chances(counts)


@cache
def chances_of_ranks(rounds):
    """The p-value by the sum of the ranks of the rounds that contradict the claim."""
    counts = [1]
    for rank in range(1, rounds + 1):
        counts = [a + b for a, b in zip(counts + [0] * rank, [0] * rank + counts)]
    return chances(counts)


def enough(n, m):
    """Whether the rank-sum test can settle so many repetitions."""
    return chances_of_pairs(n, m)[0] <= LEVEL


def claim(a, b):
    """(-1 if the times `a` are shorter than `b`, 1 if longer; the p-value of that claim)"""
    n, m = len(a), len(b)
    if not enough(n, m):
        gap = 0 if n + m < 3 else (max(b) * GAP < min(a)) - (max(a) * GAP < min(b))
        return gap, 0.0 if gap else 1.0
    won = sum(x < y for x in a for y in b)
    lost = sum(x > y for x in a for y in b)
    return (-1 if won > lost else 1), chances_of_pairs(n, m)[n * m - max(won, lost)]


def order(a, b):
    """-1 if the times `a` are shorter than `b`, 1 if longer, 0 if too close to call."""
    return settled(*claim(a, b))


def settled(sign, p):
    return sign if p <= LEVEL else 0


def ratios(before, after):
    """Of each round: the time after over the time before."""
    return [b / a for a, b in zip(before, after, strict=True)]


def paired_claim(before, after):
    """claim() that `after` is the shorter of two lists of times of the same rounds, or the longer. Fewer rounds than the
    signed-rank test needs are judged as repetitions."""
    if len(before) < fewest_rounds():
        return claim(after, before)
    logs = [math.log(ratio) for ratio in ratios(before, after)]

    def against(sign):
        """The ranks of the rounds that contradict sign * log > 0. Of equal distances from 0, they have the higher ranks."""
        ranked = sorted((sign * log for log in logs), key=lambda log: (abs(log), log <= 0))
        return sum(rank for rank, log in enumerate(ranked, 1) if log <= 0)

    lost, sign = min((against(1), 1), (against(-1), -1))
    return sign, chances_of_ranks(len(logs))[lost]


def paired_order(before, after):
    """-1 if `after` is the shorter, 1 if the longer, 0 if too close to call."""
    return settled(*paired_claim(before, after))


@cache
def fewest_rounds(level=LEVEL):
    """The fewest rounds that can settle a pair."""
    return next(rounds for rounds in count(1) if chances_of_ranks(rounds)[0] <= level)


def family(claims):
    """The orders of claims that are made together: the chance that any of them is false is at most LEVEL. (Holm, "A simple
    sequentially rejective multiple test procedure", 1979)"""
    orders = [0] * len(claims)
    for rank, i in enumerate(sorted(range(len(claims)), key=lambda i: claims[i][1])):
        sign, p = claims[i]
        if p > LEVEL / (len(claims) - rank):
            break
        orders[i] = sign
    return orders


def middle_of(figures):
    """The interval that leaves out equally many of the figures at both ends, CONFIDENCE within."""
    ordered = sorted(figures)
    outside = int(len(ordered) * (1 - CONFIDENCE) / 2)
    return ordered[outside], ordered[-1 - outside]


def median_ratio(before, after, are_rounds):
    """The median of the rounds' ratios, or the ratio of unpaired repetitions' medians."""
    return median(ratios(before, after)) if are_rounds else median(after) / median(before)


@cache
def bootstrap(*lists):
    """The interval of the median of the first list, or of its ratio to the second one's: the same each time."""
    generator = random.Random(1)
    return middle_of([ratio_of([median(generator.choices(values, k=len(values))) for values in lists]) for _ in range(RESAMPLES)])


def ratio_of(medians):
    return medians[0] / medians[1] if medians[1:] else medians[0]


def interval(values):
    """The bootstrap interval of the median; with up to five repetitions, from the fastest to the slowest."""
    return bootstrap(tuple(values))


def ratio_interval(before, after, are_rounds=False):
    """The bootstrap interval of median_ratio()."""
    return interval(ratios(before, after)) if are_rounds else bootstrap(tuple(after), tuple(before))
