#!/usr/bin/env bash
# docs.sh DIST SITE: makes the documentation's site in SITE, of docs/, the wheel in DIST and the public
# headers; a warning is an error. Sphinx is that of DIST/venv, where `python.sh test` put it, or comes
# from PyPI into an environment of its own.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/environment.sh

if [ $# -ne 2 ]; then
  echo "usage: tools/docs.sh DIST SITE" >&2
  exit 2
fi
wheel=$(echo "$1"/slalom-*.whl)
if [ ! -f "$wheel" ]; then
  echo "docs: no one wheel of slalom in '$1'; make wheel builds one into dist/" >&2
  exit 2
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

python=$(realpath "$1")/venv/bin/python
if [ ! -x "$python" ]; then
  make_environment "$work/venv"
  python=$work/venv/bin/python
  install_into "$work/venv" "$(realpath "$wheel")[docs]"
fi
mkdir "$work/pages"
cp -r docs/*.md docs/*.svg docs/measured docs/scenes docs/schemes docs/site/* "$work/pages/"
"$python" tools/cpp_reference.py --out "$work/pages/cpp" include/slalom
"$python" -m sphinx -q -W --keep-going -b html "$work/pages" "$work/site"
mkdir -p "$(dirname "$2")"
rm -rf "$2"
mv "$work/site" "$2"
echo "docs: $2/index.html"
