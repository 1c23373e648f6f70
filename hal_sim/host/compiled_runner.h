// SPDX-License-Identifier: MIT
// The Runner of code compiled for the PC: a fiber, the program's private data, a cycle clock fed by block
// costs, and the delivery of interrupts. Registers and interrupt controller are a Processor (processor.h):
// those of the native way, or the models of the chip.
//
//   run_until(end) --enter--> firmware ... tp_event() ... tp_poll() ... --yield--> run_until returns
//
// Time: compiled code subtracts estimated cycles from a budget. What handlers take that are not run, because
// they are closed forms, is a share by which the program's cycles are stretched (docs/design.md, "Time");
// none while the program masks them. A robot that sleeps in a wait costs nothing until something can happen.
#pragma once
#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hal_sim/host/context.h"
#include "hal_sim/host/fiber.h"
#include "hal_sim/host/image.h"
#include "hal_sim/host/processor.h"
#include "hal_sim/host/runner.h"

namespace host {

class NativeProcessor;

/// Every way a robot's processor can be set up.
struct CompiledSettings {
  std::string name;
  std::uint64_t seed = 0;                ///< of rand()
  std::size_t stack_bytes = 256 * 1024;  ///< PC frames are two to four times the chip's; see docs/limits.md
  ProcessorFactory processor{};          ///< empty: the native way
  Cycle start = 0;                       ///< when it is powered up
};

class CompiledRunner final : public Runner, public Context {
 public:
  /// `copy` of the image is this robot's for life. `board` outlives the robot.
  CompiledRunner(CompiledSettings settings, std::shared_ptr<Image> image, std::size_t copy,
                 board::Board& board);
  ~CompiledRunner() override;

  // --- Runner
  const char* way() const override { return processor_->way(); }
  void begin_window(Cycle now) override;
  void run_until(Cycle end) override;
  Cycle idle_until() const override { return stopped_ ? kNever : woken_ || reset_asked_ ? 0 : asleep_until_; }
  void pass_to(Cycle end) override { end_ = std::max(end_, end); }
  std::uint64_t turns() const override { return turns_; }
  void wake() override { woken_ = true; }
  void remote_changed() override;
  void restart() override;

  Cycle cycles() const override { return end_; }
  Cycle lived_cycles() const override { return stopped_ ? now_ : end_; }
  Cycle idle_cycles() const override {
    return idle_ + (idling_ && !stopped_ && end_ > now_ ? end_ - now_ : 0);
  }
  Cycle waiting_since() const override { return idling_ && !stopped_ ? now_ : kNever; }
  bool has_stopped() const override { return stopped_; }
  const std::vector<TrapReport>& traps() const override { return traps_; }
  std::vector<board::Diagnosis> diagnoses() const override;
  std::uint64_t hash() const override;

  const Variable* find_variable(const std::string& expression, std::string& error) const override {
    return image_->symbols().find_variable(expression, error);
  }
  std::vector<char> read_variable(const std::string& name, std::size_t bytes) const override;
  void read_memory(std::uintptr_t address, void* to, std::size_t bytes) const override;
  void write_memory(std::uintptr_t address, const void* from, std::size_t bytes) override;
  Place place_of(std::uintptr_t code) const override { return image_->symbols().find(code); }
  Place place_now() const override;

  void observe(Observer* observer) override {
    Runner::observe(observer);
    processor_->observe(observer);
  }
  bool flag(int vector, Cycle at) override { return processor_->flag(vector, at); }
  Cycle flag_horizon(int vector, Cycle at) override { return processor_->flag_horizon(vector, at); }
  bool has_chip() const override { return native_ == nullptr; }
  void carry_out(Cycle at) override { processor_->carry_out(at); }
  std::uint16_t peek(unsigned address, Cycle at) override { return processor_->peek(address, at); }
  Cycle register_horizon(unsigned address, Cycle at) override { return processor_->horizon(address, at); }
  std::int64_t served(int vector) const override { return processor_->served(vector); }
  const drivers::Drivers* closed_drivers() const override { return drivers_; }

  /// Handlers that have returned, and how often the processor was asked what to do next, since the robot was
  /// made: what an interrupt costs, in a number that no other work on the machine changes.
  std::int64_t interrupts_served() const override { return served_; }
  std::int64_t looks() const { return looks_; }
  /// Cycles at the last moment at which the program's own count was added up: the instant of a reset.
  Cycle settled_now() const { return now_; }
  /// The loaded image's description of itself.
  const tp_image& image() const { return copy_.description(); }

