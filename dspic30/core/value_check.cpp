// SPDX-License-Identifier: MIT
// What instructions make of values that nobody wrote, bit by bit where that is cheap to say. What is not
// known here gives results that count as written: a finding that is missed is better than a false one.
#include <algorithm>
#include <map>
#include <string>

#include "dspic30/core/cpu.h"
#include "dspic30/core/memory_check.h"
#include "dspic30/core/value_shape.h"

namespace dspic {

namespace {

using Use = MemoryFinding::Use;
constexpr unsigned kFirstPointer = 14;  // the frame's and the stack's always hold something

/// All bits from the lowest one up.
unsigned upwards(unsigned bits) { return bits ? ~((bits & (0u - bits)) - 1) : 0; }

}  // namespace

const MemoryCheck::Shape& MemoryCheck::shape_of(const Cpu& cpu, unsigned pc) {
  using Group = Shape::Group;
  static const std::map<std::string, std::pair<Group, bool>> kGroups = {
      {"MOV", {Group::Copy, false}},        {"MOV.B", {Group::Constant, false}},
      {"MOV.D", {Group::CopyPair, false}},  {"PUSH", {Group::Copy, false}},
      {"POP", {Group::Copy, false}},        {"AND", {Group::And, true}},
      {"IOR", {Group::Or, true}},           {"XOR", {Group::Xor, true}},
      {"COM", {Group::Xor, true}},          {"ADD", {Group::Sum, true}},
      {"ADDC", {Group::Sum, true}},         {"SUB", {Group::Sum, true}},
      {"SUBB", {Group::Sum, true}},         {"SUBR", {Group::Sum, true}},
      {"SUBBR", {Group::Sum, true}},        {"INC", {Group::Sum, true}},
      {"INC2", {Group::Sum, true}},         {"DEC", {Group::Sum, true}},
      {"DEC2", {Group::Sum, true}},         {"NEG", {Group::Sum, true}},
      {"SL", {Group::Left, true}},          {"LSR", {Group::Right, true}},
      {"ASR", {Group::Right, true}},        {"RLNC", {Group::Mix, true}},
      {"RLC", {Group::Mix, true}},          {"RRNC", {Group::Mix, true}},
      {"RRC", {Group::Mix, true}},          {"CLR", {Group::Constant, false}},
      {"SETM", {Group::Constant, false}},   {"CP", {Group::Compare, true}},
      {"CPB", {Group::Compare, true}},      {"CP0", {Group::Compare, true}},
      {"CPSEQ", {Group::Skip, false}},      {"CPSNE", {Group::Skip, false}},
      {"CPSGT", {Group::Skip, false}},      {"CPSLT", {Group::Skip, false}},
      {"SWAP", {Group::Swap, false}},       {"SE", {Group::SignExtend, true}},
      {"ZE", {Group::ZeroExtend, true}},    {"BSET", {Group::SetBit, false}},
      {"BCLR", {Group::SetBit, false}},     {"BTG", {Group::FlipBit, false}},
      {"BTST", {Group::TestBit, true}},     {"BTSTS", {Group::TestBit, true}},
      {"BTSS", {Group::SkipBit, false}},    {"BTSC", {Group::SkipBit, false}},
      {"FF1L", {Group::Mix, true}},         {"FF1R", {Group::Mix, true}},
      {"FBCL", {Group::Mix, true}},         {"MUL", {Group::Multiply, false}},
      {"MUL.UU", {Group::Multiply, false}}, {"MUL.US", {Group::Multiply, false}},
      {"MUL.SU", {Group::Multiply, false}}, {"MUL.SS", {Group::Multiply, false}},
      {"DIV.S", {Group::Divide, false}},    {"DIV.U", {Group::Divide, false}},
      {"ULNK", {Group::Unlink, false}}};
  // A shape is kept for as long as the same word stands at its address.
  std::unique_ptr<Shape>& shape = shapes_[pc];
  const std::uint32_t word = cpu.program.read(pc);
  if (shape && shape->word == word) return *shape;
  shape = std::make_unique<Shape>();
  shape->word = word;
  shape->row = find_row(word);
  if (!shape->row) return *shape;
  shape->f = fields_of(*shape->row, word);
  shape->byte = shape->f.B != 0 || shape->row->id == Insn::Mov_B_lit8_Wnd;
  const std::string mnemonic = shape->row->mnemonic;
  // Most shapes follow from the mnemonic; then come the rows that differ from others of their mnemonic.
  if (const auto found = kGroups.find(mnemonic); found != kGroups.end())
    std::tie(shape->group, shape->sets_flags) = found->second;
  if (shape->row->id == Insn::Mov_f) shape->sets_flags = true;
  if (shape->row->id == Insn::Mov_lit16_Wnd) shape->group = Group::Constant;
  if (shape->row->id == Insn::Btst_Ws_Wb) shape->group = Group::TestAnyBit;
  if (mnemonic.rfind("BRA ", 0) == 0 && mnemonic != "BRA OA" && mnemonic != "BRA OB" &&
      mnemonic != "BRA SA" && mnemonic != "BRA SB")
    shape->group = Group::Branch;
  if (shape->row->has(Operand::Accumulator)) shape->group = Group::Other;
  return *shape;
}

void MemoryCheck::depends(Use use, const Origin& origin, unsigned pc) {
  if (is_away_) return;
  MemoryFinding finding;
  finding.kind = MemoryFinding::Kind::Unwritten;
  finding.use = use;
  finding.address = origin.address;
  finding.pc = origin.pc ? origin.pc : pc;
  findings_.found(finding);
}

void MemoryCheck::before(const Cpu& cpu, const Decoded* d) {
  if (address_of_host_place(d)) return;
  const unsigned pc = cpu.address_of(d);
  // an address: told once, then it counts as written
  const Shape& shape = shape_of(cpu, pc);
  constexpr unsigned kWithIndex = 6;  // [Ws+Wb]
  const bool has_index = shape.f.g >= kWithIndex || shape.f.h >= kWithIndex;
  const unsigned uses = cpu.table().registers(d).uses | (has_index ? 1u << shape.f.w : 0u);
  for (unsigned left = unwritten_ & uses; left != 0; left &= left - 1) {
    const auto n = static_cast<unsigned>(__builtin_ctz(left));
    depends(Use::Address, origins_[n], pc);
    set_register(n, 0, false, {});
  }
  if (flags_unwritten_ && shape.group == Shape::Group::Branch) {
    depends(Use::Branch, flags_origin_, pc);
    flags_unwritten_ = false;
  }
}

void MemoryCheck::set_register(unsigned n, unsigned bits, bool byte, const Origin& origin) {
  if (n >= kFirstPointer) return;
  register_bits_[n] =
      static_cast<std::uint16_t>(byte ? (register_bits_[n] & 0xFF00) | (bits & 0xFF) : bits & 0xFFFF);
  unwritten_ = register_bits_[n] ? unwritten_ | 1u << n : unwritten_ & ~(1u << n);
  if (bits) origins_[n] = origin;
}

/// What the instruction has written to memory.
void MemoryCheck::set_written(unsigned n, unsigned bits, unsigned pc, const Origin& origin) {
  if (n >= writes_ || bits == 0) return;
  const Access& to = written_[n];
  if (to.address - kStart <= kBytes - to.bytes) {
    for (unsigned i = 0; i < to.bytes; ++i)
      bits_[to.address - kStart + i] = static_cast<std::uint8_t>(bits >> 8 * i);
  } else if (to.address < kStart && to.address >= 2 * register_bits_.size()) {
    depends(Use::Register, origin, pc);
  }
}

MemoryCheck::Value MemoryCheck::of_register(unsigned n, bool byte) const {
  const unsigned mask = byte ? 0xFF : 0xFFFF;
  return {register_bits_[n] & mask, w_[n] & mask, origins_[n]};
}

MemoryCheck::Value MemoryCheck::of_memory(unsigned n) const {
  if (n >= reads_) return {};
  return {read_[n].bits, read_[n].value, {0, read_[n].address}};
}

/// The operand that may lie in memory, of rows with one.
MemoryCheck::Value MemoryCheck::source(const Shape& shape, unsigned& reads) const {
  const Row& row = *shape.row;
  const Fields& f = shape.f;
  const bool of_byte =
      shape.byte || shape.group == Shape::Group::SignExtend || shape.group == Shape::Group::ZeroExtend;
  for (const Operand kind : row.kinds) switch (kind) {
      case Operand::File:
        if (row.id == Insn::Mov_WREG_f) break;
        return of_memory(reads++);
      case Operand::FileBit:
        return of_memory(reads++);
      case Operand::FileWord:
        if (row.id == Insn::Mov_Wns_f || row.id == Insn::Pop_f) break;
        return of_memory(reads++);
      case Operand::Source:
        return f.p == 0 ? of_register(f.s, of_byte) : of_memory(reads++);
      case Operand::SourceOffset:
        return f.g == 0 ? of_register(f.s, of_byte) : of_memory(reads++);
      case Operand::SourceLiteral:
        return of_memory(reads++);
      case Operand::Rs:
        return of_register(f.s, of_byte);
      case Operand::RsPair:
        return of_register(f.s & ~1u, false);
      default:
        break;
    }
  if (row.id == Insn::Pop_f) return of_memory(reads++);
  if (row.id == Insn::Mov_WREG_f) return of_register(0, of_byte);
  return {};
}

/// The result goes to where the row says.
void MemoryCheck::put(const Shape& shape, const Value& value, unsigned pc) {
  const Row& row = *shape.row;
  const Fields& f = shape.f;
  const bool widens = shape.group == Shape::Group::SignExtend || shape.group == Shape::Group::ZeroExtend;
  const bool byte = shape.byte && !widens;
  bool to_file = false;
  for (const Operand kind : row.kinds) switch (kind) {
      case Operand::Rd:
        return set_register(f.d, value.bits, byte, value.origin);
      case Operand::Destination:
        if (f.q == 0) return set_register(f.d, value.bits, byte, value.origin);
        return set_written(0, value.bits, pc, value.origin);
      case Operand::DestinationOffset:
        if (f.h == 0) return set_register(f.d, value.bits, byte, value.origin);
        return set_written(0, value.bits, pc, value.origin);
      case Operand::DestinationLiteral:
        return set_written(0, value.bits, pc, value.origin);
      case Operand::WregOption:
        if (f.D == 0) return set_register(0, value.bits, byte, value.origin);
        return set_written(0, value.bits, pc, value.origin);
      case Operand::Wreg:
        if (row.id == Insn::Clr_WREG || row.id == Insn::Setm_WREG)
          return set_register(0, value.bits, byte, value.origin);
        break;
      case Operand::Source:
        // bits of a register or of memory
        if (!row.has(Operand::Bit)) break;
        if (f.p == 0) return set_register(f.s, value.bits, byte, value.origin);
        return set_written(0, value.bits, pc, value.origin);
      case Operand::Rs:
        if (row.id == Insn::Swap_Wn) return set_register(f.s, value.bits, byte, value.origin);
        break;
      case Operand::File:
      case Operand::FileWord:
      case Operand::FileBit:
        to_file = true;
        break;
      default:
        break;
    }
  if (to_file) set_written(0, value.bits, pc, value.origin);
  if (row.id == Insn::Push_f) set_written(0, value.bits, pc, value.origin);
}

void MemoryCheck::set_flags(const Value& value) {
  flags_unwritten_ = value.bits != 0;
  if (flags_unwritten_) flags_origin_ = value.origin;
}

/// The second operand: a register, WREG, a literal.
MemoryCheck::Value MemoryCheck::second_operand(const Shape& shape) const {
  using Group = Shape::Group;
  const Row& row = *shape.row;
  const Fields& f = shape.f;
  if (row.has(Operand::Wb)) return of_register(f.w, shape.byte);
  if (row.id == Insn::Add_lit10_Wn || row.id == Insn::Addc_lit10_Wn || row.id == Insn::Sub_lit10_Wn ||
      row.id == Insn::Subb_lit10_Wn || row.id == Insn::And_lit10_Wn || row.id == Insn::Ior_lit10_Wn ||
      row.id == Insn::Xor_lit10_Wn)
    return of_register(f.d, shape.byte);
  if (row.has(Operand::File) && row.has(Operand::WregOption) &&
      (shape.group == Group::And || shape.group == Group::Or || shape.group == Group::Xor ||
       (shape.group == Group::Sum && row.id != Insn::Inc_f && row.id != Insn::Inc2_f &&
        row.id != Insn::Dec_f && row.id != Insn::Dec2_f && row.id != Insn::Neg_f)) &&
      row.id != Insn::Com_f)
    return of_register(0, shape.byte);
  if (row.id == Insn::Cp_f || row.id == Insn::Cpb_f || row.id == Insn::Mul_f)
    return of_register(0, shape.byte);
  return {};
}

/// Two words, from registers or memory to the other.
void MemoryCheck::copy_pair(const Shape& shape, unsigned pc) {
  const Row& row = *shape.row;
  const Fields& f = shape.f;
  Value a;
  Value high;
  if (row.id == Insn::Mov_D_Wns_Wd || f.p == 0) {
    const unsigned s = f.s * (row.has(Operand::RsPair) ? 2 : 1);
    a = of_register(s & 14, false), high = of_register((s & 14) + 1, false);
  } else {
    a = of_memory(0), high = of_memory(1);
    a.origin.pc = high.origin.pc = pc;
  }
  if (row.id == Insn::Mov_D_Ws_Wnd || f.q == 0) {
    const unsigned to = (row.has(Operand::RdPair) ? 2 * f.d : f.d) & 14;
    set_register(to, a.bits, false, a.origin);
    set_register(to + 1, high.bits, false, high.origin);
  } else {
    set_written(0, a.bits, pc, a.origin);
    set_written(1, high.bits, pc, high.origin);
  }
}

/// Of a shift left or right: what is unwritten moves along.
unsigned MemoryCheck::shifted(const Shape& shape, const Value& a, const Value& b) const {
  using Group = Shape::Group;
  const Row& row = *shape.row;
  const unsigned all = shape.byte ? 0xFF : 0xFFFF;
  const bool is_left = shape.group == Group::Left;
  unsigned by = 1, bits = a.bits;
  if (row.has(Operand::Wb)) {
    bits = b.bits;
    by = row.has(Operand::Rs) ? of_register(shape.f.s, false).value & 31 : shape.f.k;
    if (row.has(Operand::Rs) && a.bits) bits = all;
  }
  const bool keeps_sign = !is_left && row.mnemonic[0] == 'A';
  const unsigned sign = shape.byte ? 0x80 : 0x8000;
  unsigned result = (is_left ? bits << std::min(by, 16u) : bits >> std::min(by, 16u)) & all;
  if (keeps_sign && (bits & sign)) result |= all & ~(all >> std::min(by, 16u));
  return result;
}

/// Of one bit: set, flipped, tested, skipped on.
void MemoryCheck::finish_bit(const Shape& shape, const Value& a, unsigned pc) {
  using Group = Shape::Group;
  const Row& row = *shape.row;
  const Fields& f = shape.f;
  Value result;
  result.origin = a.origin;
  const bool of_word = row.has(Operand::FileBit) && reads_ > 0 && read_[0].bytes == 2;
  const unsigned bit = 1u << (f.b + (of_word ? 8 * (f.f & 1) : 0));
  if (shape.group == Group::SkipBit) {
    if (a.bits & bit) depends(Use::Branch, a.origin, pc);
    return;
  }
  if (shape.group == Group::TestBit) {
    set_flags({a.bits & bit, 0, a.origin});
    if (row.id != Insn::Btsts_f_bit && row.id != Insn::Btsts_Ws_bit4) return;
  }
  result.bits = shape.group == Group::FlipBit ? a.bits : a.bits & ~bit;
  return put(shape, result, pc);
}

/// A product of two words lies in two registers.
void MemoryCheck::multiplied(const Shape& shape, unsigned either, const Origin& origin) {
  const Row& row = *shape.row;
  const Fields& f = shape.f;
  const unsigned bits = either ? 0xFFFF : 0;
  const unsigned to = row.id == Insn::Mul_f ? 2 : row.has(Operand::RdPair) ? (2 * f.d) & 14 : f.d & 14;
  set_register(to, bits, false, origin);
  if (row.id != Insn::Mul_f || !shape.byte) set_register(to + 1, bits, false, origin);
}

// the instruction that was under way is through
void MemoryCheck::finish(const Cpu& cpu) {
  using Group = Shape::Group;
  const Decoded* const d = at_;
  if (!d) return;
  // A function of the host gives W0 to W7 back as C's functions do: they count as written.
  if (address_of_host_place(d)) {
    for (unsigned n = 0; n < 8; ++n) set_register(n, 0, false, {});
    return;
  }
  const unsigned pc = cpu.address_of(d);
  const Shape& shape = shape_of(cpu, pc);
  if (!shape.row) return;
  const Row& row = *shape.row;
  const Fields& f = shape.f;
  const unsigned all = shape.byte ? 0xFF : 0xFFFF;
  unsigned reads = 0;
  // One operand. Where memory was read that nobody wrote, this instruction is the one to be told.
  Value a = source(shape, reads);
  if (a.bits && a.origin.pc == 0) a.origin.pc = pc;
  const Value b = second_operand(shape);
  if (row.has(Operand::Literal)) a.value = f.k;
  // Which bits of the result depend on bits that nobody wrote.
  Value result;
  result.origin = a.bits ? a.origin : b.origin;
  const unsigned either = a.bits | b.bits;
  switch (shape.group) {
    case Group::Copy:
      result.bits = a.bits;
      break;
    case Group::CopyPair:
      return copy_pair(shape, pc);
    case Group::And:
      result.bits = ((a.bits & b.bits) | (a.bits & b.value) | (b.bits & a.value)) & all;
      break;
    // a bit that is known to be 1 on one side makes the result known
    case Group::Or:
      result.bits = ((a.bits & b.bits) | (a.bits & ~b.value) | (b.bits & ~a.value)) & all;
      break;
    case Group::Xor:
      result.bits = either;
      break;
    // a carry may reach every bit above the lowest unwritten one
    case Group::Sum:
      result.bits = upwards(either) & all;
      break;
    case Group::Left:
    case Group::Right:
      result.bits = shifted(shape, a, b);
      break;
    case Group::Mix:
      result.bits = either ? all : 0;
      break;
    case Group::SignExtend:
      result.bits = a.bits & 0x80 ? a.bits | 0xFF00 : a.bits;
      break;
    case Group::ZeroExtend:
      result.bits = a.bits & 0xFF;
      break;
    case Group::Swap: {
      const unsigned bits = register_bits_[f.s];
      result.origin = origins_[f.s];
      result.bits = shape.byte ? (bits << 4 | (bits >> 4 & 0xF)) & 0xFF : (bits << 8 | bits >> 8) & 0xFFFF;
      break;
    }
    case Group::Constant:
      break;
    case Group::SetBit:
    case Group::FlipBit:
    case Group::TestBit:
    case Group::SkipBit:
      return finish_bit(shape, a, pc);
    case Group::TestAnyBit:
      return set_flags({either, 0, result.origin});
    case Group::Compare:
      if (row.mnemonic[2] == 'B' && flags_unwritten_) return;
      return set_flags({either, 0, result.origin});
    case Group::Skip: {
      const Value other = of_register(f.s, shape.byte);
      if (other.bits | b.bits) depends(Use::Branch, other.bits ? other.origin : b.origin, pc);
      return;
    }
    case Group::Multiply:
      return multiplied(shape, either, result.origin);
    case Group::Divide:
      set_register(0, 0, false, {});
      set_register(1, 0, false, {});
      return set_flags({});
    case Group::Branch:
      return;
    case Group::Unlink:
    case Group::Other:
      // whatever it gives counts as written
      for (const Operand kind : row.kinds)
        if (kind == Operand::Rd || (kind == Operand::Destination && f.q == 0) ||
            (kind == Operand::DestinationOffset && f.h == 0))
          set_register(f.d, 0, false, {});
      if (cpu.table().registers(d).flags == WordRegisters::Flags::SetsAll) set_flags({});
      if (row.id == Insn::Pop_S)
        for (unsigned n = 0; n < 4; ++n) set_register(n, 0, false, {});
      if (row.id == Insn::Exch_Wns_Wnd) {
        const Value s = of_register(f.s, false), other = of_register(f.d, false);
        set_register(f.d, s.bits, false, s.origin);
        set_register(f.s, other.bits, false, other.origin);
      }
      return;
  }
  if (shape.sets_flags) set_flags(result);
  put(shape, result, pc);
}

}  // namespace dspic
