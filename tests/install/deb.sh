#!/usr/bin/env bash
# deb.sh CPACK BUILD DIR: makes the Debian package of the build tree BUILD in DIR, has apt say what its installation would
# do, and installs it: as root by dpkg, into a root of its own that has a copy of this machine's list of packages, so that
# dependencies are looked at; others only unpack it. Drives with the program there, which finds its own configuration, and
# removes the package. The machine's own packages stay as they are. What is left to try on a fresh machine: that apt fetches
# what the package depends on.
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

# Where an earlier version is installed, apt would say what it replaces.
says=$(LC_ALL=C apt-get install --simulate --no-install-recommends --allow-downgrades "$package")
grep -q "^Conf slalom " <<<"$says" || {
  echo "apt would not install the package: $says"
  exit 1
}
others=$(grep -E "^(Inst|Remv) " <<<"$says" | grep -v "^Inst slalom " || true)
if [ -n "$others" ]; then
  echo "on the machine that built the package, apt would have to do more for it: $others"
  exit 1
fi

root=$work/deb/root
# in_root COMMAND...: of dpkg, with the packages of the root.
in_root() {
  dpkg --root="$root" --no-triggers "$@" >"$work/deb/log" 2>&1 || {
    grep -v "files list file for package" "$work/deb/log"
    return 1
  }
}
if [ "$(id -u)" -eq 0 ]; then
  mkdir -p "$root"/var/lib/dpkg/{info,updates}
  # But for an installed slalom, whose files are not in that root.
  awk 'BEGIN { RS = ""; ORS = "\n\n" } !/^Package: slalom\n/' /var/lib/dpkg/status >"$root/var/lib/dpkg/status"
  in_root --install "$package"
  [ "$(dpkg-query --admindir="$root/var/lib/dpkg" --show --showformat='${db:Status-Status}' slalom)" = installed ]
  in_root --verify slalom
else
  dpkg-deb --extract "$package" "$root"
fi
cd "$work/deb"
"$root/usr/bin/slalom" simulate E_B --planner P_D --set loop.timeout=1 --out drive
[ -s drive/report.html ]
if [ "$(id -u)" -eq 0 ]; then
  in_root --remove slalom
  left=$(find "$root/usr" 2>/dev/null || true)
  if [ -n "$left" ]; then
    echo "the package leaves behind: $left"
    exit 1
  fi
  echo "installed, driven with, and removed"
fi
