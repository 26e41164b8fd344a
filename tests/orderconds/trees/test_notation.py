import pytest

from orderconds.errors import InputError
from orderconds.trees.levels import parse, text
from orderconds.trees.ordered import ordered_forests


@pytest.mark.parametrize("vertices", range(8))
def test_brackets_are_read_as_they_are_written(vertices):
    for forest in ordered_forests(vertices):
        assert parse(text(forest)) == forest


@pytest.mark.parametrize("written", ["[", "]", "[]", "[.", ".]", "[[.]", "a", "[.]]", "." * 2000])
def test_anything_but_balanced_brackets_is_refused(written):
    with pytest.raises(InputError):
        parse(written)
