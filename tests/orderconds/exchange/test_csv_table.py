"""CSV: one array a line, and plain Butcher tableaux as people write them."""

from __future__ import annotations

import pytest

from orderconds import Tableau
from orderconds.errors import InputError, TableauError
from orderconds.exchange import export, read_data
from orderconds.tableau import find
from orderconds.tableau.record import from_data
from orderconds.tableau.write import as_data


def test_a_plain_butcher_table() -> None:
    text = "0,0,0\n1/2,1/2,0\n,0,1\n,1,0\n"
    data = read_data(text.encode(), "csv", "heun.csv")
    tableau = from_data(data)
    assert (
        tableau.method
        == Tableau.loads('name = "t"\nfamily = "rk"\nA = [[], ["1/2"]]\nb = ["0", "1"]\n').method
    )
    assert tableau.embedded is not None
    assert tableau.embedded.order == 1


def test_the_order_of_embedded_weights_is_computed_where_a_table_states_none() -> None:
    source = Tableau.load(find("bogacki_shampine3"))
    lines = export(as_data(source), "csv").decode().splitlines()
    rows = [line.partition(",")[2] for line in lines if line.startswith("A,")]
    weights = [
        line.partition(",")[2] for key in ("b,", "embedded_b,") for line in lines if line.startswith(key)
    ]
    nodes = [source.ring.text(c) for c in source.abelian().c]
    plain = [f"{c},{row}" for c, row in zip(nodes, rows, strict=True)] + [f",{row}" for row in weights]
    data = read_data("\n".join(plain).encode(), "csv", "x.csv")
    assert data["embedded"]["order"] == 2
    assert from_data(data).embedded == source.embedded


def test_a_plain_table_whose_nodes_are_not_row_sums_is_refused() -> None:
    with pytest.raises(InputError, match="c_2 = 1/3, but the sum of row 2 of A is 1/2"):
        from_data(read_data(b"0,0,0\n1/3,1/2,0\n,0,1\n", "csv", "x.csv"))


def test_a_number_beyond_the_last_stage_is_no_blank() -> None:
    with pytest.raises(TableauError, match="3 entries"):
        from_data(read_data(b"0,0\n1/2,1/2,,1\n,0,1\n", "csv", "x.csv"))


def test_a_matrix_takes_a_line_a_row_and_names_may_come_in_any_order() -> None:
    text = b"b,1/2,1/2\nname,heun\nA,0,0\nA,1,0\n"
    assert read_data(text, "csv", "x.csv") == {
        "name": "heun",
        "family": "rk",
        "A": [["0", "0"], ["1", "0"]],
        "b": ["1/2", "1/2"],
    }


HEUN = b"0,0,0\n1,1,0\n,1/2,1/2\n"
SAME = {
    "semicolons": HEUN.replace(b",", b";"),
    "tabs": HEUN.replace(b",", b"\t"),
    "a comment": b"# Heun, 1900\n% its method\n" + HEUN + b"  # the end\n",
    "a header": b"c,a1,a2\n" + HEUN,
    "a header of words": b"node,first,second\n" + HEUN,
    "a header with semicolons": b"c;a_1;a_2\r\n" + HEUN.replace(b",", b";").replace(b"\n", b"\r\n"),
    "a mark of the byte order": b"\xef\xbb\xbf" + HEUN,
    "weights with a name": HEUN.replace(b"\n,", b"\nb,"),
    "blanks": HEUN.replace(b",", b" , "),
    "no name": b"# named arrays\nA;0;0\nA;1;0\nb;1/2;1/2\n",
}


@pytest.mark.parametrize("form", SAME)
def test_delimiters_comments_and_headers_do_not_change_a_table(form: str) -> None:
    tableau = from_data(read_data(SAME[form], "csv", "heun.csv"))
    assert tableau.method == from_data(read_data(HEUN, "csv", "heun.csv")).method


def test_a_claim_with_semicolons_does_not_change_the_delimiter() -> None:
    data = read_data(HEUN + b"claims,rk=2; explicit=true\n", "csv", "heun.csv")
    assert data["claims"] == {"rk": 2, "explicit": True}


def test_a_row_of_c_is_no_header() -> None:
    assert read_data(b"c,0,1\nA,0,0\nA,1,0\nb,1/2,1/2\n", "csv", "x.csv")["c"] == ["0", "1"]


def test_three_rows_of_weights_are_refused() -> None:
    with pytest.raises(InputError, match="3 rows of weights"):
        read_data(b"0,0\n,1\n,1\n,1\n", "csv", "x.csv")


@pytest.mark.parametrize("name", ["b", "order"])
def test_a_second_row_with_the_same_name_is_refused(name: str) -> None:
    with pytest.raises(InputError, match=f"two rows begin with {name}; expected one row"):
        read_data(
            b"A,0\nb,1\nb,1\norder,1\n" if name == "b" else b"A,0\nb,1\norder,1\norder,1\n", "csv", "x.csv"
        )
