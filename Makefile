# The commands of README, CI and packagers. `make` alone prints this list.
#   CARGO=cargo   BUILD=build   PREFIX=/usr/local   JOBS=<cores>
CARGO  ?= cargo
BUILD  ?= build
PREFIX ?= /usr/local
JOBS   ?= $(shell nproc 2>/dev/null || echo 2)

.PHONY: help tools build test test-rust test-c demo install clean

help:
	@echo "make build             build the library (shared and static) into $(BUILD)/lib"
	@echo "make test              run every test; installs cmake, valgrind and g++ when they are missing"
	@echo "make demo              run the demonstration; pictures go to demo-out/"
	@echo "make install PREFIX=p  install library, headers and pkg-config file (default $(PREFIX))"
	@echo "make clean             remove what was built"

# What is missing is installed with apt by root; everybody else is told the one line to run.
tools:
	@missing=""; \
	for tool in cmake valgrind g++; do command -v $$tool >/dev/null 2>&1 || missing="$$missing $$tool"; done; \
	if [ -z "$$missing" ]; then exit 0; fi; \
	if [ "$$(id -u)" != 0 ] || ! command -v apt-get >/dev/null 2>&1; then \
	  echo "missing:$$missing. Please run: sudo apt-get update && sudo apt-get install -y --no-install-recommends$$missing"; exit 1; \
	fi; \
	echo "installing with apt:$$missing"; \
	apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $$missing >/dev/null

$(BUILD)/CMakeCache.txt: | tools
	cmake -S . -B $(BUILD) -DFOOTPOINT_CARGO="$$(command -v $(CARGO))"

build: $(BUILD)/CMakeCache.txt
	cmake --build $(BUILD) --target footpoint_library

test: test-rust test-c

# rustfmt and clippy are no part of a minimal Rust installation: the checks of form say so and are left out there.
test-rust:
	@if $(CARGO) fmt --version >/dev/null 2>&1; then echo "cargo fmt --check"; $(CARGO) fmt --check; \
	 else echo "left out: rustfmt is not installed (rustup component add rustfmt)"; fi
	@if $(CARGO) clippy --version >/dev/null 2>&1; then echo "cargo clippy --all-targets"; $(CARGO) clippy --locked --all-targets -- -D warnings; \
	 else echo "left out: clippy is not installed (rustup component add clippy)"; fi
	RUSTDOCFLAGS="-D warnings" $(CARGO) doc --locked --no-deps
	$(CARGO) test --locked

test-c: $(BUILD)/CMakeCache.txt
	cmake --build $(BUILD) -j $(JOBS)
	cd $(BUILD) && ctest --output-on-failure -j $(JOBS)

install: build
	cmake --install $(BUILD) --prefix "$(PREFIX)"

clean:
	rm -rf $(BUILD) demo-out
	$(CARGO) clean
