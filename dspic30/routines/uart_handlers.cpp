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

// --- code: words with the module's addresses and the variables' put in

constexpr std::uint32_t bit_of_byte(std::uint32_t operation, unsigned byte, unsigned bit) {
  return operation | bit << 13 | byte;
}
constexpr std::uint32_t moved(std::uint32_t operation, unsigned word, unsigned reg) {
  return operation | word / 2 << 4 | reg;
}
constexpr std::uint32_t kFromFile = 0x800000, kToFile = 0x880000, kClearBit = 0xA90000, kTestBit = 0xAB0000;
constexpr std::uint32_t kPlace = 0x1FFF;  // of CP0 and its kin: a word near the beginning of RAM

std::uint32_t clear_flag(int irq) {
  const auto n = static_cast<unsigned>(irq);
  return bit_of_byte(kClearBit, kUartFlags + n / 8, n % 8);
}

struct SendingState {
  unsigned is_sending, next_byte, left;
};
struct ReceivingState {
  unsigned ring, received;
};

bool is_code(const std::uint32_t* words, const SendingState& s, unsigned module, int irq) {
  const std::array<std::uint32_t, 31> code = {
      0xF80034,
      0xBE9F80,
      0x200000,
      0x8801A0,
      clear_flag(irq),
      0xE20000 | s.is_sending % 0x2000,
      0x320013,
      0xE20000 | s.next_byte % 0x2000,
      0x320010,
      0xE20000 | s.left % 0x2000,
      0x32000E,
      0x200040,
      bit_of_byte(kTestBit, module + 3, 1),  // UTXBF
      0x3A000C,
      0xE20000 | s.left % 0x2000,
      0x32000D,
      0xED2000 | s.left % 0x2000,
      moved(kFromFile, s.next_byte, 1),
      0xFB8091,
      moved(kToFile, module + 4, 1),
      0xEC2000 | s.next_byte % 0x2000,
      0xE90000,
      0xFB8080,
      0x3AFFF4,
      0x370001,
      0xEF2000 | s.is_sending % 0x2000,
      0xBE004F,
      0xF90034,
      0x064000,
      0xEF2000 | s.next_byte % 0x2000,
      0x37FFFB,
  };
  return std::memcmp(words, code.data(), sizeof code) == 0;
}

bool is_code(const std::uint32_t* words, const ReceivingState& s, unsigned module, int irq) {
  const std::array<std::uint32_t, 24> code = {
      0xF80034,
      0xBE9F80,
      0xBE9F82,
      0x200000,
      0x8801A0,
      clear_flag(irq),
      bit_of_byte(kTestBit, module + 2, 0),  // URXDA
      0x320009,
      0x200000 | s.ring << 4,
      moved(kFromFile, module + 6, 1),
      moved(kFromFile, s.received, 2),
      0xE80182,
      moved(kToFile, s.received, 3),
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
      0x064000,
  };
  return std::memcmp(words, code.data(), sizeof code) == 0;
}

// --- one handler

class UartHandler {
 public:
  UartHandler(Cpu& cpu, int vector, Uart& uart, unsigned module)
      : cpu_(cpu), vector_(vector), uart_(uart), module_(module) {}

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
    if (cpu_.parts.notice_horizon() <= end || !is_host_quiet(end)) return false;
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

  // handlers known by heart are all held off, none of them becomes pending, so only their share is missing
  bool is_host_quiet(Cycle end) const {
    if (!cpu_.host) return true;
    if (cpu_.host_is_held || cpu_.host_stale || cpu_.host_due <= end + kMargin) return false;
    const Interrupts& interrupts = cpu_.parts.interrupts;
    const int own = interrupts.sources().priority(vector_ - kFirstIrqVector);
    for (int h = 0; h < HostCalls::kHandlers; ++h) {
      const int vector = cpu_.host->vector(h);
      if (vector == kNoVector) continue;
      if (interrupts.sources().priority(vector - kFirstIrqVector) > own ||
          cpu_.host->source_event(h, cpu_.now - kMargin) <= end + kMargin)
        return false;
    }
    return true;
  }

  /// Entry and the registers that it saves; `pairs` of W registers from W0 up. Its first
  /// instruction begins at begin_.
  void enter(unsigned pairs) {
    cpu_.waits->cut(cpu_);
    Interrupts& interrupts = cpu_.parts.interrupts;
    level_ = interrupts.cpu().level();
    pc_ = cpu_.address_of(cpu_.next);
    flags_ = cpu_.sr_low();
    leave(cpu_, 0, pc_ & 0xFFFF);
    leave(cpu_, 1, flags_ << 8 | (static_cast<unsigned>(level_) & 8) << 4 | pc_ >> 16);
    leave(cpu_, 2, cpu_.psvpag);
    leave_registers(cpu_, 3, 0, 2 * pairs);
    cpu_.now = interrupts.enter(vector_, cpu_.now).first_instruction;
    share_ = cpu_.host ? cpu_.host->share_q32() : 0;
    follow(0);
    begin_ = cpu_.now;
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
    cpu_.parts.events.run_to(cpu_.now);
    cpu_.set_flags(flags_);
    cpu_.now = cpu_.parts.interrupts.leave_to(level_, cpu_.now);
    cpu_.at = cpu_.code() + address_ / 2 + at_word;
    cpu_.repeat_is_fresh = false;
    cpu_.returned = true;
    cpu_.next = cpu_.jump_back(pc_, cpu_.at);
    follow(share_);
    return true;
  }
  void follow(std::uint64_t share) {
    if (!cpu_.host) return;
    cpu_.settle();
    cpu_.clocks.set_share(share);
  }

