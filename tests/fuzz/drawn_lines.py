"""Command lines drawn by seeds, over every command and option of the program, and the files they name."""

from __future__ import annotations

import os
from functools import cache
from pathlib import Path
from random import Random

import click

from codegen.scenes import names as scene_names
from orderconds import families
from orderconds.cli import program
from orderconds.exchange import FORMATS
from orderconds.tableau import find
from orderconds.tableau.library import available
from tests.fuzz.mutated_files import drawn as drawn_file
from tests.fuzz.mutated_files import library, written

SCENE = """
from codegen.scene import FieldScene, param
from codegen.groups import SO3, Rotation
G = SO3()
m = G.dual("m")
scene = FieldScene(title="a body", group=G, action=Rotation(), y=m, f=param("rate", 2) * m + m[0] * m,
                   y0=[1, 0, 0], span=(0, 1))
"""

LIST = '[[module]]\nscene = "free_rigid_body"\nmethod = "cf4"\ntargets = ["c", "python"]\n'

JUNK = (
    "",
    " ",
    "-",
    "--",
    "-h",
    "--help",
    "--json",
    "--version",
    "nan",
    "inf",
    "-inf",
    "-1",
    "0",
    "1e400",
    "1e-400",
    "1_0",
    "0x10",
    "9" * 30,
    "9" * 5000,
    "١٢",
    "½",
    "é\u0301",
    "\u202e",
    "\udcff",
    "a\nb",
    "%s%n{}",
    "'",
    '"',
    "\\",
    "*",
    "[" * 300,
    "x" * 300,
    "rk(",
    "rkmk(99999999999)",
    "lambda",
    "__class__",
    "=",
    "a=b=c",
    ":",
    "::",
    ",",
    "None",
    "true",
)
"""Words that mean something elsewhere, or nothing anywhere; none of them is an absolute path."""

READABLE = (*(f"good{suffix}" for _, suffix in FORMATS.values()), "mutated", "proved.toml")
"""Files that hold a tableau; ``mutated`` gets the suffix of its format."""

FILES = (
    *READABLE,
    "good.unknown",
    "empty.toml",
    "pipe.toml",
    "loop.toml",
    "folder",
    "folder/folder",
    "missing.toml",
    "missing/file.toml",
    "good.toml/file",
    "README.md",
    "list.toml",
    "scene.py",
    "raising.py",
    "syntax.py",
    "é \u202e.toml",
    os.devnull,
    "/dev/full",
    "n" * 300,
)

PLACES = (
    "out",
    "out.toml",
    "out.json",
    "folder/out.npz",
    "folder",
    ".",
    "missing/out",
    "good.toml",
    "link.toml",
)
PLACES += ("pipe.toml", "loop.toml", "empty.toml/out", os.devnull, "/dev/full", "n" * 300, "out\n", "é\u202e")

OFTEN = {"execute": 0.05, "output": 0.6, "as_json": 0.3, "explain": 0.3, "explicit": 0.1, "targets": 0.4}
"""How often an option that is not required is drawn."""

TARGETS = ("c", "python", "interpreter")
KINDS = {
    "construct": ("gauss", "radau1a", "radau2a", "lobatto3a", "lobatto3b", "lobatto3c", "lobatto3d"),
    "list": ("families", "tableaux", "groups", "scenes", "actions", "measurements"),
    "trees": (
        "rooted",
        "ordered",
        "forests",
        "lyndon",
        "bicoloured",
        "free",
        "essential",
        "directed",
        "action",
    ),
}
KINDS["trees"] += ("directed-rooted", "alternating", "graded", "letters")
SERIES = ("bch", "symmetric-bch", "magnus", "dexp", "dexpinv")

