# SPDX-License-Identifier: Apache-2.0
"""How sure a number from few repetitions is: Student's t on logarithms.

All that is told (errors, efficiencies, ratios) is positive and varies by factors, so its logarithm is nearer to
normal than itself, and no interval reaches below 0. Percentiles of a bootstrap are too narrow here: of five
repetitions they hold the truth clearly less often than they promise."""
import math

import numpy as np

CONFIDENCE = .95
FEWEST_FOR_MEDIAN = 6  # whose ends hold it that surely


def t_quantile(freedom):
    """The t with P(|T| < t) = CONFIDENCE. T = sqrt(freedom) tan(A), and A has the density cos(A)^(freedom - 1)."""
    angle = np.linspace(0, np.pi / 2, 20001)
    density = np.cos(angle) ** (freedom - 1)
    below = np.concatenate([[0], np.cumsum(density[1:] + density[:-1])])
    return float(np.sqrt(freedom) * np.tan(np.interp(CONFIDENCE, below / below[-1], angle)))


def _around(value, deviations):
    """The value with the interval that its logarithm has; `deviations` of the repetitions from it have mean 0."""
    count = len(deviations)
    if count < 2: return {"value": float(value), "ci": None}
    half = t_quantile(count - 1) * np.std(deviations, ddof=1) / np.sqrt(count)
    return {"value": float(value), "ci": [float(value * np.exp(-half)), float(value * np.exp(half))]}


def mean(samples):
    """The arithmetic mean, as squared errors are to be averaged. The logarithm of a mean differs by the samples'
    relative differences, to first order."""
    samples = np.asarray(samples, float)
    middle = samples.mean()
    return _around(middle, samples / middle - 1) if middle > 0 else {"value": float(middle), "ci": None}


def efficiency(errors, seconds):
    """1 / (mean error x mean time)."""
    errors, seconds = np.asarray(errors, float), np.asarray(seconds, float)
    return _around(1 / (errors.mean() * seconds.mean()), errors / errors.mean() + seconds / seconds.mean() - 2)


def ratio_of_pairs(base, other):
    """How many times cheaper `other` is: the geometric mean over pairs of cost(base) / cost(other)."""
    logarithms = np.log(np.asarray(base, float) / np.asarray(other, float))
    middle = logarithms.mean()
    return {**_around(np.exp(middle), logarithms - middle), "pairs": len(logarithms)}


def median(samples):
    """The median, with the interval between two order statistics that holds it whatever the distribution is."""
    ordered, n = sorted(map(float, samples)), len(samples)
    if n < FEWEST_FOR_MEDIAN: return {"value": float(np.median(ordered)), "ci": None}
    below, outside = 0, 2 * .5 ** n
    while outside + 2 * math.comb(n, below + 1) * .5 ** n <= 1 - CONFIDENCE:
        below += 1
        outside += 2 * math.comb(n, below) * .5 ** n
    return {"value": float(np.median(ordered)), "ci": [ordered[below], ordered[n - 1 - below]]}
