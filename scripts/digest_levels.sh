#!/bin/sh
# SPDX-License-Identifier: MIT
# The same runs with the simulator built at -O0 and at -O2 must give the same digests. Firmware is built once.
#
#   scripts/digest_levels.sh BUILD_FOLDER     BUILD_FOLDER: the usual build (-O2); build-o0 is made beside it
set -eu
build=$1
cmake -G Ninja -S . -B build-o0 -DTWINPUCK_OPTIMISE="-O0 -g1" >/dev/null
ninja -C build-o0 --quiet twinpuck
failed=0
for run in "worlds/maze.toml 20" "worlds/swarm.toml 5" "worlds/push.toml 10" "bench/worlds/brait_100.toml 2"; do
  set -- $run
  for folder in "$build" build-o0; do
    "$folder/twinpuck" run "$1" --for "$2" -q --summary "$folder/digest.json"
  done
  a=$(sed -n 's/.*"digest": "\(.*\)".*/\1/p' "$build/digest.json")
  b=$(sed -n 's/.*"digest": "\(.*\)".*/\1/p' build-o0/digest.json)
  if [ -n "$a" ] && [ "$a" = "$b" ]; then
    echo "ok    $1: $a at -O0 and -O2"
  else
    echo "FAIL  $1: $b at -O0, $a at -O2"
    failed=1
  fi
done
exit $failed
