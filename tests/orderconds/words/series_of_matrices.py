"""Power series in h whose coefficients are square matrices over Q: where identities between words are tried.

A series is the list of its coefficients of h^0, h^1, ..., all of one length.
"""

from __future__ import annotations

import random
from fractions import Fraction
from math import factorial

from flint import fmpq, fmpq_mat

SIZE = 3


def zero():
    return fmpq_mat(SIZE, SIZE)


def identity():
    return fmpq_mat(SIZE, SIZE, [fmpq(i == j) for i in range(SIZE) for j in range(SIZE)])


def random_matrix(numbers: random.Random):
    return fmpq_mat(SIZE, SIZE, [fmpq(numbers.randint(-3, 3), numbers.randint(1, 3)) for _ in range(SIZE**2)])


def rational(q: Fraction):
    return fmpq(q.numerator, q.denominator)


def one(order):
    return [identity(), *(zero() for _ in range(order))]


def multiply(x, y):
    return [sum((x[k] * y[n - k] for k in range(n + 1)), zero()) for n in range(len(x))]


def add(x, y, scale=Fraction(1)):
    return [a + b * rational(scale) for a, b in zip(x, y, strict=True)]


def exponential(x):
    result, power = one(len(x) - 1), one(len(x) - 1)
    for n in range(1, len(x)):
        power = multiply(power, x)
        result = add(result, power, Fraction(1, factorial(n)))
    return result


def inverse(x):
    """1/x for x with the identity as its first coefficient."""
    result, rest = one(len(x) - 1), add(one(len(x) - 1), x, Fraction(-1))
    for _ in range(1, len(x)):
        result = add(one(len(x) - 1), multiply(rest, result))
    return result


def flow(fields, order):
    """Y with Y' = (X_1 + h X_2 + h^2 X_3 + ...) Y and Y(0) = 1, by its recurrence."""
    result = [identity()]
    for n in range(1, order + 1):
        terms = (fields[k - 1] * result[n - k] for k in range(1, min(n, len(fields)) + 1))
        result.append(sum(terms, zero()) * fmpq(1, n))
    return result


def of_words(series, fields, order):
    """Put X_k h^k for letter k in words in the order of action; fields that are missing vanish."""
    result = [zero() for _ in range(order + 1)]
    for word, value in series.items():
        if sum(word) <= order and max(word) <= len(fields):
            matrix = identity()
            for letter in word:
                matrix = fields[letter - 1] * matrix
            result[sum(word)] += matrix * rational(value)
    return result


def of_bracket(bracket, letters):
    """The matrix of a bracket of letters."""
    if not isinstance(bracket, tuple):
        return letters[bracket]
    x, y = of_bracket(bracket[0], letters), of_bracket(bracket[1], letters)
    return x * y - y * x
