# SPDX-License-Identifier: MIT
# The front door. `make` alone prints this list; everything is built in build/ by cmake and ninja.

FW    ?= obstacle
WORLD ?= maze
T     ?=
ARGS  ?=
XC16  ?=
PACKAGES ?= build

BUILD  := build
OUT    := $(BUILD)/run
JOBS   := $(shell nproc)
CMAKE  := cmake -G Ninja -S .
NINJA  := python3 scripts/progress.py $(BUILD) $(JOBS)

.DEFAULT_GOAL := help
.PHONY: help setup tool build dev run test page check-page view test-view dspic check chip-tables tidy alone format bench asan tsan fuzz second routines levels \
  turn mutants students clean product install deb

## help: this list
help:
	@echo "Twinpuck: e-puck controllers on a PC, in virtual time."
	@echo
	@sed -n 's/^## \([a-z-]*\): *\(.*\)/  make \1\t\2/p' $(MAKEFILE_LIST) | expand -t 18
	@echo
	@echo "  variables: FW=controller (folder of firmware/)  WORLD=world (file of worlds/)  T=filter  ARGS=options"

## setup: install the packages that building and testing need
setup:
	@scripts/setup.sh $(PACKAGES)

# configures once; $(1): build folder, $(2): what differs from the usual build
define configure
@test -f $(1)/build.ninja || echo "configuring $(1)"; test -f $(1)/build.ninja || $(CMAKE) -B $(1) $(2) >$(1).log 2>&1 || { cat $(1).log; rm -f $(1).log; exit 1; }; rm -f $(1).log
endef

# the command and the firmware compiler, without tests
tool: setup
	$(call configure,$(BUILD),)
	@$(NINJA) twinpuck

## build: build everything for the PC
build: setup
	$(call configure,$(BUILD),)
	@$(NINJA)

# for work on it: each file by itself, so a touched one is all that is compiled; debug information
DEV := -DCMAKE_UNITY_BUILD=OFF -DTWINPUCK_OPTIMISE="-Og -g"

## dev: the command with debug information, built file by file, in build-dev/; T=test_program builds that as well
dev: setup
	$(call configure,$(BUILD)-dev,$(DEV))
	@python3 scripts/progress.py $(BUILD)-dev $(JOBS) twinpuck $(T)

## run: 60 simulated seconds of FW in WORLD: summary, CSV and picture
run: tool $(if $(findstring --report,$(ARGS)),page)
	@mkdir -p $(OUT)
	@$(BUILD)/twinpuck run worlds/$(WORLD).toml --fw '*=$(FW)' --for 60 --speed max \
	  --record $(OUT)/$(notdir $(FW)).csv --summary $(OUT)/$(notdir $(FW)).json \
	  --picture $(OUT)/$(notdir $(FW)).png $(ARGS)

## test: all tests that need no browser; T=filter selects by name
test: setup
	$(call configure,$(BUILD),)
	@scripts/run_tests.py $(BUILD) $(JOBS) --filter '$(T)'

## routines: routines of the runtime known by heart beside themselves, on ten million operands each: 25 minutes
routines: tool
	@TWINPUCK_ROUTINES=10000000 scripts/run_tests.py $(BUILD) $(JOBS) --programs routines_test --filter '$(T)'

## second: the chip's compiler beside avr-gcc on simavr: arguments and results of all shapes
second: tool
	@scripts/setup.sh second && scripts/run_tests.py $(BUILD) $(JOBS) --programs second_opinion --filter '$(T)'

# what only the page needs is fetched here: make run and make test do without
PAGE := viewer/page
$(PAGE)/node_modules/.package-lock.json: $(PAGE)/package-lock.json
	@scripts/setup.sh view
	@echo "fetching the page's packages"; cd $(PAGE) && npm ci --no-audit --no-fund --loglevel=error >/dev/null && touch node_modules/.package-lock.json

$(BUILD)/page/page.js: $(PAGE)/node_modules/.package-lock.json $(wildcard $(PAGE)/src/*.* $(PAGE)/src/*/*.*) $(PAGE)/index.html
	@scripts/setup.sh view
	@mkdir -p $(BUILD)/page && cp $(PAGE)/index.html $(BUILD)/page
	@esbuild page=$(PAGE)/src/main.ts start=$(PAGE)/src/start.ts --bundle --minify --target=es2020 --outdir=$(BUILD)/page --log-level=warning

