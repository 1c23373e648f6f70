// SPDX-License-Identifier: MIT
// The DSP engine: accumulators of 40 bits, products of W4 to W7, prefetches, rounding and saturation. imm
// holds the instruction's word. An accumulator is kept sign-extended.
//
//   39      32 31              16 15               0
//   [ guard   ][ high            ][ low             ]      SAC stores the high word
//
// Doubts: CLR leaves SA and SB as they are (sticky); with both prefetches into one register Y's stays.
#include "dspic30/core/operands.h"

namespace dspic {

namespace {

constexpr unsigned kIntcon1 = sfr("INTCON1");
constexpr unsigned kOvate = sfr_bits("INTCON1", "OVATE"), kOvbte = sfr_bits("INTCON1", "OVBTE"),
                   kCovte = sfr_bits("INTCON1", "COVTE");
constexpr std::uint16_t kInteger = sfr_bits("CORCON", "IF"), kRound = sfr_bits("CORCON", "RND"),
                        kSuperSaturation = sfr_bits("CORCON", "ACCSAT"),
                        kSaturateStores = sfr_bits("CORCON", "SATDW"),
                        kSaturateB = sfr_bits("CORCON", "SATB"), kSaturateA = sfr_bits("CORCON", "SATA"),
                        kUnsigned = sfr_bits("CORCON", "US");
constexpr std::int64_t kMost31 = 0x7FFFFFFF, kLeast31 = -kMost31 - 1, kMost39 = 0x7FFFFFFFFF,
                       kLeast39 = -kMost39 - 1;
constexpr int kMostAccumulatorShift = 16;

std::int64_t wrapped_40(std::int64_t v) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(v) << 24) >> 24;
}

// --- results

// saturation, flags and traps of a result of any width
void put_accumulator(Cpu& cpu, unsigned a, std::int64_t v, bool saturation_flags = true) {
  const bool saturates = (cpu.corcon & (a ? kSaturateB : kSaturateA)) != 0;
  const bool wide = !saturates || (cpu.corcon & kSuperSaturation);
  const std::int64_t most = wide ? kMost39 : kMost31, least = wide ? kLeast39 : kLeast31;
  const bool beyond = v > most || v < least;
  if (beyond) v = saturates ? (v > most ? most : least) : wrapped_40(v);
  bool& overflow = a ? cpu.ob : cpu.oa;
  overflow = v > kMost31 || v < kLeast31;
  if (beyond && saturation_flags) (a ? cpu.sb : cpu.sa) = true;
  cpu.acc[a] = v;
  if (!overflow && !beyond) return;
  const unsigned enabled = cpu.parts.bus.peek(kIntcon1, cpu.now);
  if ((overflow && (enabled & (a ? kOvbte : kOvate))) || (beyond && !saturates && (enabled & kCovte)))
    cpu.trap(Trap::MathError);
}

std::int64_t product(const Cpu& cpu, unsigned x, unsigned y) {
  std::int64_t p =
      (cpu.corcon & kUnsigned) ? std::int64_t{x} * y : std::int64_t{sign_extend(x, 16)} * sign_extend(y, 16);
  if (!(cpu.corcon & kInteger)) p *= 2;
  return p;
}

// positive: to the right
std::int64_t shifted(std::int64_t v, int right) {
  return right >= 0 ? v >> right : v * (std::int64_t{1} << -right);
}

unsigned stored(const Cpu& cpu, std::int64_t v, bool round) {
  if (round) {
    const bool tie = (v & 0xFFFF) == 0x8000;
    if (!tie || (cpu.corcon & kRound) || (v & 0x10000)) v += 0x8000;
  }
  if ((cpu.corcon & kSaturateStores) && v > kMost31) return 0x7FFF;
  if ((cpu.corcon & kSaturateStores) && v < kLeast31) return 0x8000;
  return static_cast<unsigned>(v >> 16) & 0xFFFF;
}

// --- prefetch and write back

unsigned fetched(Cpu& cpu, const PrefetchMode& mode, bool y_space) {
  const auto n = static_cast<unsigned>(mode.pointer);
  unsigned ea = cpu.w[n];
  if (mode.by_index) ea = stepped(cpu, n, ea, sign_extend(cpu.w[12], 16), y_space);
  if (!mode.by_index && mode.step)
    cpu.w[n] = static_cast<std::uint16_t>(stepped(cpu, n, ea, mode.step, y_space));
  const bool in_y = ea >= Cpu::kYStart && ea < Cpu::kRamEnd;
  if (y_space != in_y && (y_space || in_y)) return 0;
  return cpu.read16(ea);
}

