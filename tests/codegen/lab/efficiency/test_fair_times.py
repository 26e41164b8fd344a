"""All sides of a comparison are timed by one protocol: emitted methods with equal steps and with step-size
control, in diagrams and in races, and other integrators."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest

from benchmarks.decades import PeerRacer
from codegen import scenes
from codegen.emitter import compile_method
from codegen.lab.efficiency import adaptive_candidate, emitted_candidate, peer_candidate, race
from codegen.lab.efficiency.adaptive_candidate import AdaptiveCandidate
from codegen.lab.efficiency.candidates import Recipe
from codegen.lab.efficiency.emitted_candidate import EmittedCandidate
from codegen.lab.efficiency.equations import Equations
from codegen.lab.efficiency.peer_candidate import PeerCandidate
from codegen.lab.efficiency.race import Racer, entry
from codegen.lab.peers import PEERS, find, installed
from codegen.lab.reference import cached_reference
from codegen.lab.timing import Overhead
from codegen.lower import families_for
from codegen.method import parse

Run = Callable[[int], int]
SCENE = scenes.load("free_rigid_body")
EXACT = cached_reference(SCENE)
METHOD = parse("ambient:dormand_prince5", families_for(SCENE))


def racer(adaptive: bool) -> Racer:
    method = replace(METHOD, adaptive=adaptive)
    recipe = Recipe(METHOD.label, 5, 7, METHOD.name, adaptive)
    return Racer(Equations(SCENE), EXACT, entry(recipe, compile_method(SCENE, method)))


def raced(made: Racer, control: float) -> None:
    made.error(control)
    made.seconds(control)


SIDES: dict[str, Callable[[], object]] = {
    "equal steps": lambda: EmittedCandidate(SCENE, METHOD, EXACT).measure(8.0),
    "step-size control": lambda: AdaptiveCandidate(SCENE, METHOD, EXACT).measure(1e-4),
    "race with equal steps": lambda: raced(racer(False), 8.0),
    "race with step-size control": lambda: raced(racer(True), 4.0),
    "c-dop853": lambda: PeerCandidate(SCENE, find(["c-dop853"])[0], EXACT).measure(1e-4),
    "c-rk4-projected": lambda: PeerCandidate(SCENE, find(["c-rk4-projected"])[0], EXACT).measure(8.0),
    "race of a peer": lambda: raced(
        PeerRacer(Equations(SCENE), EXACT, racer(True).entry, peer=find(["c-dop853"])[0]), 4.0
    ),
}


@pytest.fixture
def calls(monkeypatch: pytest.MonkeyPatch) -> list[tuple[Run, Overhead, tuple[float, ...]]]:
    """The arguments of all calls of the timing protocol, which is replaced by a constant."""
    made: list[tuple[Run, Overhead, tuple[float, ...]]] = []

    def span_times(run: Run, overhead: Overhead, *options: float) -> list[float]:
        made.append((run, overhead, options))
        return [1e-6, 2e-6]

    for module in (emitted_candidate, adaptive_candidate, peer_candidate, race):
        monkeypatch.setattr(module, "span_times", span_times)
    return made


@pytest.mark.parametrize("side", SIDES)
def test_each_side_is_timed_over_any_number_of_spans_without_the_overhead_of_a_call(
    side: str, calls: list[tuple[Run, Overhead, tuple[float, ...]]]
) -> None:
    SIDES[side]()
    ((run, overhead, _),) = calls
    assert overhead.idle is not None
    overhead.idle()
    assert run(0) == 0  # an empty run is the overhead of a call
    one, four = run(1), run(4)
    assert 1 <= one < four <= 4 * one  # the first step of a run with step-size control is short


def test_all_races_use_the_same_batches(calls: list[tuple[Run, Overhead, tuple[float, ...]]]) -> None:
    for side, run in SIDES.items():
        if side.startswith("race"):
            run()
    assert len({options for _, _, options in calls}) == 1
    assert PeerRacer.seconds is Racer.seconds


@pytest.mark.parametrize("name", [n for n in PEERS if not n.startswith("diffrax")])
def test_a_peer_integrates_over_several_spans(name: str) -> None:
    if not installed(name):
        pytest.skip(f"{name} is not installed")
    (peer,) = find([name])
    long = replace(SCENE, span=(SCENE.span[0], 2 * SCENE.span[1] - SCENE.span[0]))
    control = 40.0 if peer.controlled == "steps" else 1e-8
    twice = peer.prepare(SCENE, control).run(2)
    once = peer.prepare(long, 2 * control if peer.controlled == "steps" else control).run()
    assert twice.state == pytest.approx(once.state, rel=1e-9)
    assert twice.steps == once.steps
