# SPDX-License-Identifier: Apache-2.0
"""What is measured: errors against a reference, bias, efficiency, and how sure they are.

The errors are those of `lampyris compare`. docs/evaluation.md says why each is what it is."""
import numpy as np

METRICS = ("trimmed", "relmse", "mse")
RELATIVE_FLOOR = .01  # of the reference's mean; keeps black pixels from deciding alone
TRIMMED_SHARE = .001
BOOTSTRAPS = 2000
CONFIDENCE = .95
# Below this multiple of the reference's own error a difference says nothing about the image.
LEAST_OVER_FLOOR = 2


def relative_squares(image, reference):
    """Per pixel: mean over the channels of (I - R)^2 / (R^2 + epsilon)."""
    epsilon = (RELATIVE_FLOOR * reference.mean()) ** 2
    if not epsilon > 0: raise ValueError("the reference is black")
    return ((image - reference) ** 2 / (reference ** 2 + epsilon)).mean(axis=2)


def errors(image, reference):
    if image.shape != reference.shape: raise ValueError("images differ in size")
    squares = np.sort(relative_squares(image, reference), axis=None)
    kept = squares.size - int(np.ceil(TRIMMED_SHARE * squares.size))
    return {"mse": float(((image - reference) ** 2).mean()), "relmse": float(squares.mean()),
            "trimmed": float(squares[:kept].mean()) if kept else float(squares.mean())}


def floor_of(halves):
    """The error of the mean of two independent halves, which is half their difference."""
    a, b = halves
    middle = (a + b) / 2
    return errors(a, middle)


def over_floor(error, floor):
    """The part of a squared error that is the image's own; None if the reference is too noisy to tell."""
    return error - floor if error > LEAST_OVER_FLOOR * floor else None


def bias(images, halves):
    """Ratio of the means to the reference's, and by how many standard deviations it differs from 1.

    Pixels are independent, so the variance of a mean is that of its pixels, estimated from repetitions: many
    more degrees of freedom than the means of a few images have. Samplers that spread error as blue noise make
    the true variance smaller, so |z| is if anything too small for them."""
    reference = (halves[0] + halves[1]) / 2
    stack = np.stack([i.mean(axis=2) for i in images])
    ratio = float(stack.mean() / reference.mean())
    if len(images) < 2: return {"ratio": ratio, "z": None}
    pixels = stack[0].size
    variance = stack.var(axis=0, ddof=1).sum() / pixels ** 2 / len(images)
    variance += (((halves[0] - halves[1]).mean(axis=2) / 2) ** 2).sum() / pixels ** 2
    difference = float(stack.mean() - reference.mean())
    if variance > 0: return {"ratio": ratio, "z": difference / float(np.sqrt(variance))}
    return {"ratio": ratio, "z": 0. if difference == 0 else None}


def bootstrap(samples, statistic, seed=1):
    """The statistic of the samples and its percentile interval over resamplings; no interval for fewer than two.

    The last axis of the samples is the runs, and it is over this that the statistic goes."""
    samples = np.asarray(samples, float)
    value, count = float(statistic(samples)), samples.shape[-1]
    if count < 2: return {"value": value, "ci": None}
    drawn = np.random.default_rng(seed).integers(0, count, (BOOTSTRAPS, count))
    tail = 50 * (1 - CONFIDENCE)
    return {"value": value, "ci": [float(v) for v in np.percentile(statistic(samples[..., drawn]), (tail, 100 - tail))]}


def mean(samples):
    return bootstrap(samples, lambda s: s.mean(axis=-1))


def efficiency(error_list, seconds):
    """1 / (mean error x mean time)."""
    return bootstrap([error_list, seconds], lambda s: 1 / s.mean(axis=-1).prod(axis=0))


def ratio_of_pairs(base, other):
    """How many times more efficient `other` is: the median over pairs of cost(base) / cost(other)."""
    ratios = np.asarray(base, float) / np.asarray(other, float)
    return {**bootstrap(ratios, lambda s: np.median(s, axis=-1)), "pairs": len(ratios)}
