#!/bin/sh
# SPDX-License-Identifier: MIT
# One of the long checks, in turn by the number of commits, so that each comes every seventh commit: the thread
# sanitizer, digests at -O0 and -O2, a minute of each fuzz target, three targets at a time. In a shallow clone, where
# commits cannot be counted, by the commit's name.
#
#   scripts/in_turn.sh [TURN]    TURN: 0 to 6 instead
set -eu
if [ "$(git rev-parse --is-shallow-repository)" = true ]; then
  number=$((0x$(git rev-parse HEAD | cut -c 1-6)))
else
  number=$(git rev-list --count HEAD)
fi
turn=${1:-$((number % 7))}
case $turn in
  0) what="make tsan TSAN=golden_test" ;;
  1) what="make levels" ;;
  2) what="make fuzz FUZZ_KINDS='world wbt proto'" ;;
  3) what="make fuzz FUZZ_KINDS='lab project source'" ;;
  4) what="make fuzz FUZZ_KINDS='elf picture wav'" ;;
  5) what="make fuzz FUZZ_KINDS='options firmware'" ;;
  6) what="make fuzz FUZZ_KINDS='assembler code faults'" ;;
  *)
    echo "in_turn.sh: turn: got '$turn', expected 0 to 6" >&2
    exit 2
    ;;
esac
echo "in turn: $what"
FUZZ_SECONDS=${FUZZ_SECONDS:-60} sh -c "$what"
