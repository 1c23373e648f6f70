// SPDX-License-Identifier: MIT
#include "tests/routines/routine_program.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "compiler/build/build.h"

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

bool build(const std::string& source, dspic::FirmwareFile& file, std::string& error) {
  const Folder folder;
  std::ofstream(folder.path / "main.c") << source;
  cc::BuildOptions options;
  options.source_dir = folder.path;
  options.output = folder.path / "program.elf";
  options.optimisation = "-O1";
  const auto built = cc::build_image(options);
  for (const std::string& e : built.errors) error += e + "\n";
  if (!built.ok) return false;
  std::ostringstream bytes;
  bytes << std::ifstream(options.output, std::ios::binary).rdbuf();
  return dspic::load_firmware(bytes.str(), options.output.string(), file, error);
}

RoutineProgram::RoutineProgram(const std::string& source) {
  if (!build(source, file_, error_)) return;
  for (const auto& [address, word] : file_.words) program_.write(address, word);
  dspic::Configuration c;
  c.program = &program_;
  chip_ = std::make_unique<dspic::Dspic30f6014a>(outside_, &notes_, c);
  cpu_ = std::make_unique<dspic::Cpu>(chip_->parts(), program_, nullptr);
  cpu_->note_written(0xFFFF);
  cpu_->corcon |= dspic::sfr_bits("CORCON", "PSV");  // page 0, as the start-up code sets it
  cpu_->choose_code();
}

unsigned RoutineProgram::address_of(const std::string& function) const {
  const auto found = file_.functions.find(function);
  return found == file_.functions.end() ? 0 : found->second;
}

unsigned RoutineProgram::constants() const { return 0x8000 | file_.functions.at("k"); }

void RoutineProgram::fill_ram(std::uint32_t seed) {
  for (std::uint8_t& byte : cpu_->ram) {
    seed = seed * 1664525u + 1013904223u;
    byte = static_cast<std::uint8_t>(seed >> 24);
  }
}

void RoutineProgram::begin(const Words& w, unsigned flags) {
  dspic::Cpu& cpu = *cpu_;
  std::copy(w.begin(), w.end(), cpu.w.begin());
  cpu.w[15] = kStack - 4;
  cpu.push(kBehind & 0xFFFF);
  cpu.push(kBehind >> 16);
  cpu.set_flags(flags);
  cpu.dc = flags << 4;
  cpu.now = 0;
  cpu.deadline = dspic::kNever;
}

void RoutineProgram::call(unsigned address, const Words& w, unsigned flags) {
  dspic::Cpu& cpu = *cpu_;
  begin(w, flags);
  const dspic::Decoded* const end = cpu.code() + kBehind / 2;
  const dspic::Decoded* d = cpu.jump(address, cpu.code());
  while (d != end && !cpu.reset_due && cpu.now < 1000000) {
    cpu.at = d;
    const dspic::Decoded* const next = d->run(cpu, d);
    cpu.now += d->cycles;
    d = next;
  }
}

bool RoutineProgram::recall(const dspic::KnownRoutine& routine, unsigned address, const Words& w,
                            unsigned flags, dspic::Cycle deadline) {
  dspic::Cpu& cpu = *cpu_;
  begin(w, flags);
  cpu.deadline = deadline;
  const dspic::Decoded* const d = cpu.jump(address, cpu.code());
  if (!dspic::recall(cpu, d, routine)) return false;
  cpu.now += d->cycles;
  return true;
}

void RoutineProgram::look(State& state) const {
  state.w = cpu_->w;
  state.sr = cpu_->sr();
  state.rcount = cpu_->rcount;
  std::memcpy(state.stack.data(), &cpu_->ram[kStack - kBelow - dspic::Cpu::kRamStart], state.stack.size());
  std::memcpy(state.data.data(), &cpu_->ram[kData - dspic::Cpu::kRamStart], state.data.size());
  state.cycles = cpu_->now;
}

void RoutineProgram::restore(const State& state) {
  std::memcpy(&cpu_->ram[kData - dspic::Cpu::kRamStart], state.data.data(), state.data.size());
  std::memcpy(&cpu_->ram[kStack - kBelow - dspic::Cpu::kRamStart], state.stack.data(), state.stack.size());
  cpu_->rcount = static_cast<std::uint16_t>(state.rcount);
}

std::string difference(const State& a, const State& b) {
  std::ostringstream text;
  const auto tell = [&](const std::string& what, auto by_heart, auto on_the_core) {
    if (by_heart != on_the_core)
      text << what << " " << by_heart << " by heart, " << on_the_core << " on the core; ";
  };
  tell("cycles", a.cycles, b.cycles);
  text << std::hex;
  for (std::size_t i = 0; i < a.w.size(); ++i) tell("w" + std::to_string(i), a.w[i], b.w[i]);
  tell("sr", a.sr, b.sr);
  tell("rcount", a.rcount, b.rcount);
  if (a.stack != b.stack)
    for (std::size_t i = 0; i < a.stack.size(); ++i)
      tell("stack+" + std::to_string(static_cast<int>(i) - 32), unsigned{a.stack[i]}, unsigned{b.stack[i]});
  if (a.data != b.data)
    for (std::size_t i = 0; i < a.data.size(); ++i)
      tell("data+" + std::to_string(i), unsigned{a.data[i]}, unsigned{b.data[i]});
  return text.str();
}

}  // namespace routines_test
