#!/usr/bin/env bash
# Builds and runs every test: the unit tests with sanitizers, then the release build with all checks.
# Goes on after a failure, sums up what failed and how long each part took, and fails if anything did.
# A build that fails counts as one failure.
set -uo pipefail
cd "$(dirname "$0")/.."

jobs=$(nproc 2>/dev/null || echo 2)
passed=0
failed=0
skipped=0
failures=()
parts=()

note_failure() {
  failures+=("$1")
  failed=$((failed + 1))
}

# The count `name` (tests, failures, ...) of a JUnit file's <testsuite>.
count() { grep -o "\b$2=\"[0-9]*\"" "$1" | head -1 | grep -o '[0-9]*'; }

# timed TITLE COMMAND...: notes seconds of the clock and of the processors.
timed() {
  local TIMEFORMAT="%0R s, %0U + %0S s of processors" code
  echo "== $1"
  # What the command itself writes goes past the note that `time` writes.
  { time "${@:2}" >&3 2>&4; } 3>&1 4>&2 2>"$notes"
  code=$?
  parts+=("$1: $(tail -1 "$notes")")
  return "$code"
}

run_ctest() { # PRESET TITLE JOBS
  local file=$PWD/build/tests-$1.xml tests bad out
  rm -f "$file"
  timed "$2" ctest --preset "$1" -j "$3" --output-junit "$file"
  local code=$?
  if [ ! -f "$file" ]; then
    note_failure "$2: ctest did not run"
    return
  fi
  tests=$(count "$file" tests)
  bad=$(count "$file" failures)
  out=$(($(count "$file" skipped) + $(count "$file" disabled)))
  passed=$((passed + tests - bad - out))
  skipped=$((skipped + out))
  if [ "$bad" -gt 0 ]; then
    failed=$((failed + bad))
    failures+=("$2: $bad of $tests")
  elif [ "$code" -ne 0 ]; then
    note_failure "$2: ctest ended with $code"
  fi
}

step() { # TITLE COMMAND...
  timed "$@" && return 0
  note_failure "$1"
  return 1
}

configure() { # both at once: each by itself keeps less than one processor busy
  local preset pids=() code=0
  for preset in asan release; do
    cmake --preset "$preset" -DSLALOM_TESTS=ON >"$logs/$preset" 2>&1 &
    pids+=($!)
  done
  for pid in "${pids[@]}"; do wait "$pid" || code=1; done
  cat "$logs"/{asan,release}
  return $code
}
build() { cmake --build --preset "$1" -j "$jobs"; }

mkdir -p build
logs=$(mktemp -d)
notes=$logs/notes
trap 'rm -rf "$logs"' EXIT
start=$SECONDS
step "configure" configure
if step "build with sanitizers" build asan; then run_ctest asan "unit tests with sanitizers" "$jobs"; fi
# One more than there are processors: the wheel's and the command line's tests wait now and then.
if step "release build" build release; then
  run_ctest release "tests and checks of the release build" $((jobs + 1))
fi

echo
printf '%s\n' "${parts[@]}"
python3 tools/measured.py --check
echo "took $(((SECONDS - start) / 60)) min $(((SECONDS - start) % 60)) s"
for failure in "${failures[@]}"; do echo "FAILED: $failure"; done
if [ "$skipped" -gt 0 ]; then echo "$skipped skipped"; fi
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
