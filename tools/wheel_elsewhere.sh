#!/usr/bin/env bash
# wheel_elsewhere.sh [SUITE...]: builds the wheel for this processor by python3 and, where the machine has
# one of 3.12 or later, by that; checks that any Linux with glibc 2.28 or later takes them, and installs and
# drives with them in userlands with python3 and nothing else: SUITEs of Debian, by debootstrap (as root).
# Where a suite's Python is older than 3.10 the program alone is run. At the end, a table for
# docs/wheel.md.
set -euo pipefail
shopt -s inherit_errexit
cd "$(dirname "$0")/.."

suites=("$@")
[ $# -gt 0 ] || suites=(bullseye bookworm trixie sid)
arch=$(uname -m)
folder=$PWD/build-portable/elsewhere
rm -rf "$folder/wheels"
mkdir -p "$folder/wheels"

# The newest Python of 3.12 or later, of which one wheel serves all: on the path, or of pyenv.
later_python() {
  local python
  for python in "$HOME"/.pyenv/versions/3.*/bin/python3 $(compgen -c python3. | grep -E '^python3\.[0-9]+$'); do
    "$python" -c 'import ensurepip, sys; print(sys.executable) if sys.version_info >= (3, 12) else exit(1)' \
      2>/dev/null || true
  done | sort -V | tail -1
}
pythons=(python3)
[ -z "$(later_python)" ] || pythons+=("$(later_python)")
for python in "${pythons[@]}"; do
  PYTHON=$python tools/python.sh wheel "$folder/one"
  cp "$folder"/one/slalom-*.whl "$folder/wheels"
done

python3 -m venv "$folder/venv"
pip() { "$folder/venv/bin/python" -m pip --disable-pip-version-check -q "$@"; }
pip install auditwheel==6.8.2
for wheel in "$folder"/wheels/slalom-*.whl; do
  says=$("$folder/venv/bin/auditwheel" show "$wheel")
  echo "$says"
  grep -qE "manylinux_2_(1[0-9]|2[0-8]|[5-9])_$arch" <<<"$says"
done
pip download --no-deps -d "$folder/wheels" pip
"$folder/venv/bin/python" -m zipfile -e "$(find "$folder/wheels" -name 'slalom-*.whl' | head -1)" "$folder/here"
chmod +x "$folder/here/slalom/bin/slalom"
"$folder/here/slalom/bin/slalom" simulate E_C --planner P_D --out "$folder/drive" --force --quiet

# within ROOT COMMAND...: runs it there, with the /proc that a program needs to find itself.
within() {
  unshare --mount sh -ec 'mount -t proc proc "$1/proc"; exec chroot "$@"' within "$@"
}

# drive_in SUITE: installs and drives there; prints a row of the table.
drive_in() {
  local root=$folder/userlands/$1 version seconds begin
  if [ ! -e "$root/usr/bin/python3" ]; then
    mkdir -p "$(dirname "$root")"
    debootstrap --variant=minbase --include=python3 "$1" "$root" >"$root.log" || return 1
  fi
  rm -rf "$root/try"
  mkdir "$root/try"
  version=$(within "$root" python3 -c 'import platform; print("%s|%s" % (platform.python_version(), platform.libc_ver()[1]))')
  local minor=${version#3.}
  minor=${minor%%.*}
  begin=$(date +%s.%N)
  if [ "$minor" -lt 10 ]; then
    cp -r "$folder/here" "$root/try/here"
    ln -s here/slalom/bin/slalom "$root/try/run"
  else
    pip download --only-binary :all: --no-deps --python-version "3.$minor" -d "$folder/wheels" \
      --platform "manylinux_2_17_$arch" --platform "manylinux_2_27_$arch" --platform "manylinux_2_28_$arch" numpy
    cp -r "$folder/wheels" "$root/try"
    begin=$(date +%s.%N)
    within "$root" sh -ec 'cd /try
      python3 -m venv --without-pip venv
      PYTHONPATH=$(echo wheels/pip-*.whl) python3 -m pip --python venv/bin/python install -q --no-index --find-links wheels slalom
      ln -s venv/bin/slalom run'
  fi
  seconds=$(awk -v a="$begin" -v b="$(date +%s.%N)" 'BEGIN { printf "%.1f", b - a }')
  within "$root" sh -ec 'cd /try; ./run simulate E_C --planner P_D --out drive --quiet --expect goal'
  local same=yes
  cmp -s "$root/try/drive/plant.csv" "$folder/drive/plant.csv" || same=no
  if [ "$minor" -ge 10 ]; then
    within "$root" /try/venv/bin/python -c '
import slalom
drive = slalom.simulate("E_B", planner="P_D")
assert drive.outcome == "goal", drive.outcome'
  else
    seconds="(program alone)"
  fi
  echo "| $1 | ${version%%|*} | ${version##*|} | $seconds | $same |"
}
rows=$(for suite in "${suites[@]}"; do drive_in "$suite"; done)
echo
echo "| Debian | Python | glibc | seconds to install | drive has the bits of this machine's |"
echo "|---|---|---|---|---|"
echo "$rows"
for wheel in "$folder"/wheels/slalom-*.whl; do
  echo "$(basename "$wheel"): $(stat -c %s "$wheel") bytes"
done
