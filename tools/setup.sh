#!/usr/bin/env bash
# setup.sh run|test|bench|wheel|wheel-elsewhere|package|fuzz|format: sees to it that what `make run` and all pages of the
# program alone, `make test` and `make tidy`, `make bench` and pages with other tools, and the other targets of these names
# need is there. What is missing is installed by apt, after saying which package and why, and asking whoever sits at the
# terminal. Nobody is asked where YES=1 or CI is set, or where there is no terminal; YES=0 says no. Where apt cannot do it,
# this says what to install and goes on: the build then tells whether it was there after all.
set -euo pipefail
trap 'echo "setup: took $SECONDS s"' EXIT

# package | needed for | how to see that it is there (any one) | why
#   cmd:X a program on the path; inc:X a header the compiler finds; pc:X known to pkg-config;
#   py:X a module python3 imports
packages() {
  cat <<'TABLE'
g++                 | run   | cmd:g++                   | compiles C++20
cmake               | run   | cmd:cmake                 | describes the build
ninja-build         | run   | cmd:ninja                 | runs the build
pkg-config          | test  | cmd:pkg-config            | finds Ipopt
libfmt-dev          | run   | inc:fmt/format.h          | formats messages and files
libcli11-dev        | run   | inc:CLI/CLI.hpp           | reads the command line
libyaml-cpp-dev     | run   | inc:yaml-cpp/yaml.h       | reads scenarios
nlohmann-json3-dev  | run   | inc:nlohmann/json.hpp     | writes results as JSON
libboost-dev        | run   | inc:boost/numeric/odeint.hpp | integrates the plant (headers alone)
coinor-libipopt-dev | test  | pc:ipopt                  | what back end ipopt loads, and a solver for the tests of .nl files
libsqlite3-dev      | run   | inc:sqlite3.h             | keeps the results of sweeps
libsleef-dev        | run   | inc:sleef.h               | elementary functions on vectors
libgtest-dev        | test  | inc:gtest/gtest.h         | unit tests
libamplsolver-dev   | test  | inc:ampl-netlib-solvers/asl_pfgh.h | reads .nl files, in the tests' own solver
clang-format        | format | cmd:clang-format         | formats the source, and checks its format
clang-tidy          | test  | cmd:clang-tidy            | checks the source for mistakes
python3             | run   | cmd:python3               | finds which sources to compile together
chromium            | test  | cmd:chromium cmd:chromium-browser cmd:google-chrome | drives the report's page
nodejs              | test  | cmd:node                  | runs the test of the page
npm                 | test  | cmd:npm                   | installs playwright-core for the test of the page
python3-venv        | wheel | py:ensurepip              | keeps the tools of that build to a folder of their own
python3-dev         | wheel | pc:python3                | compiles the Python extension
dpkg-dev            | wheel | cmd:dpkg-source           | unpacks the sources of what the wheel has inside
tcl                 | wheel | cmd:tclsh                 | puts SQLite's sources into one file
make                | wheel | cmd:make                  | does so
gcc                 | wheel | cmd:cc                    | compiles what SQLite's sources are made with
debootstrap         | wheel-elsewhere | cmd:debootstrap | makes other releases of Debian to try the wheel in
python3-venv        | bench | py:ensurepip              | keeps the peers they compare with to a folder of their own
pkg-config          | bench | cmd:pkg-config            | finds Ipopt, and tells versions of libraries
gcc                 | bench | cmd:gcc                   | compiles the C code those peers generate
make                | bench | cmd:make                  | builds acados' generated solver
dpkg-dev            | package | cmd:dpkg-shlibdeps        | finds what the Debian package depends on
coinor-libipopt-dev | bench | pc:ipopt                  | the peer that the perturbed cycles are solved by
linux-perf          | bench | cmd:perf                  | samples the profile of a solve
clang               | fuzz  | cmd:clang++               | compiles the fuzzers
libclang-rt-dev     | fuzz  | fuzzer:                   | libFuzzer, which runs them
TABLE
}

