// SPDX-License-Identifier: MIT
#include "tests/routines/routine_program.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "hal_sim/cc/build.h"

namespace routines_test {

namespace fs = std::filesystem;

namespace {

constexpr unsigned kBehind = 0x17000;  // where calls return to: nothing is there

struct Folder {
  fs::path path = fs::temp_directory_path() / ("twinpuck-routines-" + std::to_string(getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
};

}  // namespace

RoutineProgram::RoutineProgram(const std::string& source) {
  const Folder folder;
  std::ofstream(folder.path / "main.c") << source;
  cc::BuildOptions options;
  options.source_dir = folder.path;
  options.output = folder.path / "program.elf";
  options.optimisation = "-O1";
  options.register_way = options.chip_way = true;
  const auto built = cc::build_image(options);
  for (const std::string& e : built.errors) error_ += e + "\n";
  if (!built.ok) return;
  std::ostringstream bytes;
  bytes << std::ifstream(options.output, std::ios::binary).rdbuf();
  if (!dspic::load_firmware(bytes.str(), options.output.string(), file_, error_)) return;
  for (const auto& [address, word] : file_.words) program_.write(address, word);
  dspic::Configuration c;
  c.program = &program_;
  chip_ = std::make_unique<dspic::Dspic30f6014a>(outside_, &notes_, c);
  cpu_ = std::make_unique<dspic::Cpu>(chip_->parts(), program_);
  cpu_->written = 0xFFFF;
}

unsigned RoutineProgram::address_of(const std::string& function) const {
  const auto found = file_.functions.find(function);
  return found == file_.functions.end() ? 0 : found->second;
}

Outcome RoutineProgram::call(unsigned address, const Words& w) {
  dspic::Cpu& cpu = *cpu_;
  std::copy(w.begin(), w.end(), cpu.w.begin());
  cpu.w[15] = kStack - 4;
  cpu.push(kBehind & 0xFFFF);
  cpu.push(kBehind >> 16);
  cpu.now = 0;
  cpu.deadline = dspic::kNever;
  const dspic::Decoded* const end = cpu.code() + kBehind / 2;
  const dspic::Decoded* d = cpu.jump(address, cpu.code());
  while (d != end && !cpu.reset_due) {
    cpu.at = d;
    const dspic::Decoded* const next = d->run(cpu, d);
    cpu.now += d->cycles;
    d = next;
  }
  Outcome outcome;
  std::copy_n(cpu.w.begin(), outcome.w.size(), outcome.w.begin());
  outcome.cycles = cpu.now;
  return outcome;
}

}  // namespace routines_test
