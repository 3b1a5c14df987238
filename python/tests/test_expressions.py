"""Expressions: operators and NumPy's functions come to the numbers NumPy comes to."""

import math

import numpy as np
import pytest

import slalom

X, Y = slalom.Expr.symbol("x"), slalom.Expr.symbol("y")
UNARY = ["square", "sqrt", "exp", "log", "sin", "cos", "tan", "arcsin", "arccos", "arctan", "sinh",
         "cosh", "tanh", "absolute", "sign", "negative", "reciprocal", "radians", "exp2", "expm1", "log1p", "log2",
         "log10", "cbrt"]
BINARY = ["hypot", "add", "subtract", "multiply", "divide", "arctan2", "minimum", "maximum", "power"]


def value(expression, x=0.3, y=0.7):
    return expression.evaluate([(X, x), (Y, y)])


@pytest.mark.parametrize("name", UNARY)
def test_numpy_function_of_one(name):
    function = getattr(np, name)
    assert value(function(X)) == pytest.approx(function(0.3), rel=1e-14)


@pytest.mark.parametrize("name", BINARY)
def test_numpy_function_of_two(name):
    function = getattr(np, name)
    assert value(function(X, Y)) == pytest.approx(function(0.3, 0.7), rel=1e-14)
    assert value(function(np.float64(2), Y)) == pytest.approx(function(2, 0.7), rel=1e-14)


@pytest.mark.parametrize("name", [n for n in UNARY if hasattr(slalom, n)])
def test_own_function(name):
    assert value(getattr(slalom, name)(X)) == pytest.approx(getattr(np, name)(0.3), rel=1e-14)


def test_operators_with_numbers_on_either_side():
    assert value((1 - X) * 2 + 3 / Y - X**2 + 2**Y) == pytest.approx(
        0.7 * 2 + 3 / 0.7 - 0.09 + 2**0.7, rel=1e-14)
    assert value(abs(-X)) == 0.3 and value(+X) == 0.3


def test_arrays_of_expressions():
    vector = np.array([X, Y])
    total = np.array([[1.0, 2.0], [3.0, 4.0]]) @ np.sin(vector)
    assert value(total[1]) == pytest.approx(3 * math.sin(0.3) + 4 * math.sin(0.7), rel=1e-14)
    shifted = np.array([1.0, 2.0]) + X
    assert value(shifted[1]) == pytest.approx(2.3)


def test_select_takes_the_branch():
    assert value(slalom.select(X - 0.5, X, Y)) == 0.7


def test_clip():
    for x in (-1.0, 0.3, 2.0):
        assert value(np.clip(X, 0, 1), x) == np.clip(x, 0, 1)
        assert value(np.clip(X, None, 1), x) == min(x, 1)


def test_what_makes_no_sense_is_a_type_error():
    with pytest.raises(TypeError, match="select"):
        bool(X)
    with pytest.raises(TypeError, match="select"):
        np.where(X, 1, 2)
    for compare in (lambda: X < Y, lambda: X <= 2, lambda: 2 >= X, lambda: np.float64(2) > X,
                    lambda: np.less(X, 2), lambda: np.where(X > 0, 1, 2)):
        with pytest.raises(TypeError, match="path.*upper=2"):
            compare()
    with pytest.raises(TypeError, match="floor.*is not known"):
        np.floor(X)
    with pytest.raises(TypeError, match="numpy's functions take it"):
        math.sin(X)
    with pytest.raises(TypeError, match="cubic_spline"):
        np.interp(X, [0, 1], [2, 3])
    with pytest.raises(TypeError):
        X + "1"


def test_a_symbol_left_out_is_named():
    with pytest.raises(slalom.Error, match="y"):
        (X + Y).evaluate([(X, 1)])
