"""Extreme input finds no undefined behaviour: the cases of ``stability`` under the sanitizers."""

from __future__ import annotations

import math
import subprocess

import pytest

from codegen import scenes
from codegen.build import compile_files, find_compiler
from codegen.emitter import compile_method
from codegen.lab.default_methods import methods_for
from codegen.lab.runner import Emitted
from codegen.lab.stability.extreme_steps import cases
from tests.promises import SANITIZE


def number(x: float) -> str:
    return repr(x) if math.isfinite(x) else "NAN" if math.isnan(x) else "INFINITY" if x > 0 else "-INFINITY"


def program(made, emission) -> str:
    """Return a program that makes one step and a run of three for each case."""
    interface = emission.manifest["interface"]
    prefix, size = interface["prefix"], interface["size"]
    lines = [
        f'#include "{prefix.rstrip("_")}.h"',
        "#include <math.h>",
        "int main(void)",
        "{",
        "    int kinds = 0;",
    ]
    statistics = ["NULL"] if interface["blocks"] else []
    for case in cases(made):
        time = [number(case.t)] if interface["time"] else []
        arguments = ["state", *time, number(case.h)]
        lines += ["    {", f"        double state[{size}] = {{{', '.join(map(number, case.state))}}};"]
        lines += [f"        kinds |= 1 << {prefix}step({', '.join([*arguments, *statistics])});"]
        run = [*arguments, "3", "NULL", "0", *statistics, "NULL"]
        lines += [f"        kinds |= 1 << {prefix}run({', '.join(run)});", "    }"]
    return "\n".join([*lines, "    return kinds == 0;", "}", ""])


QUICK = [("dipole", "vcg:midpoint"), ("stiff_driven_spin", "cf:cf4")]


def sanitised(scene, method, folder):
    made = compile_method(scene, method)
    emission = Emitted(made, "c").artifact
    files = {**emission.files, "main.c": program(made, emission)}
    compile_files(files, folder, folder / "main", SANITIZE, find_compiler())
    done = subprocess.run([folder / "main"], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize(("scene", "method"), QUICK)
def test_extreme_steps_are_clean(scene, method, tmp_path):
    sanitised(scene, method, tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("scene", scenes.GALLERY)
def test_all_extreme_steps_are_clean(scene, tmp_path):
    for number, method in enumerate(methods_for(scenes.load(scene))):
        folder = tmp_path / str(number)
        folder.mkdir()
        sanitised(scene, method, folder)
