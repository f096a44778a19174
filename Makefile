# `make` lists the targets. Builds lie in build/<preset>; PRESET=debug builds another one.
PRESET ?= release
JOBS ?= $(shell nproc)
PYTHON := build/venv/bin/python
SAZARE := build/release/apps/sazare/sazare
DEMO_CASE := cases/free-face-blast/case.toml

.DEFAULT_GOAL := help
.PHONY: help setup build demo test sanitize fuzz validate bench docs clean

help: ## list the targets
	@grep -E '^[a-z]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/^([a-z]+):[^#]*## (.*)/  make \1\t\2/' | expand -t 18

setup: ## install missing Debian packages and the Python environment
	@scripts/setup

build: setup ## build the program in build/release (PRESET=debug|asan|tsan|mpi for another build)
	@scripts/build $(PRESET) $(JOBS) program

demo: build ## run the blast near a free face and write its report to build/demo
	@$(SAZARE) run $(DEMO_CASE) --out build/demo --overwrite
	@$(PYTHON) -m sazare report build/demo
	@$(PYTHON) -m sazare summary build/demo

test: setup ## run everything that guards the project
	@scripts/build release $(JOBS)
	@scripts/setup browser || echo "test: there is no Chromium, so nobody looks at the 3-D view in a browser"
	@scripts/test

sanitize: setup ## run the C++ tests and every case, shortened, with the address, undefined-behaviour and thread sanitizers
	@scripts/setup sanitizers || echo "sanitize: Clang could not be installed; another compiler may take much longer"
	@scripts/sanitize $(JOBS)

fuzz: build ## change the files of small cases at random and look whether each is answered with a message (MUTANTS=2000 SEED=1)
	@$(PYTHON) tests/fuzz/fuzz.py --mutants $(or $(MUTANTS),2000) --seed $(or $(SEED),1) --jobs $(JOBS)

validate: build ## compare with theory, papers, other codes and experiments; table in build/validation/results.csv
	@scripts/build release $(JOBS) validation_programs
	@$(PYTHON) validation/run.py

bench: build ## measure speed; table in build/bench/results.csv
	@scripts/build release $(JOBS) benchmarks_programs
	@$(PYTHON) benchmarks/run.py

docs: build ## check the documentation's links, and make the site build/site of it
	@$(PYTHON) tools/check_links.py README.md CONTRIBUTING.md CHANGELOG.md docs cases
	@$(PYTHON) -m pip install --quiet --disable-pip-version-check --only-binary :all: -r docs/requirements.txt
	@$(PYTHON) tools/build_site.py

clean: ## remove the builds and what they made; the Python environment stays
	@find build -mindepth 1 -maxdepth 1 ! -name venv -exec rm -rf {} + 2>/dev/null || true