  // --- for a debugger, which stands in the program's code or between two windows
  const ImageCopy& copy() const { return copy_; }
  /// Of the program's block that is under way.
  Cycle now_in_code() const { return after(issued_ - control_.budget); }
  /// Handlers that are under way, one in the other; closed forms are none.
  int handler_depth() const { return handler_depth_; }
  /// May this interrupt the program, now or when something comes from outside? Its priority.
  bool is_enabled(int vector);
  int priority(int vector);
  bool is_held_by_disi();
  /// Where a value of this robot is now: the data of a copy's robots take turns at the program's addresses.
  const void* value_at(std::uintptr_t address) const { return data_at(address - copy_.base()); }
  /// May a debugger write there: in its variables or on its stack?
  bool owns_data(std::uintptr_t address, std::size_t bytes) const;
  /// As a debugger would, wherever the program stands; a wait looks again.
  void write_value(std::uintptr_t address, const void* from, std::size_t bytes);
  /// A register of the chip likewise: between two windows, or before a line of the program.
  void poke_register(unsigned address, std::uint16_t value, bool is_in_code);
  /// How often the program has begun.
  std::int64_t starts() const { return starts_; }
  /// Does an observer hear of every access, so that now() is to be asked for it?

  // --- Context
  Cycle now() override { return observer_ ? now_and_tell() : now_unobserved(); }
  void note_write() override { ++control_.writes; }
  void spend(Cycle cycles) override {
    control_.budget -= cycles;
    if (control_.budget < 0) overspend(cycles);
  }
  void wait_until(Cycle at) override;
  void follow_handlers() override;
  void irq_install(int vector, void (*handler)(), int priority, Cycle entry_cycles) override;
  void irq_at(int vector, Cycle at) override;
  void irq_every(int vector, Cycle first, Cycle period);  ///< period 0: once; native way only
  void set_background(int slot, Cycle period, Cycle cost) override;
  void callback(const void* function) override;
  bool print(const char* bytes, std::int64_t length, int uart) override {
    return processor_->print(bytes, length, uart);
  }
  [[noreturn]] void trap(int kind, std::string_view message) override;

  // --- what the compiler inserts
  void on_event();
  void on_poll(std::int64_t loop);
  void on_rest(std::int64_t loop);
  void on_delay(Cycle rounds, Cycle cycles_per_round);
  [[noreturn]] void on_reset(const char* unexpected_reason);
  void on_disi(Cycle cycles);
  void on_power_save(bool sleep);
  std::int64_t next_rand();
  void seed_rand(std::int64_t seed) { rand_state_ = static_cast<std::uint32_t>(seed); }

  /// Where to build the sentence of a trap: the firmware's stack is abandoned, and what lies on it never
  /// freed.
  std::string& last_words() { return last_words_; }

  // --- for the registers
  Processor& processor() { return *processor_; }
  const Processor& processor() const { return *processor_; }
  /// Interrupt state changed: look for something to deliver as soon as the current block ends.
  void changed();
  /// The handlers' share at this moment; whoever calls it gives a new budget or leaves none.
  void follow_mask();
  /// At `now` the program did something after which an interrupt may be served from `at` on, and not before
  /// unless that was known already; 0: not known.
  void note_interrupt_horizon(Cycle at, Cycle now) {
    if (now >= interrupt_horizon_) at = 0;
    if (at < interrupt_horizon_ || at == 0) lower_interrupt_horizon(at);
  }
  /// The program's function for an interrupt; null: it has none.
  void (*handler_of(int vector, bool alternate) const)() {
    const tp_image& image = copy_.description();
    void (*handler)() = (alternate ? image.alternate_vectors : image.vectors)[vector];
    return handler ? handler : image.default_vector;
  }
  /// Runs it, as `entry` says. Returns when it has ended, before RETFIE.
  Cycle run_handler(void (*handler)(), const Processor::Entry& entry) {
    now_ = entry.first_instruction;
    ++handler_depth_;
    interrupt_horizon_ = entry.horizon;
    give_budget();
    control_.budget -= entry.saving;
    handler();
    --handler_depth_;
    fold();
    return now_;
  }
  /// RETFIE is done.
  void handler_returned(const Processor::Return& back) {
    now_ = back.next_instruction;
    interrupt_horizon_ = back.horizon;
    may_wait_ = false;  // or the next look() says so
    ++served_;
    note_write();
  }
  std::int64_t read_register(unsigned address, unsigned bits) { return processor_->read(address, bits); }
  void modify_register(unsigned address, std::uint16_t keep, std::uint16_t flip) {
    if (observer_) return modify_in_two(address, keep, flip);
    processor_->modify(address, keep, flip);
  }
  void write_register(unsigned address, std::uint16_t value, unsigned bits) {
    processor_->write(address, value, bits, now());
  }
  void clear_watchdog() {
    processor_->clear_watchdog(now());
    interrupt_horizon_ = 0;
    note_write();
  }

