# SPDX-License-Identifier: Apache-2.0
"""What is measured: errors against a reference, and bias.

The errors are those of `lampyris compare`. docs/evaluation.md says why each is what it is."""
import numpy as np

METRICS = ("trimmed", "relmse", "mse")
RELATIVE_FLOOR = .01  # of the reference's mean; keeps black pixels from deciding alone
TRIMMED_SHARE = .001
BLOCK = 8  # pixels; wider than reconstruction filters and the patterns of samplers reach
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


def at_samples(curve, spp, metric):
    """The error at a number of samples, between the points of a curve by a line in log-log; None outside of it."""
    n = [p["spp"] for p in curve]
    if not n or not n[0] <= spp <= n[-1]: return None
    return float(np.exp(np.interp(np.log(spp), np.log(n), np.log([p[metric] for p in curve]))))


def _block_sums(grey):
    """Of the squares of pixels that an image consists of; those at its edges may be smaller."""
    rows = np.add.reduceat(grey, np.arange(0, grey.shape[0], BLOCK), axis=0)
    return np.add.reduceat(rows, np.arange(0, grey.shape[1], BLOCK), axis=1)


def bias(images, halves):
    """Ratio of the means to the reference's, and by how many standard deviations it differs from 1.

    The variance of a mean is that of its blocks of pixels, estimated from repetitions: many more degrees of
    freedom than the means of a few images have. Pixels of a block may depend on each other, as they do by filters
    and by samplers that spread error as blue noise."""
    reference = (halves[0] + halves[1]) / 2
    grey = [i.mean(axis=2) for i in images]
    difference = float(np.mean(grey) - reference.mean())
    ratio = 1 + difference / float(reference.mean())
    if len(images) < 2: return {"ratio": ratio, "z": None}
    variance = np.var([_block_sums(g) for g in grey], axis=0, ddof=1).sum() / len(images)
    variance += (_block_sums((halves[0] - halves[1]).mean(axis=2) / 2) ** 2).sum()
    if variance > 0: return {"ratio": ratio, "z": difference * grey[0].size / float(np.sqrt(variance))}
    return {"ratio": ratio, "z": 0. if difference == 0 else None}
