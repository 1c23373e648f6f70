// SPDX-License-Identifier: MIT
// How run() is called changes nothing: neither the course, nor what is counted as waited, nor what whoever
// plays the library sees and when.
#include <utility>

#include "dspic30/core/cpu.h"
#include "tests/dspic30/core_bench.h"

namespace {

using bench::CoreBench;
using bench::Cycle;
using bench::Draw;
using bench::kNever;
using dspic::Cpu;
using dspic::HandlerStep;
using dspic::HostResult;

/// Plays a library: function 0 works, 1 and 2 wait, 3 tells the time and how long that stays, 4 changes the
/// handlers' share, of which they have taken too much or too little, 5 stops and starts the handler that calls the program; 0x800 counts time.
class Library final : public dspic::HostCalls {
 public:
  explicit Library(unsigned callback, int share_percent) : callback_(callback), percent_(share_percent) {}

  HostResult call(Cpu& cpu, unsigned index, Cycle at, bool again) override {
    if (!again) note(static_cast<int>(index), at);
    switch (index) {
      case 0:
        cpu.note_effect();
        return HostResult::done(17);
      case 1:
        return waits(at, again, 5003);
      case 2:
        return waits(at, again, 40);
      case 3:
        cpu.note_look((at / 3001 + 1) * 3001);
        cpu.w[0] = static_cast<std::uint16_t>(at / 3001);
        return HostResult::done(9);
      case 4:
        cpu.note_effect();
        percent_ = percent_ == 30 ? 7 : 30;
        owed_q32_ += (percent_ == 30 ? -420 : 250) * (std::int64_t{1} << 32);
        cpu.host_changed();
        return HostResult::done(21);
      default:
        cpu.note_effect();
        due_ = due_ == kNever ? at + 500 : kNever;
        cpu.host_changed();
        return HostResult::done(5);
    }
  }
  std::uint16_t read(unsigned address, Cycle at) override { return peek(address, at); }
  void write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle at) override {
    note(static_cast<int>(address + (value & lanes)), at);
  }
  Cycle horizon(unsigned, Cycle at) override { return (at / 4099 + 1) * 4099; }
  std::uint16_t peek(unsigned, Cycle at) const override { return static_cast<std::uint16_t>(at / 4099); }
  Cycle due() const override { return due_; }
  std::int64_t take_owed_q32() const override { return std::exchange(owed_q32_, 0); }
  std::uint64_t share_q32() const override {
    return held_ ? 0 : static_cast<std::uint64_t>(percent_) * (std::uint64_t{1} << 32) / 100;
  }
  void begin_handler(Cycle at) override {
    note(-1, at);
    steps_ = 0;
    due_ += 7001;
  }
  HandlerStep next_in_handler(Cycle at) override {
    note(-2, at);
    return ++steps_ == 1 ? HandlerStep{callback_, 31, false} : HandlerStep{0, 12, false};
  }
  void end_handler(Cycle at) override { note(-3, at); }
  int vector(int handler) const override {
    return dspic::kFirstIrqVector + (handler == 0 ? 6 : 11);
  }  // T2, ADC
  void hold_handler(int handler, bool held, bool pending, Cycle at) override {
    note(-10 - 4 * handler - 2 * pending - (held ? 1 : 0), at);
    if (handler == 1) held_ = held;
  }
  Cycle source_event(int handler, Cycle after) const override {
    const Cycle period = handler == 0 ? 1475 : 965;
    return (after / period + 1) * period;
  }
  Cycle pending_cycles() const override { return 127; }
  std::uint16_t saved_registers() const override { return 0xFF; }
  int saved_words() const override { return 1; }
  void reset(Cycle) override {}

  std::vector<std::pair<int, Cycle>> seen;

 private:
  void note(int what, Cycle at) { seen.emplace_back(what, at); }
  HostResult waits(Cycle at, bool again, Cycle time) {
    if (!again) until_ = at + time;
    if (at < until_) return HostResult::waits(until_);
    note(-4, at);
    return HostResult::done(6);
  }
  unsigned callback_;
  mutable std::int64_t owed_q32_ = 0;
  int percent_, steps_ = 0;
  bool held_ = true;
  Cycle due_ = 2000, until_ = 0;
};

