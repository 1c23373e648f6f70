#!/bin/sh
# SPDX-License-Identifier: MIT
# Runs the tests of a build folder, one line a test, and ends with "N passed, N failed".
#
#   scripts/run_tests.sh BUILD_FOLDER [FILTER]    FILTER: part of a test's name
#
# Exit code: 0 all passed, 1 some failed, 5 nothing selected.
set -u
build=$1
filter=${2:-}
log=$build/tests.log
passed=0
failed=0
# read by sanitized builds only
export LSAN_OPTIONS="suppressions=$(pwd)/scripts/lsan.supp:print_suppressions=0"

# GoogleTest programs are run one by one, so that the filter reaches single tests
for program in "$build"/tests/*; do
  [ -f "$program" ] && [ -x "$program" ] || continue
  name=$(basename "$program")
  case $name in
    *"$filter"*) selection='*' ;;
    *) selection="*$filter*" ;;
  esac
  GTEST_COLOR=no "$program" --gtest_filter="$selection" >"$log" 2>&1
  status=$?
  # "[       OK ] Room.sentence (12 ms)" -> "ok    program: Room.sentence"
  sed -n -e "s/^\[       OK \] \([^ ]*\).*/ok    $name: \1/p" -e "s/^\[  FAILED  \] \([^ ,]*\).* ms)$/FAIL  $name: \1/p" "$log"
  p=$(grep -c '^\[       OK \]' "$log")
  f=$(grep -c '^\[  FAILED  \] .* ms)$' "$log")
  if [ $status -ne 0 ] && [ "$f" = 0 ]; then
    echo "FAIL  $name: ended with status $status"
    f=1
  fi
  if [ "$f" != 0 ]; then
    # the end first: whoever shows only part of this shows the reason
    tail -n 60 "$log"
    echo "--- all of it:"
    cat "$log"
  fi
  passed=$((passed + p))
  failed=$((failed + f))
done

if [ $((passed + failed)) = 0 ]; then
  echo "run_tests.sh: no test matches '$filter'" >&2
  exit 5
fi
echo "$passed passed, $failed failed"
[ $failed = 0 ]
