"""Lower bounds of the number of brackets: never above what a program has, sharp where the count is known."""

from random import Random

import pytest

from orderconds.ring import QQ
from orderconds.series.bracket_bounds import beyond_lie, least_brackets, newest_factors
from orderconds.series.graded import GradedAlgebra

GRADES = (1, 2, 3, 3, 4)
Q = [{(n,): QQ.one} for n in range(len(GRADES))]


def arguments_of_a_random_program(algebra, random):
    """Return the arguments and the number of brackets: each sums what is there when it is due."""

    def combination(pool):
        scaled = [(QQ.rational(random.choice((-2, -1, 0, 0, 1, 3))), x) for x in pool]
        return algebra.combine(*scaled)

    pool, arguments, count = [], [], 0
    for n in range(len(GRADES) + 1):
        for _ in range(random.choice((0, 0, 1, 1, 2)) if n > 1 else 0):
            pool.append(algebra.bracket(combination(pool), combination(pool)))
            count += 1
        cut = algebra.largest - (n < len(GRADES))
        arguments.append(algebra.cut(combination(pool), cut))
        if n < len(GRADES):
            pool.append(Q[n])
    return arguments, count


@pytest.mark.parametrize("seed", range(60))
def test_no_program_has_fewer_brackets_than_the_bound(seed):
    algebra = GradedAlgebra(QQ, GRADES, 6)
    arguments, count = arguments_of_a_random_program(algebra, Random(seed))
    assert least_brackets(algebra, arguments) <= count


def test_a_bracket_in_a_bracket_takes_two_and_one_bracket_one():
    algebra = GradedAlgebra(QQ, GRADES, 6)
    single = algebra.bracket(Q[0], algebra.combine((QQ.one, Q[1]), (QQ.rational(3), Q[2])))
    nested = algebra.bracket(Q[0], single)
    filler = [{}, {}, {}, {}]
    assert least_brackets(algebra, [*filler, {}, single]) == 1
    assert least_brackets(algebra, [*filler, {}, nested]) == 2
    assert least_brackets(algebra, [*filler, single, nested]) == 2
    assert least_brackets(algebra, [*filler, {}, {}]) == 0


def test_independent_arguments_in_the_same_letters_take_a_bracket_each():
    algebra = GradedAlgebra(QQ, GRADES, 6)
    several = [algebra.bracket(Q[0], Q[1]), algebra.bracket(Q[0], Q[2]), algebra.bracket(Q[1], Q[2])]
    assert least_brackets(algebra, [{}, {}, {}, *several]) == 3
    assert least_brackets(algebra, [{}, {}, {}, several[1], several[1], several[1]]) == 1


def test_what_stages_hold_beyond_their_grade_is_not_counted():
    algebra = GradedAlgebra(QQ, GRADES, 6)
    high = algebra.bracket(Q[1], Q[4])
    assert least_brackets(algebra, [{}, {}, {}, {}, {}, high]) == 1
    assert least_brackets(algebra, [{}, {}, {}, {}, high, {}]) == 0


def test_only_sums_of_brackets_are_lie_elements():
    algebra = GradedAlgebra(QQ, GRADES, 6)
    assert beyond_lie(algebra, algebra.bracket(Q[0], algebra.bracket(Q[0], Q[1]))) == {}
    assert beyond_lie(algebra, {(0, 0): QQ.one}) == {(0, 0): QQ.one}
    product = algebra.multiply(Q[0], Q[1])
    half = QQ.rational(1, 2)
    assert beyond_lie(algebra, product) == {(0, 1): half, (1, 0): half}


def test_factors_of_a_letter_are_read_off_what_stands_before_it():
    algebra = GradedAlgebra(QQ, GRADES, 6)
    x = algebra.bracket(Q[0], algebra.bracket(Q[1], Q[2]))
    assert newest_factors(x, 2) == {2: {(0, 1): QQ.one}}
    assert newest_factors(x, 1) == {}
