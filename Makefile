# `make verify` is the main job, `make test` the tests, `make thorough` those with large budgets; each sets up what it needs on a machine with Python.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
INSTALL := $(BIN)/python -m pip install --quiet --disable-pip-version-check
SHELL := bash
.SHELLFLAGS := -e -o pipefail -c

.PHONY: verify test thorough lint docs note pictures rocq rocq-register rocq-intervals rocq-measure release-check clean

verify: $(VENV)/.installed
	@mkdir -p out
	$(BIN)/chapsym prove | tee out/prove.txt
	$(PYTHON) -S -I checker --kernels generated --manifest proofs/manifest.json > out/certificates.txt  # with Python alone
	$(BIN)/chapsym codegen --check | tee out/codegen.txt
	$(BIN)/chapsym run docs/first.toml -o out/first.npz | tee out/run.txt
	$(BIN)/chapsym check | tee out/check.txt
	@echo
	@echo "verified:"
	@echo "  claims        $$(tail -n 1 out/prove.txt)"
	@echo "  certificates  $$(grep ': accepted' out/certificates.txt | grep -vcE 'register-claim|kernel') accepted by the separate checker"
	@echo "  register      $$(grep -c ': accepted (register-claim)' out/certificates.txt) claims' statements accepted by it"
	@echo "  kernels       $$(cat out/codegen.txt)"
	@echo "  their texts   $$(grep -c ': accepted (kernel)' out/certificates.txt) compute what those certificates say, by the same checker"
	@echo "  trajectory    $$(head -n 1 out/run.txt)"
	@echo "  float64       $$(tail -n 1 out/check.txt)"

test: $(VENV)/.installed
	$(BIN)/python -m pytest -n auto

# Random seeds, many more examples of each property, the slow cells of the extremes, slips judged by more claims, more processes, scenes and states.
thorough: $(VENV)/.installed
	$(BIN)/python -m pytest -n auto --thorough

lint: $(VENV)/.installed
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

# The documentation, a site that opens from disk: docs/_build/index.html.
docs: $(VENV)/.installed
	$(BIN)/python -m sphinx -W --keep-going -q -b html docs docs/_build
	@echo "docs/_build/index.html"

# The note on the two open questions, out/note/note.pdf: its source is written from the proofs and certificates; LaTeX must be installed.
note: $(VENV)/.installed
	$(BIN)/python docs/note/make.py out/note
	@command -v pdflatex > /dev/null || { echo "LaTeX is not installed: the source alone is in out/note"; exit 1; }
	cd out/note && pdflatex -halt-on-error -interaction=batchmode note && bibtex note && pdflatex -interaction=batchmode note && \
	pdflatex -halt-on-error -interaction=batchmode note

# The pictures of the examples, in docs/pictures.
pictures: $(VENV)/.installed
	for one in bowling:contact robot:spheres,attitude vertical:spheres,phase spread:contact,spread four:spheres; do \
	  $(BIN)/chapsym show docs/scenes/$${one%%:*}.toml -o docs/pictures/$${one%%:*} --figures $${one##*:} --no-page; done
	$(BIN)/chapsym show docs/first.toml -o docs/pictures/first --format gif --no-page
	$(BIN)/python docs/pictures/layers.py
	$(BIN)/python docs/pictures/page.py
	$(BIN)/python docs/pictures/radii.py
	$(BIN)/chapsym judge benchmarks/rolling/examples/*.csv --against benchmarks/rolling/data/robot.json -o docs/pictures/engines/robot.svg

# Rocq judges the certificates of the register, too, and one of intervals: with Python and Rocq alone.
rocq:
	@command -v coqc > /dev/null || { echo "Rocq is not installed, so nothing was judged; on Debian: apt install coq libcoq-mathcomp-algebra"; exit 1; }
	cd chapsym/prove && $(PYTHON) -m rocq ../../proofs/certificates/register ../../out/rocq
	$(PYTHON) -m chapsym.certificates.rocq proofs/certificates/measure-large.json out/rocq-intervals
	@$(MAKE) -s -j $$(getconf _NPROCESSORS_ONLN) -O rocq-register rocq-intervals rocq-measure

rocq-register:
	@$(MAKE) -s -C out/rocq

rocq-intervals:
	@if [ -d "$$(coqc -where)/user-contrib/Interval" ]; then $(MAKE) -s -C out/rocq-intervals; \
	else echo "coq-interval is not installed, so no interval certificate was judged; on Debian: apt install libcoq-interval"; fi

rocq-measure:
	@if [ -d "$$(coqc -where)/user-contrib/mathcomp/analysis" ] && [ -d "$$(coqc -where)/user-contrib/Coquelicot" ]; then \
	  rm -rf out/rocq-measure; mkdir -p out; cp -r proofs/rocq out/rocq-measure; $(MAKE) -s -C out/rocq-measure; \
	else echo "mathcomp-analysis or Coquelicot is not installed, so measure-iff as a whole was not judged;" \
	  "on Debian: apt install libcoq-mathcomp-analysis libcoq-coquelicot"; fi

# A clean tree, one version and date, fresh errata, packages that install; stops at the first thing that is missing.
release-check: $(VENV)/.installed
	@$(BIN)/python .ci/release_check.py

# The editable install maps generated/ and proofs/ into the package and compiles the loops; it is renewed when one changes.
# Dependency groups are known to pip from 25.1 on.
$(VENV)/.installed: pyproject.toml constraints.txt setup.py generated/loops.c chapsym/dynamics/native/module.c
	$(PYTHON) -m venv $(VENV)
	$(INSTALL) -c constraints.txt 'pip>=25.1'
	$(INSTALL) -c constraints.txt -e '.[all,test,docs]' --group dev
	@touch $@

clean:
	rm -rf $(VENV) out build dist docs/_build *.egg-info
