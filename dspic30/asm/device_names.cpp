// SPDX-License-Identifier: MIT
#include "dspic30/asm/device_names.h"

#include <map>

#include "dspic30/asm/expression.h"
#include "dspic30/memory/program_memory.h"
#include "dspic30/memory/sfr_table.h"

namespace dspic::assembly {

namespace {

constexpr struct {
  const char* name;
  std::int64_t value;
} kConfigurationValues[] = {
#include "dspic30/asm/configuration_values.inc"
};

// a name that several registers have is the first one's
std::map<std::string, std::int64_t> make_constants() {
  std::map<std::string, std::int64_t> all;
  for (const auto& [name, value] : kConfigurationValues) all.emplace(name, value);
  for (const SfrInfo& info : kSfrRows)
    for (const SfrField& field : fields_of(info)) {
      all.emplace(field.name, field.bit);
      for (int n = 0; field.width > 1 && n < field.width; ++n)
        all.emplace(field.name + std::to_string(n), field.bit + n);
    }
  return all;
}

}  // namespace

bool is_device_file(const std::string& name) {
  std::string bare = lower(name);
  if (const std::size_t slash = bare.find_last_of("/\\"); slash != std::string::npos)
    bare = bare.substr(slash + 1);
  return bare == "p30f6014a.inc" || bare == "p30f6014.inc" || bare == "p30fxxxx.inc" || bare == "xc.inc";
}

bool device_constant(const std::string& name, std::int64_t& value) {
  static const std::map<std::string, std::int64_t> constants = make_constants();
  const auto found = constants.find(name);
  if (found == constants.end()) return false;
  value = found->second;
  return true;
}

std::uint32_t configuration_address(const std::string& word) {
  static constexpr const char* kNames[kConfigurationWords] = {"FOSC", "FWDT", "FBORPOR", "FBS",
                                                              "FSS",  "FGS",  "FICD"};
  for (std::uint32_t i = 0; i < kConfigurationWords; ++i)
    if (word == std::string("__") + kNames[i]) return kConfigurationStart + 2 * i;
  return 0;
}

}  // namespace dspic::assembly