struct Bench : CoreBench {
  Bench(const std::string& text, int share) : CoreBench(text, {}, false) {
    if (share < 0) return;
    library = std::make_unique<Library>(symbol("callback"), share);
    cpu = std::make_unique<dspic::Processor>(*chip, program, nullptr, library.get(), 0x820);
  }
  std::unique_ptr<Library> library;
};

// --- programs

// timers at levels 6, 4 and 2 that nest, a transmitter, waits of several kinds between
const char* const kAlone[] = {
    R"(
__reset: mov #__SP_init, w15
    mov #0x6444, w0
    mov w0, IPC0
    mov #0x2444, w0
    mov w0, IPC1
    mov #1777, w0
    mov w0, PR1
    mov #613, w0
    mov w0, PR2
    mov #29989, w0
    mov w0, PR3
    bset IEC0, #T1IE
    bset IEC0, #T2IE
    bset IEC0, #T3IE
    bset T1CON, #15
    bset T2CON, #15
    bset T3CON, #15
    clr flag
    clr w9
1:  rcall ready
    cp0 w0
    bra z, 1b
    clr flag
    repeat #777
    nop
    mov #300, w0
2:  dec w0, w0
    bra nz, 2b
3:  mov TMR1, w2
    cp w2, #20
    bra gtu, 3b
    inc w9, w9
    bra 1b
ready: push w2
    mov flag, w0
    pop w2
    return
__T1Interrupt: bclr IFS0, #T1IF
    push w0
    mov #20, w0
4:  dec w0, w0
    bra nz, 4b
    pop w0
    retfie
__T2Interrupt: bclr IFS0, #T2IF
    inc count
    retfie
__T3Interrupt: bclr IFS0, #T3IF
    setm flag
5:  btss IFS0, #T2IF
    bra 6f
6:  repeat #900
    nop
    retfie
    .bss
flag: .space 2
count: .space 2)",
    R"(
__reset: mov #__SP_init, w15
    mov #95, w0
    mov w0, U1BRG
    mov #0x8000, w0
    mov w0, U1MODE
    bset U1STA, #10
    mov #4999, w0
    mov w0, PR2
    bset IEC0, #T2IE
    bset T2CON, #15
    clr w9
1:  mov #1000, w1
2:  btss U1STA, #9
    bra 3f
    dec w1, w1
    bra nz, 2b
3:  inc w9, w9
    mov w9, U1TXREG
    btss w9, #2
    bra 1b
    pwrsav #1
    bra 1b
__T2Interrupt: bclr IFS0, #T2IF
    retfie)",
    R"(
__reset: mov #__SP_init, w15
    mov #777, w0
    mov w0, PR1
    bset IEC0, #T1IE
    bset T1CON, #15
    clr w9
1:  do #300, 2f
    nop
2:  nop
    disi #200
    repeat #99
    nop
    clr w0
    clr w1
3:  add w0, #1, w0
    addc w1, #0, w1
    mov #7000, w2
    sub w0, w2, w4
    bra ltu, 3b
    inc w9, w9
    mov #3, w5
4:  mov #900, w0
5:  dec w0, w0
    bra nz, 5b
    dec w5, w5
    bra nz, 4b
    bra 1b
__T1Interrupt: bclr IFS0, #T1IF
    retfie)"};

const char* const kWithLibrary[] = {
    // everything that a library has
    R"(
__reset: mov #0x1000, w15
    clr w3
    clr w9
    bset IEC0, #T2IE
    bset IEC0, #ADIE
1:  call 0x400000
    inc w9, w9
    call 0x400002
    mov 0x800, w1
    mov w1, 0x802
    call 0x400004
    btsc w9, #2
    call 0x400008
    btsc w9, #3
    call 0x40000A
2:  call 0x400006
    cp w0, w3
    bra z, 2b
    mov w0, w3
    mov #2000, w0
3:  dec w0, w0
    bra nz, 3b
    mov 0x800, w1
4:  mov 0x800, w2
    cp w1, w2
    bra z, 4b
    repeat #333
    nop
    bra 1b
callback: inc 0x900
    return)",
    // ... against interrupts of the program's own, above and below, and levels that hold it off
    R"(
