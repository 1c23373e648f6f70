// SPDX-License-Identifier: MIT
#include "hal_sim/debug/pc_machine.h"

#include <fmt/format.h>
#include <sys/uio.h>
#include <ucontext.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

#include "dspic30/memory/irqs.h"
#include "dspic30/memory/sfr_table.h"
#include "hal_sim/host/endless_wait.h"

namespace debug {

namespace {

constexpr std::size_t kMostFrames = 64;
constexpr int kRbp = 6, kRsp = 7;  // numbers of the debug information
constexpr Address kNvmcon = dspic::sfr("NVMCON");

struct Register {
  const char* name;
  int index;
};
/// In the order of their numbers in the debug information. Source: System V ABI, AMD64 supplement, 3.6.2.
constexpr Register kPcRegisters[] = {{"rax", REG_RAX}, {"rdx", REG_RDX}, {"rcx", REG_RCX}, {"rbx", REG_RBX},
                                     {"rsi", REG_RSI}, {"rdi", REG_RDI}, {"rbp", REG_RBP}, {"rsp", REG_RSP},
                                     {"r8", REG_R8},   {"r9", REG_R9},   {"r10", REG_R10}, {"r11", REG_R11},
                                     {"r12", REG_R12}, {"r13", REG_R13}, {"r14", REG_R14}, {"r15", REG_R15}};

}  // namespace

PcMachine::PcMachine(host::CompiledRunner& runner)
    : runner_(runner),
      file_(read_pc_program(runner.copy().path())),
      stepper_(runner, file_.code,
               [this](const Stepper::Place& place, void* c) { return reached(place, c); }),
      starts_(runner.starts()) {
  if (const auto* main = file_.code.function_named("main")) main_ = body_of(main->begin);
}

// --- being stopped

void PcMachine::watch(Watcher* watcher, bool on) {
  watcher_ = on ? watcher : nullptr;
  host::catch_faults_on_this_thread();
  host::set_step_guest(on ? &stepper_ : nullptr);
  stepper_.begin(on ? watcher->look() : Look::Nothing);
  last_ = 0;
}

void PcMachine::mark(const std::vector<std::uint32_t>& addresses) {
  std::vector<std::uintptr_t> all;
  for (const std::uint32_t address : addresses) all.push_back(runner_.copy().base() + address);
  if (main_) all.push_back(runner_.copy().base() + main_);  // a reset is noticed there
  stepper_.mark(std::move(all));
}

Look PcMachine::reached(const Stepper::Place& place, void* context) {
  place_ = place;
  context_ = context;
  in_code_ = true;
  if (last_) {
    chip::Step step;
    step.pc = last_;
    step.next = pc();
    watcher_->after(step);
  }
  last_ = pc();
  if (pc() == main_ && std::exchange(starts_, runner_.starts()) != runner_.starts())
    watcher_->was_reset(now());
  watcher_->before(now());
  context_ = nullptr;
  return watcher_->look();
}

bool PcMachine::stands_between() {
  in_code_ = false;
  context_ = nullptr;
  place_ = stepper_.place_between().value_or(Stepper::Place{});
  return true;
}

// --- where it stands

Address PcMachine::base() { return place_.pc ? ~Address{stepper_.frame_end(place_)} : 0; }

std::vector<Frame> PcMachine::frames() {
  std::vector<Frame> all;
  if (!place_.pc) return all;
  const auto add = [&](const Stepper::Place& place, bool is_return) {
    Frame f;
    f.pc = relative(place.pc);
    f.call = is_return ? f.pc - 1 : f.pc;
    f.base = ~Address{stepper_.frame_end(place)};
    f.function = file_.code.function_at(f.call);
    if (stepper_.is_told(runner_.copy().base() + f.call)) all.push_back(f);
  };
  add(place_, false);
  for (const auto& caller : stepper_.callers(place_, kMostFrames)) {
    if (caller.by_host && !all.empty()) all.back().is_handler = true;
    add(caller.place, true);
  }
  return all;
}

std::uint32_t PcMachine::body_of(std::uint32_t function) const {
  const auto* const whole = file_.code.function_at(function);
  for (const auto& line : file_.code.lines)
    if (whole && line.address > function && line.address < whole->end && !line.is_end && line.line > 0)
      return line.address;
  return function;
}

std::string PcMachine::instruction(std::uint32_t address, std::uint32_t& next) const {
  next = address + 1;
  return "";
}

// --- its data

bool PcMachine::read(const Data& data, void* to) const {
  if (data.is_register) {
    const std::uint16_t value = runner_.peek(static_cast<unsigned>(data.address), now());
    std::memcpy(to, &value, std::min<std::size_t>(data.bytes, sizeof value));
    return true;
  }
  const void* const value = runner_.value_at(data.address);
  if (runner_.owns_data(data.address, data.bytes)) {
    std::memcpy(to, value, data.bytes);
    return true;
  }
  // asked of the system, for a pointer of the program may lead anywhere
  iovec here{to, data.bytes}, there{const_cast<void*>(value), data.bytes};
  return process_vm_readv(getpid(), &here, 1, &there, 1, 0) == static_cast<ssize_t>(data.bytes);
}

bool PcMachine::write(const Data& data, const void* from) {
  if (!data.is_register) {
    if (!runner_.owns_data(data.address, data.bytes)) return false;
    runner_.write_value(data.address, from, data.bytes);
    return true;
  }
  // within a line the program may be counting its cycles, which a change of the chip's interrupts would
  // upset; a write of the flash or EEPROM would keep it waiting here
  const auto* const line = file_.code.line_at(pc());
  if ((in_code_ && (!line || line->address != pc())) || data.address == kNvmcon) return false;
  std::uint16_t value = 0;
  std::memcpy(&value, from, sizeof value);
  runner_.poke_register(static_cast<unsigned>(data.address), value, in_code_);
  return true;
}

Address PcMachine::register_value(int number) const {
  if (number == kRbp) return place_.frame;
  if (number == kRsp) return place_.sp;
  if (!context_ || number < 0 || number >= static_cast<int>(std::size(kPcRegisters))) return 0;
  return static_cast<Address>(
      static_cast<ucontext_t*>(context_)->uc_mcontext.gregs[kPcRegisters[number].index]);
}

std::optional<Data> PcMachine::find_register(const std::string& name) const {
  auto data = runner_.has_chip() ? find_sfr(name) : std::nullopt;
  if (data) data->is_register = true;
  return data;
}

// --- for people

std::vector<std::pair<std::string, std::string>> PcMachine::register_list() const {
  std::vector<std::pair<std::string, std::string>> all;
  for (int n = 0; n < static_cast<int>(std::size(kPcRegisters)); ++n)
    if (context_ || n == kRbp || n == kRsp)
      all.emplace_back(kPcRegisters[n].name, fmt::format("{:#018x}", register_value(n)));
  return all;
}

std::string PcMachine::registers() const {
  std::string text;
  int n = 0;
  for (const auto& [name, value] : register_list())
    text += fmt::format("{:<3} {}{}", name, value, ++n % 4 == 0 ? "\n" : "   ");
  return text + fmt::format("{}pc  {:#x}\n", n % 4 ? "\n" : "", pc());
}

std::string PcMachine::told(int vector) {
  const std::string timer =
      !runner_.has_chip() ? "" : told_timer(dspic::irq_name(vector), [this](unsigned address) {
        return runner_.peek(address, now());
      });
  return told_interrupt(dspic::irq_name(vector), runner_.flag(vector, now()), runner_.is_enabled(vector),
                        runner_.priority(vector), runner_.processor().cpu_level(),
                        runner_.is_held_by_disi()) +
         timer;
}

std::string PcMachine::interrupts() {
  std::string text = fmt::format("the processor is at level {}, {} handlers deep\n",
                                 runner_.processor().cpu_level(), nesting());
  for (int v = 0; v < dspic::kIrqs; ++v)
    if (runner_.is_enabled(v) || runner_.flag(v, now()))
      text += fmt::format("  {}{}\n", told(v),
                          runner_.has_chip() ? fmt::format(", served {} times", runner_.served(v)) : "");
  return text;
}

std::string PcMachine::why() {
  // the library's functions stand in for the line that called them
  host::Place place;
  for (const Frame& frame : frames()) {
    place = runner_.place_of(frame.call);
    if (!host::variables_in(runner_, place).empty()) break;
  }
  std::string text = "it stands in " + host::to_string(place);
  const std::vector<std::string> names = host::variables_in(runner_, place);
  text += names.empty() ? ", which reads no variable\n" : ", which reads\n";
  for (const std::string& name : names) {
    std::string error;
    const host::Variable* const variable = runner_.find_variable(name, error);
    std::vector<char> bytes(variable ? variable->bytes : 0);
    const bool is_number = variable && variable->kind != host::Variable::Kind::Aggregate;
    if (is_number) runner_.read_memory(variable->address, bytes.data(), bytes.size());
    text +=
        "  " + name + (is_number ? fmt::format(" = {}", variable_value(*variable, bytes.data())) : "") + "\n";
    bool is_written = false;
    for (const host::Writer& w : host::writers_of(name, place)) {
      is_written = true;
      std::string state;
      for (int v = 0; v < dspic::kIrqs && !w.vector.empty(); ++v)
        if (dspic::irq_name(v) == w.vector) state = told(v);
      text += fmt::format("    {}{} ({}) writes it{}\n", w.is_handler() ? "the handler " : "", w.function,
                          w.place, state.empty() ? "" : "; " + state);
    }
    if (!is_written) text += "    no function of its sources writes it by its name\n";
  }
  std::string pending;
  for (int v = 0; v < dspic::kIrqs; ++v)
    if (runner_.flag(v, now()) &&
        (!runner_.is_enabled(v) || runner_.priority(v) <= runner_.processor().cpu_level()))
      pending += "  " + told(v) + "\n";
  return text + (pending.empty() ? "" : "pending, but not served:\n" + pending);
}

}  // namespace debug
