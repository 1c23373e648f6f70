// SPDX-License-Identifier: MIT
#include "hal_sim/host/compiled_runner.h"

#include <algorithm>
#include <cstring>

#include "dspic30/memory/irqs.h"
#include "hal_sim/board/board.h"
#include "hal_sim/host/faults.h"
#include "hal_sim/host/host_params.h"
#include "hal_sim/host/native_processor.h"
#include "hal_sim/host/oscillator.h"
#include "hal_sim/host/pins.h"
#include "sim_core/base/check.h"

namespace host {

CompiledRunner::CompiledRunner(CompiledSettings settings, std::shared_ptr<Image> image, std::size_t copy,
                               board::Board& board)
    : Runner(settings.name),
      Context(board),
      settings_(std::move(settings)),
      image_(std::move(image)),
      copy_(image_->copy(copy)),
      control_(copy_.control()),
      fiber_(settings_.stack_bytes),
      unused_memory_(static_cast<char>(0x81 | (settings_.seed * 0x9E3779B97F4A7C15u >> 57))) {
  if (settings_.processor) {
    processor_ = settings_.processor(*this);
  } else {
    auto native = std::make_unique<NativeProcessor>(*this);
    native_ = native.get();
    drivers_ = &native->drivers();
    processor_ = std::move(native);
  }
  program_eeprom();
  power_up();
}

/// The programmer writes the data EEPROM with the program; from then on only the program changes it.
void CompiledRunner::program_eeprom() {
  const tp_image& image = copy_.description();
  unsigned address = board::DataEeprom::kFirst;
  for (const char* at = image.eedata_begin; at + 1 < image.eedata_end && address <= 0xFFFE;
       at += 2, address += 2) {
    std::uint16_t word;
    std::memcpy(&word, at, sizeof word);
    board_.eeprom().erase(address);
    board_.eeprom().write(address, word);
  }
}

CompiledRunner::~CompiledRunner() {
  if (copy_.owner == this) copy_.owner = nullptr;
}

void CompiledRunner::power_up() {
  now_ = settings_.start;
  processor_->power_up();
  end_ = settings_.start;
  idle_ = 0;
  stopped_ = false;
  traps_.clear();
  rand_state_ = static_cast<std::uint32_t>(settings_.seed * 2654435761u + 1);
  restart_program();
}

void CompiledRunner::restart_program() {
  ++starts_;
  if (observer_) observer_->ended(now_);
  data_ = copy_.start_values();
  // RAM that the start-up code does not clear holds anything, and the same each time
  std::fill_n(data_.data() + copy_.heap_offset(), copy_.heap_bytes(), unused_memory_);
  if (copy_.owner == this) copy_.owner = nullptr;
  std::fill(background_.begin(), background_.end(), Background{});
  background_share_q32_ = 0;
  handler_depth_ = 0;
  interrupt_horizon_ = 0;
  may_wait_ = false;
  horizon_ = kNever;
  poll_loop_ = -1;
  asleep_until_ = -1;
  idling_ = false;
  overflowed_ = false;
  resting_ = false;
  reset_asked_ = false;
  processor_->reset(now_);
  find_share();
  now_ += kStartUpCycles;
  fiber_.restart(enter_firmware, this);
}

NativeProcessor& CompiledRunner::native() {
  CHECK(native_, "a function of the native way was called in the register way");
  return *native_;
}

void CompiledRunner::remote_changed() {
  processor_->remote_changed(now_);
  interrupt_horizon_ = 0;
  wake();
}

namespace {
/// Calls it with registers that hold no address of the PC: what a function saves and a stray index finds is
/// the same in every run.
void call_with_clear_registers(void (*function)()) {
#if defined(__x86_64__)
  asm volatile(
      "xorl %%ebx, %%ebx\n xorl %%r12d, %%r12d\n xorl %%r13d, %%r13d\n xorl %%r14d, %%r14d\n"
      "xorl %%r15d, %%r15d\n callq *%%rax"
      : "+a"(function)
      :
      : "rbx", "rcx", "rdx", "rsi", "rdi", "r8", "r9", "r10", "r11", "r12", "r13", "r14", "r15", "memory",
        "cc");
#else
  function();
#endif
}
}  // namespace

void CompiledRunner::enter_firmware(void* raw) {
  auto* self = static_cast<CompiledRunner*>(raw);
  self->pass_window();
  self->give_budget();
  if (const void* fosc = self->copy_.description().fosc) {
    self->last_words_ = clock_problem(*static_cast<const std::uint16_t*>(fosc));
    if (!self->last_words_.empty()) self->trap(TP_TRAP_UNSIMULATED, self->last_words_);
  }
  call_with_clear_registers(self->copy_.description().start);
  // not `self`: the program may have written all over this stack
  running()->on_reset("main() returned, so the start-up code resets the processor");
}

void CompiledRunner::swap_in() {
  if (copy_.owner == this) return;
  if (copy_.owner) {
    auto* other = static_cast<CompiledRunner*>(const_cast<void*>(copy_.owner));
    copy_.copy_out(other->data_.data());
  }
  copy_.copy_in(data_.data());
  copy_.owner = this;
}

void CompiledRunner::begin_window(Cycle now) {
  pass_to(now);
  // bytes are on their way: whoever waits for them looks again
  if (board_.is_receiving(now)) wake();
  if (stopped_ || !processor_->begin_window(now)) return;
  interrupt_horizon_ = 0;
  wake();
}

void CompiledRunner::run_until(Cycle end) {
  fiber_.fetch();
  window_start_ = end_;
  end_ = end;
  if (stopped_ || end <= window_start_) return;
  if (asleep_until_ > end && !woken_) return processor_->end_window(end);
  catch_faults_on_this_thread();
  Context* outer = detail::running_here;
  detail::running_here = this;
  ++turns_;
  do {
    if (reset_asked_) restart_program();
    swap_in();
    // what other robots of the copy wrote is no change that this one's loops could see
    control_.writes = writes_;
    control_.fill = unused_memory_;
    fiber_.enter();
    writes_ = control_.writes;
  } while (reset_asked_);
  woken_ = false;
  detail::running_here = outer;
  if (!stopped_) processor_->end_window(end);
}

// --- time

Cycle CompiledRunner::main_beside_handlers(Cycle at) const {
  // by the reciprocal, rounded down: never too many, at most one too few
  const auto left = static_cast<std::uint64_t>(at - now_);
  auto main = static_cast<Cycle>(static_cast<unsigned __int128>(left) * kept_q32_ >> kQ);
  while (after(main + 1) <= at) ++main;
  return main;
}

void CompiledRunner::find_share() {
  const bool masked = native_ && native_->masks_handlers();
  const std::uint64_t handlers = native_ && !masked ? native_->drivers().handler_share_q32() : 0;
  const auto share =
      std::min<std::uint64_t>(handlers + background_share_q32_, kOne / 100 * kMostBackgroundPercent);
  kept_q32_ = kOne - share;
  // it goes to and fro between none and the same: masked and not
  if (share != 0 && share != share_q32_) {
    share_q32_ = share;
    stolen_of_share_q32_ = (share << kQ) / kept_q32_;
  }
  stolen_q32_ = share == 0 ? 0 : stolen_of_share_q32_;
}

void CompiledRunner::follow_handlers() {
  follow_mask();
  give_budget();
}

void CompiledRunner::follow_mask() {
  fold();
  find_share();
}

Cycle CompiledRunner::now_and_tell() {
  const Cycle at = now_unobserved();
  observer_->reached(at);
  return at;
}

void CompiledRunner::modify_in_two(unsigned address, std::uint16_t keep, std::uint16_t flip) {
  const auto old = static_cast<std::uint16_t>(read_register(address, 16));
  write_register(address, static_cast<std::uint16_t>((old & keep) ^ flip), 16);
}

int CompiledRunner::look() {
  ++looks_;
  const Processor::Outlook outlook = processor_->look(now_);
  note_outlook(outlook);
  return outlook.vector;
}

void CompiledRunner::note_outlook(const Processor::Outlook& outlook) {
  interrupt_horizon_ = outlook.vector == kNoVector ? outlook.horizon : now_;
  may_wait_ = outlook.may_wait;
  if (may_wait_ && handler_depth_ == 0) {
    // a main program that masks a waiting interrupt for ever is found out after a while
    const Processor::Waiting waiting = processor_->longest_waiting(now_);
    if (waiting.vector >= 0)
      interrupt_horizon_ = std::min(interrupt_horizon_, waiting.since + kBlockedInterruptCycles);
  }
}

Cycle CompiledRunner::find_interrupt_horizon() {
  if (now_ < interrupt_horizon_) return interrupt_horizon_;
  return look() == kNoVector ? std::max(interrupt_horizon_, now_ + 1) : now_;
}

void CompiledRunner::give_budget_anew() {
  Cycle until = std::min(end_, find_interrupt_horizon());
  if (observer_) until = std::min(until, now_ + observer_->look_every);
  // an overflow that a host function met is told at the program's next block
  issued_ = overflowed_ ? -1 : main_until(until);
  control_.budget = issued_;
}

void CompiledRunner::look_again() {
  if (native_) native_->interrupts().touch();
  interrupt_horizon_ = 0;
  fold();
}

void CompiledRunner::changed() {
  look_again();
  give_budget();
}

void CompiledRunner::lower_interrupt_horizon(Cycle at) {
  fold();
  interrupt_horizon_ = at;
  give_budget();
}

void CompiledRunner::set_background(int slot, Cycle period, Cycle cost) {
  fold();
  background_[static_cast<std::size_t>(slot)] = {period, cost};
  background_share_q32_ = 0;
  for (const auto& b : background_)
    if (b.period > 0)
      background_share_q32_ +=
          (static_cast<std::uint64_t>(b.cost) << kQ) / static_cast<std::uint64_t>(b.period);
  find_share();
  note_write();
  give_budget();
}

// --- interrupts

void CompiledRunner::irq_install(int vector, void (*handler)(), int priority, Cycle entry_cycles) {
  auto& s = native().interrupts().source(vector);
  s.handler = handler;
  s.enabled = handler != nullptr;
  s.priority = priority;
  s.entry_cycles = entry_cycles;
  s.self_clearing = true;
  s.flag = false;  // drivers clear the flag before they enable
  if (vector == TP_V_INT0)
    native_->interrupts().refresh_int0(now());  // the library's edge is the falling one
  note_write();
  changed();
}

void CompiledRunner::irq_at(int vector, Cycle at) { irq_every(vector, at, 0); }

void CompiledRunner::irq_every(int vector, Cycle at, Cycle period) {
  auto& s = native().interrupts().source(vector);
  s.period = period;
  s.due = at < 0 ? kNever : at;
  if (at < 0) s.flag = false;
  look_again();  // mostly a handler ends here, and who goes on gets a budget then
}

void CompiledRunner::deliver_now() {
  do {
    if (observer_) {
      const int vector = look();
      if (vector == kNoVector) return;
      if (vector == kResetDue) on_reset(processor_->why_reset());
      serve_told(vector);
      continue;
    }
    ++looks_;
    if (processor_->serve(now_)) continue;
    Processor::Entry entry;
    const Processor::Outlook outlook = processor_->take(now_, entry);
    if (outlook.vector >= 0) {
      handle(outlook.vector, entry);
      continue;
    }
    note_outlook(outlook);
    if (outlook.vector == kNoVector) return;
    on_reset(processor_->why_reset());
  } while (now_ >= interrupt_horizon_);
}

void CompiledRunner::serve_told(int vector) {
  const Cycle flagged = processor_->flag_since(vector);
  observer_->reached(now_);
  const Processor::Entry entry = processor_->enter(vector, now_);
  observer_->handler_begins(vector, flagged, now_, entry.first_instruction);
  handle(vector, entry);
}

void CompiledRunner::handle(int vector, const Processor::Entry& entry) {
  const tp_image& image = copy_.description();
  void (*handler)() = entry.handler;
  if (!handler && vector >= kTrapVector)
    handler = (entry.alternate ? image.alternate_trap_vectors : image.trap_vectors)[vector - kTrapVector];
  else if (!handler)
    handler = handler_of(vector, entry.alternate);
  if (!handler) handler = image.default_vector;
  if (!handler) miss_handler(vector, entry.alternate);
  run_handler(handler, entry);
  if (observer_) observer_->handler_ends(now_);
  handler_returned(processor_->leave(now_));
}

void CompiledRunner::miss_handler(int vector, bool alternate) {
  static constexpr const char* kTraps[] = {"OscillatorFail", "AddressError", "StackError", "MathError"};
  const std::string name = vector >= kTrapVector ? kTraps[vector - kTrapVector]
                                                 : std::string(dspic::irq_name(vector)) + "Interrupt";
  last_words_ = "interrupt " + name.substr(0, name.rfind("Interrupt")) +
                " is enabled and was raised, but the program has no handler _" + (alternate ? "Alt" : "") +
                name + "; on the chip the processor resets";
  trap(TP_TRAP_INTERRUPT, last_words_);
}

// not within a handler: a long one delays others on the chip too
void CompiledRunner::stop_if_blocked() {
  const Processor::Waiting waiting = processor_->longest_waiting(now_);
  if (waiting.vector < 0 || now_ - waiting.since < kBlockedInterruptCycles) return;
  last_words_ = std::string("interrupts have been off for more than a second while ") +
                dspic::irq_name(waiting.vector) + " is waiting: an endless loop with interrupts off";
  trap(TP_TRAP_INTERRUPT, last_words_);
}

// --- what compiled code calls

bool CompiledRunner::lend_reserve() {
  if (!fiber_.open_reserve()) return false;
  overflowed_ = true;
  // the next block asks for an event; the time that has passed stays what it is
  issued_ -= control_.budget + 1;
  control_.budget = -1;
  return true;
}

void CompiledRunner::on_event() {
  if (overflowed_) trap(TP_TRAP_STACK, kStackOverflow);
  if (!native_) {
    // a block may be a division of 500 cycles: an interrupt comes within it, and the rest of it afterwards
    const Cycle undisturbed = issued_, rest = -copy_.control().budget;
    issued_ = copy_.control().budget = 0;
    advance_main(undisturbed);
    run_main(rest);
    if (observer_) observer_->reached(now_);
    give_budget();
    if (overflowed_) trap(TP_TRAP_STACK, kStackOverflow);
    return;
  }
  fold();
  if (observer_) observer_->reached(now_);
  for (;;) {
    deliver();
    check_blocked();
    if (now_ < end_) break;
    pass_window();
  }
  give_budget();
  if (overflowed_) trap(TP_TRAP_STACK, kStackOverflow);
}

void CompiledRunner::pass_window() {
  while (now_ >= end_) {
    asleep_until_ = now_ + 1;
    fiber_.yield();
  }
  asleep_until_ = -1;
}

void CompiledRunner::doze(Cycle until) {
  asleep_until_ = std::max(until, end_ + 1);
  fiber_.yield();
  asleep_until_ = -1;
}

void CompiledRunner::run_main(Cycle main) {
  while (true) {
    deliver();
    check_blocked();
    const Cycle disturbed = find_interrupt_horizon();
    const Cycle finish = after(main), next = std::min(disturbed, finish);
    if (finish <= std::min(disturbed, end_)) {
      advance_main(main);
      return;
    }
    if (next > end_) {
      doze(next);
      continue;
    }
    const Cycle part = std::min(main, main_until(disturbed));
    advance_main(part);
    main -= part;
    now_ = std::max(now_, disturbed);
  }
}

// more than may pass undisturbed
void CompiledRunner::overspend(Cycle cycles) {
  control_.budget += cycles;
  fold();
  run_main(cycles);
  give_budget();
}

void CompiledRunner::on_delay(Cycle rounds, Cycle cycles_per_round) {
  fold();
  if (rounds > 0) run_main(rounds * cycles_per_round);
  give_budget();
}

void CompiledRunner::wait_until(Cycle at) {
  fold();
  while (now_ < at) {
    deliver();
    check_blocked();
    const Cycle stop = std::min(at, find_interrupt_horizon());
    if (stop > end_) {
      doze(stop);
      continue;
    }
    now_ = std::max(now_, stop);
  }
  give_budget();
}

void CompiledRunner::on_poll(std::int64_t loop) {
  fold();
  const bool same = loop == poll_loop_ && served_ == poll_served_;
  const Cycle round = main_ - poll_main_;
  if (same && round > 0 && horizon_ > now_) sleep_until(horizon_, round, now_);
  note_poll(loop);
  processor_->watch_reads(now_);
  give_budget();
}

// on_poll() and the rounds between two of them at once, as long as nothing but handlers happens: after a
// handler one round is done, finds nothing, and the loop sleeps on
void CompiledRunner::on_rest(std::int64_t loop) {
  fold();
  if (loop == poll_loop_ && served_ == poll_served_ && !observer_ && handler_depth_ == 0) {
    const Cycle round = main_ - poll_main_;
    while (round > 0 && !may_wait_ && now_ < interrupt_horizon_ && interrupt_horizon_ <= end_) {
      const Cycle start = now_;
      idle_ += interrupt_horizon_ - now_;
      now_ = interrupt_horizon_;
      ++looks_;
      processor_->serve(now_) ? deliver() : deliver_now();
      const bool served = served_ != poll_served_;
      if (!served) sleep_until(kNever, round, start);
      note_poll(loop);
      if (!served || after(round) > std::min(end_, interrupt_horizon_)) return give_budget();
      advance_main(round);
    }
  }
  resting_ = true;
  on_poll(loop);
  resting_ = false;
}

void CompiledRunner::sleep_until(Cycle target, Cycle round, Cycle start) {
  // the program notices a change at the end of the round in which it happens
  std::uint64_t fraction = 0;
  round = stretched(round, fraction);
  const auto end_of_round = [&](Cycle at) { return start + (at - start + round - 1) / round * round; };
  if (target < kNever) target = end_of_round(target);
  while (now_ < target) {
    deliver();
    if (now_ != start && served_ != poll_served_)  // a handler ran: look again
      break;
    check_blocked();
    const Cycle stop = std::min(target, find_interrupt_horizon());
    if (stop >= kNever && handler_depth_ > 0 && !looked_outside_)
      trap(TP_TRAP_INTERRUPT, "an interrupt handler waits for ever: nothing that it looks at can change");
    if (stop >= kNever && !looked_outside_ && !resting_) look_for_endless_wait();
    if (stop > end_) {
      idling_ = true;
      doze(stop);
      idling_ = false;
      if (woken_) {
        woken_ = false;
        const Cycle at = end_of_round(std::max(window_start_, now_));
        idle_to(at);
        break;
      }
      continue;
    }
    if (stop > now_) {
      idle_to(stop);
    }
  }
  deliver();
}

void CompiledRunner::idle_to(Cycle at) {
  if (observer_) observer_->waited(now_, at, handler_depth_);
  idle_ += at - now_;
  now_ = at;
}

void CompiledRunner::on_disi(Cycle cycles) {
  fold();
  processor_->disi(cycles, now_);
  interrupt_horizon_ = 0;
  note_write();
  deliver();
  check_blocked();
  give_budget();
}

void CompiledRunner::on_power_save(bool sleep) {
  fold();
  processor_->power_save(sleep, now_);
  interrupt_horizon_ = 0;
  for (;;) {
    if (processor_->wakes(now_)) {
      idle_to(now_ + kWakeCycles);  // a program of nothing but Idle() lives on this time
      deliver();
      break;
    }
    deliver();
    const Cycle stop = find_interrupt_horizon();
    if (stop > end_) {
      idling_ = true;
      doze(stop);
      idling_ = false;
      continue;
    }
    if (stop > now_) {
      idle_to(stop);
    }
  }
  give_budget();
}

std::int64_t CompiledRunner::next_rand() {
  // 32-bit congruential generator with the usual constants; the upper half is what rand() shows
  rand_state_ = rand_state_ * 1103515245u + 12345u;
  note_write();
  return (rand_state_ >> 16) & 0x7FFF;
}

// --- for observers

void CompiledRunner::callback(const void* function) {
  if (observer_)
    observer_->callback(function ? reinterpret_cast<std::uintptr_t>(function) - copy_.base() : 0, now());
}

}  // namespace host
