#!/usr/bin/env bash
# python.sh wheel FOLDER: builds the wheel into FOLDER.
# python.sh test FOLDER: builds it there, installs it into a fresh environment, runs its tests, checks
# the types of what it ships, and runs the Python blocks of the docs. Packages come from PyPI.
set -euo pipefail
cd "$(dirname "$0")/.."

if [ $# -ne 2 ] || { [ "$1" != wheel ] && [ "$1" != test ]; }; then
  echo "usage: tools/python.sh wheel|test FOLDER" >&2
  exit 2
fi
root=$PWD
mkdir -p "$2"
folder=$(cd "$2" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

rm -f "$folder"/slalom-*.whl
python3 -m venv "$work/venv"
pip() { "$work/venv/bin/python" -m pip --disable-pip-version-check "$@"; }
pip wheel --no-deps -w "$folder" ./python
[ "$1" = test ] || exit 0

pip install -q "$(echo "$folder"/slalom-*.whl)[test]"
cp -r python/tests "$work/tests"
cd "$work"
SLALOM_README=$root/README.md "$work/venv/bin/python" -m pytest -q tests
"$work/venv/bin/python" -m mypy --strict tests/typed_use.py
"$work/venv/bin/python" "$root/tools/doc_blocks.py" "$root"/docs/*.md
