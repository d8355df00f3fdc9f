# `make help` prints every target. Two of them do everything: `make generate` and `make test`.

PYTHON     ?= python3.11
VENV       := .venv
BIN        := $(VENV)/bin
CATEGORIES ?=
COUNT      ?=
SEED       ?= 0
OUT        ?= out
WORKERS    ?= $(shell nproc)

.DEFAULT_GOAL := help
.PHONY: help generate test install install-test doctor fmt lint type unit goldens gallery bench hard-cases ci clean

help: ## print this list
	@grep -hE '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | awk -F ':.*## ' '{printf "  make %-14s %s\n", $$1, $$2}'
	@echo '  variables: CATEGORIES="laptop cabinet" COUNT=200 SEED=7 OUT=out WORKERS=2'

generate: install ## rules -> assets -> renders -> shards, installing what it needs first
	$(BIN)/artgen generate --seed $(SEED) --out $(OUT) --workers $(WORKERS) $(if $(strip $(COUNT)),--count $(COUNT)) $(if $(strip $(CATEGORIES)),--categories $(CATEGORIES))

test: install-test lint type unit ## install the rest and pass every test

$(VENV)/bin/python:
	@command -v $(PYTHON) >/dev/null || { echo "artgen: $(PYTHON) is missing (Blender's module needs Python 3.11 exactly); on Debian 12: sudo apt-get install -y python3.11 python3.11-venv"; exit 2; }
	@$(PYTHON) -c 'import ensurepip' 2>/dev/null || { echo "artgen: $(PYTHON) cannot make virtual environments; on Debian 12: sudo apt-get install -y python3.11-venv"; exit 2; }
	$(PYTHON) -m venv $(VENV)

$(VENV)/.installed: pyproject.toml | $(VENV)/bin/python
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable .
	$(BIN)/artgen doctor --mend --folder $(OUT)
	@touch $@

$(VENV)/.installed-test: pyproject.toml $(VENV)/.installed
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[test]'
	@touch $@

install: $(VENV)/.installed ## install what `make generate` needs into .venv

install-test: $(VENV)/.installed-test ## install what the tests need too

doctor: install ## check this machine
	$(BIN)/artgen doctor --folder $(OUT)

fmt: install-test ## format the sources
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

lint: install-test ## style and import contracts
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/lint-imports

type: install-test ## types
	$(BIN)/mypy

unit: install-test ## the tests alone
	$(BIN)/pytest -n $(WORKERS) --dist loadgroup

goldens: install-test ## rewrite the golden summaries of the categories
	$(BIN)/python -m tests.golden.write

gallery: install ## rewrite the pictures of all categories in docs/
	$(BIN)/artgen sheet $(notdir $(basename $(filter-out category_rules/_%,$(wildcard category_rules/*.toml)))) \
	  --count 24 --seed 20261121 --size 160 --paths 8 --out docs/images/categories --work out/sheets

bench: install-test ## measure the figures in docs/benchmarks.md
	$(BIN)/python -m tests.bench.figures
	$(BIN)/python -m tests.bench.rendering

hard-cases: install-test ## rewrite docs/hard_cases.md with fresh measurements
	$(BIN)/python -m tests.hard_cases.write

ci: test ## what CI runs

clean: ## delete generated output and caches, not .venv
	rm -rf out .mypy_cache .ruff_cache .pytest_cache .hypothesis build *.egg-info
