// SPDX-License-Identifier: MIT
#include "hal_sim/chip/chip_runner.h"

#include <bitset>

#include "dspic30/core/cpu.h"
#include "dspic30/core/waits.h"
#include "dspic30/device/chip_parts.h"
#include "hal_sim/board/board.h"
#include "hal_sim/board/epuck_params.h"
#include "hal_sim/chip/endless_wait.h"
#include "hal_sim/chip/oscillator.h"
#include "hal_sim/chip/translation.h"
#include "sim_core/base/hash.h"

namespace chip {

namespace {

constexpr unsigned kRamStart = dspic::Processor::kRamStart, kRamEnd = dspic::Processor::kRamEnd;
constexpr std::size_t kMostReports = 64;
/// Which drivers are the host's: those whose functions lead there.
api::HostLibrary::Served served_by(const dspic::FirmwareFile& file) {
  const auto is_filled = [&](const char* driver) {
    for (const api::HostName& f : api::kHostFunctions) {
      const auto found = file.functions.find(f.name);
      if (std::string(driver) != f.driver || found == file.functions.end()) continue;
      if (dspic::is_host_place(goto_target(file, found->second))) return true;
    }
    return false;
  };
  api::HostLibrary::Served served{is_filled("agenda"), is_filled("scan"), api::Level::O1, 0};
  if (const auto found = file.objects.find("hal_free_space"); found != file.objects.end())
    served.free_space = found->second;
  if (const auto level = file.marks.find(dspic::kLibraryLevelSymbol); level != file.marks.end())
    served.level = static_cast<api::Level>(std::min<std::uint32_t>(level->second, 3));
  return served;
}

constexpr std::int64_t kUsualResets = 9;           // that a program asks for itself; assumed: more are a loop
constexpr Cycle kLeastWait = board::kFcyHz / 100;  // a wait is called endless from then on

}  // namespace

ChipRunner::ChipRunner(std::string name, std::shared_ptr<const ChipImage> image, double clock_factor,
                       board::Board& board, Cycle start, std::uint64_t seed)
    : Runner(std::move(name)),
      image_(std::move(image)),
      file_(image_->file()),
      board_(board),
      chip_(board),
      program_(image_->program()),
      seed_(seed) {
  program_eeprom();
  dspic::Configuration configuration;
  configuration.fosc = static_cast<std::uint16_t>(program_.read(dspic::kConfigurationStart));
  configuration.fwdt = static_cast<std::uint16_t>(program_.read(dspic::kConfigurationStart + 2));
  configuration.fcy_hz = static_cast<double>(board::kFcyHz) * clock_factor;
  configuration.program = &program_;
  chip_.power_up(configuration);
  if (const auto end = file_.marks.find(dspic::kServedEndSymbol); end != file_.marks.end()) {
    plain_from_ = end->second;
    library_ = std::make_unique<api::HostLibrary>(board, served_by(file_));
    library_->tell_calls(this);
    chip_.share_coils();
  }
  processor_ =
      std::make_unique<dspic::Processor>(device(), program_, image_->code(), library_.get(), plain_from_);
  fill_ram();
  const bool is_checked = MemoryReports::is_for(file_);
  if (!is_checked) {
    processor_->set_translator(translation());
    processor_->know(image_->known(program_));
  }
  places_ = std::make_unique<ProgramPlaces>(file_, program_, image_->shared_handler(), *processor_, chip_);
  endings_ = std::make_unique<Endings>(file_, program_, *processor_, chip_, *places_);
  calls_ = std::make_unique<LibraryCalls>(image_->functions(), *processor_, *places_, chip_, board);
  const ChipData::Parts parts{file_, program_, chip_, *processor_, *places_, library_.get(), plain_from_};
  data_ = std::make_unique<ChipData>(
      parts,
      [this](unsigned address, unsigned char byte) {
        chip_.digest().note(EventDigest::Kind::Written, address << 8 | byte, end_);
      },
      [this] { wake(); });
  view_ = view_of(device());
  if (is_checked) check_memory();
  tell_calls();
  chip_.comment_on([this](const dspic::Diagnosis& d) { return comment(d); });
  // a source of clock that the robot has not: no instruction is ever executed
  const std::string problem = clock_problem(configuration.fosc);
  has_clock_ = problem.empty();
  if (!has_clock_) report({host::kTrapUnsimulated, "Reset", problem, 0});
  if (start <= 0) return;
  end_ = start;
  processor_->wait_until(start);
  chip_.reset(start);
  if (library_) library_->reset(start);
  processor_->restart();
}

/// --sanitize: everything is interpreted, and looked at.
void ChipRunner::check_memory() {
  memory_ = std::make_unique<MemoryReports>(
      file_, *processor_, *places_, [this](const std::string& message, unsigned place) {
        constexpr std::size_t kMostCallers = 16;
        report(Ending{host::kTrapSanitizer, "", message, place},
               places_->callers(processor_->pc_of_access(), place, kMostCallers));
      });
  processor_->check_memory(&memory_->check());
}

/// Which functions of the program entered() wants to hear of.
void ChipRunner::tell_calls() {
  std::vector<std::uint32_t> addresses = image_->functions().addresses();
  if ((start_ = goto_target(file_, 0)) != 0) addresses.push_back(start_);
  if (memory_)
    for (const std::uint32_t address : memory_->addresses()) addresses.push_back(address);
  processor_->tell_calls(this, std::move(addresses));
}

/// For an observer: the calls of agendas by hal_dspic's own handler. Their functions are known once they are
/// activated, and the place to which they return once one has been called.
void ChipRunner::follow_agendas(unsigned address) {
  const auto learn = [this](unsigned place) {
    const bool is_place = place != 0 && place % 2 == 0 && place < dspic::kFlashEnd;
    if (is_place && agendas_.insert(place).second) processor_->tell_calls(this, {place});
  };
  if (image_->functions().activates_agenda(address)) return learn(processor_->w(0));
  if (address == agenda_returns_to_) {
    observer_->callback(0, processor_->now());
    agenda_returns_to_ = 0;
  } else if (agendas_.count(address) && device().interrupts().nesting() > 0) {
    observer_->callback(address, processor_->now());
    agenda_depth_ = open_handlers_;
    learn(agenda_returns_to_ = calls_->return_address());
  }
}

void ChipRunner::program_eeprom() {
  for (auto at = file_.words.lower_bound(dspic::kEepromStart & 0xFF0000);
       at != file_.words.end() && at->first >> 16 == dspic::kEepromStart >> 16; ++at) {
    const unsigned low = at->first & 0xFFFF;
    board_.eeprom().erase(low);
    board_.eeprom().write(low, static_cast<std::uint16_t>(at->second));
  }
}

// --- time

// Of parts that stand still their heads alone, which say so. (Found by a trace of memory: 120 of the robot's
// 530 cache lines.)
void ChipRunner::add_hot(sim::HotMemory& memory) const {
  constexpr std::size_t kLine = sim::HotMemory::kLine;
  const auto add = [&memory](const auto& part) { memory.add(&part, sizeof part); };
  const dspic::Cpu& cpu = processor_->cpu();
  const dspic::ChipParts& parts = device().parts();
  add(*this);
  add(*processor_);
  memory.add(&cpu, static_cast<std::size_t>(cpu.ram.data() - reinterpret_cast<const std::uint8_t*>(&cpu)));
  add(*cpu.waits);
  add(*calls_);
  memory.add(&parts.bus, kLine);
  memory.add(&parts.events, 2 * kLine);
  memory.add(&parts.interrupts, 5 * kLine);
  memory.add(&parts.adc, kLine);
  memory.add(&parts.dci, kLine);
  memory.add(&parts.system, kLine);
  if (!library_) return;
  add(*library_);
  add(library_->drivers());
}

/// Behind windows that it was idle for: there is nothing in them but time.
void ChipRunner::catch_up(Cycle now) {
  if (!has_clock_) return;
  while (processor_->now() < now)
    if (const auto kind = processor_->run(now)) reset(*kind);
}

// what came from outside finds the program where it is by now; who looks at each step sees
// it sleep up to then
void ChipRunner::begin_window(Cycle now) {
  if (watches_.empty() && chip_.may_have_news()) catch_up(now);
  end_ = std::max(end_, now);
  if (chip_.begin_window(now)) processor_->stir();
}

// where nothing was to happen, it counts as left out, also for those who look on
void ChipRunner::run_until(Cycle end) {
  if (!has_clock_) {
    end_ = std::max(end_, end);
    idle_until_ = dspic::kNever;
    return;
  }
  const bool passes = idle_until_ > end;
  runs_ = true;  // who looks while somebody holds it up sees it where it is held
  if (processor_->now() < end) {
    if (!passes) ++turns_;
    if (!watches_.empty())
      run_watched(end);
    else if (observer_ && observer_->look_every < dspic::kNever)
      run_looked_at(end);
    else
      while (const auto kind = processor_->run(end)) reset(*kind);
  }
  runs_ = false;
  end_ = std::max(end_, end);
  tell_asked(end_);
  chip_.end_window(std::max(end_, processor_->now()));
  if (end_ >= calls_->next_look()) calls_->look(end_);
  constexpr std::uint64_t kTurnsToLook = 16;
  if (library_ && !passes && turns_ % kTurnsToLook == 0) look_at_stack();
  if (!passes) idle_until_ = std::min(processor_->idle_until(), calls_->next_look());
}

/// Handlers known by heart push nothing, so a stack that has no room for what they would push is told.
void ChipRunner::look_at_stack() {
  if (library_->share_q32() == 0) return;  // none would come
  constexpr unsigned kEntryBytes = 4, kLimit = dspic::sfr("SPLIM"), kStackPointer = 15;
  const auto limit = device().peek(kLimit, chip_.at(processor_->now()));
  const auto pushed = kEntryBytes + 2 * static_cast<unsigned>(library_->saved_words()) +
                      2 * static_cast<unsigned>(std::bitset<16>(library_->saved_registers()).count());
  const unsigned stack = processor_->w(kStackPointer);
  if (limit != 0 && (stack < plain_from_ || stack + pushed > limit + 2u))
    calls_->stack_out_of_range(stack, plain_from_, limit, pushed);
}

void ChipRunner::pass_to(Cycle end) {
  if (runs_ || end <= end_) return;
  end_ = end;
  catch_up(end);
  chip_.end_window(end);
}

void ChipRunner::remote_changed() {
  catch_up(end_);
  device().outside_changed(chip_.at(processor_->now()));
  wake();
}

void ChipRunner::restart() {
  chip_.note_reset(dspic::ResetKind::Pin);
  catch_up(end_);
  processor_->wait_until(end_);
  chip_.digest().note(EventDigest::Kind::Reset, static_cast<std::uint64_t>(dspic::ResetKind::Pin), end_);
  chip_.reset(processor_->now());
  if (library_) library_->reset(processor_->now());
  processor_->restart();
  tell_reset(processor_->now());
  wake();
}

void ChipRunner::begin_again() {
  program_eeprom();
  // an instruction that was under way reached beyond the window's end; the first run began at one
  chip_.begin_again(end_);
  if (library_) library_->reset(end_);
  processor_->power_up(end_);
  fill_ram();
  if (memory_) memory_->check().forget(kRamStart, kRamEnd);
  wake();
}

/// Nobody knows what RAM holds at power-up: each run and robot has its own, the same with either HAL. Where
/// variables lie that start-up code sets it is empty, for who looks at them before.
void ChipRunner::fill_ram() {
  std::uint64_t chance = sim::mix64(seed_);
  for (const char c : name()) chance = sim::mix64(chance ^ static_cast<unsigned char>(c));
  std::array<std::uint8_t, dspic::Processor::kRamBytes> bytes;
  for (unsigned at = kRamStart; at < kRamEnd; at += 8) {
    chance = sim::mix64(chance + at);
    for (unsigned i = 0; i < 8; ++i) bytes[at - kRamStart + i] = static_cast<std::uint8_t>(chance >> 8 * i);
  }
  for (const auto& [variable, address] : file_.objects) {
    const auto size = file_.object_bytes.find(variable);
    const unsigned end = address + (size == file_.object_bytes.end() ? 2 : size->second);
    for (unsigned at = std::max(address, kRamStart); at < std::min(end, kRamEnd); ++at)
      bytes[at - kRamStart] = 0;
  }
  processor_->fill_ram(bytes);
}

void ChipRunner::tell_reset(Cycle at) {
  if (observer_) observer_->ended(at);
  open_handlers_ = 0;
  agenda_returns_to_ = 0;
  for (StepWatch* watch : watches_) watch->was_reset(at);
  calls_->forget_starts();
  if (memory_) memory_->restart();
}

void ChipRunner::report(const Ending& ending, const std::vector<unsigned>& callers) {
  host::TrapReport report;
  report.robot = name();
  report.kind = ending.kind;
  report.vector = ending.vector;
  report.message = ending.message;
  report.place = data_->place_of(ending.place);
  if (report.place.function == "?") report.place.function = places_->text_of(ending.place);
  if (!callers.empty()) report.backtrace.push_back(report.place);
  for (const unsigned call : callers) report.backtrace.push_back(data_->place_of(call));
  report.cycle = processor_->now();
  report.time_s = to_world_s ? to_world_s(report.cycle) : 0;
  // it may come ten thousand times a second, from here and from there; a pointer that is wrong may be another
  // one each time
  const auto same = std::find_if(traps_.begin(), traps_.end(), [&](const host::TrapReport& known) {
    return known.kind == report.kind &&
           (known.message == report.message || report.kind == host::kTrapAddress) &&
           known.place.function == report.place.function && known.place.file == report.place.file &&
           known.place.line == report.place.line;
  });
  if (same != traps_.end())
    ++same->count;
  else if (traps_.size() < kMostReports)
    traps_.push_back(std::move(report));
  else
    ++traps_.back().count;
}

void ChipRunner::came_to_start() {
  if (const auto ending = endings_->of_start(start_, null_told_at_)) report(*ending);
}

void ChipRunner::went_to_reset_vector(unsigned from) {
  null_told_at_ = processor_->now();
  report(endings_->of_null_pointer(from));
  if (memory_) memory_->restart();
  calls_->forget_starts();
  if (library_) library_->begin_anew(processor_->now());
}

/// Where the program is, of what its course has to do with.
std::string ChipRunner::comment(const dspic::Diagnosis& d) const {
  switch (d.cause) {
    case dspic::Cause::MissedInterrupt:
      return places_->who_runs();
    case dspic::Cause::UartOff:
    case dspic::Cause::UartFull:
    case dspic::Cause::NvmBusy:
    case dspic::Cause::CpuTrap:
      return "; at " + places_->text_of(places_->own(processor_->pc_of_access()));
    default:
      return "";
  }
}

void ChipRunner::note_own_reset(Cycle at) {
  if (own_resets_.count++ == 0) own_resets_.first = at;
  own_resets_.last_place = places_->own(processor_->pc());
}

// what the program asked for by RESET goes unsaid, unless it does so again and again
void ChipRunner::reset(dspic::ResetKind kind) {
  const Cycle at = processor_->now();
  if (gives_up_)
    report(endings_->of_giving_up());
  else if (const auto ending = endings_->of_reset(kind))
    report(*ending);
  else if (kind == dspic::ResetKind::Instruction)
    note_own_reset(at);
  gives_up_ = false;
  chip_.note_reset(kind);
  tell_reset(at);
  chip_.digest().note(EventDigest::Kind::Reset, static_cast<std::uint64_t>(kind), at);
  chip_.reset(at);
  if (library_) library_->reset(at);
  processor_->restart();
}

std::vector<board::Diagnosis> ChipRunner::diagnoses() const {
  std::vector<board::Diagnosis> all = chip_.diagnoses();
  // what has ended in a reset is a trap report
  all.erase(std::remove_if(all.begin(), all.end(), [this](const auto& d) { return is_ending(d); }),
            all.end());
  for (board::Diagnosis& of_library : calls_->diagnoses(end_)) all.push_back(std::move(of_library));
  add_endless_wait(all);
  if (own_resets_.count > kUsualResets)
    all.push_back({"resets itself", places_->text_of(own_resets_.last_place),
                   "the program resets the processor again and again by RESET",
                   "what stands behind that line never runs", own_resets_.first, 0, own_resets_.count});
  return dated(std::move(all), board_.diagnoses(cycles()));
}

/// For what no code can set any more. A loop that looks at nothing is none, but the end of a program.
void ChipRunner::add_endless_wait(std::vector<board::Diagnosis>& all) const {
  const auto [since, reads, standing] = processor_->still();
  if (since == dspic::kNever || end_ - since < kLeastWait) return;
  // With no interrupt enabled a sleep is the end of a program.
  constexpr unsigned kInstruction = 2;  // bytes of PWRSAV, behind which it goes on
  if (standing)
    all.push_back(endless_sleep(places_->text_of(processor_->pc() - kInstruction), standing, since));
  if (device().interrupts().nesting() > 0 || !reads) return;
  if (asked_since_ != since) {
    asked_since_ = since;
    wait_.reset();
    std::uint64_t enabled = 0;
    for (int v = dspic::kFirstIrqVector; v < dspic::kVectors; ++v)
      enabled |= std::uint64_t{device().interrupts().is_enabled(v)} << v;
    const auto by_name = [this](const std::string& name) {
      for (int v = dspic::kFirstIrqVector; v < dspic::kVectors; ++v)
        if (dspic::vector_name(v) == name) return device().interrupts().is_enabled(v);
      return false;
    };
    // a wait inside a function of the library is its caller's; who writes what that one looks at is not known
    const unsigned here = processor_->pc(), own = places_->own(here);
    const host::Place place = data_->place_of(own);
    const auto find = [&] { return is_written_by_none(*this, place, by_name); };
    const std::string line = place.file + ":" + std::to_string(place.line);
    if (enabled ? own == here && image_->is_endless(line, enabled, find) : place.line > 0)
      wait_ = endless_wait(*this, place, since);
  }
  if (wait_) all.push_back(*wait_);
}

std::uint64_t ChipRunner::hash() const { return chip_.digest().sum() + (library_ ? library_->digest() : 0); }

// --- watched

// by pieces for an observer who asks for them. A wait changes nothing but what it counts
void ChipRunner::run_looked_at(Cycle end) {
  while (processor_->now() < end) {
    const Cycle piece = processor_->now() + observer_->look_every;
    if (const auto kind = processor_->run(std::min(end, std::max(piece, processor_->idle_until()))))
      reset(*kind);
    observer_->reached(processor_->now());
  }
}

void ChipRunner::run_watched(Cycle end) {
  while (processor_->now() < end) {
    Step step;
    step.begin = processor_->now();
    for (StepWatch* watch : watches_) watch->before(step.begin);
    step.pc = processor_->pc();
    step.slept = processor_->is_asleep();
    const int nesting = device().interrupts().nesting();
    const std::int64_t begun = processor_->cpu().handlers_begun;
    const Cycle own = processor_->own_cycles(), due = library_ ? library_->due() : dspic::kNever;
    // asleep it goes on to what may wake it, and from there by instructions again
    const Cycle until =
        step.slept ? std::min(end, std::max(processor_->idle_until(), step.begin + 1)) : step.begin + 1;
    if (const auto kind = processor_->run(until)) {
      for (StepWatch* watch : watches_) watch->led_to_reset(step.pc);
      reset(*kind);
      continue;
    }
    step.end = processor_->now();
    for (dspic::Uart& uart : device().parts().uarts) uart.advance(step.end);  // they may look at the lines
    step.took = processor_->own_cycles() - own;
    step.next = processor_->pc();
    const int now_nesting = device().interrupts().nesting();
    if (now_nesting > nesting) {
      step.entered = device().peek(dspic::sfr("INTTREG"), chip_.at(step.end)) & 0x3F;
      step.by_heart = library_ && step.entered == library_->vector(0);
      if (step.entered >= dspic::kFirstIrqVector)
        step.flagged = step.by_heart ? due : device().interrupts().flag_since(step.entered);
    }
    step.left = now_nesting < nesting;
    step.served = !step.slept && processor_->cpu().handlers_begun != begun && step.next == step.pc &&
                  now_nesting == nesting;
    if (observer_ && observer_->look_every < dspic::kNever) observer_->reached(step.end);
    for (StepWatch* watch : watches_) watch->after(step);
  }
}

void ChipRunner::handler_ends(Cycle at) {
  // the first time the place behind the call was not known yet
  if (agenda_returns_to_ != 0 && open_handlers_ == agenda_depth_) {
    observer_->callback(0, at);
    agenda_returns_to_ = 0;
  }
  --open_handlers_;
  observer_->handler_ends(at);
}

void ChipRunner::handler_begins(int vector, Cycle entry, Cycle first) {
  ++open_handlers_;
  if (vector < dspic::kFirstIrqVector)
    return observer_->handler_begins(host::kTrapVector + vector - 1, -1, entry, first);
  // one known by heart that is not held off needs no flag to come
  const bool needs_none =
      library_ && vector == library_->vector(0) && !device().interrupts().has_flag(vector, chip_.at(entry));
  const Cycle since =
      needs_none ? std::min(library_->due(), entry) : device().interrupts().flag_since(vector);
  observer_->handler_begins(vector - dspic::kFirstIrqVector, since, entry, first);
}

void ChipRunner::watch_steps(StepWatch* watch, bool on) {
  watches_.erase(std::remove(watches_.begin(), watches_.end(), watch), watches_.end());
  if (on) watches_.push_back(watch);
}

void ChipRunner::observe(host::Observer* observer) {
  Runner::observe(observer);
  chip_.watch(observer ? this : nullptr);
  processor_->tell_course(observer ? this : nullptr);
}

std::int64_t ChipRunner::interrupts_served() const {
  std::int64_t all = 0;
  for (int vector = dspic::kFirstIrqVector; vector < dspic::kVectors; ++vector)
    all += device().interrupts().served(vector);
  return all;
}

bool ChipRunner::is_ending(const board::Diagnosis& d) const {
  using dspic::Cause;
  for (const Cause reset : {Cause::WatchdogReset, Cause::TrapConflict, Cause::IllegalOpcode})
    if (d.cause == dspic::cause_name(reset)) return true;
  if (d.cause != dspic::cause_name(Cause::CpuTrap)) return false;
  const auto is_of = [&](int trap) { return d.place.rfind(dspic::vector_name(trap), 0) == 0; };
  for (int trap = 1; trap < dspic::kFirstIrqVector; ++trap)
    if (is_of(trap)) return !places_->has_handler(trap);
  return false;
}

}  // namespace chip
