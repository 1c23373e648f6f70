// SPDX-License-Identifier: MIT
// How fast the chip's models are alone: 100 s of a robot that scans three inputs at 16,384 Hz and runs a 10
// kHz agenda timer, with handlers of the library's size that make its register accesses. Not a test.
//
//     build/tests/chip_bench
#include <algorithm>
#include <cstdio>
#include <ctime>

#include "dspic30/device/dspic30f6014a.h"

namespace {

using dspic::Cycle;

constexpr double kFcyHz = 14745600;
constexpr int kSeconds = 100;
constexpr unsigned kIfs0 = 0x084, kIec0 = 0x08C, kPr2 = 0x10C, kT2con = 0x110, kBuffer = 0x280,
                   kAdcon1 = 0x2A0, kAdcon2 = 0x2A2, kAdcon3 = 0x2A4, kAdcssl = 0x2AA, kTrisd = 0x2D2,
                   kLatd = 0x2D6;
constexpr unsigned kAdif = 0x0800, kT2if = 0x0040;

struct Inputs : dspic::Outside {
  int analogue_counts(int channel, Cycle) override { return 100 * channel; }
};

}  // namespace

int main() {
  Inputs inputs;
  dspic::Dspic30f6014a chip(inputs);
  const auto write = [&](unsigned address, unsigned value, Cycle now) {
    chip.write(address, static_cast<std::uint16_t>(value), 16, now);
  };
  const auto clear_flag = [&](unsigned bit, Cycle now) {
    write(kIfs0, chip.read(kIfs0, 16, now) & ~bit, now);
  };
  write(kTrisd, 0xFF00, 0);
  write(kAdcon2, 0x0408, 0);
  write(kAdcon3, 0x0127, 0);
  write(kAdcssl, 0x001C, 0);
  write(kAdcon1, 0x80E4, 0);
  write(kPr2, 1474, 0);
  write(kT2con, 0x8000, 0);
  write(kIec0, kAdif | kT2if, 0);

  const std::clock_t begin = std::clock();
  std::int64_t handlers = 0;
  unsigned sum = 0;
  for (Cycle now = 10; now < static_cast<Cycle>(kFcyHz * kSeconds);
       now = std::max(now, chip.next_event(now))) {
    for (int vector; (vector = chip.interrupts().pending(now)) != dspic::kNoVector; ++handlers) {
      now = chip.interrupts().enter(vector, now).first_instruction;
      if (vector == dspic::kFirstIrqVector + dspic::irq::Adc) {
        clear_flag(kAdif, now);
        for (unsigned i = 0; i < 3; ++i) sum += chip.read(kBuffer + 2 * i, 16, now += 10);
        write(kAdcon1, 0x00E4, now);  // as the library does: off, next inputs, on
        write(kAdcssl, 0x001C, now);
        write(kAdcon2, 0x0408, now);
        write(kAdcon1, 0x80E4, now);
        now += 40;
      } else {
        clear_flag(kT2if, now);
        if (handlers % 20 == 0) write(kLatd, handlers & 0xFF, now);
        now += 30;
      }
      now = chip.interrupts().leave(now);
    }
  }
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  std::printf(
      "%d s simulated in %.2f s of processor time: %.0f times real time, %lld handlers, %.0f ns each (%u)\n",
      kSeconds, seconds, kSeconds / seconds, static_cast<long long>(handlers),
      1e9 * seconds / static_cast<double>(handlers), sum);
  return 0;
}
