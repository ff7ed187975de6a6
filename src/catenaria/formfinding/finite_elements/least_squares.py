"""SciPy's least squares with the types that it does not state, run until nothing changes any more."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray
from scipy import optimize  # pyright: ignore[reportMissingTypeStubs]

FloatArray = NDArray[np.float64]
Function = Callable[[FloatArray], FloatArray]

_PRECISION = 1e-10  # relative, of all parameters together: some tenths of a nanometre each


def least_squares(error: Function, derivative: Function, first: FloatArray) -> tuple[FloatArray, int]:
    """Return the parameters for which the sum of squared errors is least, and the number of iterations.

    Parameters
    ----------
    error, derivative : callable
        Errors, shape (m,), and their derivatives by the parameters, shape (m, n).
    first : FloatArray, shape (n,)
        First guess.

    Examples
    --------
    >>> x, _ = least_squares(lambda x: x - 3.0, lambda x: np.eye(1), np.array([1.0]))
    >>> x.round(9)
    array([3.])

    References
    ----------
    Branch, Coleman & Li 1999, SIAM J. Sci. Comput. 21, 1-23 (the trust-region reflective algorithm).
    """
    found = cast(
        "Any",
        optimize.least_squares(  # pyright: ignore[reportUnknownMemberType]
            error, first, derivative, xtol=_PRECISION, ftol=None, gtol=None
        ),
    )
    return np.asarray(found.x, dtype=np.float64), int(found.nfev)
