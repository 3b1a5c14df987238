#!/usr/bin/env bash
# ripopt.sh FOLDER TESTS: runs the tests of back end nl, programs in TESTS, by ripopt, a solver that
# reads .nl files and comes from PyPI; installs it into FOLDER unless it is there.
set -euo pipefail
package=pyomo-ripopt==0.8.2
folder=$1 tests=$2
stamp=$folder/.installed-for
if [ ! -f "$stamp" ] || [ "$(cat "$stamp")" != "$package" ]; then
  rm -rf "$folder/package"
  python3 -m venv "$folder/venv"
  "$folder/venv/bin/pip" install --quiet --no-deps --target "$folder/package" "$package"
  echo "$package" >"$stamp"
fi
export SLALOM_NL_SOLVER=$folder/package/pyomo_ripopt/bin/ripopt
"$tests/test_planner" --gtest_filter='Nl.*'
"$tests/test_ocp_slow" --gtest_filter='Nl.*'
