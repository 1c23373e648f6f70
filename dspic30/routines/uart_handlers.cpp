// SPDX-License-Identifier: MIT
// The handlers of hal_dspic's UART driver (hal_dspic/uart/uart_driver.h), as they are compiled at -O1:
//
//   flag --entry--> registers saved, flag down, bytes moved --RETFIE--> program
//                   (between the ring or the caller's memory and the module's FIFOs)
//
// The module is the chip's: each access to it comes at the cycle at which the handler's own code would
// make it. Known by heart is what lies between. Where anything else may happen before the handler is over,
// where somebody looks on, or where the code is another one, the handler runs. So nothing but the PC's
// time depends on it.
#include <array>

#include "dspic30/core/host_handlers.h"
#include "dspic30/core/waits.h"
#include "dspic30/routines/forms.h"
#include "dspic30/routines/known_routines.h"

namespace dspic {

namespace {

using namespace forms;

constexpr unsigned kUartFlags = sfr("IFS0");
// longer than either handler may take, with what the window into the flash costs
constexpr Cycle kLongestHandler = 92;
// how close a handler known by heart may come to its beginning and its end
constexpr Cycle kMargin = 4;
// what the handler pays more for a byte that lies in the flash
constexpr Cycle kWindowCycles = 2;
constexpr unsigned kTxReg = 4;

// --- code: words with the module's addresses and the variables' put in

constexpr std::uint32_t bit_of_byte(std::uint32_t operation, unsigned byte, unsigned bit) {
  return operation | bit << 13 | byte;
}
constexpr std::uint32_t moved(std::uint32_t operation, unsigned word, unsigned reg) {
  return operation | word / 2 << 4 | reg;
}
constexpr std::uint32_t kFromFile = 0x800000, kToFile = 0x880000, kClearBit = 0xA90000, kTestBit = 0xAB0000;
constexpr std::uint32_t kPlace = 0x1FFF;  // of CP0 and its kin: a word near the beginning of RAM

constexpr std::uint32_t clear_flag(int irq) {
  const auto n = static_cast<unsigned>(irq);
  return bit_of_byte(kClearBit, kUartFlags + n / 8, n % 8);
}

// what the linker has put in
constexpr std::uint32_t kAll = 0xFFFFFF, kButPlace = kAll & ~kPlace, kButWord = kAll & ~(0x7FFFu << 4),
                        kButLiteral = kAll & ~(0xFFFFu << 4);

std::uint64_t two(const std::uint32_t* words) {
  std::uint64_t both;
  std::memcpy(&both, words, sizeof both);
  return both;
}

template <std::size_t N>
struct Code {
  std::array<std::uint32_t, N> words, fixed;
  bool is_at(const std::uint32_t* code) const {
    // two words at a time
    std::uint64_t other = 0;
    for (std::size_t i = 0; i + 1 < N; i += 2) other |= (two(&code[i]) ^ two(&words[i])) & two(&fixed[i]);
    return other == 0 && (N % 2 == 0 || code[N - 1] == words[N - 1]);
  }
};

struct SendingState {
  unsigned is_sending, next_byte, left;
};
struct ReceivingState {
  unsigned ring, received;
};

constexpr Code<31> sending_code(unsigned module, int irq) {
  Code<31> code{{0xF80034,
                 0xBE9F80,
                 0x200000,
                 0x8801A0,
                 clear_flag(irq),
                 0xE20000,  // is_sending
                 0x320013,
                 0xE20000,  // next_byte
                 0x320010,
                 0xE20000,  // left
                 0x32000E,
                 0x200040,
                 bit_of_byte(kTestBit, module + 3, 1),  // UTXBF
                 0x3A000C,
                 0xE20000,
                 0x32000D,
                 0xED2000,
                 moved(kFromFile, 0, 1),
                 0xFB8091,
                 moved(kToFile, module + 4, 1),
                 0xEC2000,
                 0xE90000,
                 0xFB8080,
                 0x3AFFF4,
                 0x370001,
                 0xEF2000,
                 0xBE004F,
                 0xF90034,
                 0x064000,
                 0xEF2000,
                 0x37FFFB},
                {}};
  for (auto& word : code.fixed) word = kAll;
  for (const std::size_t i : {5, 7, 9, 14, 16, 20, 25, 29}) code.fixed[i] = kButPlace;
  code.fixed[17] = kButWord;
  return code;
}

constexpr Code<24> receiving_code(unsigned module, int irq) {
  Code<24> code{{0xF80034,
                 0xBE9F80,
                 0xBE9F82,
                 0x200000,
                 0x8801A0,
                 clear_flag(irq),
                 bit_of_byte(kTestBit, module + 2, 0),  // URXDA
                 0x320009,
                 0x200000,  // ring
                 moved(kFromFile, module + 6, 1),
                 moved(kFromFile, 0, 2),  // received
                 0xE80182,
                 moved(kToFile, 0, 3),
                 0xB203F2,
                 0x787101,
                 bit_of_byte(kTestBit, module + 2, 0),
                 0x3AFFF8,
                 bit_of_byte(kTestBit, module + 2, 1),  // OERR
                 0x320001,
                 bit_of_byte(kClearBit, module + 2, 1),
                 0xBE014F,
                 0xBE004F,
                 0xF90034,
                 0x064000},
                {}};
  for (auto& word : code.fixed) word = kAll;
  code.fixed[8] = kButLiteral;
  code.fixed[10] = code.fixed[12] = kButWord;
  return code;
}

constexpr unsigned kModules[] = {sfr("U1MODE"), sfr("U2MODE")};
constexpr int kSends[] = {irq::U1Tx, irq::U2Tx}, kReceives[] = {irq::U1Rx, irq::U2Rx};
constexpr Code<31> kSending[] = {sending_code(kModules[0], kSends[0]), sending_code(kModules[1], kSends[1])};
constexpr Code<24> kReceiving[] = {receiving_code(kModules[0], kReceives[0]),
                                   receiving_code(kModules[1], kReceives[1])};

/// Its variables; false: the code is another one.
bool read_code(const std::uint32_t* code, std::size_t n, SendingState& s) {
  if (!kSending[n].is_at(code)) return false;
  s = {code[5] & kPlace, code[7] & kPlace, code[9] & kPlace};
  return (code[14] & kPlace) == s.left && (code[16] & kPlace) == s.left &&
         code[17] == moved(kFromFile, s.next_byte, 1) && (code[20] & kPlace) == s.next_byte &&
         (code[25] & kPlace) == s.is_sending && (code[29] & kPlace) == s.next_byte;
}

bool read_code(const std::uint32_t* code, std::size_t n, ReceivingState& s) {
  if (!kReceiving[n].is_at(code)) return false;
  s = {code[8] >> 4 & 0xFFFF, (code[10] >> 4 & 0x7FFF) * 2};
  return code[12] == moved(kToFile, s.received, 3);
}

// --- one handler

class UartHandler {
 public:
  UartHandler(Cpu& cpu, int vector, std::size_t number)
      : cpu_(cpu), vector_(vector), number_(number), uart_(cpu.parts.uarts[number]) {}

