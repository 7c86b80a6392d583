# `make demo` shows what the checker does; `make test` runs all tests. Both start from a bare
# Debian or Ubuntu with Python 3.11 or newer.

PYTHON ?= python3
BIN := .venv/bin
CORPUS ?= $(wildcard ../shared/corpus)
REVIEWS ?= $(wildcard ../shared/reviews)
WORKERS ?= auto

.PHONY: demo test lint types format bench constraints clean golden

demo: .venv/installed
	@mkdir -p demo
	@echo "== good robots: on wheels, on steered wheels, on tracks, and in the air"
	@$(BIN)/subt-check samples/husky_migration_sensor_config_1 samples/subtcheck_*_sensor_config_1 \
	  | tee demo/good.txt
	@echo "== a robot with faults (the first lines; everything is in demo/broken.txt)"
	@$(BIN)/subt-check samples/broken_rover_sensor_config_1 --report demo > demo/broken.txt; \
	  test $$? -eq 1
	@head -n 40 demo/broken.txt
	@tail -n 1 demo/broken.txt
	@echo "== results: demo/good.txt, demo/broken.txt, demo/report.json"

test: .venv/tested
	SUBT_CHECK_CORPUS=$(abspath $(CORPUS)) SUBT_CHECK_REVIEWS=$(abspath $(REVIEWS)) \
	  $(BIN)/pytest -n $(WORKERS)

lint: .venv/tested
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: .venv/tested
	$(BIN)/mypy

format: .venv/tested
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

bench: .venv/tested
	SUBT_CHECK_CORPUS=$(abspath $(CORPUS)) $(BIN)/python bench/static.py
	SUBT_CHECK_CORPUS=$(abspath $(CORPUS)) $(BIN)/python bench/trial.py
	$(BIN)/python bench/hostile.py

# Reports beside the samples and generated pages: written anew, then read before they are committed.
golden: .venv/tested
	$(BIN)/pytest -q tests/test_samples.py tests/test_docs.py tests/test_checklist.py --update-golden

.venv/bin/python:
	scripts/require venv=python3-venv
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "Python 3.11 or newer is needed")'
	$(PYTHON) -m venv .venv

.venv/installed: .venv/bin/python pyproject.toml constraints.txt
	$(BIN)/pip install --quiet --disable-pip-version-check -c constraints.txt -e '.[service]'
	@touch $@

.venv/tested: .venv/installed
	scripts/require ruby=ruby git=git
	$(BIN)/pip install --quiet --disable-pip-version-check -c constraints.txt -r requirements-dev.txt
	@touch $@

constraints: .venv/tested
	@{ head -n 2 constraints.txt; $(BIN)/pip freeze --exclude-editable; } > constraints.new
	@mv constraints.new constraints.txt

clean:
	rm -rf .venv build dist demo
