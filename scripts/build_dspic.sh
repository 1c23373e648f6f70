#!/bin/sh
# SPDX-License-Identifier: MIT
# Cross-builds a controller for the robot with Microchip's XC16.
#
#   scripts/build_dspic.sh COMPILER CONTROLLER OUTPUT_FOLDER
set -eu
compiler=$1
controller=$2
out=$3

if ! command -v "$compiler" >/dev/null; then
  echo "make dspic: XC16: got '$compiler', which is not there; install Microchip's XC16 and pass XC16=/path/to/xc16-gcc" >&2
  exit 2
fi
if [ ! -d "firmware/$controller" ]; then
  echo "make dspic: FW: got '$controller', expected a folder of firmware/" >&2
  exit 2
fi
if [ ! -d hal_dspic ]; then
  echo "make dspic: the library for the chip (hal_dspic) is not written yet" >&2
  exit 2
fi

mkdir -p "$out"
"$compiler" -mcpu=30F6014A -O1 -Ifirmware/include -o "$out/$controller.elf" \
  "firmware/$controller"/*.c $(find hal_dspic -name '*.c') -Wl,--script=p30F6014A.gld,--heap=512
"$(dirname "$(command -v "$compiler")")/xc16-bin2hex" "$out/$controller.elf"
echo "$out/$controller.hex"