  /// Does nothing else happen before it is over, or before `until`?
  bool is_alone(Cycle until) {
    const Interrupts& interrupts = cpu_.parts.interrupts;
    const Cycle end = cpu_.now + kLongestHandler;
    if (end > until || cpu_.looks_at_each() || cpu_.course || cpu_.watching || cpu_.repeating ||
        cpu_.parts.events.is_watched())
      return false;
    if (cpu_.modcon || cpu_.loop_end || stands_in_host(cpu_) || interrupts.cpu().nesting() > 0 ||
        !interrupts.has_no_other(vector_) || interrupts.cpu().disi_until() > cpu_.now ||
        interrupts.control().nesting_disabled() || !uart_.enabled())
      return false;
    alone_until_ = std::min(until + 1, cpu_.parts.notice_horizon());
    host_comes_ = host_horizon();
    if (alone_until_ <= end || host_comes_ < 0) return false;
    const unsigned top = cpu_.w[15], full = top + KnownCalls::kStack;
    return !(top & 1) && top >= cpu_.plain_start && full <= Cpu::kRamEnd && full <= cpu_.stack_most;
  }
  /// Where its code is; null: there is none.
  const std::uint32_t* words() {
    const unsigned table = cpu_.parts.interrupts.control().uses_alternate_table() ? 0x84u : 0x04u;
    const std::uint32_t* const flash = cpu_.program.flash();
    address_ = flash[(table + 2 * static_cast<unsigned>(vector_)) / 2] & 0x7FFFFE;
    constexpr unsigned kMostBytes = 64;
    if (address_ >= kFlashEnd - kMostBytes || cpu_.table().tells(cpu_.code() + address_ / 2)) return nullptr;
    return flash + address_ / 2;
  }

