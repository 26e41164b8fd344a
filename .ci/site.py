"""Hooks of MkDocs: pages of the site that are files outside docs/, its title, and its address."""

from __future__ import annotations

import posixpath
import re
import tomllib
from pathlib import Path
from typing import Any

from mkdocs.structure.files import File, Files

ROOT = Path(__file__).parents[1]
OUTSIDE = {
    "contributing.md": "CONTRIBUTING.md",
    "changelog.md": "CHANGELOG.md",
    "benchmarks.md": "benchmarks/README.md",
    "ci_example.md": "examples/ci/README.md",
    "satellite.md": "examples/satellite/README.md",
}
"""Pages of the site, and the files of the repository that they show."""


PLACEHOLDER = "https://example.org/"


def on_config(config: Any) -> Any:
    """Link to the address of the project, the only URL of pyproject.toml, if it has been filled in."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    home = project["urls"]["Homepage"]
    config["site_name"] = f"{project['name']} {project['version']}"
    if not home.startswith(PLACEHOLDER):
        config["repo_url"] = home
    return config


def on_files(files: Files, config: Any) -> Files:
    """Add the pages of :data:`OUTSIDE`."""
    for page, source in OUTSIDE.items():
        text = (ROOT / source).read_text(encoding="utf-8")
        files.append(File.generated(config, page, content=text))
    return files


def on_page_markdown(markdown: str, page: Any, **_: Any) -> str:
    """Turn links between files of the repository into links between pages of the site."""
    uri = page.file.src_uri
    here = posixpath.dirname(OUTSIDE.get(uri, f"docs/{uri}"))
    pages = {source: name for name, source in OUTSIDE.items()}

    def link(match: re.Match[str]) -> str:
        path, anchor = match[1], match[2] or ""
        target = posixpath.normpath(posixpath.join(here, path))
        name = pages.get(target, target.removeprefix("docs/") if target.startswith("docs/") else None)
        if name is None:
            return match[0]
        return f"]({posixpath.relpath(name, posixpath.dirname(uri) or '.')}{anchor})"

    return re.sub(r"\]\((?![a-z]+:|#)([^)#\s]+)(#[^)\s]*)?\)", link, markdown)
