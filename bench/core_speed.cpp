// SPDX-License-Identifier: MIT
// bench --core: the chip's core, interpreted and translated, beside simavr (bench/avr_core.cpp).
#include "bench/core_speed.h"

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "bench/avr_core.h"
#include "bench/median.h"
#include "bench/processor_time.h"
#include "dspic30/asm/assembler.h"
#include "dspic30/core/processor.h"
#include "hal_sim/chip/translation.h"

namespace bench {

namespace {

using dspic::Cycle;

constexpr int kSeconds = 10;                         // simulated
constexpr double kInstructionsPerCycle = 21.0 / 22;  // of kStraight

// 21 instructions in 22 cycles a round, as a compiler writes them: loads, sums, shifts,
// compares, a call's stack
constexpr const char* kStraight = R"(
start:
    mov #0x1F00, w15
    mov #0x0900, w8
    mov #0x0A00, w9
    clr w0
    clr w1
    clr w2
    clr w3
    clr w4
loop:
    mov [w8], w2
    add w2, #3, w2
    mov w2, [w8]
    mov [w9+4], w3
    sub w3, w2, w4
    sl w4, #2, w5
    xor w5, w4, w5
    mov w5, [w9+4]
    mov.b w5, [w9+7]
    ze w5, w6
    mul.su w6, w2, w6
    add w6, w0, w0
    addc w7, w1, w1
    mov w0, [w15++]
    and w0, #15, w0
    mov [--w15], w0
    lsr w0, w2
    inc w10, w10
    mov #1000, w11
    cp w10, w11
    bra ltu, loop
    clr w10
    bra loop
)";

constexpr const char* kInterrupts = R"(
__reset:
    mov #0x1F00, w15
    mov #0xFF00, w0
    mov w0, TRISD
    mov #0x0408, w0
    mov w0, ADCON2
    mov #0x0127, w0
    mov w0, ADCON3
    mov #0x001C, w0
    mov w0, ADCSSL
    mov #0x80E4, w0
    mov w0, ADCON1
    mov #1474, w0
    mov w0, PR2
    mov #0x8000, w0
    mov w0, T2CON
    bset IEC0, #T2IE
    bset IEC0, #ADIE
    goto start
__T2Interrupt:
    push w0
    bclr IFS0, #T2IF
    inc ticks
    mov ticks, w0
    and w0, #15, w0
    bra nz, 1f
    mov ticks, w0
    mov w0, LATD
1:  pop w0
    retfie
__ADCInterrupt:
    push.d w0
    push w2
    bclr IFS0, #ADIF
    mov ADCBUF0, w0
    mov ADCBUF1, w1
    add w0, w1, w0
    mov ADCBUF2, w2
    add w0, w2, w0
    mov w0, sum
    pop w2
    pop.d w0
    retfie
    .bss
ticks: .space 2
sum: .space 2
    .text
)";

struct Inputs : dspic::Outside {
  int analogue_counts(int channel, Cycle) override { return 100 * channel; }
};

// million instructions a second of processor time
double chip_rate(const std::string& text, bool translated) {
  const dspic::assembly::Image image = dspic::assembly::assemble(text, "core_speed");
  if (!image.is_whole()) {
    std::fputs(image.report().c_str(), stderr);
    std::exit(2);
  }
  Inputs inputs;
  dspic::ProgramMemory program;
  for (const auto& [address, word] : image.program) program.write(address, word);
  dspic::Configuration configuration;
  configuration.program = &program;
  dspic::Dspic30f6014a device(inputs, nullptr, configuration);
  dspic::Processor cpu(device, program);
  if (translated) cpu.set_translator(chip::translation());
  const double from = processor_s();
  for (int tick = 0; tick < 512 * kSeconds; ++tick) cpu.run(static_cast<Cycle>(tick + 1) * 28800);
  return 1e-6 * kInstructionsPerCycle * static_cast<double>(cpu.now()) / (processor_s() - from);
}

bool row(const char* what, const std::string& program, bool interrupts, double interpreted_promise,
         double translated_promise, int rounds) {
  std::vector<double> interpreted, translated, avr;
  for (int round = 0; round < rounds; ++round) {
    interpreted.push_back(chip_rate(program, false));
    translated.push_back(chip_rate(program, true));
    avr.push_back(avr_rate(interrupts));
  }
  std::printf("%-38s %7.0f (%.0f) %9.0f (%.0f) %9.0f\n", what, median(interpreted), interpreted_promise,
              median(translated), translated_promise, median(avr));
  std::fflush(stdout);
  return median(interpreted) >= interpreted_promise && median(translated) >= translated_promise;
}

}  // namespace

bool measure_core(int rounds) {
  std::printf("\n%-38s %13s %16s %9s\n", "million instructions a second", "interpreted", "translated",
              "simavr");
  bool kept = row("straight code", kStraight, false, 300, 1000, rounds);
  kept &= row("with the interrupts of a driving robot", std::string(kInterrupts) + kStraight, true, 150, 500,
              rounds);
  return kept;
}

}  // namespace bench