struct Prefetch {
  unsigned word;
  PrefetchMode x() const { return prefetch_mode(word >> 6 & 15, false); }
  PrefetchMode y() const { return prefetch_mode(word >> 2 & 15, true); }
  unsigned x_target() const { return 4 + (word >> 12 & 3); }
  unsigned y_target() const { return 4 + (word >> 10 & 3); }
  unsigned accumulator() const { return word >> 15 & 1; }
};

void prefetch(Cpu& cpu, const Prefetch& p) {
  const PrefetchMode x = p.x(), y = p.y();
  if (x.on) {
    const unsigned value = fetched(cpu, x, false);
    cpu.w[p.x_target()] = static_cast<std::uint16_t>(value);
  }
  if (y.on) cpu.w[p.y_target()] = static_cast<std::uint16_t>(fetched(cpu, y, true));
}

void write_back(Cpu& cpu, const Prefetch& p) {
  const unsigned code = p.word & 3, other = 1 - p.accumulator();
  if (code > 1) return;
  const unsigned value = stored(cpu, cpu.acc[other], true);
  if (code == 0) {
    cpu.w[13] = static_cast<std::uint16_t>(value);
  } else {
    cpu.write16(cpu.w[13], value);
    cpu.w[13] = static_cast<std::uint16_t>(cpu.w[13] + 2);
  }
}

// --- products

enum class Into { Sum, Difference, Product, Negated };

template <Into How, bool Square, bool WriteBack>
const Decoded* multiply(Cpu& cpu, const Decoded* d) {
  const Prefetch p{static_cast<unsigned>(d->imm)};
  int m = 4 + static_cast<int>(p.word >> 16 & 3), n = m;
  if (!Square) product_registers(p.word >> 16 & 7, m, n);
  const std::int64_t value =
      product(cpu, cpu.w[static_cast<std::size_t>(m)], cpu.w[static_cast<std::size_t>(n)]);
  const unsigned a = p.accumulator();
  if (WriteBack) write_back(cpu, p);
  prefetch(cpu, p);
  switch (How) {
    case Into::Sum:
      put_accumulator(cpu, a, cpu.acc[a] + value);
      break;
    case Into::Difference:
      put_accumulator(cpu, a, cpu.acc[a] - value);
      break;
    case Into::Product:
      put_accumulator(cpu, a, value);
      break;
    default:
      put_accumulator(cpu, a, -value, false);
  }
  return d + 1;
}

template <bool Adds>
const Decoded* euclidean_distance(Cpu& cpu, const Decoded* d) {
  const Prefetch p{static_cast<unsigned>(d->imm)};
  const unsigned a = p.accumulator(), factor = cpu.w[4 + (p.word >> 16 & 3)];
  const std::int64_t square = product(cpu, factor, factor);
  const unsigned x = fetched(cpu, p.x(), false), y = fetched(cpu, p.y(), true);
  cpu.w[p.x_target()] = static_cast<std::uint16_t>(x - y);
  put_accumulator(cpu, a, (Adds ? cpu.acc[a] : 0) + square);
  return d + 1;
}

template <bool Clears>
const Decoded* clear_or_move(Cpu& cpu, const Decoded* d) {
  const Prefetch p{static_cast<unsigned>(d->imm)};
  write_back(cpu, p);
  prefetch(cpu, p);
  if (Clears) put_accumulator(cpu, p.accumulator(), 0);
  return d + 1;
}

// --- accumulators alone

const Decoded* add_accumulators(Cpu& cpu, const Decoded* d) {
  put_accumulator(cpu, d->imm >> 15 & 1, cpu.acc[0] + cpu.acc[1]);
  return d + 1;
}
const Decoded* subtract_accumulators(Cpu& cpu, const Decoded* d) {
  const unsigned a = d->imm >> 15 & 1;
  put_accumulator(cpu, a, cpu.acc[a] - cpu.acc[1 - a]);
  return d + 1;
}
const Decoded* negate_accumulator(Cpu& cpu, const Decoded* d) {
  const unsigned a = d->imm >> 15 & 1;
  put_accumulator(cpu, a, -cpu.acc[a]);
  return d + 1;
}

