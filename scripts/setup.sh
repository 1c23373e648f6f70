#!/bin/sh
# SPDX-License-Identifier: MIT
# Installs what building and testing need on Debian 12, and says nothing when all is there.
#
#   scripts/setup.sh [GROUP]    GROUP: build (default), check, bench, fuzz
#
# Needs root or sudo only when something is missing.
set -eu

build="g++ cmake ninja-build pkg-config python3 binutils zlib1g-dev
 llvm-14-dev libclang-14-dev
 libbox2d-dev libeigen3-dev libccd-dev libboost-context-dev
 libtomlplusplus-dev libcli11-dev nlohmann-json3-dev libfmt-dev libelf-dev libdw-dev libcairo2-dev
 libvpx-dev libjpeg62-turbo-dev libgtest-dev libwebm-dev"
check="clang-format clang-tidy"
bench="libenki-dev libbenchmark-dev"
fuzz="clang-14 libclang-rt-14-dev"

group=${1:-build}
case $group in
  build) packages=$build ;;
  check) packages=$check ;;
  bench) packages=$bench ;;
  fuzz) packages=$fuzz ;;
  *)
    echo "setup.sh: group: got '$group', expected build, check, bench or fuzz" >&2
    exit 2
    ;;
esac

if ! command -v dpkg-query >/dev/null; then
  echo "setup.sh: this is not Debian; install by hand what corresponds to:" $packages >&2
  exit 2
fi

# one query for all packages; it fails for names dpkg has never heard of, which are missing too
installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' $packages 2>/dev/null | sed -n 's/^installed //p') || true
missing=
for package in $packages; do
  case "
$installed
" in
    *"
$package
"*) ;;
    *) missing="$missing $package" ;;
  esac
done
[ -n "$missing" ] || exit 0

if [ "$(id -u)" = 0 ]; then
  as_root=
elif command -v sudo >/dev/null; then
  as_root=sudo
else
  echo "setup.sh: needs root or sudo to install:$missing" >&2
  exit 2
fi

echo "setup.sh: installing$missing"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
# waits up to five minutes for another apt that may be running
apt() { $as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300 "$@" >>"$log" 2>&1; }
apt update || { cat "$log" >&2; echo "setup.sh: apt-get update failed, see above" >&2; exit 2; }
apt install -y --no-install-recommends $missing ||
  { cat "$log" >&2; echo "setup.sh: apt-get install failed, see above" >&2; exit 2; }
