"""What tests of exchange draw from: coefficients in the grammar of tableau files."""

from __future__ import annotations

from hypothesis import strategies as st

COEFFICIENTS = st.one_of(
    st.fractions(min_value=-9, max_value=9, max_denominator=40).map(str),
    st.sampled_from(
        [
            "sqrt(2)",
            "1/4 - sqrt(3)/6",
            "1/(2 - 2^(1/3))",
            "-sqrt(3)/6",
            "(1 + sqrt(5))^(1/3)",
            "2^(-1/3)",
            "3^(-2)",
            "-(1 - sqrt(2))*(3/4)/5",
            "0.125",
            "-0.333333~",
            "0.3333333333333333~",
            "1 - 2 - 3",
            "1/2/3",
            "2*(1/3)*sqrt(6)/4 - (-1)",
        ]
    ),
)
"""Rational numbers, radicals, exact and rounded decimals, and chains of operations."""
