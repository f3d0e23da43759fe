# Everything sets itself up: `make run` and `make test` are enough on a fresh machine.
PY := .venv/bin/python
# An empty environment has none.
export PATH := $(or $(PATH),/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin)
export OPENBLAS_NUM_THREADS := 1
export OMP_NUM_THREADS := 1

PACKAGE_PY := $(or $(PYTHON),python3)

.PHONY: run test lint pytest bench accuracy torture screenshots fresh package package-test windows-test release translations setup setup-test lock clean

run: setup                      ## the application on a simulated camera and patient
	.venv/bin/carpus demo

test: lint pytest               ## everything that must hold before a change lands

lint: setup-test                ## style, types, layers
	$(PY) -m ruff check .
	$(PY) -m ruff format --check .
	@rm -rf build/lint && mkdir -p build/lint/carpus  # the package as it is when installed: what the tools look for
	@ln -s ../../../carpus.py build/lint/carpus/__init__.py
	@for part in app core ui resources; do ln -s ../../../$$part build/lint/carpus/$$part; done
	cd build/lint && ../../$(PY) -m mypy --config-file ../../pyproject.toml
	cd build/lint && ../../.venv/bin/lint-imports --no-cache --config ../../pyproject.toml

pytest: setup-test
	$(PY) -m pytest -q -n auto --maxprocesses 4 --dist loadgroup

bench: setup-test               ## cost per frame and of the screen
	$(PY) -m tests.bench

accuracy: setup-test            ## errors against simulated truth
	$(PY) -m tests.accuracy

torture: setup-test             ## kills, damaged files, bad disks: what is lost and let in (an hour or two)
	$(PY) -m tests.torture

screenshots: setup-test         ## every screen, light and dark, into out/screenshots
	$(PY) -m tests.screenshots

fresh:                          ## `make run` and `make test` in clean roots of Debian 12 and 13; as root, long
	installer/fresh.sh $(SUITES)

package:                        ## archive and .deb with their own Python, into dist/; on a Debian 12 for it and Ubuntu 24.04
	$(PACKAGE_PY) installer/package/build.py

package-test:                   ## the .deb in clean roots: install, start, measure, upgrade, remove; as root, long
	installer/package/clean_root.sh $(SUITES)

windows-test:                   ## the Windows installer around a stand-in, its handling of files under Wine
	installer/package/windows/try_under_wine.sh

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

clean:                          ## all that was built here, except what `make run` recorded
	rm -rf .venv build dist *.egg-info .pytest_cache .mypy_cache .ruff_cache .import_linter_cache .hypothesis
	find app core ui resources tests -name __pycache__ -type d -prune -exec rm -rf {} +
