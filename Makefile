# One word for each thing to do; `make help` lists them. CMake does the work underneath.
.DEFAULT_GOAL := help
.PHONY: help run quick test sanitize fuzz tidy problems bench reproduce study results robustness realtime obstacle-choice model-choice sensitivity random-scenarios paper-sweep latency peers long-solves shape-forms verdicts perturbed verified-planner ablation belief-errors any-scenario solver-profile growth docs-measured wheel wheel-elsewhere package docs sweep-scale kills laps commonroad format clean build

JOBS := $(shell nproc 2>/dev/null || echo 2)

help: ## this list
	@echo "usage: make TARGET"
	@sed -n 's/^\([a-z-]*\):.*## /\1|/p' $(MAKEFILE_LIST) | \
	  while IFS='|' read -r name what; do printf '  %-16s %s\n' "$$name" "$$what"; done

build: ## the release build of program and library in build/, without setting anything up
	cmake --preset release
	cmake --build build --target slalom_app libslalom.a -j $(JOBS)

run: ## set up, build, and drive the paper's environments E_B and E_C into run/
	tools/setup.sh run
	$(MAKE) --no-print-directory build
	build/slalom simulate E_B --planner P_D --out run/E_B --force
	build/slalom simulate E_C --planner P_D --out run/E_C --force
	@echo
	@echo "Look at the drives: open these pages in a browser."
	@echo "  $(CURDIR)/run/E_B/report.html"
	@echo "  $(CURDIR)/run/E_C/report.html"

quick: ## build and run the unit tests of what changed, with format and layers
	tools/quick.py

test: ## set up, build, and run every test and check
	tools/setup.sh test
	tools/run_tests.sh

sanitize: ## the unit tests with address and undefined-behaviour sanitizers, and those of threads with the thread sanitizer
	tools/setup.sh test
	cmake --preset asan -DSLALOM_TESTS=ON
	cmake --build --preset asan -j $(JOBS)
	ctest --preset asan -j $(JOBS)
	cmake --preset tsan -DSLALOM_TESTS=ON
	cmake --build --preset tsan -j $(JOBS)
	ctest --preset tsan -j $(JOBS)

tidy: ## clang-tidy on every source by itself, and with the analyzer, which `make test` leaves out
	tools/setup.sh test
	cmake --preset release -DSLALOM_TESTS=ON
	tools/tidy.py --build build --alone --jobs $(JOBS)

bench: ## set up, and time the planner's solver beside its peers into docs/measured/benchmarks.md (takes hours)
	tools/setup.sh bench
	python3 benchmarks/run.py

peers: ## time tools for optimal control on the same problems into docs/measured/peers.md (takes an hour)
	tools/setup.sh bench
	tools/setup.sh wheel
	python3 benchmarks/ocp/peers.py

perturbed: ## thousands of perturbed cycles by ours and by Ipopt, into docs/measured/perturbed.md (takes half an hour)
	tools/setup.sh bench
	python3 benchmarks/perturb.py

solver-profile: ## where a solve's time goes, by perf, into docs/measured/solver-profile.md (takes minutes)
	tools/setup.sh bench
	python3 benchmarks/profile.py

growth: ## time against intervals, obstacles, phases, points, controls and states, into docs/measured/growth.md (takes minutes)
	tools/setup.sh bench
	python3 benchmarks/growth.py

reproduce: ## all drives of the paper's figures into run/reproduce/, ours beside the paper's
	tools/setup.sh run
	$(MAKE) --no-print-directory build
	build/slalom reproduce --out run/reproduce --force

study: ## the paper's sweep of 800 drives into run/study/, with its page; goes on where it stopped
	tools/setup.sh run
	$(MAKE) --no-print-directory build
	build/slalom sweep paper --out run/study
	build/slalom study-report run/study

sweep-scale: ## 100,000 very short trials: rate, memory, how soon a sweep goes on, into docs/measured/sweep-scale.md (takes half an hour)
	tools/setup.sh run
	$(MAKE) --no-print-directory build
	python3 benchmarks/sweep_scale.py --program build/slalom

kills: ## sweeps, shards and merges killed at random moments and run on, into docs/measured/kills.md (takes minutes)
	tools/setup.sh run
	$(MAKE) --no-print-directory build
	python3 tools/kills.py --program build/slalom

results: ## the paper's drives into docs/measured/results.md and figures/
	tools/setup.sh run
	$(MAKE) --no-print-directory build
	python3 tools/paper_pages.py results

paper-sweep: ## the paper's sweep on both grids and with one thing changed, into docs/measured/paper-sweep.md (takes 20 minutes)
	tools/setup.sh run
	$(MAKE) --no-print-directory build
	python3 tools/paper_pages.py paper-sweep

latency: ## what each latency rule does to the pass rate, into docs/measured/latency.md
	tools/setup.sh run
	$(MAKE) --no-print-directory build
	python3 tools/latency.py --program build/slalom

verdicts: ## each claim of the paper judged by our drives and sweeps, into docs/measured/verdicts.md and paper-index.md
	tools/setup.sh run
	$(MAKE) --no-print-directory build
	python3 tools/paper_pages.py verdicts paper-index

long-solves: ## long cold plans beside CasADi with Ipopt, into docs/measured/long-solves.md (takes a quarter of an hour)
	tools/setup.sh bench
	$(MAKE) --no-print-directory build
	python3 benchmarks/long_solves.py --program build/slalom