__reset: mov #0x1000, w15
    mov #0x6444, w0
    mov w0, IPC0
    mov #0x4442, w0
    mov w0, IPC1
    mov #1777, w0
    mov w0, PR1
    mov #9973, w0
    mov w0, PR3
    bset IEC0, #T1IE
    bset IEC0, #T2IE
    bset IEC0, #T3IE
    bset IEC0, #ADIE
    bset T1CON, #15
    bset T3CON, #15
    clr w9
1:  call 0x400002
    inc w9, w9
    disi #1500
    mov #400, w0
2:  dec w0, w0
    bra nz, 2b
    mov #0xA0, w0
    mov w0, SR
    call 0x400004
    mov #700, w0
3:  dec w0, w0
    bra nz, 3b
    clr SR
    pwrsav #1
4:  btss 0x900, #0
    bra 4b
    bclr 0x900, #0
    bra 1b
callback: bset 0x900, #0
    mov #60, w0
5:  dec w0, w0
    bra nz, 5b
    return
__T1Interrupt: bclr IFS0, #T1IF
    call 0x400000
    retfie
__T3Interrupt: bclr IFS0, #T3IF
    push.d w0
    call 0x400006
    call 0x400004
    pop.d w0
    retfie)",
    // a wait that nothing ends but the callback, and one with a limit
    R"(
__reset: mov #0x1000, w15
    clr 0x900
    clr w9
    bset IEC0, #T2IE
1:  cp0 0x900
    bra z, 1b
    clr 0x900
    inc w9, w9
    mov #0x1200, w0
2:  cp0 0x900
    bra nz, 1b
    dec w0, w0
    bra nz, 2b
    bra 1b
callback: setm 0x900
    return)"};

// --- cuts

constexpr Cycle kSecond = 14745600;

/// Of one course: what is seen at common instants.
struct Look {
  Cycle now, idle;
  std::uint64_t hash;
  unsigned pc;
  bool operator==(const Look& o) const {
    return now == o.now && idle == o.idle && hash == o.hash && pc == o.pc;
  }
};
std::ostream& operator<<(std::ostream& out, const Look& look) {
  return out << "now " << look.now << " idle " << look.idle << " hash " << look.hash << " pc " << look.pc;
}

struct Course {
  std::vector<Look> looks;
  std::vector<std::pair<int, Cycle>> seen;
  unsigned rounds = 0;
};

/// `cut`: the next window's length; looks stand at instants that do not depend on it.
template <class Cut>
Course course_of(const std::string& text, int share, Cycle end, Cut cut) {
  Bench b(text, share);
  Course course;
  Draw instants{4711};
  for (Cycle at = 0; at < end;) {
    at += 1 + instants(instants(3) ? 20000 : 90);
    for (Cycle to = b.cpu->now(); to < at;) b.run(to = std::min(at, to + cut()));
    course.looks.push_back({b.cpu->now(), b.cpu->idle(b.cpu->now()), b.cpu->state_hash(), b.cpu->pc()});
  }
  if (b.library) course.seen = b.library->seen;
  course.rounds = b.w(9);
  return course;
}