  bool send(Cycle until);
  bool receive(Cycle until);

 private:
  unsigned module() const { return kModules[number_]; }
  std::uint16_t word(unsigned address) const {
    std::uint16_t value;
    std::memcpy(&value, &cpu_.ram[address - Cpu::kRamStart], sizeof value);
    return value;
  }
  void put(unsigned address, unsigned value) {
    const auto word = static_cast<std::uint16_t>(value);
    std::memcpy(&cpu_.ram[address - Cpu::kRamStart], &word, sizeof word);
  }
  bool is_plain(unsigned address) const { return !cpu_.is_elsewhere(address, false); }
  int byte_at(unsigned address) const {
    if (!cpu_.is_elsewhere(address, true)) return cpu_.ram[address - Cpu::kRamStart];
    if (address < Cpu::kPsvStart || address > 0xFFFF || !(cpu_.corcon & Cpu::kPsvOn)) return -1;
    return static_cast<int>(cpu_.program.read(address & 0x7FFE) >> 8 * (address & 1) & 0xFF);
  }

  /// Do bytes from there on lie among the words that the handler with so many pairs of registers puts on the
  /// stack?
  bool is_on_stack(unsigned from, unsigned bytes, unsigned pairs) const {
    return meet(from, bytes, cpu_.w[15], 2 * (kEntryWords + 2 * pairs));
  }
  static bool meet(unsigned a, unsigned a_bytes, unsigned b, unsigned b_bytes) {
    return a < b + b_bytes && b < a + a_bytes;
  }

  /// When one of the handlers known by heart, which are held off, becomes pending; up to there only their share
  /// is missing. -1: one of them may come into this one.
  Cycle host_horizon() const {
    if (!cpu_.host) return kNever;
    if (cpu_.host_stale) return -1;
    Cycle horizon = cpu_.host_is_held ? 0 : cpu_.host_due;
    const Interrupts& interrupts = cpu_.parts.interrupts;
    const int own = interrupts.sources().priority(vector_ - kFirstIrqVector);
    for (int h = 0; h < HostCalls::kHandlers; ++h) {
      const int vector = cpu_.host->vector(h);
      if (vector == kNoVector) continue;
      if (interrupts.sources().priority(vector - kFirstIrqVector) > own) return -1;
      if (horizon > cpu_.now) horizon = std::min(horizon, cpu_.host->source_event(h, cpu_.now - kMargin));
    }
    return horizon;
  }

  /// It is over by then. Will a wait that it comes into go on as if it had been found again? Not where it reads
  /// what the handler changes; of its variables wait_reads() tells.
  bool goes_through(Cycle over, unsigned saved_words) const {
    const Waits& waits = *cpu_.waits;
    if (follows_host_ || !waits.is_waiting()) return false;
    const Cycle back = waits.back_by(cpu_, over + kMargin), busy = uart_.transmits() ? uart_.busy_until() : 0;
    const unsigned top = cpu_.w[15] - Cpu::kRamStart;
    return back < std::min(alone_until_, host_comes_ - kMargin) && (busy <= cpu_.now || busy > back) &&
           !waits.reads(top, top + 2 * saved_words);
  }
  bool wait_reads(unsigned address, unsigned bytes) const {
    const unsigned place = address - Cpu::kRamStart;
    return cpu_.waits->reads(place, place + bytes);
  }