shape-forms: ## ways to keep a rectangle off rectangles in an OCP, into docs/measured/shape-forms.md (takes a quarter of an hour)
	tools/setup.sh bench
	python3 benchmarks/shape_forms.py

robustness: ## outcomes over floors, starts and horizons into docs/measured/robustness.csv, .svg and .md (takes minutes)
	tools/setup.sh run
	$(MAKE) --no-print-directory build
	python3 tools/robustness.py --program build/slalom

realtime: ## planning times beside the execution horizon into docs/measured/realtime.md
	tools/setup.sh run
	$(MAKE) --no-print-directory build
	python3 tools/realtime.py --program build/slalom

obstacle-choice: ## what leaving out obstacles does, into docs/measured/obstacle-choice.md
	tools/setup.sh run
	$(MAKE) --no-print-directory build
	python3 tools/obstacle_choice.py --program build/slalom

model-choice: ## how P_D drives with each model it may have in mind, into docs/measured/model-choice.md
	tools/setup.sh run
	$(MAKE) --no-print-directory build
	python3 tools/model_choice.py --program build/slalom

sensitivity: ## how far plant and sensors may be from what P_D and P_E believe, into docs/measured/sensitivity.md (takes an hour)
	tools/setup.sh run
	$(MAKE) --no-print-directory build
	python3 tools/sensitivity.py --program build/slalom

docs-measured: ## every page of docs/measured/ anew, the quickest first (takes hours)
	@failed=; for target in $$(python3 tools/measured.py --targets); do \
	  $(MAKE) --no-print-directory $$target || failed="$$failed $$target"; done; \
	if [ -n "$$failed" ]; then echo "docs-measured: failed:$$failed"; exit 1; fi
	python3 tools/measured.py --check

problems: ## every problem of the library by two schemes, beside its known value
	tools/setup.sh run
	$(MAKE) --no-print-directory build
	build/slalom problems --all

wheel: ## set up, and build the Python package, for any Linux, into dist/
	tools/setup.sh wheel
	tools/python.sh wheel dist

wheel-elsewhere: ## install and drive with that wheel in other releases of Debian, as root (takes minutes)
	tools/setup.sh wheel-elsewhere
	tools/wheel_elsewhere.sh

package: ## set up, and build a Debian package of program and library into dist/
	tools/setup.sh package
	$(MAKE) --no-print-directory build
	cpack --config build/CPackConfig.cmake -B dist

docs: wheel ## the documentation's site into build/docs/
	tools/docs.sh dist build/docs

random-scenarios: ## P_A to P_D on 1000 random scenarios, into docs/measured/random-scenarios.md (takes minutes)
	tools/setup.sh run
	$(MAKE) --no-print-directory build
	python3 tools/random_scenarios.py --program build/slalom

verified-planner: ## P_E beside P_D in the paper's sweep and random scenarios, into docs/measured/verified-planner.md (takes half an hour)
	tools/setup.sh run
	$(MAKE) --no-print-directory build
	python3 tools/verified_planner.py --program build/slalom

ablation: ## P_E with one part of it left out at a time, into docs/measured/ablation.md (takes half an hour)
	tools/setup.sh run
	$(MAKE) --no-print-directory build
	python3 tools/planner_ablation.py --program build/slalom

any-scenario: ## random valid scenarios with random options, and what is at fault, into docs/measured/any-scenario.md (takes an hour)
	tools/setup.sh run
	$(MAKE) --no-print-directory build
	python3 tools/any_scenario.py --program build/slalom

belief-errors: ## P_E with plant and sensors not as believed, 10,000 drives, into docs/measured/belief-errors.md (takes hours)
	tools/setup.sh run
	$(MAKE) --no-print-directory build
	python3 tools/belief_errors.py --program build/slalom

fuzz: ## feed what reads files, answers, options and requests with millions of inputs, for SECONDS=600
	tools/setup.sh fuzz
	tools/fuzz.py --seconds $(or $(SECONDS),600) --jobs $(JOBS)

laps: ## laps of the tracks in TRACKS=folder beside CasADi's and in closed loop, into docs/measured/laps.md (takes an hour)
	@test -n "$(TRACKS)" || { echo "laps: TRACKS=folder of race tracks as CSV files is wanted (docs/import.md)"; exit 2; }
	tools/setup.sh bench
	$(MAKE) --no-print-directory build
	python3 benchmarks/laps.py "$(TRACKS)" --program build/slalom

commonroad: ## the CommonRoad scenarios in FILES=folder driven and judged, into docs/measured/commonroad.md (takes minutes)
	@test -n "$(FILES)" || { echo "commonroad: FILES=folder of CommonRoad's XML files is wanted (docs/import.md)"; exit 2; }
	tools/setup.sh run
	$(MAKE) --no-print-directory build wheel
	python3 tools/commonroad_page.py "$(FILES)" --program build/slalom

format: ## format the C++ sources
	tools/setup.sh format
	tools/format.sh

clean: ## remove the build trees, dist/ and what `make run` wrote; what was measured stays in run/
	rm -rf build build-python build-portable build-debug build-asan build-tsan build-fuzz dist run/E_B run/E_C \
	  tests/browser/node_modules
