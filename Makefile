# `make test` and `make reproduce` start from a bare Debian 12: they install packages, build and run.
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.DEFAULT_GOAL := help
MAKEFLAGS += --no-print-directory

PAPER ?= carr2006
METHOD ?= grid_fluid
MINUTES ?= 10
CASES ?= 100000
INPUTS ?= 10000
SEED ?= 17
KILLS ?= 1000
RELEASE ?= trixie
JOBS ?= $(shell nproc)
LINT = $(if $(SINCE),--since $(SINCE)) $(if $(LINT_SECONDS),--seconds $(LINT_SECONDS)) $(FILES)
PROGRAM := build/release/dustbench
# The environment of programs built with sanitizers, as in the test preset `asan`.
SANITIZED = ASAN_OPTIONS=detect_leaks=1 ASAN_SYMBOLIZER_PATH=/usr/bin/llvm-symbolizer-16 \
	LSAN_OPTIONS=suppressions=$(CURDIR)/tests/sanitizers/leaks.supp UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1

# The compiler cache stores paths relative to the tree, so that a copy of the tree finds its objects there.
export CCACHE_BASEDIR ?= $(CURDIR)
export CCACHE_NOHASHDIR ?= true
export CTEST_PARALLEL_LEVEL ?= $(JOBS)

SOURCES = $(shell find methods bench tests -name '*.h' -o -name '*.cpp' | LC_ALL=C sort)

.PHONY: help
help: ## List the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-14s %s\n", $$1, $$2 }' Makefile

.PHONY: packages
packages: ## Install missing Debian packages
	@.ci/install build
	@.ci/install view || echo "make: continuing without the packages of the window (dustbench view)" >&2

