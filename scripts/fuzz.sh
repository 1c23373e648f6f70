#!/bin/sh
# SPDX-License-Identifier: MIT
# Runs the libFuzzer programs of a build folder, as many at once as there are processors, and says what each
# came to. What crashed lies in FOLDER/fuzz/found; a copy of it belongs into tests/fuzz/crashed/KIND, where
# `make test` feeds it from then on.
#
#   FUZZ_SECONDS=600 FUZZ_KINDS="world wbt" scripts/fuzz.sh FOLDER [libFuzzer options]
set -eu

folder=$1
shift
seconds=${FUZZ_SECONDS:-600}
kinds=${FUZZ_KINDS:-world wbt proto lab project source elf picture wav options firmware assembler code faults}
found=$folder/fuzz/found
mkdir -p "$found"

# one kind: its corpus grows from run to run; a line at the end
one() {
  kind=$1
  shift
  mkdir -p "$folder/fuzz/corpus/$kind"
  set -- -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -max_len=8192 -print_final_stats=1 \
    -artifact_prefix="$found/$kind-" "$@" "$folder/fuzz/corpus/$kind"
  if [ -f "tests/fuzz/dict/$kind.dict" ]; then set -- -dict="tests/fuzz/dict/$kind.dict" "$@"; fi
  for seeds in "tests/fuzz/seeds/$kind" "tests/fuzz/crashed/$kind"; do
    if [ -d "$seeds" ]; then set -- "$@" "$seeds"; fi
  done
  case $kind in
    world) set -- "$@" worlds ;;
    wbt) set -- "$@" tests/import/worlds ;;
    lab) mkdir -p "$folder/fuzz/lab" && cp docs/lab.toml "$folder/fuzz/lab" && set -- "$@" "$folder/fuzz/lab" ;;
  esac
  log=$folder/fuzz/$kind.log
  if ASAN_OPTIONS=intercept_tls_get_addr=0 "$folder/fuzz/fuzz_$kind" "$@" >"$log" 2>&1; then  # see run_tests.py
    echo "fuzz $kind: good: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") inputs in $seconds s"
  else
    echo "fuzz $kind: failed, see $log"
    grep -E 'SUMMARY|ERROR|Test unit written' "$log" | head -4
    return 1
  fi
}

# two or more at once; each line comes when one has ended
failed=0
running=
for kind in $kinds; do
  set -- "$@"
  (one "$kind" "$@") &
  running="$running $!"
  while [ "$(echo $running | wc -w)" -ge "$(nproc)" ]; do
    first=${running# }
    first=${first%% *}
    wait "$first" || failed=1
    running=${running# }
    running=${running#"$first"}
  done
done
for child in $running; do wait "$child" || failed=1; done
exit $failed