trim() { sed -E 's/^[[:space:]]+|[[:space:]]+$//g' <<<"$1"; }

has_header() {
  if command -v g++ >/dev/null; then
    echo "#include <$1>" | g++ -std=c++20 -fsyntax-only -x c++ - 2>/dev/null
  else
    [ -e "/usr/include/$1" ] || [ -e "/usr/local/include/$1" ]
  fi
}

has_fuzzer() {
  echo 'extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }' |
    clang++ -fsanitize=fuzzer -x c++ - -o /dev/null 2>/dev/null
}

# Debian's own word first: it is quick; then the thing itself, which may come from elsewhere.
is_there() {
  local package=$1 probe
  if command -v dpkg-query >/dev/null &&
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ]; then
    return 0
  fi
  for probe in $2; do
    case $probe in
      cmd:*) command -v "${probe#cmd:}" >/dev/null && return 0 ;;
      inc:*) has_header "${probe#inc:}" && return 0 ;;
      fuzzer:) has_fuzzer && return 0 ;;
      py:*) python3 -c "import ${probe#py:}" 2>/dev/null && return 0 ;;
      pc:*) command -v pkg-config >/dev/null && pkg-config --exists "${probe#pc:}" && return 0 ;;
    esac
  done
  return 1
}

wanted() { # needed for $1, when asked for $2
  local of="run $2"
  case $2 in
    test) of="run test wheel package format" ;;
    wheel-elsewhere) of="run wheel wheel-elsewhere" ;;
    format) of=format ;;
  esac
  [[ " $of " == *" $1 "* ]]
}

missing_for() {
  local package needed probes why
  while IFS='|' read -r package needed probes why; do
    package=$(trim "$package") needed=$(trim "$needed") why=$(trim "$why")
    if wanted "$needed" "$1" && ! is_there "$package" "$probes"; then
      printf '  %-20s %s\n' "$package" "$why"
    fi
  done < <(packages)
}

may_install() {
  local answer=${YES:-}
  if [ -z "$answer" ] && [ -z "${CI:-}" ] && [ -t 0 ]; then
    read -r -p "setup: install them with apt? [y/N] " answer || answer=no
    answer=${answer:-no}
  fi
  case $answer in
    0 | [nN] | [nN][oO]) return 1 ;;
    '' | 1 | [yY] | [yY][eE][sS]) return 0 ;;
    *) return 1 ;;
  esac
}

go_on() {
  echo "setup: $1"
  echo "setup: install the above by other means if the build misses them; going on."
  exit 0
}

purpose=${1:-}
case $purpose in
  run | test | bench | wheel | wheel-elsewhere | package | fuzz | format) ;;
  *)
    echo "usage: tools/setup.sh run|test|bench|wheel|wheel-elsewhere|package|fuzz|format" >&2
    exit 2
    ;;
esac

missing=$(missing_for "$purpose")
if [ -z "$missing" ]; then
  echo "setup: all that 'make $purpose' needs is there"
  exit 0
fi
echo "setup: 'make $purpose' needs these Debian packages, which are missing:"
echo "$missing"
names=$(awk '{print $1}' <<<"$missing")

command -v apt-get >/dev/null || go_on "there is no apt here to install them with."
may_install || go_on "not installed."
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || go_on "neither root nor sudo: apt cannot install them."
  as_root=(sudo)
fi
export DEBIAN_FRONTEND=noninteractive
apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y)

echo "setup: installing them with apt"
# shellcheck disable=SC2086  # one word a package
{ "${apt[@]}" update && "${apt[@]}" install --no-install-recommends $names; } ||
  go_on "apt could not install them."
missing=$(missing_for "$purpose")
if [ -n "$missing" ]; then
  echo "$missing"
  go_on "these are still missing after the installation."
fi
echo "setup: all that 'make $purpose' needs is there"
