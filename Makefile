# Everything sets itself up: `make run` and `make test` are enough on a fresh machine.
PY := .venv/bin/python
# An empty environment has none.
export PATH := $(or $(PATH),/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin)
export OPENBLAS_NUM_THREADS := 1
export OMP_NUM_THREADS := 1

PACKAGE_PY := $(or $(PYTHON),python3)

.PHONY: run test compiled lint pytest unit window journey thorough coverage bench accuracy validation torture screenshots fresh package package-test windows-test release docs translations setup setup-test lock clean

run: setup                      ## the application on a simulated camera and patient
	.venv/bin/carpus demo

test: lint pytest               ## everything that must hold before a change lands

compiled:                       ## core/compiled built anew after a change; with every index checked too: make compiled checked=1
	$(PY) setup.py -q build_ext --inplace --parallel 2
	$(if $(checked),CARPUS_BOUNDS_CHECKED=1 $(PY) setup.py -q build_ext --parallel 2)

lint: setup-test                ## style, types, layers
	$(PY) -m ruff check .
	$(PY) -m ruff format --check .
	$(PY) -m mypy
	.venv/bin/lint-imports --no-cache

SUITE = $(PY) -m pytest -q -n auto --maxprocesses 4 --dist loadgroup --durations=60

pytest: setup-test              ## all tests but the thorough ones
	$(SUITE)

unit: setup-test                ## those that need no window, process or recording: the quick ones
	$(SUITE) -m unit

window: setup-test              ## those of the window and of the commands
	$(SUITE) -m window

journey: setup-test             ## those of whole ways
	$(SUITE) -m journey

thorough: setup-test            ## long repetitions of what the tests show with few (part of `make torture`)
	$(SUITE) -m thorough
	$(MAKE) compiled checked=1
	CARPUS_BOUNDS_CHECKED=1 $(PY) -m pytest -q tests/compiled

coverage: setup-test            ## how much of the code the tests reach, half as long again as the tests alone
	$(PY) -m pytest -q -n auto --maxprocesses 4 --dist loadgroup --cov --cov-report=term:skip-covered $(ARGUMENTS)

bench: setup-test               ## cost per frame and of the screen
	$(PY) -m tests.bench

accuracy: setup-test            ## errors against simulated truth
	$(PY) -m tests.accuracy

validation: setup-test          ## resources/validation.md: agreement and retest of 20 simulated people from fresh seeds (a quarter of an hour; ARGUMENTS="--people 3": less)
	$(PY) -m tests.validation $(ARGUMENTS)

torture: thorough               ## kills, damaged files, bad disks: what is lost and let in (an hour or two)
	CARPUS_TORTURE=100 $(PY) -m pytest -q -rP --timeout 0 tests/torture

screenshots: setup-test         ## every screen, light and dark, into out/screenshots
	$(PY) -m tests.screenshots

fresh:                          ## `make run` and `make test` in clean roots of Debian 12 and 13; as root, long
	installer/fresh.sh $(SUITES)

package:                        ## archive and .deb with their own Python, into dist/; on a Debian 12 for it and Ubuntu 24.04
	$(PACKAGE_PY) installer/package/build.py

package-test: setup-test        ## the .deb in clean roots: install, start, measure, upgrade, remove; as root, long
	installer/package/clean_root.sh $(SUITES)

windows-test:                   ## the Windows installer around a stand-in, its handling of files under Wine
	installer/package/windows/try_under_wine.sh

docs: setup-test build/docs-tools/ready build/tutorials ## the documentation as a site, into build/site; a link that leads nowhere ends it
	NO_MKDOCS_2_WARNING=1 build/docs-tools/bin/python installer/docs.py

build/tutorials: resources/tutorials/*.ipynb
	$(PY) installer/tutorials.py resources/tutorials $@
	touch $@

build/docs-tools/ready: requirements-docs.lock
	$(PACKAGE_PY) -m venv --clear build/docs-tools
	build/docs-tools/bin/python -m pip install --disable-pip-version-check --progress-bar off -q --require-hashes -r requirements-docs.lock
	touch $@

translations: setup-test        ## texts of the sources into resources/translations; says how many are missing
	$(PY) installer/translations.py $(ARGUMENTS)

release: setup-test             ## all that is handed out, or why not; RELEASE_KEY=... signs the checksums
	$(PACKAGE_PY) installer/release.py

setup:
	@installer/setup.sh run

setup-test:
	@installer/setup.sh test

lock:                           ## pin the newest versions that pyproject.toml allows
	installer/lock.sh

.PHONY: hashes
hashes:                         ## the hashes of the pins that are there, after one was written by hand
	installer/lock.sh hashes

clean:                          ## all that was built here, except what `make run` recorded
	rm -rf .venv build dist *.egg-info .pytest_cache .mypy_cache .ruff_cache .import_linter_cache .hypothesis
	rm -f core/compiled/*.so core/compiled/*.pyd
	find app core ui resources tests -name __pycache__ -type d -prune -exec rm -rf {} +
