"""Which errors matter: shares of variance, from sensitivities and from samples."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.special import betaincinv  # pyright: ignore[reportMissingTypeStubs, reportUnknownVariableType]

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Mask = NDArray[np.bool_]

_SAMPLES_A_BIN = 40
_MOST_BINS = 64


def variance_parts(slope: FloatArray, deviation: FloatArray) -> FloatArray:
    r"""Return what each independent error contributes to the variances of outputs, shape (n_outputs, m).

    Notes
    -----
    .. math:: \mathrm{Var}\,y_i = \sum_k \left(\frac{\partial y_i}{\partial p_k}\right)^2 \sigma_k^2.
    """
    return slope**2 * deviation**2


def shares(parts: FloatArray, groups: list[Mask]) -> FloatArray:
    """Return the share of each group in the variance of every output, shape (n_groups, n_outputs).

    Where nothing scatters, there is no share.
    """
    total = parts.sum(axis=1)
    grouped = np.array([parts[:, own].sum(axis=1) for own in groups]).reshape(len(groups), total.size)
    return grouped / np.where(total > 0.0, total, 1.0)


def first_order_index(x: FloatArray, y: FloatArray) -> float:
    r"""Return the first-order Sobol index of a scalar x for y from given samples, shape (n,) each.

    Notes
    -----
    Pearson's correlation ratio Var(E[y|x])/Var(y) with equally filled bins of x, corrected for the part of
    the variance of bins' means that is chance, as Kelley (1935) does: with N samples in B bins,

    .. math:: S = 1 - (1 - \eta^2)\frac{N - 1}{N - B}.

    It needs no model of y(x); of a scalar that is made of several errors it is a lower bound of their index.
    """
    n = y.size
    bins = min(max(n // _SAMPLES_A_BIN, 2), _MOST_BINS)
    variance = float(np.var(y))
    if n <= bins or variance == 0.0:
        return 0.0
    sorted_y = y[np.argsort(x, kind="stable")]
    between = sum(part.size * float(part.mean() - y.mean()) ** 2 for part in np.array_split(sorted_y, bins))
    eta = between / (n * variance)
    return float(np.clip(1.0 - (1.0 - eta) * (n - 1) / (n - bins), 0.0, 1.0))


def rank_correlation(x: FloatArray, y: FloatArray) -> float:
    """Return Spearman's coefficient of samples without ties, shape (n,) each; 0 where one is constant."""
    if x.size < 2 or np.ptp(x) == 0.0 or np.ptp(y) == 0.0:
        return 0.0
    ranks = [np.argsort(np.argsort(values, kind="stable")) - 0.5 * (x.size - 1) for values in (x, y)]
    return float(ranks[0] @ ranks[1] / (ranks[0] @ ranks[0]))


def confidence_limits(count: IntArray, samples: int, level: float = 0.95) -> tuple[FloatArray, FloatArray]:
    """Return the limits of probabilities of which `count` of `samples` cases were seen.

    References
    ----------
    Clopper & Pearson 1934, Biometrika 26, 404-413.

    Examples
    --------
    >>> lower, upper = confidence_limits(np.array([0, 5, 10]), 10)
    >>> lower.round(3), upper.round(3)
    (array([0.   , 0.187, 0.692]), array([0.308, 0.813, 1.   ]))
    """
    k, tail = count.astype(np.float64), 0.5 * (1.0 - level)
    some, not_all = k > 0, k < samples
    low = betaincinv(np.where(some, k, 1.0), np.where(some, samples - k + 1.0, 1.0), tail)
    high = betaincinv(np.where(not_all, k + 1.0, 1.0), np.where(not_all, samples - k, 1.0), 1.0 - tail)
    return np.where(some, low, 0.0), np.where(not_all, high, 1.0)