  /// When it is over whose RETFIE comes so long behind its first instruction. From here on it is known whether
  /// handlers known by heart matter to it.
  Cycle ends(Cycle behind) {
    const Cycle over = cpu_.now + kInterruptEntryCycles + behind + kInterruptReturnCycles;
    follows_host_ = host_comes_ <= over + kMargin;
    return over;
  }
  /// Entry and the registers that it saves; `pairs` of W registers from W0 up. Its first
  /// instruction begins at begin_. `is_through`: the wait that it comes into goes on.
  void enter(unsigned pairs, bool is_through) {
    is_through_ = is_through;
    cut_ = cpu_.clocks.own_cycles(cpu_.now);
    cut_true_ = cpu_.now;
    if (!is_through) cpu_.waits->cut(cpu_, vector_);
    Interrupts& interrupts = cpu_.parts.interrupts;
    level_ = interrupts.cpu().level();
    pc_ = cpu_.address_of(cpu_.next);
    flags_ = cpu_.sr_low();
    leave(cpu_, 0, pc_ & 0xFFFF);
    leave(cpu_, 1, flags_ << 8 | (static_cast<unsigned>(level_) & 8) << 4 | pc_ >> 16);
    leave(cpu_, 2, cpu_.psvpag);
    leave_registers(cpu_, kEntryWords, 0, 2 * pairs);
    cpu_.now = interrupts.enter(vector_, cpu_.now).first_instruction;
    if (cpu_.host) hold_host();
    begin_ = cpu_.now;
  }
  /// From its first instruction on its level holds off all handlers known by heart.
  void hold_host() {
    if (follows_host_) return follow_host();
    share_ = cpu_.host->share_q32();
    cpu_.settle();
    cpu_.clocks.set_share(0);
  }
  void follow_host() {
    cpu_.settle();
    cpu_.parts.events.run_to(cpu_.now);
    cpu_.follow_host();
  }
  void lower_flag(Cycle at) {
    ChipParts& parts = cpu_.parts;
    parts.events.run_to(at);
    const int irq = vector_ - kFirstIrqVector;
    const unsigned flags = kUartFlags + 2 * (static_cast<unsigned>(irq) / 16);
    const auto kept = static_cast<std::uint16_t>(~(1u << irq % 16));
    if (!parts.are_flags(flags, at) || !parts.lower_flags(flags, kept, at))
      parts.modify_flags(flags, kept, 0, at);
  }
  /// RETFIE begins so long behind the first instruction; it is the word `at_word`.
  bool go_back(Cycle behind, unsigned at_word) {
    cpu_.now = begin_ + behind;
    if (follows_host_)
      follow_host();
    else
      cpu_.parts.events.run_to(cpu_.now);
    cpu_.set_flags(flags_);
    cpu_.now = cpu_.parts.interrupts.leave_to(level_, cpu_.now);
    cpu_.at = cpu_.code() + address_ / 2 + at_word;
    cpu_.repeat_is_fresh = false;
    cpu_.returned = !is_through_;
    cpu_.next = cpu_.jump_back(pc_, cpu_.at);
    if (cpu_.host && !follows_host_) {
      cpu_.settle();
      cpu_.clocks.set_share(share_);
    }
    if (is_through_) cpu_.waits->go_through(cpu_, vector_, cut_, cut_true_);
    return true;
  }

