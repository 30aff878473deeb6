# The commands of README, CI and packagers. `make` alone prints this list.
CARGO  ?= cargo
BUILD  ?= build
PREFIX ?= /usr/local
JOBS   ?= $(shell nproc 2>/dev/null || echo 2)
SEED    ?= 1
QUERIES ?= 10000000
WEIGHTS ?= 10000
RUNS    ?= 3
PLACES  ?= 1000000
THREADS ?= $(JOBS)
CASES   ?= ../shared/cases
OCCT_PACKAGES = libocct-foundation-dev libocct-modeling-data-dev libocct-modeling-algorithms-dev

.PHONY: help build test test-rust test-c test-python test-freecad stress weights-stress trims-stress demo demo-weights compare-occt compare-fit compare-intersect bench bench-drivers bench-instructions install deb abi-baseline clean

help:
	@echo "make build             build the library, shared and static, into $(BUILD)/lib"
	@echo "make test              run every test; also test-rust, test-c, test-python, test-freecad"
	@echo "make stress            ask QUERIES=10000000 difficult queries, each checked; also SEED, THREADS"
	@echo "make weights-stress    find weights for WEIGHTS=10000 random polygons with wishes, each checked (minutes); also SEED"
	@echo "make trims-stress      trimmed surfaces: classification of PLACES=1000000 places against exact arithmetic, a million places of"
	@echo "                       Algorithm 3, a thousand spheres to NURBS and back, relations, pull-back, faces of OpenCASCADE (minutes)"
	@echo "make demo              run the demonstration (a minute); pictures go to demo-out/"
	@echo "make demo-weights      the part of it that finds weights from wished distances, with two figures"
	@echo "make compare-occt      compare the extrema with OpenCASCADE 7.6 on the cases in $(CASES) (minutes)"
	@echo "make compare-fit       fit surfaces to grids of 100,000 points, beside OpenCASCADE (three minutes)"
	@echo "make compare-intersect intersect pairs of surfaces, faces of solids, stacks of planes, rays beside OpenCASCADE, SISL and CGAL (ten minutes); RUNS=3"
	@echo "make bench             time against OpenCASCADE, SISL and CGAL on the cases in $(CASES) (ten minutes); tables and"
	@echo "                       pictures go to bench-out/; BENCH_QUICK=1 takes a fifth of the cases (two minutes)"
	@echo "make bench-instructions  count instructions per query with callgrind, beside docs/instructions.csv; RECORD=1 appends"
	@echo "make install PREFIX=p  install library, headers, and what pkg-config and CMake need (default $(PREFIX))"
	@echo "make deb               build the Debian packages into $(BUILD)/deb; make abi-baseline accepts a changed binary interface"
	@echo "make clean             remove what was built"
	@echo "Tools that are missing (cmake; for the tests also g++, valgrind, and the libraries that they compare with) are"
	@echo "installed with apt by root;"
	@echo "everybody else is told the one line to run. Settings: CARGO=$(CARGO) BUILD=$(BUILD) JOBS=$(JOBS)"

# $(call need,<tools>,<packages>): each tool is also the name of its package; packages that hold no tool are asked
# for by name.
define need
@missing=""; \
for tool in $(1); do command -v $$tool >/dev/null 2>&1 || missing="$$missing $$tool"; done; \
for name in $(2); do dpkg -s $$name >/dev/null 2>&1 || missing="$$missing $$name"; done; \
if [ -z "$$missing" ]; then exit 0; fi; \
if [ "$$(id -u)" != 0 ] || ! command -v apt-get >/dev/null 2>&1; then \
  echo "missing:$$missing. Please run: sudo apt-get update && sudo apt-get install -y --no-install-recommends$$missing"; \
  exit 1; \
fi; \
echo "installing with apt:$$missing"; \
apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $$missing >/dev/null
endef

