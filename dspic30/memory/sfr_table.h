// SPDX-License-Identifier: MIT
// The chip's registers by address: name, implemented bits, reset value, fields. Generated rows (sfr_rows.inc)
// from device/sfr.csv; a register with a second name (C1RERRCNT) is listed under its first one.
#pragma once
#include <cstdint>
#include <string>

namespace dspic {

inline constexpr unsigned kSfrBytes = 0x800;

struct SfrInfo {
  std::uint16_t address;
  const char* name;
  std::uint16_t implemented;  ///< bits that exist; the others read 0
  std::uint16_t reset;        ///< value at power-on
  bool defined;               ///< false: the chip comes up with anything; here 0
  const char* fields;         ///< "TCS:1:1 TSYNC:2:1 ...": name, lowest bit, width
};

/// Register at a byte address (the odd byte belongs to its word); null where nothing is.
const SfrInfo* sfr_info(unsigned address);
/// Register of that name; null for unknown ones.
const SfrInfo* sfr_named(const std::string& name);
/// All registers in the order of their addresses.
const SfrInfo* sfr_begin();
const SfrInfo* sfr_end();
/// "U1MODE.LPBACK", "TCKPS1" style for fields of several bits ("T1CON.TCKPS"), "PR1.3" where no field is
/// named.
std::string sfr_bit_name(const SfrInfo& info, int bit);

}  // namespace dspic
