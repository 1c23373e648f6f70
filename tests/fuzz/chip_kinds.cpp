// SPDX-License-Identifier: MIT
// What a stranger hands to the chip: program files, assembler text, and code.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "dspic30/asm/assembler.h"
#include "dspic30/core/disassembler.h"
#include "dspic30/core/processor.h"
#include "dspic30/load/firmware_file.h"
#include "dspic30/translate/translations.h"
#include "hal_sim/chip/translation.h"
#include "tests/fuzz/kinds.h"

namespace fuzz {
namespace {

constexpr dspic::Cycle kMoment = 50000, kWindow = 37;

void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "%s\n", what);
  std::abort();
}

// a course: registers, RAM, time
std::uint64_t run(std::string_view bytes, dspic::Cycle window, bool translated = false) {
  dspic::Outside nobody;
  dspic::ProgramMemory program;
  std::uint32_t address = 0;
  for (std::size_t i = 0; i + 3 <= bytes.size() && address < dspic::kFlashEnd; i += 3, address += 2)
    program.write(address, static_cast<unsigned char>(bytes[i]) |
                               static_cast<unsigned char>(bytes[i + 1]) << 8 |
                               static_cast<unsigned char>(bytes[i + 2]) << 16);
  dspic::Configuration configuration;
  configuration.program = &program;
  dspic::Dspic30f6014a chip(nobody, nullptr, configuration);
  dspic::Processor cpu(chip, program);
  if (translated) {
    static dspic::translate::Translations translations(::chip::translator_library(), {});
    cpu.set_translator(&translations);
    cpu.translate_all();
  }
  for (dspic::Cycle end = window; cpu.now() < kMoment; end += window)
    while (const auto kind = cpu.run(std::min(end, kMoment))) {
      const dspic::Cycle before = cpu.now();
      chip.reset(*kind, before);
      cpu.restart();
      require(cpu.now() > before, "a reset takes no time");
    }
  return cpu.state_hash() ^ chip.state_hash(cpu.now());
}

}  // namespace

void firmware(std::string_view bytes) {
  dspic::FirmwareFile file, again;
  std::string error;
  const bool good = dspic::load_firmware(std::string(bytes), "x", file, error);
  require(good == error.empty(), "a file is refused without a reason, or accepted with one");
  if (!good) return;
  file.debug.value();
  file.code.lines();
  for (const auto& [address, word] : file.words) {
    require(dspic::is_program_memory(address) && address % 2 == 0 && word <= 0xFFFFFF,
            "a word where there is no memory");
    dspic::disassemble(word, 0, address & 0x1FFFE);
  }
  require(dspic::load_hex(dspic::to_hex(file), "y", again, error) && again.words == file.words,
          "a HEX file does not come back");
}

void assembler(std::string_view bytes) {
  const auto image = dspic::assembly::assemble(std::string(bytes), "x.s");
  if (!image.is_whole()) return;
  for (const auto& [address, word] : image.program)
    require(address % 2 == 0 && word <= 0xFFFFFF, "a word that is none");
}

void code(std::string_view bytes) {
  require(run(bytes, kMoment) == run(bytes, kWindow), "a course depends on how it is divided");
  if (bytes.size() % 64 == 0)  // not each: it takes many times as long
    require(run(bytes, kMoment) == run(bytes, kMoment, true), "translated code takes another course");
}

}  // namespace fuzz
