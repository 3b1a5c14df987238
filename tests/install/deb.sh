#!/usr/bin/env bash
# deb.sh CPACK BUILD DIR: makes the Debian package of the build tree BUILD in DIR, unpacks it, and drives with the
# program in it, which finds its own configuration.
set -euo pipefail

cpack=$1
build=$2
work=$3
unset SLALOM_CONFIG_DIR
rm -rf "$work/deb" && mkdir -p "$work/deb"
"$cpack" --config "$build/CPackConfig.cmake" -B "$work/deb" >"$work/deb/log" 2>&1 || {
  cat "$work/deb/log"
  exit 1
}
package=$(find "$work/deb" -maxdepth 1 -name 'slalom_*.deb')
dpkg-deb --info "$package"
for library in libc6 libfmt libyaml-cpp libsqlite3; do
  dpkg-deb --field "$package" Depends | grep -q "$library" || {
    echo "the package does not depend on $library"
    exit 1
  }
done
for library in libfmt-dev libyaml-cpp-dev libsqlite3-dev libsleef-dev; do
  dpkg-deb --field "$package" Recommends | grep -qw "$library" || {
    echo "the package does not recommend $library, which its library is linked with"
    exit 1
  }
done
dpkg-deb --extract "$package" "$work/deb/root"
cd "$work/deb"
"$work/deb/root/usr/bin/slalom" simulate E_B --planner P_D --set loop.timeout=1 --out drive
[ -s drive/report.html ]