## page: bundle the page of the live view and of reports (--report)
page: $(BUILD)/page/page.js

## check-page: the page's format, types and unit tests
check-page: $(PAGE)/node_modules/.package-lock.json
	@scripts/setup.sh view
	@cd $(PAGE) && npx prettier --check --log-level warn . && npx tsc -p .
	@esbuild $(PAGE)/tests/*.test.ts --bundle --platform=node --external:happy-dom --outdir=$(BUILD)/page-tests --log-level=warning
	@cd $(PAGE) && NODE_PATH=node_modules node --test --test-reporter=dot $(abspath $(BUILD))/page-tests/*.test.js

## view: FW in WORLD in the browser: see, touch and change it while it runs
view: tool $(BUILD)/page/page.js
	@$(BUILD)/twinpuck view worlds/$(WORLD).toml --fw '*=$(FW)' $(ARGS)

## test-view: the page in a real browser (chromium)
test-view: tool $(BUILD)/page/page.js
	@scripts/setup.sh browser
	@cd tests/browser && { test node_modules -nt package-lock.json || npm ci --no-audit --no-fund --loglevel=error >/dev/null; touch node_modules; }
	@node tests/browser/run.mjs '$(T)'

## dspic: cross-build FW for the robot: build/dspic/NAME.elf, .hex, .lst, .map; XC16=path does it with Microchip's compiler
ifeq ($(XC16),)
dspic: tool
	@mkdir -p $(BUILD)/dspic
	@$(BUILD)/twinpuck build '$(FW)' --hal dspic -o '$(BUILD)/dspic/$(notdir $(FW)).elf'
	@echo $(BUILD)/dspic/$(notdir $(FW)).hex
else
dspic:
	@scripts/build_dspic.sh '$(XC16)' '$(FW)' $(BUILD)/dspic
endif

# what is installed: the tool, its manual, the page
product: tool page
	@$(NINJA) manual embed python_core

PREFIX  ?= /usr/local
## install: into PREFIX (/usr/local), below DESTDIR if that is set; docs/start.md
install: product
	@DESTDIR='$(DESTDIR)' cmake --install $(BUILD) --prefix '$(PREFIX)' --strip >$(BUILD)/install.log || { cat $(BUILD)/install.log; exit 1; }
	@echo "installed in $(DESTDIR)$(PREFIX)"

## deb: the Debian package, in build/package/
deb: product
	@scripts/setup.sh deb
	@rm -rf $(BUILD)/package && mkdir $(BUILD)/package
	@cd $(BUILD) && cpack -G DEB >deb.log 2>&1 || { cat deb.log; exit 1; }
	@rm -rf $(BUILD)/_CPack_Packages; mv $(BUILD)/*twinpuck*.deb $(BUILD)/package; ls $(BUILD)/package/*.deb

## check: rules of code and pages: includes, names, sources of numbers, formatting, contract, timings; clang-tidy on the last changes
check: tool
	@scripts/setup.sh check
	@scripts/check_pages.py --test
	@scripts/check_sizes.py --test
	@scripts/each_file.py --test
	@scripts/check.py
	@scripts/check_contract.py
	@scripts/gen_sfr_header.py --check
	@scripts/gen_sfr_table.py --check
	@scripts/gen_configuration.py --check
	@scripts/gen_instruction_table.py --check
	@scripts/instruction_coverage.py --check
	@scripts/each_file.py $(BUILD) tidy
	@$(NINJA) twinpuck-dev bench_steps
	@$(BUILD)/twinpuck-dev timings --check
	@if test -d $(PAGE)/node_modules || command -v npm >/dev/null; then $(MAKE) --no-print-directory check-page; else echo "left out: the page's checks (npm is not here)"; fi

## tidy: clang-tidy on every source of the product: half an hour
tidy: setup
	@scripts/setup.sh check
	$(call configure,$(BUILD),)
	@scripts/each_file.py $(BUILD) tidy all

## chip-tables: times of the chip's models and tests of its instructions, as build/chip-timing.md and build/instructions.txt
chip-tables: tool
	@$(NINJA) chip_timing_doc
	@$(BUILD)/tests/chip_timing_doc $(BUILD)/chip-timing.md
	@scripts/instruction_coverage.py >$(BUILD)/instructions.txt
	@echo $(BUILD)/chip-timing.md $(BUILD)/instructions.txt

## alone: every source compiled by itself, without a result: each includes what it uses
alone: setup
	$(call configure,$(BUILD),)
	@scripts/each_file.py $(BUILD) alone

## format: format C++ sources in place
format:
	@scripts/setup.sh check
	@git ls-files '*.h' '*.cpp' | grep -v '^firmware/' | grep -v '^hal_sim/api/' | grep -v '^hal_dspic/' | grep -v '^firmware/library/' | xargs -r clang-format -i

## bench: speed for 1 to 1000 robots beside libenki, of the chip's core beside simavr
bench: tool
	@scripts/setup.sh bench
	@$(CMAKE) -B $(BUILD) >/dev/null
	@$(NINJA) bench bench_steps python_core
	@$(BUILD)/bin/bench $(ARGS)
	@PYTHONPATH=$(BUILD)/python /usr/bin/python3 bench/python_steps.py $(BUILD)

# the tests that run the simulator in their own process: the compiler's and the command's start others
SANITIZED = dspic30_test,sim_core_test,board_test,drivers_test,import_test,golden_test,firmware_test,chip_test,flash_test,programs_link_test,programs_nodes_test,controller_test,faults_test,python_test

## asan: the simulator's tests under the address and undefined-behaviour sanitizers
asan: setup
	@$(CMAKE) -B $(BUILD)-asan -DTWINPUCK_OPTIMISE="-O1 -g1" -DTWINPUCK_SANITIZE=address,undefined >/dev/null
	@scripts/run_tests.py $(BUILD)-asan $(JOBS) --filter '$(T)' --programs $(SANITIZED)

## tsan: the simulator's tests under the thread sanitizer
tsan: setup
	@$(CMAKE) -B $(BUILD)-tsan -DTWINPUCK_OPTIMISE="-O1 -g1" -DTWINPUCK_SANITIZE=thread >/dev/null
	@scripts/run_tests.py $(BUILD)-tsan $(JOBS) --filter '$(T)' --programs $(or $(TSAN),$(SANITIZED))

## fuzz: ten minutes of broken input of each kind (FUZZ_SECONDS=600, FUZZ_KINDS="world wbt ...")
fuzz: setup
	@scripts/setup.sh fuzz
	@$(CMAKE) -B $(BUILD)-fuzz -DCMAKE_C_COMPILER=clang-14 -DCMAKE_CXX_COMPILER=clang++-14 -DTWINPUCK_FUZZ=ON \
	  -DTWINPUCK_OPTIMISE="-O1 -g1" >/dev/null
	@ninja -C $(BUILD)-fuzz --quiet -j $(JOBS) $(or $(addprefix fuzz_,$(FUZZ_KINDS)),fuzzers)
	@scripts/fuzz.sh $(BUILD)-fuzz $(ARGS)

## levels: digests with the simulator at -O0 and -O2 must agree
levels: tool
	@scripts/digest_levels.sh $(BUILD)

## turn: one of the long checks (tsan, levels, a minute of three fuzz targets), by the number of commits
turn: tool
	@scripts/in_turn.sh

## mutants: faults planted in the sources, and which of them no test notices: hours (ARGS="--sites 25 --seed 2 --rooms flash,import")
mutants: setup
	@scripts/setup.sh mutants
	@for verb in plant reach run; do /usr/bin/python3 scripts/mutants.py $(BUILD)-mutants $$verb $(ARGS) || exit; done

## students: the students' edition, without the lab's solutions: build/twinpuck-students.tar.gz
students:
	@scripts/students.py $(BUILD)/twinpuck-students

## clean: remove everything that was built
clean:
	@rm -rf $(BUILD) $(BUILD)-asan $(BUILD)-tsan $(BUILD)-fuzz $(BUILD)-o0 $(BUILD)-dev $(BUILD)-mutants
