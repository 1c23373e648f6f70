// SPDX-License-Identifier: MIT
#include "dspic30/routines/routine_code.h"

#include <algorithm>
#include <vector>

namespace dspic {

namespace {

constexpr std::size_t kMostWords = 1024;  // the longest known routines reach less

// what a word does to the course, by its opcode [chip C3]
enum class Flow { On, Skip, Branch, Always, Call, FarCall, FarGoto, End, Unknown };

Flow flow_of(std::uint32_t word) {
  switch (word >> 16) {
    case 0x01:  // by a register
    case 0x08:  // DO
      return Flow::Unknown;
    case 0x02:
      return Flow::FarCall;
    case 0x04:
      return Flow::FarGoto;
    case 0x05:
      return Flow::End;
    case 0x06:
      return word == 0x060000 ? Flow::End : Flow::Unknown;
    case 0x07:
      return Flow::Call;
    case 0x37:
      return Flow::Always;
    case 0xA6:
    case 0xA7:
    case 0xAE:
    case 0xAF:
    case 0xE6:
    case 0xE7:
      return Flow::Skip;
    default:
      return word >> 20 == 0x3 || (word >= 0x0C0000 && word < 0x100000) ? Flow::Branch : Flow::On;
  }
}

/// Straight pieces of code in the order in which they are met.
class Walk {
 public:
  Walk(const ProgramMemory& program, unsigned address, bool hides_variable)
      : program_(program), hides_variable_(hides_variable) {
    meet(address);
  }

  std::uint64_t sum() {
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      if (!read_piece(pieces_[i])) return 0;
    return sum_;
  }

 private:
  void add(std::uint64_t value) { sum_ = (sum_ ^ value) * 0x100000001B3u; }
  // its number stands for the place, which is the linker's affair
  void meet(unsigned address) {
    const auto known = std::find(pieces_.begin(), pieces_.end(), address);
    add(0x1000000u + static_cast<std::uint64_t>(known - pieces_.begin()));
    if (known == pieces_.end()) pieces_.push_back(address);
  }
  static unsigned relative(unsigned address, std::uint32_t word) {
    return (address + 2 + 2 * static_cast<unsigned>(static_cast<std::int16_t>(word & 0xFFFF))) & 0x7FFFFE;
  }

  /// MOV #address, Wn of it?
  bool is_of_variable(std::uint32_t word) {
    const std::uint32_t address = word >> 4 & 0xFFFF;
    if (!hides_variable_ || word >> 20 != 0x2 || address < 0x800 || address >= 0x2000) return false;
    if (variable_ == 0) variable_ = address;
    return address == variable_;
  }

  bool read_piece(unsigned address) {
    for (bool may_be_skipped = false; address < kFlashEnd; address += 2) {
      if (++words_ > kMostWords) return false;
      const std::uint32_t word = program_.read(address);
      const Flow flow = flow_of(word);
      bool ends = false;
      // Words as they are, but for addresses, which are the linker's affair.
      switch (flow) {
        case Flow::Unknown:
          return false;
        case Flow::On:
        case Flow::Skip:
          add(is_of_variable(word) ? kVariable | (word & 0xF) : word);
          break;
        case Flow::End:
          add(word);
          ends = true;
          break;
        case Flow::Branch:
        case Flow::Always:
        case Flow::Call:
          add(word & 0xFF0000);
          meet(relative(address, word));
          ends = flow == Flow::Always;
          break;
        case Flow::FarCall:
        case Flow::FarGoto:
          add(word & 0xFF0000);
          meet((program_.read(address + 2) & 0x7F) << 16 | (word & 0xFFFE));
          ends = flow == Flow::FarGoto;
          address += 2;
          break;
      }
      if (ends && !may_be_skipped) return true;
      may_be_skipped = flow == Flow::Skip;
    }
    return false;
  }

  static constexpr std::uint64_t kVariable = 0x2000000;

  const ProgramMemory& program_;
  const bool hides_variable_;
  std::uint32_t variable_ = 0;
  std::vector<unsigned> pieces_;
  std::size_t words_ = 0;
  std::uint64_t sum_ = 0xCBF29CE484222325u;
};

}  // namespace

std::uint64_t code_sum(const ProgramMemory& program, unsigned address, bool hides_variable) {
  return Walk(program, address, hides_variable).sum();
}

}  // namespace dspic