void expect_same(const std::string& text, int share, Cycle end) {
  const Course whole = course_of(text, share, end, [] { return kSecond; });
  EXPECT_GT(whole.rounds, 2u) << text;
  EXPECT_GT(whole.looks.back().idle, end / 10) << text;
  Draw draw{99};
  const auto compare = [&](const char* how, auto cut) {
    const Course other = course_of(text, share, end, cut);
    ASSERT_EQ(other.looks.size(), whole.looks.size());
    for (std::size_t i = 0; i < whole.looks.size(); ++i)
      ASSERT_EQ(other.looks[i], whole.looks[i]) << how << ", look " << i << ", share " << share << "\n"
                                                << text;
    ASSERT_EQ(other.seen.size(), whole.seen.size()) << how << "\n" << text;
    for (std::size_t i = 0; i < whole.seen.size(); ++i)
      ASSERT_EQ(other.seen[i], whole.seen[i]) << how << ", " << i << ", share " << share << "\n" << text;
  };
  compare("one cycle", [] { return Cycle{1}; });
  compare("seven cycles", [] { return Cycle{7}; });
  compare("a tick", [] { return Cycle{15360}; });
  for (int i = 0; i < 4; ++i)
    compare("at random", [&] { return Cycle{1 + draw(draw(2) ? 30 : draw(2) ? 900 : 30000)}; });
}

TEST(Windows, do_not_matter_to_a_program) {
  for (const char* text : kAlone) expect_same(text, -1, 400000);
}

TEST(Windows, do_not_matter_to_a_library) {
  for (const char* text : kWithLibrary)
    for (const int share : {0, 30}) expect_same(text, share, 400000);
}

// up to idle_until() nothing happens, and what is waited is known ahead
TEST(Windows, idle_is_known_ahead) {
  int ahead = 0;
  const auto check = [&](const char* text, int share) {
    Bench b(text, share), later(text, share);
    for (Cycle at = 3000; at < 200000; at += 3001) {
      b.run(at);
      const Cycle until = std::min(b.cpu->idle_until(), at + kSecond);
      if (until < at + 20) continue;
      ++ahead;
      for (const Cycle to : {at + (until - at) / 3, until - 9}) {
        later.run(to);
        if (later.cpu->now() > until) continue;
        EXPECT_EQ(later.cpu->idle(later.cpu->now()), b.cpu->idle(later.cpu->now()))
            << at << " " << until << text;
      }
      b.run(later.cpu->now());
      EXPECT_EQ(later.cpu->state_hash(), b.cpu->state_hash()) << text;
    }
  };
  for (const char* text : kAlone) check(text, -1);
  for (const char* text : kWithLibrary)
    for (const int share : {0, 30}) check(text, share);
  EXPECT_GT(ahead, 100);
}

// half of the time is taken
TEST(TwoClocks, make_good_what_was_taken_too_much_or_too_little) {
  constexpr std::uint64_t kHalf = std::uint64_t{1} << 31;
  constexpr std::int64_t kCycle = std::int64_t{1} << 32;
  struct Row {
    std::int64_t owed;                 // cycles
    Cycle at_3, at_12, at_30, at_300;  // true times behind so many cycles of the program
  };
  // too little: of each cycle another one; too much: the program has it all; until that is even
  for (const Row& row :
       {Row{0, 1006, 1024, 1060, 1600}, Row{8, 1009, 1032, 1068, 1608}, Row{100, 1009, 1036, 1090, 1700},
        Row{-4, 1003, 1020, 1056, 1596}, Row{-50, 1003, 1012, 1030, 1550}}) {
    dspic::TwoClocks clocks;
    Cycle now = 1000;
    clocks.settle(now);
    clocks.correct(row.owed * kCycle);
    clocks.set_share(kHalf);
    EXPECT_EQ(clocks.true_at(now), now) << row.owed;
    const Cycle own = clocks.own_cycles(now);
    for (const auto& [after, at] :
         {std::pair{3, row.at_3}, {12, row.at_12}, {30, row.at_30}, {300, row.at_300}}) {
      EXPECT_EQ(clocks.true_at(now + after), at) << row.owed << ", " << after;
      EXPECT_EQ(clocks.program_at(at), now + after) << row.owed << ", " << after;
    }
    // settled on the way it is the same
    Cycle settled = now + 30;
    clocks.settle(settled);
    EXPECT_EQ(settled, row.at_30) << row.owed;
    EXPECT_EQ(clocks.own_cycles(settled) - own, 30) << row.owed;
    EXPECT_EQ(clocks.true_at(settled + 270), row.at_300) << row.owed;
    EXPECT_EQ(clocks.program_at(row.at_300), settled + 270) << row.owed;
  }
}

}  // namespace
