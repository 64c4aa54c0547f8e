"""Curves through points: the harmonics of a period, and cubics with given slopes."""

import numpy as np


def series(values, theta):
    """The harmonics that pass through values at equal steps of a period, at phases theta.

    `values` may have further axes after the first, theta is a list of phases.
    """
    values = np.asarray(values, dtype=float)
    coefficients = np.fft.rfft(values, axis=0) / len(values)
    orders = np.arange(len(coefficients))
    weights = np.where(orders == 0, 1.0, 2.0)
    return np.real(np.tensordot(np.exp(1j * np.outer(theta, orders)) * weights, coefficients, axes=1))


def three_point_slopes(x, y):
    """dy/dx at every point from the parabola through it and its neighbours; of two points, their line."""
    if len(x) < 3:
        return np.full(len(x), (y[-1] - y[0]) / (x[-1] - x[0]) if len(x) == 2 else 0.0)
    return np.gradient(y, x, edge_order=2)


def hermite(x, y, slopes, at):
    """Value and slope, at points inside [x_0, x_n], of the piecewise cubic with these values and slopes; x rises."""
    cell = np.clip(np.searchsorted(x, at, side="right") - 1, 0, len(x) - 2)
    length = x[cell + 1] - x[cell]
    t = (at - x[cell]) / length
    left, right = slopes[cell] * length, slopes[cell + 1] * length
    rise = y[cell + 1] - y[cell]
    square, cube = left + right - 2.0 * rise, 3.0 * rise - 2.0 * left - right
    value = y[cell] + t * (left + t * (cube + t * square))
    return value, (left + t * (2.0 * cube + t * 3.0 * square)) / length
