#!/usr/bin/env bash
# portable.sh ARCH FOLDER: what a build needs that shall run on any Linux of ARCH (x86_64 or aarch64) with
# glibc 2.28 or later, in FOLDER, with FOLDER/toolchain.cmake for CMake. The compiler is clang with its own
# C++ library, from PyPI's ziglang. The libraries are Debian's: those in C++ compiled from Debian's
# sources, for what Debian compiled needs Debian's C++ library. SLEEF is Debian's binary, whose source
# the archive lacks; it needs nothing but libc.
set -euo pipefail

case ${1:-}/$# in
  x86_64/2) debian_arch=amd64 ;;
  aarch64/2) debian_arch=arm64 ;;
  *)
    echo "usage: tools/portable.sh x86_64|aarch64 FOLDER" >&2
    exit 2
    ;;
esac
arch=$1
mkdir -p "$2"
folder=$(cd "$2" && pwd)
stamp="ziglang 0.17.1 $(sha256sum <"$0")"
[ "$(cat "$folder/stamp" 2>/dev/null)" != "$stamp" ] || exit 0
rm -rf "$folder"
mkdir -p "$folder"/{bin,packages,sources,build,root/usr} "$folder"/apt/{lists,cache}/partial
root=$folder/root
shared=$root/usr/lib/$arch-linux-gnu

# The compiler.
python3 -m venv "$folder/venv"
"$folder/venv/bin/python" -m pip --disable-pip-version-check install -q ziglang==0.17.1
zig=$("$folder/venv/bin/python" -c 'import pathlib, ziglang; print(pathlib.Path(ziglang.__file__).parent / "zig")')
for tool in cc c++; do
  # Unless told not to, it adds debug information, and checks for undefined behaviour where it does not
  # optimise.
  printf '#!/bin/sh\nexec %s %s -target %s-linux-gnu.2.28 -g0 -fno-sanitize=undefined "$@"\n' \
    "$zig" "$tool" "$arch" >"$folder/bin/$tool"
done
for tool in ar ranlib; do printf '#!/bin/sh\nexec %s %s "$@"\n' "$zig" "$tool" >"$folder/bin/$tool"; done
chmod +x "$folder"/bin/*
cat >"$folder/toolchain.cmake" <<EOF
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR $arch)
set(CMAKE_C_COMPILER $folder/bin/cc)
set(CMAKE_CXX_COMPILER $folder/bin/c++)
set(CMAKE_AR $folder/bin/ar)
set(CMAKE_RANLIB $folder/bin/ranlib)
set(CMAKE_C_STANDARD_INCLUDE_DIRECTORIES $root/usr/include)
set(CMAKE_CXX_STANDARD_INCLUDE_DIRECTORIES $root/usr/include)
set(CMAKE_EXE_LINKER_FLAGS_INIT -s)
set(CMAKE_MODULE_LINKER_FLAGS_INIT "-L$shared -Wl,-rpath,$shared")
set(CMAKE_LIBRARY_ARCHITECTURE $arch-linux-gnu)
set(CMAKE_FIND_ROOT_PATH $root)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE BOTH)
EOF

# Debian's packages, by the machine's own mirror, for ARCH, with sources; in lists of their own, so that
# the machine's stay as they are.
for kind in deb deb-src; do
  apt-get indextargets --format "$kind \$(REPO_URI) \$(RELEASE) \$(COMPONENT)" \
    "Created-By: Packages" "Origin: Debian"
done | sort -u >"$folder/apt/sources.list"
apt() {
  local command=$1
  shift
  "$command" -q -o APT::Architecture=$debian_arch -o APT::Architectures::=$debian_arch \
    -o Dir::Etc::sourcelist="$folder/apt/sources.list" -o Dir::Etc::sourceparts=- \
    -o Dir::State::lists="$folder/apt/lists" -o Dir::Cache="$folder/apt/cache" \
    -o APT::Sandbox::User=root "$@"
}
apt apt-get update
# Debian's Python keeps what of its headers depends on the processor apart.
python=$(python3 -c 'import sysconfig; print(sysconfig.get_config_var("INCLUDEPY"))')
python_headers=()
[ "$(dirname "$python")" != /usr/include ] || python_headers=("lib$(basename "$python")-dev")
boost=$(apt apt-cache depends libboost-dev | sed -n 's/.*Depends: \(libboost[0-9.]*-dev\)$/\1/p')
(cd "$folder/packages" && apt apt-get download libsleef-dev libsleef3 libcli11-dev nlohmann-json3-dev "$boost" \
  "${python_headers[@]}")
for package in "$folder"/packages/*.deb; do dpkg-deb -x "$package" "$root"; done
mv "$root/usr/include/$arch-linux-gnu/sleef.h" "$root/usr/include"
(cd "$folder/sources" && apt apt-get source fmtlib yaml-cpp sqlite3)

# The libraries in C++ and SQLite.
build() { # NAME SOURCE OPTION...
  cmake -S "$2" -B "$folder/build/$1" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$folder/toolchain.cmake" \
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_POSITION_INDEPENDENT_CODE=ON -DBUILD_SHARED_LIBS=OFF \
    -DCMAKE_INSTALL_PREFIX="$root/usr" "${@:3}"
  cmake --build "$folder/build/$1" -j "$(nproc)"
  cmake --install "$folder/build/$1"
}
build fmt "$(echo "$folder"/sources/fmtlib-*)" -DFMT_TEST=OFF -DFMT_DOC=OFF
build yaml-cpp "$(echo "$folder"/sources/yaml-cpp-*)" -DYAML_CPP_BUILD_TESTS=OFF -DYAML_CPP_BUILD_TOOLS=OFF
mkdir -p "$folder/build/sqlite"
cd "$folder/build/sqlite"
"$(echo "$folder"/sources/sqlite3-*)/configure" --disable-tcl CC=cc >configure.log
make -s sqlite3.c
"$folder/bin/cc" -O2 -fPIC -DSQLITE_THREADSAFE=1 -DSQLITE_OMIT_LOAD_EXTENSION -c sqlite3.c
"$folder/bin/ar" rc "$root/usr/lib/libsqlite3.a" sqlite3.o
cp sqlite3.h "$root/usr/include"

# The licences of what gets into a program. Boost's files have one of few owners each; its text is SLEEF's too.
licenses=$folder/licenses
mkdir "$licenses"
for source in fmtlib yaml-cpp sqlite3; do
  cp "$(echo "$folder/sources/$source"-*/debian/copyright)" "$licenses/$source.txt"
done
for package in libsleef3 libcli11-dev nlohmann-json3-dev; do
  cp "$root/usr/share/doc/$package/copyright" "$licenses/$package.txt"
done
{
  echo "Boost, headers of Debian's $boost, Copyright their authors"
  awk '/^License: BSL-1.0$/ {on = 1; next} !/^ / {on = 0} on {sub(/^ \.?/, ""); print}' \
    "$licenses/libsleef3.txt"
} >"$licenses/boost.txt"
for part in libcxx libcxxabi libunwind; do
  cp "$(dirname "$zig")/lib/$part/LICENSE.TXT" "$licenses/$part.txt"
done
cp "$(dirname "$zig")/LICENSE" "$licenses/zig.txt" # its compiler-rt
echo "$stamp" >"$folder/stamp"
