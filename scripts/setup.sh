#!/bin/sh
# SPDX-License-Identifier: MIT
# Installs what building and testing need on Debian 12, and says nothing when all is there.
#
#   scripts/setup.sh [GROUP]    GROUP: build (default), check, bench, second, fuzz, mutants, view (make view),
#                               browser (make test-view), deb (make deb)
#
# Needs root or sudo only when something is missing.
set -eu

build="g++ cmake ninja-build pkg-config python3 binutils zlib1g-dev
 llvm-14-dev libclang-14-dev clang-14
 libbox2d-dev libeigen3-dev libccd-dev
 libtomlplusplus-dev libcli11-dev nlohmann-json3-dev libfmt-dev libelf-dev libdw-dev libcairo2-dev
 libcivetweb-dev libmuparser-dev libvpx-dev libjpeg62-turbo-dev libpng-dev libsndfile1-dev libpugixml-dev libgtest-dev libwebm-dev mandoc bsdextrautils
 pybind11-dev python3-dev python3-numpy python3-pytest python3-pytest-xdist python3-websocket bubblewrap"
check="clang-format clang-tidy"
bench="libenki-dev libsimavr-dev"
second="gcc-avr avr-libc simavr"
fuzz="libclang-rt-14-dev"
mutants="python3-clang-14"
view="esbuild nodejs"
command -v npm >/dev/null || view="$view npm"  # other nodejs packages than Debian's bring it along
browser="chromium"
deb="dpkg-dev file"

group=${1:-build}
case $group in
  build) packages=$build ;;
  check) packages=$check ;;
  bench) packages=$bench ;;
  second) packages=$second ;;
  fuzz) packages=$fuzz ;;
  mutants) packages=$mutants ;;
  view) packages=$view ;;
  browser) packages=$browser ;;
  deb) packages=$deb ;;
  *)
    echo "setup.sh: group: got '$group', expected build, check, bench, second, fuzz, mutants, view, browser or deb" >&2
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
  echo "setup.sh: packages are missing, and installing them needs root. As root, run:" >&2
  echo "  apt-get update && apt-get install -y --no-install-recommends$missing" >&2
  exit 2
fi

echo "setup.sh: installing$missing"
scratch=$(mktemp -d)
log=$scratch/log
status=$scratch/status
trap 'rm -rf "$scratch"' EXIT

# apt STAGE WORDS...: waits up to five minutes for another apt that may be running; a line every five seconds says how
# far it is, by the percentages that apt writes to descriptor 3
apt() {
  stage=$1
  shift
  echo "packages $stage"
  : >"$status"
  $as_root env DEBIAN_FRONTEND=noninteractive \
    sh -c 'exec 3>"$0"; exec apt-get -q -o DPkg::Lock::Timeout=300 -o APT::Status-Fd=3 "$@"' "$status" "$@" >>"$log" 2>&1 &
  running=$!
  seconds=0
  while kill -0 $running 2>/dev/null; do
    sleep 1
    seconds=$((seconds + 1))
    [ $((seconds % 5)) = 0 ] || continue
    # "dlstatus:3:41.5:..." while packages are fetched, "pmstatus:cmake:60.1:..." while they are unpacked
    tail -n 1 "$status" | tr -d '\r' |
      awk -F: -v s=$seconds -v stage="$stage" '{ if ($3 > 0) printf "packages %s: %.0f %%, %d s\n", stage, $3, s
                                                 else printf "packages %s: %d s\n", stage, s; said = 1 }
                                               END { if (!said) printf "packages %s: %d s\n", stage, s }'
  done
  wait $running
}
apt "1/3 reading the lists" update ||
  { cat "$log" >&2; echo "setup.sh: apt-get update failed, see above" >&2; exit 2; }
apt "2/3 fetching" install -y --no-install-recommends --download-only $missing ||
  { cat "$log" >&2; echo "setup.sh: apt-get could not fetch the packages, see above" >&2; exit 2; }
apt "3/3 installing" install -y --no-install-recommends $missing ||
  { cat "$log" >&2; echo "setup.sh: apt-get install failed, see above" >&2; exit 2; }
