"""Kinds of trees: as many as their generating functions say, each with a name and a drawing of its own."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import pytest

from orderconds import families
from orderconds.derivation import derive
from orderconds.errors import UnknownName
from orderconds.explain import kinds
from orderconds.explain.diagram import Diagram
from orderconds.explain.lines import ASCII, UNICODE, Style, draw
from orderconds.explain.svg import sheet

ORDERS = range(1, 6)


@pytest.mark.parametrize("name", kinds.KINDS)
def test_enumerated_and_counted_numbers_agree(name: str) -> None:
    kind = kinds.get(name)
    for order in ORDERS:
        members = list(kind.members(order))
        assert len(members) == kind.count(order)
        assert len({*map(kind.text, members)}) == len(members)


@pytest.mark.parametrize("name", kinds.KINDS)
@pytest.mark.parametrize("style", [ASCII, UNICODE])
def test_different_trees_have_different_drawings(name: str, style: Style) -> None:
    kind = kinds.get(name)
    for order in ORDERS:
        drawings = ["\n".join(draw(kind.diagram(member), style)) for member in kind.members(order)]
        assert len(set(drawings)) == len(drawings)


@pytest.mark.parametrize("name", [name for name in kinds.KINDS if name not in ("graded", "letters")])
def test_a_drawing_has_a_line_and_a_picture_a_mark_for_each_vertex(name: str) -> None:
    kind = kinds.get(name)
    for member in kind.members(4):
        diagram = kind.diagram(member)
        size = sum(vertex.size for vertex in diagram)
        transports = diagram_signs(diagram).count("transport")
        assert size - transports == 4
        assert len(draw(diagram, UNICODE)) == size
        picture = ET.fromstring(sheet([(diagram, [kind.text(member)])]))
        marks = [element.tag.rpartition("}")[2] for element in picture]
        assert marks.count("circle") == size - transports
        assert marks.count("path") == size - len(diagram) + transports


def diagram_signs(diagram: Diagram) -> list[str]:
    return [sign for v in diagram for sign in (v.sign, *diagram_signs(tuple(b.vertex for b in v.branches)))]


@pytest.mark.parametrize("family", [name for name in families.names() if kinds.of_family(name)])
def test_every_condition_names_something(family: str) -> None:
    kind = kinds.of_family(family)
    assert kind is not None
    for condition in derive(family, order=families.get(family).order_bound or 3).conditions:
        assert kind.text(condition.key) == condition.tree
        assert kinds.named_by(condition) == kind.names(condition.key)
        assert kind.names(condition.key).count("(") == kind.names(condition.key).count(")")


@pytest.mark.parametrize("name", kinds.KINDS)
def test_every_member_has_a_condition(name: str) -> None:
    kind = kinds.get(name)
    for order in range(1, 4):
        assert set(kind.members(order)) <= set(kind.conditions(order))


def test_a_misspelt_kind_is_told_the_right_one() -> None:
    with pytest.raises(UnknownName, match="rooted"):
        kinds.get("roted")


def test_lyndon_words_are_drawn_as_their_brackets() -> None:
    kind = kinds.get("letters")
    word = (0, 0, 1)
    assert draw(kind.diagram(word), ASCII) == ["[,]", "+-A", "+-[,]", "  +-A", "  +-B"]
    assert (kind.text(word), kind.names(word)) == ("AAB", "[A, [A, B]]")
    picture = sheet([(kind.diagram(word), [])])
    assert [picture.count(f">{letter}<") for letter in "AB"] == [2, 1]
    assert draw(kind.diagram((1, 0)), ASCII) == ["B", "A"]