  // --- for the fault handler
  bool owns_code(std::uintptr_t pc) const { return copy_.is_code(pc); }
  /// Addresses that are this program's alone, used or not; below its variables: its code and constants.
  bool owns_address(std::uintptr_t address) const { return copy_.holds(address); }
  bool owns_constant(std::uintptr_t address) const {
    return copy_.holds(address) && address >= copy_.base() &&
           address < reinterpret_cast<std::uintptr_t>(&control_);
  }
  const Fiber& fiber() const { return fiber_; }
  /// Opens the stack's reserve to a host function; the overflow is reported when it has returned. Called by
  /// the signal handler. False: there is no reserve.
  bool lend_reserve();
  /// The program's own place for an instruction, or for the one that called what it belongs to.
  Place place_of_code(std::uintptr_t pc, std::uintptr_t frame) const;
  /// Runs on the recovery stack after a hardware fault; never returns.
  /// Where the frames say nothing, because they were overwritten, the words around `stack` are searched.
  [[noreturn]] void fault(int kind, std::string message, std::uintptr_t pc, std::uintptr_t frame,
                          std::uintptr_t stack);

  /// On this thread; null outside firmware.
  static CompiledRunner* running() { return static_cast<CompiledRunner*>(detail::running_here); }

 private:
  static constexpr unsigned kQ = 32;  // of stolen_q32_
  static constexpr std::uint64_t kOne = std::uint64_t{1} << kQ;

  static void enter_firmware(void* self);
  void power_up();
  void restart_program();
  void program_eeprom();
  char* data_at(std::uintptr_t address) const;  // where this robot's value of a variable is now
  void swap_in();
  void fold() {  // spent budget -> now_
    if (issued_ != control_.budget) advance_main(issued_ - control_.budget);
    issued_ = 0;
    control_.budget = 0;
  }
  // program cycles -> cycles of the clock
  void advance_main(Cycle main) {
    main_ += main;
    now_ += stretched(main, fraction_);
  }
  // with the share that handlers take
  Cycle stretched(Cycle main, std::uint64_t& fraction) const {
    if (stolen_q32_ == 0) return main;
    const unsigned __int128 stolen =
        static_cast<unsigned __int128>(static_cast<std::uint64_t>(main)) * stolen_q32_ + fraction;
    fraction = static_cast<std::uint64_t>(stolen) & (kOne - 1);
    return main + static_cast<Cycle>(stolen >> kQ);
  }
  Cycle after(Cycle main) const {
    std::uint64_t fraction = fraction_;
    return now_ + stretched(main, fraction);
  }
  void find_share();
  Cycle now_unobserved() const { return now_in_code(); }
  Cycle now_and_tell();
  void modify_in_two(unsigned address, std::uint16_t keep, std::uint16_t flip);
  void overspend(Cycle cycles);
  Cycle main_until(Cycle at) const {  // most program cycles that end at or before `at`
    if (at <= now_) return 0;
    return stolen_q32_ == 0 ? at - now_ : main_beside_handlers(at);
  }
  Cycle main_beside_handlers(Cycle at) const;
  void give_budget() {
    if (now_ >= interrupt_horizon_ || observer_ || overflowed_) return give_budget_anew();
    issued_ = main_until(std::min(end_, interrupt_horizon_));
    control_.budget = issued_;
  }
  void give_budget_anew();
  void look_again();  // at the interrupts, before the next block ends: no budget is left
  NativeProcessor& native();
  int look();  // the vector to serve now; kNoVector: interrupt_horizon_ is known afterwards
  void note_outlook(const Processor::Outlook& outlook);
  Cycle find_interrupt_horizon();  // when an interrupt or the end of DISI may change the program's course
  void lower_interrupt_horizon(Cycle at);
  // due interrupts, in order
  void deliver() {
    if (now_ >= interrupt_horizon_) deliver_now();
  }
  void deliver_now();
  void serve_told(int vector);  // for an observer
  void handle(int vector, const Processor::Entry& entry);
  [[noreturn]] void miss_handler(int vector, bool alternate);
  void idle_to(Cycle at);     // jumps over a wait
  void pass_window();         // now_ >= end_: let the others run
  void run_main(Cycle main);  // spends main cycles, delivering on the way
  void look_for_endless_wait();
  void note_endless_wait();
  // a wait since `start` that polls every `round` of its cycles; ends early when disturbed
  void sleep_until(Cycle target, Cycle round, Cycle start);
  void note_poll(std::int64_t loop) {
    poll_loop_ = loop;
    poll_main_ = main_;
    poll_served_ = served_;
    horizon_ = kNever;
    looked_outside_ = false;
  }
  void doze(Cycle until);  // yields; the scheduler comes back at `until` or when something woke the robot
  // endless loop with interrupts off; after deliver()
  void check_blocked() {
    if (may_wait_ && handler_depth_ == 0) stop_if_blocked();
  }
  void stop_if_blocked();
  [[noreturn]] void stop_with(TrapReport report);
  std::vector<Place> walk(std::uintptr_t pc, std::uintptr_t frame) const;
  std::uintptr_t find_return_address(std::uintptr_t stack) const;
  TrapReport report_here(int kind, std::string_view message);
  TrapReport report_at(int kind, std::string message, std::uintptr_t pc, std::uintptr_t frame) const;

