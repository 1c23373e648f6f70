// SPDX-License-Identifier: MIT
// How fast the processor's core is: straight code, and the same with the interrupts of a driving robot (timer
// at 10 kHz, converter at 16,384 Hz). Not a test.
//
//     build/tests/core_speed [SECONDS simulated]
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "dspic30/asm/assembler.h"
#include "dspic30/core/processor.h"
#include "hal_sim/chip/translation.h"

namespace {

using dspic::Cycle;

constexpr double kFcyHz = 14745600;
constexpr double kInstructionsPerCycle = 21.0 / 22;  // of kStraight

// 22 instructions in 24 cycles a round, as a compiler writes them: loads, sums, shifts, compares, a call's
// stack
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

// of a round 21 instructions take 22 cycles
void measure(const char* what, const std::string& text, int seconds) {
  const dspic::assembly::Image image = dspic::assembly::assemble(text, what);
  if (!image.is_whole()) {
    std::fputs(image.report().c_str(), stderr);
    std::exit(1);
  }
  Inputs inputs;
  dspic::ProgramMemory program;
  for (const auto& [address, word] : image.program) program.write(address, word);
  dspic::Configuration configuration;
  configuration.program = &program;
  dspic::Dspic30f6014a chip(inputs, nullptr, configuration);
  dspic::Processor cpu(chip, program);
  cpu.set_translator(&chip::translation());
  const std::clock_t begin = std::clock();
  for (int tick = 0; tick < 512 * seconds; ++tick) cpu.run(static_cast<Cycle>(tick + 1) * 28800);
  const double taken = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  const double cycles = static_cast<double>(cpu.now()), rate = cycles / taken;
  std::printf("%-12s %.0f million instructions/s, %.0f million cycles/s, %.0f times real time, W0 = %u\n",
              what, rate * kInstructionsPerCycle / 1e6, rate / 1e6, rate / kFcyHz, cpu.w(0));
}

}  // namespace

int main(int argc, char** argv) {
  const int seconds = argc > 1 ? std::atoi(argv[1]) : 30;
  measure("straight", kStraight, seconds);
  measure("interrupts", std::string(kInterrupts) + kStraight, seconds);
  return 0;
}
