"""Kinds of trees: as many as their generating functions say, each with a name and a drawing of its own."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from itertools import pairwise

import pytest

from orderconds import families
from orderconds.derivation import derive
from orderconds.errors import UnknownName
from orderconds.explain import kinds
from orderconds.explain.diagram import Diagram, Vertex, action, plain
from orderconds.explain.lines import ASCII, UNICODE, Style, draw
from orderconds.explain.svg import lay_out, sheet
from orderconds.series.action_trees import Velocity

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


@pytest.mark.parametrize("name", sorted(set(kinds.KINDS) - {"free", "essential", "directed", "alternating"}))
def test_different_rooted_trees_name_different_functions(name: str) -> None:
    kind = kinds.get(name)
    for order in ORDERS:
        named = [kind.names(member) for member in kind.members(order)]
        assert len(set(named)) == len(named)


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


def test_names_known_from_books() -> None:
    named = {name: kinds.get(name) for name in kinds.KINDS}
    # HLW III.1, Table 1.1
    assert [*map(named["rooted"].names, named["rooted"].members(4))] == [
        "f'(f'(f'(f)))",
        "f'(f''(f, f))",
        "f''(f'(f), f)",
        "f'''(f, f, f)",
    ]
    # The terms of the modified Hamiltonian of symplectic Euler, HLW IX.3
    assert sorted(map(named["directed"].names, named["directed"].members(3))) == [
        "H_pp(H_q, H_q)",
        "H_q(H_qp(H_p))",
        "H_qq(H_p, H_p)",
    ]


def test_layouts_keep_neighbours_apart_and_parents_above_the_middle() -> None:
    def placed(layout: object, x: float, level: int) -> list[tuple[int, float]]:
        found = [(level, x)]
        for child in layout.below:  # type: ignore[attr-defined]
            found += placed(child, x + child.x, level + 1)
        if layout.below:  # type: ignore[attr-defined]
            ends = layout.below[0].x + layout.below[-1].x  # type: ignore[attr-defined]
            assert ends == pytest.approx(0, abs=1e-12)
        return found

    for tree in kinds.get("ordered").members(7):
        at = sorted(placed(lay_out(plain(tree)[0]), 0.0, 0))
        pairs = pairwise(at)
        assert all(x + 1 <= y + 1e-9 for (level, x), (other, y) in pairs if level == other)


def test_the_place_of_a_force_in_a_word_is_drawn() -> None:
    def notes(tree: Velocity) -> list[str]:
        return [line for line in draw(action(tree), ASCII) if "*" in line]

    trees = {str(tree): tree for tree in kinds.get("action").members(3)}
    assert notes(trees["o(|f(o *))"]) == ["+<o (>*)"]
    assert notes(trees["o(|f(* o))"]) == ["+<o (*>)"]


def test_an_svg_sheet_is_the_same_text_each_time_and_escapes_captions() -> None:
    entries = [(plain(b"\0\1"), ["<f>"]), ((Vertex("dot"),), [])]
    assert sheet(entries) == sheet(entries)
    assert "&lt;f&gt;" in sheet(entries)
    assert "nan" not in sheet([])


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