# Removes the build folders of a moved or copied tree before make checks their dates.
ifneq ($(filter-out help packages portable portable-elsewhere elsewhere format format-check clean,$(or $(MAKECMDGOALS),help)),)
DROPPED := $(shell .ci/drop-stale-builds build/*)
endif

# For the first configuration and for changed presets; after a change to a CMakeLists.txt, Ninja configures automatically.
build/%/build.ninja: CMakePresets.json | packages
	@cmake --preset $*
	@touch $@

build/asan/build.ninja: | sanitizers

.PHONY: sanitizers
sanitizers:
	@.ci/install sanitizers

.PHONY: build
build: build/release/build.ninja ## Build the program, build/release/dustbench
	@cmake --build --preset release --parallel $(JOBS) --target dustbench

.PHONY: check
check: build/release/build.ninja ## Check a module (MODULE=weighted_oit; default: changes since origin/main): build, tests, rules, format, lint
	@.ci/gates check $(if $(SINCE),--since $(SINCE)) $(MODULE)

.PHONY: all-gates
all-gates: ## Run every gate of .ci/run, whatever has changed (about an hour)
	@.ci/gates run --all

.PHONY: package
package: build ## Build the Debian package, build/release/dustbench_*.deb
	@.ci/install package
	@cpack --config build/release/CPackConfig.cmake -B build/release

.PHONY: portable
portable: ## Build one file for any Linux on x86-64, build/dustbench-VERSION-linux-x86_64.tar.zst
	@JOBS=$(JOBS) .ci/portable

.PHONY: view
view: build ## Compare billboards with an octree in a window (needs a display)
	@$(PROGRAM) view --method billboard --with octree_search

.PHONY: reproduce
reproduce: build ## Run a paper's experiments quickly (PAPER=carr2006); results in reports/out/
	@$(PROGRAM) reproduce --paper $(PAPER) --quick --out reports/out/$(PAPER)

.PHONY: sample
sample: build ## Measure the sample reports in reports/sample, and README's table and chart
	@python3 reports/sample/make_sample.py $(PROGRAM)

.PHONY: full
full: build ## Do a full run of a paper (PAPER=carr2006, up to two hours); tables in reports/sample/PAPER/full
	@python3 reports/sample/make_sample.py --full $(PROGRAM) $(PAPER)

.PHONY: test
test: build/release/build.ninja ## Build everything and run every test
	@.ci/install browser
	@cmake --build --preset release --parallel $(JOBS)
	@ctest --preset release

.PHONY: long
long: build/release/build.ninja ## Simulate a minute of every delivered particle system at full size
	@cmake --build --preset release --parallel $(JOBS) --target plugin_particles_tests
	@DUSTBENCH_FULL_SIZE=1 build/release/plugin_particles_tests --gtest_filter='*DeliveredSystemsAreStable'

.PHONY: fuzz
fuzz: build/release/build.ninja build/asan/build.ninja ## Test with mutated files, command lines and results (MINUTES=10); findings in build/fuzz
	@cmake --build --preset release --parallel $(JOBS) --target dustbench
	@cmake --build --preset asan --parallel $(JOBS) --target fuzz_tests
	@$(SANITIZED) python3 -B tests/fuzz/long_run.py --minutes $(MINUTES) \
	    --readers build/asan/fuzz_tests --program $(PROGRAM) --findings build/fuzz

.PHONY: fuzz-guided
fuzz-guided: packages ## Test our text readers with Clang's libFuzzer (MINUTES=10 for all six); findings in build/fuzz/guided
	@.ci/install sanitizers
	@tests/fuzz/coverage/coverage_guided.sh $$(($(MINUTES) * 10)) build/fuzz/guided

.PHONY: fuzz-volumes
fuzz-volumes: packages ## Test mutants of OpenVDB's files under sanitizers (CASES=100000); findings in build/fuzz/volumes
	@tests/fuzz/openvdb/vdb_mutants.sh $(CASES) build/fuzz/volumes

.PHONY: bench
bench: build/release/build.ninja ## Run every benchmark program
	@cmake --build --preset release --parallel $(JOBS) --target benches
	@for program in build/release/*_bench; do echo "== $$program"; "$$program"; done

.PHONY: without
without: build/release/build.ninja ## Build, list and run with an added method and without one (METHOD=grid_fluid), in a copy of the tree
	@cmake -DSOURCE=$(CURDIR) -DWORK=$(CURDIR)/build/add_a_method -DWITHOUT=$(METHOD) -P tests/add_a_method/add_a_method.cmake

.PHONY: planted
planted: packages ## Plant faults in a copy of the tree; tests and verdicts must detect them (FAULTS=NAME …; default: all)
	@JOBS=$(JOBS) python3 -B tests/planted/planted.py $(FAULTS)

.PHONY: asan
asan: build/asan/build.ninja ## Run the unit tests under AddressSanitizer and UndefinedBehaviorSanitizer
	@cmake --build --preset asan --parallel $(JOBS) --target unit_tests
	@ctest --preset asan --exclude-regex _NOT_BUILT

.PHONY: view-random
view-random: build/asan/build.ninja ## Send random inputs to the window's panels under AddressSanitizer (INPUTS=10000 SEED=17)
	@cmake --build --preset asan --parallel $(JOBS) --target bench_panels_tests
	@$(SANITIZED) DUSTBENCH_RANDOM_INPUTS=$(INPUTS) DUSTBENCH_RANDOM_SEED=$(SEED) \
		build/asan/bench_panels_tests --gtest_filter='*RandomInput*'

.PHONY: golden
golden: build/release/build.ninja ## Redraw the window's golden pictures; look at them before you commit them
	@cmake --build --preset release --parallel $(JOBS) --target bench_panels_tests
	@DUSTBENCH_GOLDEN=write build/release/bench_panels_tests --gtest_filter='GoldenPictures.*'

.PHONY: documents
documents: build/release/build.ninja ## Write the tables in reports/ that are made from declarations
	@cmake --build --preset release --parallel $(JOBS) --target bench_results_tests
	@DUSTBENCH_DOCUMENTS=write build/release/bench_results_tests --gtest_filter='*Documents.*'

.PHONY: faults
faults: build/release/build.ninja ## Let every system call fail once, and kill the program 1,000 times (KILLS=1000): about an hour
	@cmake --build --preset release --parallel $(JOBS) --target dustbench failing_calls
	@python3 -B tests/faults/faults_test.py $(PROGRAM) build/release/tests/libfailing_calls.so build/release/tests/faults
	@python3 -B tests/faults/kills.py $(PROGRAM) build/release/tests/kills --kills $(KILLS)

.PHONY: external
external: build ## Compare our reference images with POV-Ray, vdb_render and Cycles, where installed; figures in tests/external
	@python3 -B tests/external/external.py $(PROGRAM) --write tests/external/figures.csv

.PHONY: elsewhere
elsewhere: ## Run both commands of README in a bare system of another Debian release (RELEASE=trixie; needs root)
	@tests/elsewhere/readme_commands.sh $(RELEASE)

.PHONY: portable-elsewhere
portable-elsewhere: portable ## Run the portable file in bare Debian 12 and 13 with nothing but Mesa, and follow the Containerfile (needs root)
	@tests/elsewhere/portable_file.sh build/dustbench-*-linux-x86_64.tar.zst
	@tests/elsewhere/container_file.sh

.PHONY: tsan
tsan: build/tsan/build.ninja ## Run the unit tests that need no GPU under ThreadSanitizer
	@cmake --build --preset tsan --parallel $(JOBS) --target cpu_tests
	@ctest --preset tsan --exclude-regex _NOT_BUILT

.PHONY: format
format: ## Format all sources with clang-format
	@.ci/install format
	@clang-format-14 -i $(SOURCES)

.PHONY: format-check
format-check: ## List the sources that `make format` would change
	@.ci/install format
	@clang-format-14 --dry-run --Werror $(SOURCES)

.PHONY: lint
lint: build/lint/build.ninja ## Run clang-tidy on all sources, on FILES=…, or on changes since a revision (SINCE=origin/main)
	@.ci/install lint
	@cmake --build --preset lint --parallel $(JOBS) --target generated_headers
	@.ci/lint $(LINT)

.PHONY: clean
clean: ## Remove everything that was built (keeps the results in reports/out/)
	@rm -rf build
