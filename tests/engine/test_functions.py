"""The functions of a formula: the same names for arrays and for plain floats."""

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from hodograph.engine.functions import ARRAYS, PLAIN, horner


@pytest.mark.parametrize("name", [*ARRAYS._fields])
def test_one_name_one_function(name):
    arguments = (0.3, 0.7) if name in ("minimum", "maximum") else (0.3,)
    plain = getattr(PLAIN, name)(*arguments)
    assert type(plain) is float
    assert plain == pytest.approx(getattr(ARRAYS, name)(*arguments), rel=2e-16)


@pytest.mark.parametrize("coefficients", [(2.0, -1.0), (0.3, 1.5, -0.7, 2.0)])
def test_horner(coefficients):
    x = np.linspace(-1, 2, 7)
    np.testing.assert_allclose(horner(coefficients, x), Polynomial(coefficients)(x), rtol=1e-14)
    assert horner(coefficients, 0.5) == pytest.approx(Polynomial(coefficients)(0.5), rel=1e-15)
    assert x[0] == -1  # left as it was