NAMED = {
    "family": ("rk", "cg", "vcg", "rkmk(1)", "rkmk", "cf", "vcf", "splitting", "composition", "magnus"),
    "target": TARGETS,
    "targets": TARGETS,
    "against": ("c-dop853", "c-rk4-projected", "scipy", "all", "heyoka"),
    "only": ("order", "energy", "timing", "bench", "stability"),
    "steps": ("4,8,16,32", "20,40", "3", "0,0", "1,2,3,4"),
    "precision": ("double", "single", "half"),
    "solver": ("newton", "simplified-newton", "fixed-point", "auto"),
    "frame": ("space", "body"),
    "parameters": ("alpha", "alpha=1/3", "alpha=nan", "alpha=", "=1", "rate=1e999", "rate", "alpha=1/0"),
    "inputs": ("u", "torque", "u=1"),
    "prefix": ("mine_", "9", "int", "a b", "lambda", "é"),
    "fix": ("a21=1/2", "b2=1", "a21=a21", "b1+b2=1", "c2=1/0", "a21=x^64^64", "b1=0.5~"),
    "positive": ("b", "a21", "b9"),
    "size": ("1", "1/2", "0", "-1", "1e9"),
    "dask": ("tcp://127.0.0.1:9", "tls://127.0.0.1:9", "127.0.0.1", "nothing"),
}
"""Values by the name of a parameter."""

WEIGHTS = {"check": 6, "convert": 6, "derive": 4, "refine": 3, "emit": 2, "modified": 3, "solve": 3}
WEIGHTS |= {
    "report": 0.05,
    "bench": 0.05,
    "stability": 0.05,
    "longrun": 0.1,
    "converge": 0.2,
    "localerror": 0.3,
}
"""How often a command is drawn; those that measure take seconds."""


@cache
def commands() -> dict[str, click.Command]:
    context = click.Context(program)
    found = {name: program.get_command(context, name) for name in program.list_commands(context)}
    return {name: command for name, command in found.items() if command is not None}


@cache
def proved() -> tuple[str, ...]:
    """Return the tableaux that refine can sharpen."""
    return tuple(name for name in available() if "[proof]" in find(name).read_text(encoding="utf-8"))


@cache
def methods() -> tuple[str, ...]:
    ready = (
        "cf4",
        "rk4",
        "cg:cg3",
        "rkmk(2):rk4",
        "vcg:midpoint",
        "ambient:rk4",
        "ambient:dop853",
        "vcg:gauss2",
    )
    return (*ready, *ready, "vcg:", ":rk4", "rkmk(:", "cg:good.toml", "good.csv", "cg:missing.toml", "rk:rk4")


def value(command: str, parameter: click.Parameter, generator: Random) -> str:
    """Return a value of a parameter: mostly one of its kind, sometimes junk."""
    if generator.random() < 0.04:
        return generator.choice((*JUNK, *FILES, *PLACES))
    kind, name = parameter.type, parameter.name or ""
    if isinstance(kind, click.Choice):
        return generator.choice([str(choice) for choice in kind.choices])
    if isinstance(kind, click.types.IntParamType):
        return integer(kind, generator)
    if isinstance(kind, click.types.FloatParamType):
        return generator.choice(("0.1", "1", "0.01", "0", "-1", "1e-300", "1e300", "nan", "inf"))
    if kind.name in ("file", "folder") or name in ("write", "check_file"):
        return generator.choice((*PLACES, *PLACES[:3] * 3))
    if name == "kind":
        return generator.choice(KINDS[command])
    if name == "name":
        known = {"series": SERIES, "cite": available()}
        return generator.choice(known.get(command, ("found", "a-b", "a b", "ü")))
    return text(command, name, generator)


