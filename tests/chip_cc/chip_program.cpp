// SPDX-License-Identifier: MIT
#include "tests/chip_cc/chip_program.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "compiler/build/build.h"

namespace chip_cc {

namespace fs = std::filesystem;
using dspic::Cycle;

namespace {

// before the program: its functions stay functions
constexpr const char* kDeclaration = "extern long bench_run(void) __attribute__((noinline));\n";
constexpr const char* kMain = R"(
volatile long bench_result;
volatile int bench_done;
int main(void) {
  bench_result = bench_run();
  bench_done = 1;
  for (;;) ;
}
)";

/// Of this process: programs one after the other, and the library's objects for all of them.
struct Workplace {
  fs::path path = fs::temp_directory_path() / ("twinpuck-chip-cc-" + std::to_string(getpid()));
  ~Workplace() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
};

}  // namespace

ChipProgram::ChipProgram(const std::string& name, const std::string& source, const std::string& level,
                         const std::vector<std::string>& others) {
  static const Workplace workplace;
  const fs::path folder = workplace.path / name;
  fs::create_directories(folder);
  std::ofstream(folder / "main.c") << kDeclaration << source << kMain;
  for (std::size_t i = 0; i < others.size(); ++i)
    std::ofstream(folder / ("other" + std::to_string(i) + ".c")) << others[i];
  cc::BuildOptions options;
  options.source_dir = folder;
  options.output = folder / "program.elf";
  options.cache_dir = workplace.path / "cache";
  options.optimisation = level;
  const auto built = cc::build_image(options);
  for (std::string e : built.errors) {
    const std::string ours = folder.string() + "/";
    for (std::size_t at; (at = e.find(ours)) != std::string::npos;) e.erase(at, ours.size());
    error_ += e + "\n";
  }
  warnings_ = built.warnings;
  if (built.ok) {
    std::ostringstream bytes;
    bytes << std::ifstream(options.output, std::ios::binary).rdbuf();
    dspic::load_firmware(bytes.str(), options.output.string(), file_, error_);
  }
  fs::remove_all(folder);
  if (!is_whole()) return;
  constexpr std::uint32_t kEeprom = 0x7FF000, kEepromEnd = 0x800000;
  for (const auto& [address, word] : file_.words)
    if (address >= kEeprom && address < kEepromEnd)
      eeprom_.words()[(address - kEeprom) / 2] = static_cast<std::uint16_t>(word);
    else
      program_.write(address, word);
  dspic::Configuration c;
  c.program = &program_;
  c.eeprom = &eeprom_;
  chip_ = std::make_unique<dspic::Dspic30f6014a>(outside_, &notes_, c);
  cpu_ = std::make_unique<dspic::Processor>(*chip_, program_);
  done_ = address_of("bench_done");
  result_ = address_of("bench_result");
}

unsigned ChipProgram::address_of(const std::string& variable) const {
  const auto found = file_.objects.find(variable);
  EXPECT_NE(found, file_.objects.end()) << variable;
  return found == file_.objects.end() ? 0x800 : found->second;
}

unsigned ChipProgram::sfr(const std::string& name) const {
  return chip_->peek(bench::Bench::at(name), cpu_->now());
}

std::uint64_t ChipProgram::peek(unsigned address, unsigned bytes) const {
  std::uint64_t value = 0;
  for (unsigned i = 0; i < bytes; ++i) value |= std::uint64_t{cpu_->ram(address + i)} << 8 * i;
  return value;
}

void ChipProgram::poke(unsigned address, std::uint64_t value, unsigned bytes) {
  for (unsigned i = 0; i < bytes; ++i) cpu_->set_ram(address + i, static_cast<std::uint8_t>(value >> 8 * i));
}

void ChipProgram::step(Cycle until) {
  if (cpu_->run(until)) {
    // none of the programs asks for a reset
    ADD_FAILURE() << "reset at cycle " << cpu_->now();
    cpu_->set_ram(done_, 1);
  }
}

void ChipProgram::run_until(const std::string& variable, Cycle most) {
  constexpr Cycle kLook = 2000;  // between two looks
  const unsigned at = address_of(variable);
  const Cycle end = cpu_->now() + most;
  while (!peek(at, 2) && cpu_->now() < end) step(cpu_->now() + kLook);
  EXPECT_TRUE(peek(at, 2)) << "no end after " << most << " cycles, pc " << std::hex << cpu_->pc();
}

std::uint32_t ChipProgram::run(Cycle most) {
  run_until("bench_done", most);
  return static_cast<std::uint32_t>(peek(result_, 4));
}

std::uint32_t ChipProgram::run_counting(const std::string& function, Cycle& own, bool with_runtime) {
  constexpr int kStackPointer = 15;
  std::map<unsigned, bool> entries;  // of functions; true: the runtime's
  for (const auto& [name, address] : file_.functions)
    entries[address] = !with_runtime && name.rfind("__", 0) == 0;
  const unsigned begin = file_.functions.at(function);
  unsigned stack_outside = 0, stack_in_runtime = 0;  // W15 at the entry; 0: not inside
  own = 0;
  const Cycle end = cpu_->now() + 20'000'000;
  while (!has_ended() && cpu_->now() < end) {
    const unsigned pc = cpu_->pc(), stack = cpu_->w(kStackPointer);
    const Cycle before = cpu_->now();
    if (!stack_outside && pc == begin) stack_outside = stack;
    if (stack_outside && !stack_in_runtime) {
      const auto entry = entries.find(pc);
      if (entry != entries.end() && entry->second) stack_in_runtime = stack;
    }
    const bool counts = stack_outside && !stack_in_runtime;
    step(before + 1);
    if (counts) own += cpu_->now() - before;
    // a RETURN takes the four bytes that the CALL had pushed
    if (stack_in_runtime && cpu_->w(kStackPointer) < stack_in_runtime) stack_in_runtime = 0;
    if (stack_outside && cpu_->w(kStackPointer) < stack_outside) stack_outside = 0;
  }
  EXPECT_TRUE(has_ended());
  return static_cast<std::uint32_t>(peek(result_, 4));
}

}  // namespace chip_cc
