// SPDX-License-Identifier: MIT
// What an assembler program may name without having defined it: what the vendor's p30f6014A.inc would define.
#pragma once
#include <cstdint>
#include <string>

namespace dspic::assembly {

/// Is it that file, or another that the vendor's assembler brings, by its name in .include?
bool is_device_file(const std::string& name);
/// A bit's number by a field's name, "URXISEL", or by the bit's own, "URXISEL1"; or a configuration word's
/// part, "XT_PLL8". False: it is none.
bool device_constant(const std::string& name, std::int64_t& value);
/// Where the configuration word lies that `config` calls "__FOSC"; 0: there is none of that name.
std::uint32_t configuration_address(const std::string& word);

}  // namespace dspic::assembly