  static constexpr unsigned kEntryWords = 3, kSendsPairs = 1, kReceivesPairs = 2;
  static constexpr Cycle kGivesBack = 3;
  Cpu& cpu_;
  const int vector_;
  const std::size_t number_;
  Uart& uart_;
  Cycle alone_until_ = 0, host_comes_ = 0;
  bool follows_host_ = false;  // a handler known by heart becomes pending meanwhile, or may
  unsigned address_ = 0, pc_ = 0, flags_ = 0;
  int level_ = 0;
  std::uint64_t share_ = 0;
  Cycle begin_ = 0;
  bool is_through_ = false;
  Cycle cut_ = 0, cut_true_ = 0;  // cycles of the program, and true ones
};

/// Up to four bytes to the module.
bool UartHandler::send(Cycle until) {
  if (!is_alone(until)) return false;
  const std::uint32_t* const code = words();
  SendingState s;
  if (!code || !read_code(code, number_, s)) return false;
  for (const unsigned own : {s.is_sending, s.next_byte, s.left})
    if (!is_plain(own) || is_on_stack(own, 2, kSendsPairs)) return false;
  uart_.advance(cpu_.now);
  // all that it will send can be read, and the shift register takes none of it meanwhile
  const unsigned from = word(s.next_byte), left = word(s.left);
  const bool is_on = word(s.is_sending) != 0, sends = is_on && from && left;
  constexpr unsigned kBurst = 4;
  std::array<std::uint8_t, kBurst> bytes{};
  const unsigned count = sends ? std::min({kBurst, uart_.room(), left}) : 0;
  if (sends && (!uart_.transmits() || uart_.busy_until() <= cpu_.now + kLongestHandler + kMargin ||
                !cpu_.parts.bus.was_written(module() + kTxReg)))
    return false;
  // bytes that it changes itself, before it comes to them
  if (is_on_stack(from, count, kSendsPairs) || meet(from, count, s.next_byte, 2) ||
      meet(from, count, s.left, 2))
    return false;
  for (unsigned i = 0; i < count; ++i) {
    const int byte = byte_at(from + i);
    if (byte < 0) return false;
    bytes[i] = static_cast<std::uint8_t>(byte);
  }
  const bool is_flash = from >= Cpu::kPsvStart, is_over = is_on && !sends,
             is_last = sends && count == left && count < kBurst && count < uart_.room();

  // The cycles of the handler's code, from its first instruction to what gives the registers back.
  Cycle t = 9;
  if (is_over)
    t = from == 0 ? 12 : 14;
  else if (sends)
    t = 13 + count * (14 + (is_flash ? kWindowCycles : 0)) + (is_last ? 8 : count == kBurst ? 1 : 3);
  const Cycle over = ends(t + kGivesBack);
  const bool is_through = goes_through(over, kEntryWords + 2) && !(is_over && wait_reads(s.is_sending, 2)) &&
                          !(count > 0 && (wait_reads(s.left, 2) || wait_reads(s.next_byte, 2)));

  // From here on it is done: registers, flag, then byte after byte.
  enter(kSendsPairs, is_through);
  lower_flag(begin_ + 5);
  if (is_over) put(s.is_sending, 0);
  for (unsigned i = 0; i < count; ++i) {
    cpu_.parts.bus.count_write();
    uart_.load(bytes[i]);
  }
  if (sends) {
    put(s.left, left - count);
    put(s.next_byte, is_last ? 0 : from + count);
    if (count > 0) uart_.loaded();
  }
  // of its operations the last one leaves its DC behind
  if (!sends || is_last)
    sub(cpu_, 0, 0);
  else if (count > 0)
    sub(cpu_, kBurst - count + 1, 1);
  else
    sub(cpu_, left, 0);
  return go_back(t + kGivesBack, 28);
}

/// What the module has received goes to the ring.
bool UartHandler::receive(Cycle until) {
  if (!is_alone(until) || uart_.has_overrun()) return false;
  const std::uint32_t* const code = words();
  ReceivingState s;
  if (!code || !read_code(code, number_, s)) return false;
  constexpr unsigned kRing = 64;
  if (!is_plain(s.received) || cpu_.is_elsewhere(s.ring, true) || cpu_.is_elsewhere(s.ring + kRing - 1, true))
    return false;
  if (is_on_stack(s.received, 2, kReceivesPairs) || is_on_stack(s.ring, kRing, kReceivesPairs)) return false;

  const Cycle over = ends(kLongestHandler);
  enter(kReceivesPairs,
        goes_through(over, kEntryWords + 4) && !wait_reads(s.received, 2) && !wait_reads(s.ring, kRing));
  lower_flag(begin_ + 7);
  Cycle t = 11;
  for (Cycle round = 11; uart_.has_received(); round += 9) {
    const unsigned byte = cpu_.parts.read(module() + 6, 16, begin_ + round) & 0xFF;
    const unsigned n = word(s.received);
    put(s.received, add(cpu_, n, 1));
    cpu_.ram[s.ring + n % kRing - Cpu::kRamStart] = static_cast<std::uint8_t>(byte);
    t = round + 8;
  }
  return go_back(t + 8, 23);
}

bool serve(Cpu& cpu, int vector, Cycle until) {
  for (std::size_t n = 0; n < 2; ++n) {
    if (vector == kFirstIrqVector + kSends[n]) return UartHandler(cpu, vector, n).send(until);
    if (vector == kFirstIrqVector + kReceives[n]) return UartHandler(cpu, vector, n).receive(until);
  }
  return false;
}

}  // namespace

KnownHandler uart_handler() { return &serve; }

}  // namespace dspic
