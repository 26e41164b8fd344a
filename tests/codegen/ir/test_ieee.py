"""Functions of doubles: where Python's functions raise an exception, the value is that of C."""

from __future__ import annotations

import math

import pytest

from codegen.ir.domain import FloatDomain
from codegen.ir.ieee import OVERFLOWING, UNDEFINED, divided, ieee
from codegen.snippets.graph import needed

VALUES = (-math.inf, -1e3, -1.5, -0.0, 0.0, 0.5, 1e3, 1e300, math.inf, math.nan)


def same(a: float, b: float) -> bool:
    return a == b or (math.isnan(a) and math.isnan(b))


@pytest.mark.parametrize("name", [*OVERFLOWING, *UNDEFINED])
def test_the_domain_and_the_helpers_have_the_values_of_numpy(name: str) -> None:
    import numpy as np

    names = {"acos": "arccos", "asin": "arcsin"}
    namespace = dict(vars(math))
    for text in needed("python", [f"ieee_{name}"]).texts:
        exec(text, namespace)
    for x in VALUES:
        with np.errstate(all="ignore"):
            expected = float(getattr(np, names.get(name, name))(x))
        if math.isfinite(expected):
            expected = getattr(math, name)(x)
        for value in (ieee(name, x), FloatDomain(0.0).call(name, x), namespace[f"_{name}"](x)):
            assert same(value, expected)


def test_a_division_by_zero_has_the_value_of_numpy() -> None:
    import numpy as np

    namespace = dict(vars(math))
    for text in needed("python", ["divided"]).texts:
        exec(text, namespace)
    for a in VALUES:
        for b in VALUES:
            with np.errstate(all="ignore"):
                expected = float(np.float64(a) / np.float64(b))
            assert same(divided(a, b), expected)
            assert same(namespace["_divided"](a, b), expected)


def test_stumpff_functions_of_large_negative_numbers_are_infinite() -> None:
    namespace = dict(vars(math))
    for text in needed("python", [f"signed_stumpff{k}" for k in range(4)]).texts:
        exec(text, namespace)
    for k in range(4):
        assert FloatDomain(0.0).call(f"signed_stumpff{k}", -1e7) == math.inf
        assert namespace[f"signed_stumpff{k}"](-1e7) == math.inf