  CompiledSettings settings_;
  std::shared_ptr<Image> image_;
  ImageCopy& copy_;
  tp_control& control_;  // of copy_
  Fiber fiber_;
  std::unique_ptr<Processor> processor_;
  NativeProcessor* native_ = nullptr;  // processor_, or null in the register way
  std::vector<char> data_;             // private data while another robot of the copy is live

  const char unused_memory_;  // what memory holds before somebody writes it: from the seed, never 0

  Cycle now_ = 0;                 // real cycles, up to the last fold
  Cycle issued_ = 0;              // budget given at that moment
  std::uint64_t fraction_ = 0;    // of a cycle, Q32, left over from stretching
  std::uint64_t stolen_q32_ = 0;  // cycles background handlers take per main cycle, Q32
  std::uint64_t share_q32_ = 0, stolen_of_share_q32_ = 0;  // the last share that was not 0
  std::uint64_t kept_q32_ = 0;  // program's cycles per cycle of the clock, Q32, rounded down
  Cycle main_ = 0;              // cycles of the program itself so far, up to the last fold
  struct Background {
    Cycle period = 0, cost = 0;
  };
  std::uint64_t background_share_q32_ = 0;  // of all of them
  std::vector<Background> background_ = std::vector<Background>(16);

  Cycle end_ = 0;  // of the window
  Cycle window_start_ = 0;
  bool resting_ = false;  // in a loop that is empty on purpose
  bool stopped_ = false;
  bool reset_asked_ = false;
  bool woken_ = false;
  bool overflowed_ = false;  // the stack's reserve is in use
  bool idling_ = false;      // asleep because it waits, not because a delay loop counts
  Cycle asleep_until_ = -1;  // the firmware sleeps up to this cycle; -1 awake
  Cycle idle_ = 0;

  // nothing can be served or found blocked before; <= now_: unknown. The program is interrupted at the end of
  // the first block beyond it, so it is exact, not merely early enough
  Cycle interrupt_horizon_ = 0;
  bool may_wait_ = false;  // a flag may be held off; as interrupt_horizon_
  int handler_depth_ = 0;
  std::int64_t served_ = 0;  // interrupts so far
  std::int64_t looks_ = 0;   // look() so far
  std::uint64_t turns_ = 0;
  std::int64_t starts_ = 0;

  std::int64_t writes_ = 0;  // image_abi.h's counter while another robot of the copy runs
  std::int64_t poll_loop_ = -1;
  Cycle poll_main_ = 0;
  std::int64_t poll_served_ = 0;

  std::uint32_t rand_state_ = 1;
  std::int64_t asked_wait_ = -1;   // loop that was looked at last for an endless wait
  board::Diagnosis endless_wait_;  // the first one of this power-up; without a cause: none
  std::vector<TrapReport> traps_;
  std::string last_words_;
};

inline constexpr const char* kStackOverflow = "stack overflow: endless recursion, or local arrays too large";

}  // namespace host
