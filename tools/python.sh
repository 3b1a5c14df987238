#!/usr/bin/env bash
# python.sh wheel FOLDER: builds the wheel into FOLDER.
# python.sh test FOLDER BUILD: builds it there of the library in the build tree BUILD, installs it into
# a fresh environment, FOLDER/venv, runs its tests, checks the types of what it ships, and runs the
# Python blocks of the docs. Packages come from PyPI.
set -euo pipefail
cd "$(dirname "$0")/.."

case ${1:-}/$# in
  wheel/2 | test/3) ;;
  *)
    echo "usage: tools/python.sh wheel FOLDER | test FOLDER BUILD" >&2
    exit 2
    ;;
esac
root=$PWD
mkdir -p "$2"
folder=$(cd "$2" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

venv=$work/venv
options=()
if [ "$1" = test ]; then
  venv=$folder/venv
  options=(--config-settings="cmake.define.SLALOM_BUILD_TREE=$(cd "$3" && pwd)"
    --config-settings="build-dir=$folder/build")
fi
rm -rf "$folder"/slalom-*.whl "$venv"
python3 -m venv "$venv"
pip() { "$venv/bin/python" -m pip --disable-pip-version-check "$@"; }
pip wheel --no-deps "${options[@]}" -w "$folder" ./python
[ "$1" = test ] || exit 0

# What the tests and the site need; most of it is never imported, so it is not compiled beforehand.
pip install -q --no-compile "$(echo "$folder"/slalom-*.whl)[test,docs]"
cp -r python/tests "$work/tests"
cd "$work"
SLALOM_README=$root/README.md "$venv/bin/python" -m pytest -q tests
"$venv/bin/python" -m mypy --strict tests/typed_use.py
"$venv/bin/python" "$root/tools/doc_blocks.py" "$root"/docs/*.md