  Cpu& cpu_;
  const int vector_;
  Uart& uart_;
  const unsigned module_;
  unsigned address_ = 0, pc_ = 0, flags_ = 0;
  int level_ = 0;
  std::uint64_t share_ = 0;
  Cycle begin_ = 0;
};

/// Up to four bytes to the module.
bool UartHandler::send(Cycle until) {
  if (!is_alone(until)) return false;
  const std::uint32_t* const code = words();
  if (!code) return false;
  const SendingState s = {code[5] & kPlace, code[7] & kPlace, code[9] & kPlace};
  if (!is_code(code, s, module_, vector_ - kFirstIrqVector)) return false;
  if (!is_plain(s.is_sending) || !is_plain(s.next_byte) || !is_plain(s.left)) return false;
  // all that it will send can be read, and the shift register takes none of it meanwhile
  const unsigned from = word(s.next_byte);
  const bool sends = word(s.is_sending) && from && word(s.left);
  constexpr unsigned kBurst = 4;
  if (sends && (!uart_.transmits() || uart_.busy_until() <= cpu_.now + kLongestHandler + kMargin))
    return false;
  for (unsigned i = 0; sends && i < kBurst; ++i)
    if (byte_at(from + i) < 0) return false;
  const bool is_flash = from >= Cpu::kPsvStart;

  // From here on it is done: registers, flag, then byte after byte, with the cycles of the handler's code.
  enter(1);
  lower_flag(begin_ + 5);
  Cycle t = 0;
  if (sub(cpu_, word(s.is_sending), 0) == 0) {
    t = 9;
  } else if (sub(cpu_, word(s.next_byte), 0) == 0 || sub(cpu_, word(s.left), 0) == 0) {
    t = from == 0 ? 12 : 14;
    put(s.is_sending, 0);
  } else {
    t = 13;
    for (unsigned burst = kBurst;;) {
      if (!uart_.has_room()) {
        t += 3;
        break;
      }
      if (sub(cpu_, word(s.left), 0) == 0) {
        t += 8;
        put(s.next_byte, 0);
        break;
      }
      put(s.left, word(s.left) - 1u);
      const unsigned next = word(s.next_byte);
      if (is_flash) t += kWindowCycles;
      cpu_.parts.write(module_ + 4, static_cast<std::uint16_t>(byte_at(next)), 16, begin_ + t + 8);
      put(s.next_byte, next + 1);
      sub(cpu_, burst, 1);
      t += --burst > 0 ? 14 : 15;
      if (burst == 0) break;
    }
  }
  return go_back(t + 3, 28);
}

/// What the module has received goes to the ring.
bool UartHandler::receive(Cycle until) {
  if (!is_alone(until) || uart_.has_overrun()) return false;
  const std::uint32_t* const code = words();
  if (!code) return false;
  const ReceivingState s = {code[8] >> 4 & 0xFFFF, (code[10] >> 4 & 0x7FFF) * 2};
  if (!is_code(code, s, module_, vector_ - kFirstIrqVector)) return false;
  constexpr unsigned kRing = 64;
  if (!is_plain(s.received) || cpu_.is_elsewhere(s.ring, true) || cpu_.is_elsewhere(s.ring + kRing - 1, true))
    return false;

  enter(2);
  lower_flag(begin_ + 7);
  Cycle t = 11;
  for (Cycle round = 11; uart_.has_received(); round += 9) {
    const unsigned byte = cpu_.parts.read(module_ + 6, 16, begin_ + round) & 0xFF;
    const unsigned n = word(s.received);
    put(s.received, add(cpu_, n, 1));
    cpu_.ram[s.ring + n % kRing - Cpu::kRamStart] = static_cast<std::uint8_t>(byte);
    t = round + 8;
  }
  return go_back(t + 8, 23);
}

bool serve(Cpu& cpu, int vector, Cycle until) {
  constexpr unsigned kModules[] = {sfr("U1MODE"), sfr("U2MODE")};
  for (std::size_t n = 0; n < 2; ++n) {
    UartHandler handler(cpu, vector, cpu.parts.uarts[n], kModules[n]);
    if (vector == kFirstIrqVector + (n == 0 ? irq::U1Tx : irq::U2Tx)) return handler.send(until);
    if (vector == kFirstIrqVector + (n == 0 ? irq::U1Rx : irq::U2Rx)) return handler.receive(until);
  }
  return false;
}

}  // namespace

KnownHandler uart_handler() { return &serve; }

}  // namespace dspic
