#!/bin/sh
# SPDX-License-Identifier: MIT
# Cross-builds a controller for the robot with Microchip's XC16: controller + hal_dspic + firmware/library -> .elf, .hex and
# a report of its size. Exit 2 when the compiler, the controller or an argument is wrong, 1 when it does not build or fit.
#
#   scripts/build_dspic.sh COMPILER CONTROLLER OUTPUT_FOLDER
set -eu
compiler=$1
controller=$2
out=$3
cd "$(dirname "$0")/.."

flash_bytes=147456 # 48 K instruction words of 3 bytes
ram_bytes=8192
heap_bytes=512     # agendas: 12 bytes and the allocator's own each

if ! command -v "$compiler" >/dev/null; then
  echo "make dspic: XC16: got '$compiler', expected Microchip's XC16; install it and pass XC16=/path/to/xc16-gcc" >&2
  exit 2
fi
folder="firmware/$controller"
[ -d "$folder" ] || folder="firmware/lab/$controller" # the lab's solutions
if [ -z "$controller" ] || [ ! -d "$folder" ]; then
  echo "make dspic: FW: got '$controller', expected a folder of firmware/" >&2
  exit 2
fi
if ! find "$folder" -name '*.c' | grep -q .; then
  echo "make dspic: FW: got '$controller', a folder without a .c file, expected one with" >&2
  exit 2
fi
# the other tools lie beside the compiler and are named like it
tools=$(command -v "$compiler")
tools=${tools%gcc}

objects="$out/$controller.objects"
rm -rf "$objects"
mkdir -p "$objects/library" "$objects/include"

# programs write the device header's name in several ways; the file system minds
for name in p30f6014A p30f6014a P30F6014A P30f6014a; do
  echo '#include <p30F6014A.h>' >"$objects/include/$name.h"
done

includes="-I$folder"
for sub in "" /motor_led/advance_one_timer /motor_led /a_d/advance_ad_scan /a_d /uart /utility /camera/fast_2_timer \
  /codec /bluetooth /I2C /fft /matlab /acc_gyro /motor_led/advance_one_timer/fast_agenda \
  /contrib/LIS_sensors_turret /contrib/SWIS_com_module /contrib; do
  includes="$includes -Ifirmware/include$sub"
done
includes="$includes -I$objects/include"
flags="-mcpu=30F6014A -omf=elf -std=gnu99 -O1 -Wall -mlarge-data"

# compile FLAGS SOURCE OBJECT
compile() {
  "$compiler" $flags $includes $1 -c "$2" -o "$3" || {
    echo "make dspic: $2: does not compile" >&2
    exit 1
  }
}

library=""
for source in $(find hal_dspic firmware/library firmware/webots -name '*.[cs]' | sort); do
  case $source in hal_dspic/motor_led/configuration.c | hal_dspic/runtime/* | hal_dspic/bootloader/*) continue ;; esac
  object="$objects/library/$(echo "$source" | tr / -).o"
  compile "-Ihal_dspic -I." "$source" "$object"
  library="$library $object"
done
# an archive: a driver is linked only where it is used, so two drivers of one timer are no conflict by themselves
rm -f "$objects/libhal.a"
"${tools}ar" -omf=elf rcs "$objects/libhal.a" $library

program=""
for source in $(find "$folder" -name '*.c' ! -name 'test*.c' | sort); do
  object="$objects/$(echo "$source" | tr / -).o"
  compile "" "$source" "$object"
  program="$program $object"
done
if ! grep -rqE '\b_FOSC[[:space:]]*\(' "$folder" --include='*.[ch]'; then
  compile "-Ihal_dspic -I." hal_dspic/motor_led/configuration.c "$objects/configuration.o"
  program="$program $objects/configuration.o"
fi
vendor=""
if grep -rqE 'e_fft\.h|dsp\.h' "$folder" --include='*.[ch]'; then vendor="-ldsp-elf"; fi

elf="$out/$controller.elf"
"$compiler" -mcpu=30F6014A -omf=elf -o "$elf" $program "$objects/libhal.a" $vendor -lm \
  -T p30F6014A.gld "-Wl,--heap=$heap_bytes,--stack=512,--report-mem,-Map=$out/$controller.map" >"$out/$controller.memory" || {
  cat "$out/$controller.memory" >&2
  echo "make dspic: $controller: does not link" >&2
  exit 1
}
"${tools}bin2hex" -omf=elf "$elf"
if command -v "${tools}objdump" >/dev/null; then
  "${tools}objdump" -omf=elf -d "$elf" >"$out/$controller.lst" 2>/dev/null || : >"$out/$controller.lst"
else
  : >"$out/$controller.lst"
fi
python3 scripts/chip_size.py "$out/$controller.memory" "$out/$controller.lst" $flash_bytes $ram_bytes $heap_bytes
echo "$out/$controller.hex"
