#!/usr/bin/env bash
# run.sh CMAKE BUILD: installs the build tree BUILD into a fresh prefix, builds the consumer in this
# folder from that prefix alone, and runs it and the installed program.
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
"$cmake" -S "$here" -B "$work/consumer" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Debug
"$cmake" --build "$work/consumer"
SLALOM_CONFIG_DIR=$prefix/share/slalom/config "$work/consumer/consumer"

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