const Decoded* shift_by(Cpu& cpu, const Decoded* d, int right) {
  if (right < -kMostAccumulatorShift || right > kMostAccumulatorShift) {
    cpu.trap(Trap::MathError);
    return d + 1;
  }
  const unsigned a = d->imm >> 15 & 1;
  put_accumulator(cpu, a, shifted(cpu.acc[a], right));
  return d + 1;
}
const Decoded* shift_literal(Cpu& cpu, const Decoded* d) {
  return shift_by(cpu, d, sign_extend(static_cast<unsigned>(d->imm), 6));
}
const Decoded* shift_register(Cpu& cpu, const Decoded* d) {
  return shift_by(cpu, d, sign_extend(cpu.w[d->s], 16));
}

// --- loads and stores; shift in bits 10:7

int slit4(const Decoded* d) { return sign_extend(static_cast<unsigned>(d->imm) >> 7, 4); }

// modes of bits 6:4: register, memory, [W+Wb]
unsigned mode(const Decoded* d) { return static_cast<unsigned>(d->imm) >> 4 & 7; }

unsigned indexed(Cpu& cpu, unsigned n, const Decoded* d) {
  return stepped(cpu, n, cpu.w[n], sign_extend(cpu.w[d->b], 16), false);
}

template <bool Adds>
const Decoded* load(Cpu& cpu, const Decoded* d) {
  const unsigned value = mode(d) == 0  ? cpu.w[d->s]
                         : mode(d) < 6 ? cpu.read16(source_address(cpu, d))
                                       : cpu.read16(indexed(cpu, d->s, d));
  const unsigned a = d->imm >> 15 & 1;
  put_accumulator(
      cpu, a, (Adds ? cpu.acc[a] : 0) + shifted(std::int64_t{sign_extend(value, 16)} * 0x10000, slit4(d)));
  return d + 1;
}
template <bool Rounds>
const Decoded* store(Cpu& cpu, const Decoded* d) {
  const unsigned value = stored(cpu, shifted(cpu.acc[d->imm >> 15 & 1], slit4(d)), Rounds);
  if (mode(d) == 0)
    operands::put_register<false>(cpu, d, value);
  else
    cpu.write16(mode(d) < 6 ? destination_address(cpu, d) : indexed(cpu, d->d, d), value);
  return d + 1;
}

}  // namespace

// The function of each instruction of the DSP engine; null: it is none of them.
Run choose_dsp(Insn id, const Fields&) {
  switch (id) {
    case Insn::Add_Acc:
      return &add_accumulators;
    case Insn::Sub_Acc:
      return &subtract_accumulators;
    case Insn::Neg_Acc:
      return &negate_accumulator;
    case Insn::Add_Wso_slit4_Acc:
      return &load<true>;
    case Insn::Lac_Wso_slit4_Acc:
      return &load<false>;
    case Insn::Sac_Acc_slit4_Wdo:
      return &store<false>;
    case Insn::Sac_R_Acc_slit4_Wdo:
      return &store<true>;
    case Insn::Sftac_Acc_slit6:
      return &shift_literal;
    case Insn::Sftac_Acc_Wb:
      return &shift_register;
    case Insn::Clr_Acc_prefetch:
      return &clear_or_move<true>;
    case Insn::Movsac_Acc_prefetch:
      return &clear_or_move<false>;
    case Insn::Mac_WmWn_Acc:
      return &multiply<Into::Sum, false, true>;
    case Insn::Msc_WmWn_Acc:
      return &multiply<Into::Difference, false, true>;
    case Insn::Mpy_WmWn_Acc:
      return &multiply<Into::Product, false, false>;
    case Insn::Mpy_N_WmWn_Acc:
      return &multiply<Into::Negated, false, false>;
    case Insn::Mac_WmWm_Acc:
      return &multiply<Into::Sum, true, false>;
    case Insn::Mpy_WmWm_Acc:
      return &multiply<Into::Product, true, false>;
    case Insn::Ed_WmWm_Acc_Wx_Wy_Wxd:
      return &euclidean_distance<false>;
    case Insn::Edac_WmWm_Acc_Wx_Wy_Wxd:
      return &euclidean_distance<true>;
    default:
      return nullptr;
  }
}

}  // namespace dspic