def integer(kind: click.types.IntParamType, generator: Random) -> str:
    low = int(getattr(kind, "min", None) or 0)
    high = int(getattr(kind, "max", None) or 10**30)
    if generator.random() < 0.9:
        return str(low + generator.choice((0, 1, 1, 2, 2, 3, 3, 4, 5)))
    return str(generator.choice((low - 1, high, high - 1, high + 1, high // 2, -high, 10**30)))


def text(command: str, name: str, generator: Random) -> str:
    files = [*FILES, *READABLE * 3, *generator.choices(available(), k=2 * len(FILES))]
    if command == "refine" and generator.random() < 0.5:
        return "proved.toml"
    if name in ("scene", "scenes"):
        known = [
            *scene_names(),
            *scene_names(),
            "scene.py",
            "raising.py",
            "syntax.py",
            "dipole+u",
            "duffing+u",
        ]
        return generator.choice(known)
    if name in ("methods", "method", "adaptive"):
        named = f"{generator.choice(families.names())}:{generator.choice(available())}"
        return generator.choice((*methods(), named, named, named, generator.choice(files)))
    if name in NAMED and generator.random() < 0.9:
        return generator.choice((*NAMED[name], *(families.names() if name == "family" else ())))
    return generator.choice(files)


def sound(command: str, generator: Random) -> list[str]:
    """Return a line for a command in which each parameter has a value of its kind, or nearly."""
    options: list[list[str]] = []
    arguments: list[str] = []
    for parameter in commands()[command].params:
        if isinstance(parameter, click.Argument):
            many = generator.choice((1, 1, 1, 2, 3)) if parameter.nargs < 0 else 1
            arguments += [value(command, parameter, generator) for _ in range(many)]
            continue
        assert isinstance(parameter, click.Option)
        often = 0.99 if parameter.required else OFTEN.get(parameter.name or "", 0.15)
        for _ in range(generator.choice((1, 2)) if parameter.multiple else 1):
            if generator.random() < often:
                spelling = generator.choice((*parameter.opts, *parameter.secondary_opts))
                options.append(
                    [spelling] if parameter.is_flag else [spelling, value(command, parameter, generator)]
                )
    generator.shuffle(options)
    words = [word for option in options for word in option]
    return [command, *arguments, *words] if generator.random() < 0.8 else [command, *words, *arguments]


def mutated(words: list[str], generator: Random) -> list[str]:
    words = list(words)
    for _ in range(generator.choice((0, 0, 0, 0, 0, 1, 1, 2))):
        if not words:
            break
        place = generator.randrange(len(words))
        match generator.randrange(6):
            case 0:
                del words[place]
            case 1:
                words.insert(place, generator.choice(words))
            case 2:
                words.insert(place, generator.choice(JUNK))
            case 3:
                other = generator.randrange(len(words))
                words[place], words[other] = words[other], words[place]
            case 4:
                words[place] = generator.choice(JUNK)
            case 5 if "/" not in words[place]:  # a changed path could lead out of the folder
                letters = list(words[place])
                letters.insert(generator.randrange(len(letters) + 1), generator.choice("-=~:(.,0 é"))
                words[place] = "".join(letters)
    return words


def drawn(seed: int) -> list[str]:
    """Return the words of a command line."""
    generator = Random(seed)
    names = sorted(commands())
    (name,) = generator.choices(names, [WEIGHTS.get(name, 1) for name in names])
    line = mutated(sound(name, generator), generator)
    of, _ = drawn_file(seed)
    return [f"mutated{FORMATS[of][1]}" if word == "mutated" else word for word in line]


def fill(folder: Path, seed: int) -> None:
    """Write the files that the line of a seed may name."""
    generator = Random(seed)
    place = generator.randrange(len(library()))
    for of, (_, suffix) in FORMATS.items():
        content = written(place, of)
        (folder / f"good{suffix}").write_bytes(content or b"")
    of, content = drawn_file(seed)
    (folder / f"mutated{FORMATS[of][1]}").write_bytes(content)
    good = (folder / "good.toml").read_bytes()
    (folder / "folder" / "folder").mkdir(parents=True)
    for name in ("good.unknown", "folder/one.toml", "folder/folder/two.toml", "é \u202e.toml"):
        (folder / name).write_bytes(good)
    (folder / "folder" / "DECIMAL").write_text("two.toml: no proof yet\n")
    (folder / "README.md").write_text("<!-- begin: orderconds table -->\n<!-- end: orderconds table -->\n")
    (folder / "scene.py").write_text(SCENE)
    (folder / "raising.py").write_text("1 / 0\n")
    (folder / "syntax.py").write_text("def (\n")
    (folder / "list.toml").write_text(LIST)
    (folder / "empty.toml").touch()
    (folder / "proved.toml").write_bytes(find(generator.choice(proved())).read_bytes())
    (folder / "target.toml").write_bytes(find("rk4").read_bytes())
    (folder / "link.toml").symlink_to("target.toml")
    (folder / "loop.toml").symlink_to("loop.toml")
    os.mkfifo(folder / "pipe.toml")
