# Everything runs in .venv, made on first use; nothing is written that git sees.
PYTHON       ?= python3
PYTEST_FLAGS ?= -n auto --dist loadgroup --no-loadscope-reorder

VENV ?= .venv
PY   := $(VENV)/bin/python
TMM  := $(VENV)/bin/tmm-gen
CORE := $(VENV)/.installed-core
TEST := $(VENV)/.installed-test
SITE := $(VENV)/.installed-site
# Style and type checkers are pinned, in an environment of their own: they must not change under a user's feet.
LINT := .venv-lint/.installed

export PIP_DISABLE_PIP_VERSION_CHECK := 1
export PYTHONUNBUFFERED := 1

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.NOTPARALLEL:
.PHONY: help demo test lint build check site bench format clean compiler

help:  ## list the targets
	@awk -F ':.*## ' '/^[a-z]+:.*## / { printf "make %-7s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

demo: $(CORE) compiler  ## an arm lifts its payload: what accuracy costs in C, one table, one picture in out/demo
	$(TMM) demo --out out/demo

test: $(TEST) compiler  ## drift of generated/, then all tests; ends with what absent tools left out
	$(TMM) build --check
	$(PY) -m pytest $(PYTEST_FLAGS)

lint: $(LINT)  ## style and types of this and of generated code, by pinned tools in .venv-lint
	.venv-lint/bin/ruff check .
	.venv-lint/bin/ruff format --check .
	.venv-lint/bin/mypy
	.venv-lint/bin/python -m pytest -q -m style tests/emit

format: $(LINT)  ## rewrite sources in the project's style
	.venv-lint/bin/ruff check --fix .
	.venv-lint/bin/ruff format .

build: $(CORE)  ## regenerate generated/ from scenes/
	$(TMM) build
	$(TMM) build examples/firmware/beam5.toml --out examples/firmware/generated

check: $(CORE)  ## fail where generated/ differs from what scenes/ give
	$(TMM) build --check
	$(TMM) build examples/firmware/beam5.toml --out examples/firmware/generated --check

# Playgrounds of the site: PLAYGROUNDS=all has one for each scene of the gallery, and takes five minutes.
PLAYED := $(notdir $(basename $(wildcard scenes/*.toml examples/space/*.toml)))
PLAYGROUNDS := elbow arm10 thesis10 yaw3
PAGES = $(patsubst %, out/playground/%.html, $(if $(filter all, $(PLAYGROUNDS)), $(PLAYED), $(PLAYGROUNDS)))

site: $(SITE) $(PAGES)  ## the documentation as a site in out/site; fails at any warning, broken link or page too wide
	NO_MKDOCS_2_WARNING=1 $(PY) -m mkdocs build --quiet --strict --config-file website/mkdocs.yml
	$(PY) website/check.py out/site

out/playground/%.html: scenes/%.toml $(SITE) $(wildcard templates/playground/*)
	@mkdir -p $(@D)
	$(TMM) playground $< --out $@

# in space a kernel takes long to compile, and has 70 to 280 kB
out/playground/%.html: examples/space/%.toml $(SITE) $(wildcard templates/playground/*)
	@mkdir -p $(@D)
	$(TMM) playground $< --integrators newmark --out $@

bench: $(TEST) compiler  ## run every script of benchmarks/ (a day); what each prints is kept in out/bench
	@mkdir -p out/bench; trap "exit 130" INT; failed=""; for script in benchmarks/*.py; do \
	    name=$$(basename $$script .py); echo "$(PY) $$script > out/bench/$$name.txt"; \
	    $(PY) $$script > out/bench/$$name.txt 2>&1 || failed="$$failed $$name"; \
	done; \
	[ -z "$$failed" ] || { echo "error: these did not end well, see out/bench/*.txt:$$failed" >&2; exit 1; }

clean:  ## remove the environment, caches and all outputs
	rm -rf $(VENV) .venv-lint out build dist .hypothesis .mypy_cache .pytest_cache .ruff_cache
	find src tests generated -name __pycache__ -type d -prune -exec rm -rf {} + 2>/dev/null || true

compiler:
	@command -v gcc >/dev/null || { \
	    echo "error: gcc not found; install a C compiler (Debian, Ubuntu: apt-get install gcc libc6-dev)" >&2; exit 1; }

define need_python
	@command -v $(PYTHON) >/dev/null || { \
	    echo "error: $(PYTHON) not found; install Python 3.11 or later, or name one: make PYTHON=/path/to/python3" >&2; exit 1; }
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { \
	    echo "error: $(PYTHON) is $$($(PYTHON) -V 2>&1); Python 3.11 or later is needed: make PYTHON=/path/to/python3.11" >&2; exit 1; }
	@$(PYTHON) -c 'import ensurepip, venv' 2>/dev/null || { \
	    echo "error: $(PYTHON) cannot make environments; install its venv module (Debian, Ubuntu: apt-get install python3-venv)" >&2; exit 1; }
endef

$(PY):
	$(need_python)
	$(PYTHON) -m venv $(VENV)

# Stamps: an install happens when pyproject.toml is newer, and the larger install counts as the smaller.
$(CORE): pyproject.toml | $(PY)
	$(PY) -m pip install --quiet --editable .
	@touch $@

$(TEST): pyproject.toml | $(PY)
	$(PY) -m pip install --quiet --editable '.[test]'
	@touch $(CORE) $@

$(SITE): pyproject.toml | $(PY)
	$(PY) -m pip install --quiet --editable '.[site]'
	@touch $(CORE) $@

$(LINT): pyproject.toml
	$(need_python)
	$(PYTHON) -m venv .venv-lint
	.venv-lint/bin/python -m pip install --quiet --editable '.[lint]'
	@touch $@
