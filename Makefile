# The short way in: `make demo` and `make test` install what is missing, build and go. CMake does the work (see
# CMakePresets.json for debug and sanitizer builds).
BUILD ?= build
BUILD_TYPE ?= Release
PREFIX ?= /usr/local
# For whoever works on it a warning is an error; for whoever only builds it, not. But with the compiler that all of it is tested
# with (of Debian 12) it is for both: then `make test` after `make demo` compiles nothing again.
TESTED = -DBRICKFALL_TESTS=ON -DBRICKFALL_WERROR=ON
BUILT = -DBRICKFALL_TESTS=OFF $$(test "$$(c++ -dumpversion 2>/dev/null)" = 12 && echo -DBRICKFALL_WERROR=ON)
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
SCENE ?= wall

# A fresh tree compiles each module of the engine as one file, a third of the time; whoever works on it wants
# cmake -B build -DBRICKFALL_UNITY=OFF.
CONFIGURE = cmake -S . -B $(BUILD) $$(test -f $(BUILD)/CMakeCache.txt || echo -G Ninja -DCMAKE_BUILD_TYPE=$(BUILD_TYPE) -DBRICKFALL_UNITY=ON)

.PHONY: help docs gallery dist deb demo build view render test validate fuzz golden same-bits check bench install clean
.DEFAULT_GOAL := help

help:
	@echo "make demo               build, knock the wall down, leave out/wall/replay.html to watch (SCENE=hole for another)"
	@echo "make view               build brickfall-view and open its window (SCENE=hole for another)"
	@echo "make test               build everything and run every test"
	@echo "make validate           the laws at full length: minutes of simulated time, many seeds, small steps"
	@echo "make fuzz               made-up files thrown at every reader, five minutes each (needs clang)"
	@echo "make golden             write the state hashes of the shipped scenes anew, after results were meant to change"
	@echo "make same-bits          the same bits from every compiler, level of optimisation and instruction set at hand"
	@echo "make build              build only: the command is then $(BUILD)/bin/brickfall"
	@echo "make render             also brickfall render (pictures and films), with the packages that it needs"
	@echo "make check              the tests and the rules of the source (tools/check)"
	@echo "make bench              figures of the shipped scenes, as a table (tools/bench)"
	@echo "make install PREFIX=... install command, library, scenes and CMake package (default /usr/local)"
	@echo "make docs               the documents as a site, out/docs/index.html, with the library's reference and a check of all links"
	@echo "make gallery            replays of the shipped scenes for the site, in out/gallery (GALLERY='wall hole' for others)"
	@echo "make dist               a release archive, out/brickfall-VERSION.tar.gz: builds without node and without a network"
	@echo "make deb                a Debian package of what was built, in $(BUILD)/deb/, and a try whether it runs"
	@echo "make clean              remove $(BUILD)/ and out/"
	@echo "All but check and clean first install what is missing (Debian packages: apt-get, as root or with sudo)."

# The configuring step is quiet unless it fails; the tests need more packages than the demo, so they are left out of a
# fresh tree until `make test` turns them on.
build:
	@tools/install-dependencies build
	@test -f $(BUILD)/build.ninja || { $(CONFIGURE) $(BUILT); }
	@cmake --build $(BUILD) -j $(JOBS) --target brickfall_cli

demo: build
	@$(BUILD)/bin/brickfall run $(SCENE) -o out/$(SCENE)

# CMake looks again for what was missing before: quietly, unless it fails or still has to leave the program out.
look_again = cmake -S . -B $(BUILD) -D$(1)=ON >$(BUILD)/look-again.log || { cat $(BUILD)/look-again.log; exit 1; }; \
  ! grep -F '$(2) is left out' $(BUILD)/look-again.log >&2

render:
	@tools/install-dependencies build render
	@test -f $(BUILD)/build.ninja || { $(CONFIGURE) $(BUILT); }
	@$(call look_again,BRICKFALL_RENDER,brickfall-render)
	@cmake --build $(BUILD) -j $(JOBS) --target brickfall_cli brickfall_render

view:
	@tools/install-dependencies build view
	@test -f $(BUILD)/build.ninja || { $(CONFIGURE) $(BUILT); }
	@$(call look_again,BRICKFALL_VIEWER,brickfall-view)
	@cmake --build $(BUILD) -j $(JOBS) --target brickfall_cli brickfall_view
	@$(BUILD)/bin/brickfall view $(SCENE)

test:
	@tools/install-dependencies build test
	@$(CONFIGURE) $(TESTED)
	@cmake --build $(BUILD) -j $(JOBS)
	@ctest --test-dir $(BUILD) --output-on-failure -j $(JOBS)

fuzz:
	@tools/install-dependencies build test
	@$(CONFIGURE) $(TESTED)
	@cmake --build $(BUILD) -j $(JOBS) --target brickfall_fuzz

# Runs all laws, short and long, and writes docs/validation.md from what they recorded. LAWS='*Row7*' runs some of them; the
# records of the others stay as they were.
LAWS ?= *
validate:
	@tools/install-dependencies build test
	@$(CONFIGURE) $(TESTED)
	@cmake --build $(BUILD) -j $(JOBS) --target brickfall_cli test_law brickfall_validate test_ledger_scenes \
	  brickfall_validate_solver brickfall_validate_toolkit brickfall_validate_collision brickfall_validate_continuous
	@JOBS=$(JOBS) tools/validate $(BUILD) '$(LAWS)'

# Results that were meant to change: the table that the tests hold the shipped scenes against.
golden:
	@tools/install-dependencies build test
	@$(CONFIGURE) $(TESTED)
	@cmake --build $(BUILD) -j $(JOBS) --target golden_hashes
	@$(BUILD)/bin/golden_hashes tests/determinism/golden_hashes.txt
	@git --no-pager diff --stat -- tests/determinism/golden_hashes.txt 2>/dev/null || true

# Every compiler, level of optimisation and instruction set at hand, each a build of its own.
same-bits:
	@tools/install-dependencies build test
	@$(CONFIGURE) $(TESTED)
	@cmake --build $(BUILD) --target same_bits

check:
	@tools/check

# Figures of the shipped scenes; SCENES="wall hole:speed=5" for others.
bench: build
	@command -v python3 >/dev/null || { echo "brickfall: make bench needs python3" >&2; exit 1; }
	@tools/bench --command $(BUILD)/bin/brickfall $(SCENES)

install: build
	@cmake --build $(BUILD) -j $(JOBS) --target brickfall_cli
	@cmake --install $(BUILD) --prefix $(PREFIX)

# With the gallery, if `make gallery` has made one.
docs:
	@tools/install-dependencies docs
	@tools/docs out/docs $$(test -f out/gallery/index.html && echo --gallery out/gallery)

# Replays that the project makes itself, with one page that shows them; ADDRESS=https://... of it, for previews of links.
GALLERY ?= wall wall-hits house round-tower dome arch garden-gate domino-spiral wrecking-ball bridge pendulum-wall shake-table
gallery: build
	@tools/gallery --command $(BUILD)/bin/brickfall $(if $(ADDRESS),--address $(ADDRESS)) out/gallery $(GALLERY)

# The source as it is committed, with the page bundled.
dist: build
	@tools/dist $(BUILD) out

deb: build
	@tools/install-dependencies deb
	@cmake --build $(BUILD) -j $(JOBS)
	@cmake -DBUILD_DIR=$(BUILD) -DWORK_DIR=$(abspath $(BUILD))/deb -P tests/package/deb.cmake

clean:
	@rm -rf $(BUILD) out
