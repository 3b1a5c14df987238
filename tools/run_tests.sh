#!/usr/bin/env bash
# Builds and runs every test and check of the release build. Goes on after a failure, sums up what failed and how long each part took, and fails if anything did.
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

run_ctest() { # TITLE JOBS
  local file=$PWD/build/tests.xml tests bad out
  rm -f "$file"
  timed "$1" ctest --preset release -j "$2" --output-junit "$file"
  local code=$?
  if [ ! -f "$file" ]; then
    note_failure "$1: ctest did not run"
    return
  fi
  tests=$(count "$file" tests)
  bad=$(count "$file" failures)
  out=$(($(count "$file" skipped) + $(count "$file" disabled)))
  passed=$((passed + tests - bad - out))
  skipped=$((skipped + out))
  if [ "$bad" -gt 0 ]; then
    failed=$((failed + bad))
    failures+=("$1: $bad of $tests")
  elif [ "$code" -ne 0 ]; then
    note_failure "$1: ctest ended with $code"
  fi
}

step() { # TITLE COMMAND...
  timed "$@" && return 0
  note_failure "$1"
  return 1
}

mkdir -p build
notes=$(mktemp)
trap 'rm -f "$notes"' EXIT
start=$SECONDS
step "configure" cmake --preset release -DSLALOM_TESTS=ON
# One more job than there are processors: the wheel's and the command line's tests wait now and then.
if step "build" cmake --build --preset release -j "$jobs"; then run_ctest "tests and checks" $((jobs + 1)); fi

echo
printf '%s\n' "${parts[@]}"
python3 tools/measured.py --check
echo "took $(((SECONDS - start) / 60)) min $(((SECONDS - start) % 60)) s"
for failure in "${failures[@]}"; do echo "FAILED: $failure"; done
if [ "$skipped" -gt 0 ]; then echo "$skipped skipped"; fi
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
