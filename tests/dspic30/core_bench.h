// SPDX-License-Identifier: MIT
// A whole chip on a bench: a program in assembler text runs on it.
#pragma once
#include <memory>
#include <string>

#include "dspic30/asm/assembler.h"
#include "dspic30/core/cpu.h"
#include "dspic30/core/processor.h"
#include "dspic30/core/waits.h"
#include "dspic30/translate/translations.h"
#include "hal_sim/chip/translation.h"
#include "tests/dspic30/bench.h"

namespace bench {

/// The macro `go OPERATION`: writes or erases flash as NVMCON says, with the unlocking sequence.
inline const std::string kFlashMacro = R"(
    .macro go operation
    mov #\operation, w0
    mov w0, NVMCON
    mov #0x55, w0
    mov w0, NVMKEY
    mov #0xAA, w0
    mov w0, NVMKEY
    bset NVMCON, #WR
    nop
    nop
    .endm
)";

struct CoreBench {
  /// `text` is assembled and programmed; the configuration words are those of `c`. `translates`: jumped to,
  /// code is translated at once. `store`: shared with others that run the same text.
  explicit CoreBench(const std::string& text, dspic::Configuration c = {}, bool translates = true,
                     std::shared_ptr<dspic::CodeStore> store = nullptr) {
    image = dspic::assembly::assemble(text, "test.s");
    EXPECT_TRUE(image.is_whole()) << image.report();
    for (const auto& [address, word] : image.program) program.write(address, word);
    c.program = &program;
    chip = std::make_unique<dspic::Dspic30f6014a>(outside, &notes, c);
    cpu = std::make_unique<dspic::Processor>(*chip, program, std::move(store));
    if (!translates) return;
    static dspic::translate::Translations translations(chip::translator_library(), {});
    cpu->set_translator(&translations);
    cpu->translate_all();
  }
  FakeOutside outside;
  Notes notes;
  dspic::ProgramMemory program;
  dspic::assembly::Image image;
  std::unique_ptr<dspic::Dspic30f6014a> chip;
  std::unique_ptr<dspic::Processor> cpu;
  int resets = 0;

  /// Runs up to `until`, through resets.
  void run(Cycle until) {
    while (const auto kind = cpu->run(until)) {
      ++resets;
      chip->reset(*kind, cpu->now());
      cpu->restart();
    }
  }
  /// Runs until the program counter is at a label, at an instruction's end; false: not within `most` cycles.
  bool run_to(const std::string& label, Cycle most = 1000000) {
    for (const Cycle end = cpu->now() + most; cpu->now() < end;) {
      if (cpu->pc() == symbol(label) && !cpu->is_asleep()) return true;
      run(cpu->now() + 1);
    }
    return false;
  }
  unsigned symbol(const std::string& name) const {
    const auto found = image.symbols.find(name);
    EXPECT_NE(found, image.symbols.end()) << name;
    return found == image.symbols.end() ? 0 : found->second;
  }
  unsigned w(int n) const { return cpu->w(n); }
  unsigned word(unsigned address) const {
    return address < 0x800 ? chip->peek(address, cpu->now()) : cpu->ram(address) | cpu->ram(address + 1) << 8;
  }
  unsigned word(const std::string& name) const { return word(symbol(name)); }
  unsigned sfr(const std::string& name) const { return chip->peek(Bench::at(name), cpu->now()); }
};

}  // namespace bench
