# `make verify` is the main job, `make test` the tests; each sets up what it needs on a machine with Python.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin

.PHONY: verify test lint clean

verify: $(VENV)/.installed
	@echo "== prove: every claim that has a proof"
	$(BIN)/chapsym prove
	@echo "== codegen: the kernels are what is derived"
	$(BIN)/chapsym codegen --check
	@echo "== run: a real trajectory, ten seconds of a bowling-sized ball"
	@mkdir -p out
	$(BIN)/chapsym run docs/first.toml -o out/first.npz
	@echo "== check: float64 against mpmath"
	$(BIN)/chapsym check
	@echo "== verified: claims judged, kernels derived, trajectory in out/first.npz, float64 within its budget"

test: $(VENV)/.installed
	$(BIN)/python -m pytest -n auto

lint: $(VENV)/.installed
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

# The editable install maps generated/ and proofs/ into the package; it is renewed when the metadata change.
$(VENV)/.installed: pyproject.toml constraints.txt
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt -e '.[dev]'
	@touch $@

clean:
	rm -rf $(VENV) out build dist *.egg-info
