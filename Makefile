# Everything a reader of this repository runs. Needs Python 3.11 or later and a C compiler; makes its own .venv.
#
#   make demo      derive, check, emit, compile, converge, report: the whole life of a method
#   make test      the tests that take seconds, and the examples of docstrings
#   make test-all  the same with the proofs that take minutes, and coverage
#   make gate      check every tableau of the library
#   make lint      ruff, mypy --strict, import-linter, limits of size and complexity (.ci/structure.py)
#   make docs      build the documentation as a web site in build/site
#   make reference write the pages of docs/ that follow from the program: commands, Python, outputs of sessions
#   make bench     time this project beside its peers (benchmarks/)

SHELL := /bin/bash
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
INSTALLED := $(VENV)/.installed
REPORT := report
EMITTED := $(REPORT)/emitted
# The tests start hundreds of programs. Without byte code on the disk, each of them compiles the packages again.
unexport PYTHONDONTWRITEBYTECODE
# Neighbouring tests share what they derive, so each process begins with a run of neighbours and takes over others' last.
PYTEST := $(BIN)/python -m pytest -n 2 --dist worksteal -rs --doctest-modules orderconds codegen tests

.PHONY: demo test test-all bench gate lint docs reference compiler clean
.DELETE_ON_ERROR:

# The stamp makes an old environment follow pyproject.toml and constraints.txt. The pins also bind the build backend.
$(INSTALLED): pyproject.toml constraints.txt
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { \
	  echo "make: '$(PYTHON)' is missing or older than Python 3.11; install Python >= 3.11 or type: make PYTHON=/path/to/python3.11" >&2; exit 2; }
	@$(PYTHON) -c 'import ensurepip, venv' 2>/dev/null || { \
	  echo "make: '$(PYTHON)' cannot create virtual environments (no ensurepip); on Debian or Ubuntu type: apt-get install python3-venv" >&2; exit 2; }
	$(PYTHON) -m venv $(VENV)
	PIP_CONSTRAINT=$(CURDIR)/constraints.txt $(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[test]'
	@touch $@

compiler:
	@command -v cc >/dev/null || command -v gcc >/dev/null || command -v clang >/dev/null || { \
	  echo "make: no C compiler (cc, gcc or clang) on PATH; on Debian or Ubuntu type: apt-get install gcc libc6-dev" >&2; exit 2; }

# VCG2 is vcg:midpoint, VCG4 vcg:triple_jump, RKMK4 rkmk(2):rk4. converge compiles what it measures.
demo: $(INSTALLED) compiler
	$(BIN)/orderconds derive vcg --order 3
	$(BIN)/orderconds check tableaux
	$(BIN)/orderconds emit free_rigid_body --method cg:cg3 --target python --target c -o $(EMITTED)
	$(BIN)/orderconds emit free_rigid_body --method 'rkmk(2):rk4' --target python --target c -o $(EMITTED)
	$(BIN)/orderconds emit free_rigid_body --method cf:cf4 --target python --target c -o $(EMITTED)
	$(BIN)/orderconds emit dipole --method vcg:midpoint --target python --target c -o $(EMITTED)
	$(BIN)/orderconds emit dipole --method vcg:triple_jump --target python --target c -o $(EMITTED)
	for target in c python; do \
	  $(BIN)/orderconds converge free_rigid_body --target $$target \
	    --method cg:cg3 --method 'rkmk(2):rk4' --method cf:cf4 && \
	  $(BIN)/orderconds converge dipole --target $$target \
	    --method vcg:midpoint --method vcg:triple_jump || exit; \
	done
	$(BIN)/orderconds report free_rigid_body dipole --quick -o $(REPORT)

test: $(INSTALLED)
	$(PYTEST) -m 'not slow'

# Coverage is counted here, where time does not matter: it takes half as long again.
test-all: $(INSTALLED)
	$(PYTEST) --cov --cov-report=term

bench: $(INSTALLED) compiler
	PIP_CONSTRAINT=$(CURDIR)/constraints.txt $(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[peers]'
	@set -e; for script in $(filter-out benchmarks/scale_all.py,$(wildcard benchmarks/*.py)); do echo "$$script"; $(BIN)/python $$script; done

# MkDocs stops at the first broken link (--strict).
docs: $(INSTALLED)
	PIP_CONSTRAINT=$(CURDIR)/constraints.txt $(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[docs]'
	$(BIN)/python .ci/reference.py --check
	$(BIN)/mkdocs build --strict --quiet
	@echo "open build/site/index.html"

reference: $(INSTALLED)
	$(BIN)/python .ci/reference.py
	$(BIN)/python .ci/pairs.py
	$(BIN)/python tests/sessions.py
	$(BIN)/orderconds table --write docs/reference/library.md

# The gate: every claim of the library holds with a certificate, nothing that a tableau can serve is left unclaimed, and
# docs/reference/library.md shows the library as it is.
gate: $(INSTALLED)
	$(BIN)/orderconds check --complete --certified tableaux
	$(BIN)/orderconds table --check docs/reference/library.md
	$(BIN)/python .ci/reference.py --check

lint: $(INSTALLED)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/python .ci/structure.py

clean:
	rm -rf $(VENV) $(REPORT) build dist .pytest_cache .mypy_cache .ruff_cache .import_linter_cache .hypothesis .coverage
