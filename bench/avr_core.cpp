// SPDX-License-Identifier: MIT
#include "bench/avr_core.h"

#include <simavr/sim_avr.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "bench/processor_time.h"

namespace bench {

namespace {

using Word = std::uint16_t;

constexpr double kFrequencyHz = 14745600, kSeconds = 3;
constexpr double kInstructionsPerCycle = 20.0 / 28;  // of the loop

// --- instructions, as in Atmel's manual

constexpr Word with_two(int opcode, int d, int r) {
  return static_cast<Word>(opcode | (r & 16) << 5 | d << 4 | (r & 15));
}
constexpr Word with_one(int opcode, int d) { return static_cast<Word>(opcode | d << 4); }
constexpr Word add(int d, int r) { return with_two(0x0C00, d, r); }
constexpr Word adc(int d, int r) { return with_two(0x1C00, d, r); }
constexpr Word sub(int d, int r) { return with_two(0x1800, d, r); }
constexpr Word land(int d, int r) { return with_two(0x2000, d, r); }
constexpr Word eor(int d, int r) { return with_two(0x2400, d, r); }
constexpr Word mov(int d, int r) { return with_two(0x2C00, d, r); }
constexpr Word cp(int d, int r) { return with_two(0x1400, d, r); }
constexpr Word mul(int d, int r) { return with_two(0x9C00, d, r); }
constexpr Word ldi(int d, int k) {
  return static_cast<Word>(0xE000 | (k & 0xF0) << 4 | (d - 16) << 4 | (k & 15));
}
constexpr Word with_y(int d, int q, bool store) {
  return static_cast<Word>(0x8008 | (store ? 0x200 : 0) | d << 4 | (q & 7) | (q & 0x18) << 7 |
                           (q & 0x20) << 8);
}
constexpr Word with_z(int d, int q, bool store) { return static_cast<Word>(with_y(d, q, store) & ~8); }
constexpr Word lsr(int d) { return with_one(0x9406, d); }
constexpr Word inc(int d) { return with_one(0x9403, d); }
constexpr Word push(int d) { return with_one(0x920F, d); }
constexpr Word pop(int d) { return with_one(0x900F, d); }
constexpr Word sts(int d) { return with_one(0x9200, d); }  // the address follows
constexpr Word lds(int d) { return with_one(0x9000, d); }
constexpr Word brne(int words) { return static_cast<Word>(0xF401 | (words & 0x7F) << 3); }
constexpr Word rjmp(int words) { return static_cast<Word>(0xC000 | (words & 0xFFF)); }
constexpr Word kNop = 0, kSei = 0x9478, kReti = 0x9518;

// ATmega328P: registers of timer 1 and its vector
constexpr Word kTccr1b = 0x81, kOcr1al = 0x88, kOcr1ah = 0x89, kTimsk1 = 0x6F, kTicks = 0x140;
constexpr int kCompareVector = 22, kStart = 52, kPeriod = 558;

std::vector<Word> program(bool interrupts) {
  const std::vector<Word> handler = {push(24), lds(24), kTicks, inc(24), sts(24), kTicks, pop(24), kReti};
  const std::vector<Word> loop = {with_y(18, 0, false),
                                  ldi(19, 3),
                                  add(18, 19),
                                  with_y(18, 0, true),
                                  with_z(20, 4, false),
                                  sub(20, 18),
                                  mov(21, 20),
                                  add(21, 21),
                                  eor(21, 20),
                                  with_z(21, 4, true),
                                  mul(21, 18),
                                  add(22, 0),
                                  adc(23, 1),
                                  push(22),
                                  land(22, 19),
                                  pop(22),
                                  lsr(18),
                                  inc(24),
                                  cp(24, 25),
                                  brne(-20)};
  std::vector<Word> all(kStart, kNop);
  all[0] = rjmp(kStart - 1);
  std::vector<Word> begin = {ldi(28, 0), ldi(29, 2), ldi(30, 0x40), ldi(31, 2), ldi(25, 0)};
  if (interrupts)
    for (const auto& [value, to] :
         {std::pair<int, Word>{kPeriod >> 8, kOcr1ah}, {kPeriod & 0xFF, kOcr1al}, {9, kTccr1b}, {2, kTimsk1}})
      begin.insert(begin.end(), {ldi(24, value), sts(24), to});
  if (interrupts) begin.push_back(kSei);
  all.insert(all.end(), begin.begin(), begin.end());
  all.insert(all.end(), loop.begin(), loop.end());
  all.push_back(rjmp(-21));
  all[kCompareVector] = rjmp(static_cast<int>(all.size()) - kCompareVector - 1);
  all.insert(all.end(), handler.begin(), handler.end());
  return all;
}

}  // namespace

double avr_rate(bool interrupts) {
  avr_t* const avr = avr_make_mcu_by_name("atmega328p");
  if (!avr) std::exit(2);
  avr_init(avr);
  avr->log = LOG_ERROR;
  avr->frequency = static_cast<std::uint32_t>(kFrequencyHz);
  const std::vector<Word> words = program(interrupts);
  std::memcpy(avr->flash, words.data(), 2 * words.size());
  avr->codeend = avr->flashend;
  const auto cycles = static_cast<avr_cycle_count_t>(kSeconds * kFrequencyHz);
  const double from = processor_s();
  while (avr->cycle < cycles)
    if (const int state = avr_run(avr); state == cpu_Done || state == cpu_Crashed) {
      std::fprintf(stderr, "simavr: the loop ended in state %d\n", state);
      std::exit(2);
    }
  const double rate = 1e-6 * kInstructionsPerCycle * static_cast<double>(avr->cycle) / (processor_s() - from);
  // the loop ran, and the handler with it, or else the figure says nothing
  if (avr->data[0x200] == 0 || (avr->data[kTicks] != 0) != interrupts) {
    std::fprintf(stderr, "simavr: the loop did not run as it should\n");
    std::exit(2);
  }
  avr_terminate(avr);
  return rate;
}

}  // namespace bench
