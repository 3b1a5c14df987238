#!/usr/bin/env bash
# run.sh CMAKE BUILD: installs the build tree BUILD into a fresh prefix, builds the consumer in this
# folder and the programs of docs/cpp.md from that prefix alone, and runs them and the installed program.
set -euo pipefail

cmake=$1
build=$2
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix

"$cmake" --install "$build" --prefix "$prefix" >"$work/install.log" || {
  cat "$work/install.log"
  exit 1
}
# The page's C++ blocks, in their order: page_1.cpp, page_2.cpp, ...
mkdir "$work/page"
awk -v folder="$work/page" '
  /^```cpp$/ { file = folder "/page_" ++count ".cpp"; next }
  /^```$/ { file = "" }
  file { print > file }' "$here/../../docs/cpp.md"

"$cmake" -S "$here" -B "$work/consumer" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Debug \
  -DPAGE_PROGRAMS="$work/page"
"$cmake" --build "$work/consumer"
# Without Sleef the package is not found, and says why.
sleef=$(dirname "$(realpath "$(g++ -print-file-name=libsleef.so)")")
if "$cmake" -S "$here" -B "$work/without" -DCMAKE_PREFIX_PATH="$prefix" \
  "-DCMAKE_IGNORE_PATH=$sleef;${sleef#/usr}" >"$work/without.log" 2>&1 ||
  ! tr -s '\n ' ' ' <"$work/without.log" | grep -q "the library sleef is missing"; then
  cat "$work/without.log"
  echo "the package does not say that Sleef is missing"
  exit 1
fi
export SLALOM_CONFIG_DIR=$prefix/share/slalom/config
"$work/consumer/consumer"

# expect PROGRAM PATTERN: what the page's program prints.
expect() {
  local says
  says=$("$work/consumer/$1")
  grep -Eq "$2" <<<"$says" || {
    echo "$1 of docs/cpp.md says '$says', expected $2"
    exit 1
  }
  echo "$1: $says"
}
expect page_1 '^goal at 6\.[0-9]+ s$'
expect page_2 '^solved (4|3\.9999|4\.0000)[0-9]* [0-9.]+e-[0-9]+$'
if [ -e "$work/page/page_3.cpp" ]; then
  echo "docs/cpp.md has a third program that nothing here expects"
  exit 1
fi

# The installed program finds the configuration installed beside it, not the source tree's.
version=$(sed -n 's/^set(PACKAGE_VERSION "\(.*\)")$/\1/p' \
  "$(find "$prefix" -name slalomConfigVersion.cmake)")
says=$("$prefix/bin/slalom" --version)
if [ "$says" != "slalom $version" ]; then
  echo "the package has version '$version', the program says '$says'"
  exit 1
fi
unset SLALOM_CONFIG_DIR
mv "$prefix/share/slalom/config/scenarios/E_B.yaml" \
  "$prefix/share/slalom/config/scenarios/E_moved.yaml"
cd "$work"
"$prefix/bin/slalom" list | grep -q E_moved || {
  echo "the installed program does not list the scenarios installed beside it:"
  "$prefix/bin/slalom" list
  exit 1
}
echo "the installed program lists the scenarios installed beside it"
