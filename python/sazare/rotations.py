"""The rotation that takes points to where they are later, by least squares."""

import numpy as np


def best_rotations(covariance):
    """Rotations (..., 3, 3) for the sums of (after)(before)^T over points (..., 3, 3), each from its own middle; W. Kabsch, Acta Cryst. A32 (1976) 922. Of points in
    a row they are one of those that turn about it."""
    left, _, right = np.linalg.svd(covariance)
    sign = np.sign(np.linalg.det(left @ right))
    left[..., :, 2] *= np.where(sign == 0.0, 1.0, sign)[..., None]
    return left @ right