# $(call want,<packages>): installed with apt by root when they can be had. Without them the tests that use them are left out.
define want
@missing=""; \
for name in $(1); do dpkg -s $$name >/dev/null 2>&1 || missing="$$missing $$name"; done; \
if [ -z "$$missing" ]; then exit 0; fi; \
if [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null 2>&1 && echo "installing with apt:$$missing" \
  && { apt-get update -qq; DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $$missing; } >/dev/null 2>&1; \
then exit 0; fi; \
echo "left out, what needs:$$missing (sudo apt-get install -y --no-install-recommends$$missing)"
endef

# $(call configure,<ON or OFF>): with or without the tests.
define configure
@cmake -S . -B $(BUILD) -DFOOTPOINT_CARGO="$$(command -v $(CARGO))" -DFOOTPOINT_BUILD_TESTS=$(1)
endef

build:
	$(call need,cmake)
	$(call configure,OFF)
	cmake --build $(BUILD) --target footpoint_library

test: test-rust test-c test-python test-freecad

# rustfmt and clippy are no part of a minimal Rust installation: their checks say so and are left out there.
test-rust:
	@if $(CARGO) fmt --version >/dev/null 2>&1; then echo "cargo fmt --check"; $(CARGO) fmt --check; \
	 else echo "left out: rustfmt is not installed (rustup component add rustfmt)"; fi
	@if $(CARGO) clippy --version >/dev/null 2>&1; then echo "cargo clippy"; \
	   $(CARGO) clippy --locked --all-targets --all-features -- -D warnings; \
	 else echo "left out: clippy is not installed (rustup component add clippy)"; fi
	RUSTDOCFLAGS="-D warnings" $(CARGO) doc --locked --no-deps
	$(CARGO) test --locked

test-c:
	$(call need,cmake g++ valgrind)
	$(call want,pkg-config)
	$(call want,abigail-tools)
	$(call want,$(OCCT_PACKAGES))
	$(call want,libocct-data-exchange-dev)
	$(call want,libcgal-dev)
	$(call want,libopenmesh-dev)
	$(call want,libsisl-dev)
	$(call configure,ON)
	cmake --build $(BUILD) -j $(JOBS)
	cd $(BUILD) && ctest --output-on-failure -j $(JOBS)

# Both say in one line what they leave out.
test-python:
	@mkdir -p $(BUILD) && CARGO="$(CARGO)" python/tests/run.sh "$(abspath $(BUILD))"

test-freecad:
	@mkdir -p $(BUILD) && CARGO="$(CARGO)" freecad/Footpoint/tests/run.sh "$(abspath $(BUILD))"

# Ten million take a quarter of an hour on two cores. The exit code says whether anything was wrong.
stress:
	$(CARGO) bench --locked --bench stress -- seed=$(SEED) queries=$(QUERIES) threads=$(THREADS) out=stress.txt

weights-stress:
	$(CARGO) bench --locked --bench weights -- seed=$(SEED) count=$(WEIGHTS)

# Figures of docs/trims.md. What needs CGAL or OpenCASCADE is left out without them.
trims-stress:
	$(call want,libcgal-dev)
	$(call want,$(OCCT_PACKAGES))
	$(CARGO) test --release --locked --test matching -- --ignored --nocapture
	$(CARGO) test --release --locked --test trims --test pullback --test face_supports --test trim_recut -- --nocapture
	$(CARGO) test --release --locked --lib transform:: -- --nocapture
	$(call configure,ON)
	cmake --build $(BUILD) -j $(JOBS)
	for program in "reference/reference_faces $(PLACES)" "occt/occt_faces 50" occt/occt_trims; do \
	  if [ -x $(BUILD)/ctests/$${program%% *} ]; then echo "$$program" && $(BUILD)/ctests/$$program || exit 1; \
	  else echo "left out: $$program"; fi; done

demo-weights:
	$(call need,cmake)
	$(call configure,OFF)
	cmake --build $(BUILD) -j $(JOBS) --target weights
	mkdir -p demo-out
	$(BUILD)/examples/weights demo-out

demo: demo-weights
	$(call need,cmake)
	$(call configure,OFF)
	cmake --build $(BUILD) -j $(JOBS)
	$(BUILD)/examples/first_query
	$(BUILD)/examples/paper_example
	mkdir -p demo-out
	$(BUILD)/examples/trims demo-out
	$(BUILD)/examples/propeller demo-out

compare-occt: build
	$(call need,cmake g++,$(OCCT_PACKAGES))
	cmake -S compare/occt -B $(BUILD)/compare-occt -DFOOTPOINT_LIB="$(abspath $(BUILD))/lib"
	cmake --build $(BUILD)/compare-occt -j $(JOBS)
	$(BUILD)/compare-occt/compare_extrema "$(CASES)" --list $(BUILD)/compare-occt/list.txt

compare-fit: build
	$(call need,cmake g++,$(OCCT_PACKAGES))
	cmake -S compare/occt -B $(BUILD)/compare-occt -DFOOTPOINT_LIB="$(abspath $(BUILD))/lib"
	cmake --build $(BUILD)/compare-occt -j $(JOBS) --target compare_fit
	$(BUILD)/compare-occt/compare_fit

# A library that cannot be had is left out.
compare-intersect: build
	$(call need,cmake g++)
	-$(call need,,$(OCCT_PACKAGES) libocct-visualization-dev)
	-$(call need,,libcgal-dev)
	-$(call need,,libsisl-dev)
	cmake -S compare/intersect -B $(BUILD)/compare-intersect -DFOOTPOINT_LIB="$(abspath $(BUILD))/lib"
	cmake --build $(BUILD)/compare-intersect -j $(JOBS)
	$(BUILD)/compare-intersect/pairs $(RUNS)
	if [ -x $(BUILD)/compare-intersect/rays ]; then $(BUILD)/compare-intersect/rays "$(CASES)"; fi
	if [ -x $(BUILD)/compare-intersect/stacks ]; then $(BUILD)/compare-intersect/stacks "$(CASES)"; fi
	if [ -x $(BUILD)/compare-intersect/faces ]; then $(BUILD)/compare-intersect/faces 200 1 $(BUILD)/compare-intersect/faces.csv; fi

# A library that cannot be had is left out, and the tables say so.
bench-drivers: build
	$(call need,cmake g++ python3)
	-$(call need,,$(OCCT_PACKAGES))
	-$(call need,,libsisl-dev)
	-$(call need,,libcgal-dev)
	cmake -S compare/bench -B $(BUILD)/bench -DFOOTPOINT_LIB="$(abspath $(BUILD))/lib"
	cmake --build $(BUILD)/bench -j $(JOBS)

bench: bench-drivers
	python3 compare/bench/run.py --build $(BUILD)/bench --out bench-out $(if $(BENCH_QUICK),--quick) \
	  --cases "$(if $(wildcard $(CASES)/*/geometry.txt),$(CASES),tests/data)"
	python3 compare/bench/report.py bench-out

bench-instructions: bench-drivers
	$(call need,valgrind)
	python3 compare/bench/instructions.py --build $(BUILD)/bench $(if $(RECORD),--write)

install: build
	cmake --install $(BUILD) --prefix "$(PREFIX)"

# Recipes for Debian, vcpkg and Conan are in packaging/.
deb:
	$(call need,cmake pkg-config,dpkg-dev debhelper)
	sh packaging/deb.sh . $(BUILD)/deb

# After a deliberate change of the binary interface.
abi-baseline:
	sh ctests/abi/abi.sh cc include/footpoint.h ctests/abi/baseline.h write

clean:
	rm -rf $(BUILD) demo-out bench-out
	$(CARGO) clean
