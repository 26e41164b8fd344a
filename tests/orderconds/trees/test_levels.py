"""Level sequences: texts, density, symmetry, roots."""

import pytest

from orderconds.errors import InputError
from orderconds.trees.levels import children, parse, rooted_at_new_vertex, text
from orderconds.trees.ordered import ordered_forests


def test_adding_and_removing_a_root_are_inverse():
    for forest in ordered_forests(6):
        assert b"".join(children(rooted_at_new_vertex(forest))) == forest


@pytest.mark.parametrize("vertices", range(8))
def test_brackets_are_read_as_they_are_written(vertices):
    for forest in ordered_forests(vertices):
        assert parse(text(forest)) == forest


@pytest.mark.parametrize("written", ["[", "]", "[]", "[.", ".]", "[[.]", "a", "[.]]", "." * 2000])
def test_anything_but_balanced_brackets_is_refused(written):
    with pytest.raises(InputError):
        parse(written)
