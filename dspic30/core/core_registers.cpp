// SPDX-License-Identifier: MIT
#include "dspic30/core/core_registers.h"

#include <algorithm>

#include "dspic30/core/cpu.h"
#include "dspic30/core/pointers.h"

namespace dspic {

namespace {

constexpr unsigned kSplim = sfr("SPLIM"), kAccal = sfr("ACCAL"), kAccbu = sfr("ACCBU"), kPcl = sfr("PCL"),
                   kPch = sfr("PCH"), kTblpag = sfr("TBLPAG"), kPsvpag = sfr("PSVPAG"),
                   kRcount = sfr("RCOUNT"), kDcount = sfr("DCOUNT"), kDostartl = sfr("DOSTARTL"),
                   kDostarth = sfr("DOSTARTH"), kDoendl = sfr("DOENDL"), kDoendh = sfr("DOENDH"),
                   kSr = sfr("SR"), kCorcon = sfr("CORCON"), kModcon = sfr("MODCON"),
                   kXmodsrt = sfr("XMODSRT"), kYmodend = sfr("YMODEND"), kXbrev = sfr("XBREV"),
                   kDisicnt = sfr("DISICNT");
constexpr SfrBits kDl = sfr_field("CORCON", "DL");
constexpr std::uint16_t kIpl3 = sfr_bits("CORCON", "IPL3"), kEdt = sfr_bits("CORCON", "EDT"),
                        kCorconKept = 0xFFFF & ~(kIpl3 | kDl.mask | kEdt);

void set_low(unsigned& address, unsigned value) { address = (address & 0x7F0000) | (value & 0xFFFE); }
void set_high(unsigned& address, unsigned value) { address = (address & 0xFFFF) | (value & 0x7F) << 16; }

}  // namespace

std::uint16_t CoreRegisters::peek(unsigned address, Cycle when) const {
  if (address < kSplim) return cpu_.w[address / 2];
  if (address >= kAccal && address <= kAccbu) {
    const std::int64_t a = cpu_.acc[(address - kAccal) / 6];
    return static_cast<std::uint16_t>(a >> 8 * ((address - kAccal) % 6));
  }
  if (address >= kXmodsrt && address <= kYmodend) return cpu_.modulo[(address - kXmodsrt) / 2];
  const unsigned pc = cpu_.address_of(cpu_.next);
  switch (address) {
    case kSplim:
      return cpu_.splim;
    case kPcl:
      return static_cast<std::uint16_t>(pc);
    case kPch:
      return static_cast<std::uint16_t>(pc >> 16);
    case kTblpag:
      return cpu_.tblpag;
    case kPsvpag:
      return cpu_.psvpag;
    case kRcount:
      return cpu_.rcount;
    case kDcount:
      return static_cast<std::uint16_t>(cpu_.loop.count);
    case kDostartl:
      return static_cast<std::uint16_t>(cpu_.loop.start);
    case kDostarth:
      return static_cast<std::uint16_t>(cpu_.loop.start >> 16);
    case kDoendl:
      return static_cast<std::uint16_t>(cpu_.loop.end);
    case kDoendh:
      return static_cast<std::uint16_t>(cpu_.loop.end >> 16);
    case kSr:
      return static_cast<std::uint16_t>(cpu_.sr());
    case kCorcon:
      return static_cast<std::uint16_t>(cpu_.corcon | (cpu_.parts.interrupts.cpu().level() > 7 ? kIpl3 : 0) |
                                        cpu_.loop_depth << kDl.lowest);
    case kModcon:
      return cpu_.modcon;
    case kXbrev:
      return cpu_.xbrev;
    case kDisicnt:
      return static_cast<std::uint16_t>(
          std::clamp<Cycle>(cpu_.parts.interrupts.cpu().disi_until() - when, 0, kMostDisi));
    default:
      return 0;
  }
}

Cycle CoreRegisters::horizon(unsigned address, Cycle when) const {
  return address == kDisicnt && cpu_.parts.interrupts.cpu().disi_active(when) ? when + 1 : kNever;
}

void CoreRegisters::write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle when) {
  const std::uint16_t wanted = merge_lanes(peek(address, when), value, lanes);
  if (address < kSplim) {
    cpu_.w[address / 2] = address == 0x1E ? wanted & 0xFFFE : wanted;
    if (lanes == 0xFFFF) cpu_.note_written(1u << address / 2);
    return;
  }
  if (address >= kAccal && address <= kAccbu) {
    std::int64_t& a = cpu_.acc[(address - kAccal) / 6];
    const unsigned shift = 8 * ((address - kAccal) % 6);
    const std::uint64_t mask = std::uint64_t{shift == 32 ? 0xFFu : 0xFFFFu} << shift;
    const std::uint64_t bits =
        (static_cast<std::uint64_t>(a) & ~mask) | ((std::uint64_t{wanted} << shift) & mask);
    a = static_cast<std::int64_t>(bits << 24) >> 24;
    return;
  }
  switch (address) {
    case kSplim:
      cpu_.splim = wanted;
      cpu_.splim_on |= lanes == 0xFFFF;
      if (cpu_.splim_on) cpu_.stack_most = cpu_.splim;
      break;
    case kTblpag:
      cpu_.tblpag = wanted;
      break;
    case kPsvpag:
      cpu_.psvpag = wanted;
      cpu_.window_words = nullptr;
      break;
    case kRcount:
      cpu_.rcount = wanted;
      break;
    case kDcount:
      cpu_.loop.count = wanted;
      break;
    case kDostartl:
      set_low(cpu_.loop.start, wanted);
      break;
    case kDostarth:
      set_high(cpu_.loop.start, wanted);
      break;
    case kDoendl:
      set_low(cpu_.loop.end, wanted);
      cpu_.find_loop_end();
      break;
    case kDoendh:
      set_high(cpu_.loop.end, wanted);
      cpu_.find_loop_end();
      break;
    case kSr:
      cpu_.set_sr(value, lanes);
      break;
    case kCorcon:
      cpu_.corcon = wanted & kCorconKept;
      cpu_.window_words = nullptr;
      if ((lanes & kIpl3) && !(value & kIpl3) && cpu_.parts.interrupts.cpu().level() > 7)
        cpu_.parts.interrupts.set_level(cpu_.parts.interrupts.cpu().level() & 7, when);
      cpu_.end_loop |= (value & kEdt) && cpu_.loop_depth > 0;
      cpu_.deadline = 0;
      break;
    case kDisicnt:
      cpu_.parts.interrupts.disi(wanted, when);
      cpu_.deadline = 0;
      break;
    default: {
      if (address == kPcl || address == kPch) break;
      // the modulo and bit-reversed pointers decide which table the code runs on
      const auto special = special_registers(cpu_);
      if (address == kModcon) cpu_.modcon = wanted;
      if (address == kXbrev) cpu_.xbrev = wanted;
      if (address >= kXmodsrt && address <= kYmodend)
        cpu_.modulo[(address - kXmodsrt) / 2] = address & 2 ? wanted | 1 : wanted & 0xFFFE;
      if (special == special_registers(cpu_)) break;
      cpu_.code_is_stale = true;
      cpu_.deadline = 0;
    }
  }
}

}  // namespace dspic
