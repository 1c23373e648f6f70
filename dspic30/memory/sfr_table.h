// SPDX-License-Identifier: MIT
// The chip's registers by address: name, implemented bits, reset value, fields. Generated rows (sfr_rows.inc)
// from device/sfr.csv; a register with a second name (C1RERRCNT) is listed under its first one.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

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

inline constexpr SfrInfo kSfrRows[] = {
#include "dspic30/memory/sfr_rows.inc"
};

namespace detail {
[[noreturn]] void no_such_register();  // aborts; no constant calls it
}

/// Address of the register of that name, for constants.
constexpr unsigned sfr(std::string_view name) {
  for (const SfrInfo& row : kSfrRows)
    if (name == row.name) return row.address;
  detail::no_such_register();
  return 0;
}

/// Bits that exist, by word; 0 where nothing is.
inline constexpr auto kSfrImplemented = [] {
  std::array<std::uint16_t, kSfrBytes / 2> bits{};
  for (const SfrInfo& row : kSfrRows) bits[row.address / 2] = row.implemented;
  return bits;
}();

namespace detail {
constexpr unsigned decimal(std::string_view digits) {
  unsigned value = 0;
  for (const char digit : digits) value = 10 * value + static_cast<unsigned>(digit - '0');
  return value;
}
constexpr std::string_view fields_of(std::string_view name) {
  for (const SfrInfo& row : kSfrRows)
    if (name == row.name) return row.fields;
  no_such_register();
  return {};
}
}  // namespace detail

/// Where a field lies in its register, and what it holds.
struct SfrBits {
  std::uint16_t mask = 0;
  int lowest = 0;
  constexpr unsigned of(unsigned word) const { return (word & mask) >> lowest; }
};

/// Field of a register by the table's names, for constants: what the models know of bits is from here.
constexpr SfrBits sfr_field(std::string_view name, std::string_view field) {
  for (std::string_view rest = detail::fields_of(name); !rest.empty();) {
    const std::string_view one = rest.substr(0, rest.find(' '));
    rest.remove_prefix(one.size() < rest.size() ? one.size() + 1 : one.size());
    const auto first = one.find(':'), second = one.find(':', first + 1);
    if (one.substr(0, first) != field) continue;
    const unsigned lowest = detail::decimal(one.substr(first + 1, second - first - 1)),
                   width = detail::decimal(one.substr(second + 1));
    return {static_cast<std::uint16_t>(((1u << width) - 1) << lowest), static_cast<int>(lowest)};
  }
  detail::no_such_register();
  return {};
}
/// All bits of these fields.
template <class... Fields>
constexpr std::uint16_t sfr_bits(std::string_view name, Fields... fields) {
  return static_cast<std::uint16_t>((sfr_field(name, fields).mask | ...));
}

/// Register at a byte address (the odd byte belongs to its word); null where nothing is.
const SfrInfo* sfr_info(unsigned address);
/// Register of that name; null for unknown ones.
const SfrInfo* sfr_named(const std::string& name);
/// A field: bits `bit` to `bit + width - 1`.
struct SfrField {
  std::string name;
  int bit = 0, width = 0;
};
/// In the table's order; none where no field is named.
std::vector<SfrField> fields_of(const SfrInfo& info);
/// "U1MODE.LPBACK", "TCKPS1" style for fields of several bits ("T1CON.TCKPS"), "PR1.3"
/// where no field is named.
std::string sfr_bit_name(const SfrInfo& info, int bit);

}  // namespace dspic
