# Everything sets itself up: `make run` and `make test` are enough on a fresh machine.
PY := .venv/bin/python
export OPENBLAS_NUM_THREADS := 1
export OMP_NUM_THREADS := 1

.PHONY: run test lint pytest bench accuracy screenshots setup setup-test lock clean

run: setup                      ## the application on a simulated camera and patient
	.venv/bin/carpus demo

test: lint pytest               ## everything that must hold before a change lands

lint: setup-test                ## style, types, layers
	$(PY) -m ruff check .
	$(PY) -m ruff format --check .
	$(PY) -m mypy
	.venv/bin/lint-imports --no-cache

pytest: setup-test
	$(PY) -m pytest -q

bench: setup-test               ## cost per frame and of the screen
	$(PY) -m tests.bench

accuracy: setup-test            ## errors against simulated truth
	$(PY) -m tests.accuracy

screenshots: setup-test         ## every screen, light and dark, into out/screenshots
	$(PY) -m tests.screenshots

setup:
	@installer/setup.sh run

setup-test:
	@installer/setup.sh test

lock:                           ## pin the newest versions that pyproject.toml allows
	installer/lock.sh

clean:                          ## all that was built here, except what `make run` recorded
	rm -rf .venv build dist *.egg-info .pytest_cache .mypy_cache .ruff_cache .import_linter_cache .hypothesis
	find app core ui resources tests -name __pycache__ -type d -prune -exec rm -rf {} +
