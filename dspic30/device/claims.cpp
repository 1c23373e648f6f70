// SPDX-License-Identifier: MIT
#include "dspic30/device/claims.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "dspic30/memory/sfr_table.h"

namespace dspic {

namespace {

// the module that a set-up register belongs to; empty for other registers
std::string resource_of(const std::string& name) {
  const auto ends = [&](const char* tail) {
    const std::string t = tail;
    return name.size() > t.size() && name.compare(name.size() - t.size(), t.size(), t) == 0;
  };
  if (name.size() == 5 && name[0] == 'T' && ends("CON")) return name.substr(0, 2);
  if (name.size() == 3 && name[0] == 'P' && name[1] == 'R') return "T" + name.substr(2);
  if (name == "ADCON1" || name == "ADCON2" || name == "ADCON3" || name == "ADCSSL") return "ADC";
  if (name[0] == 'U' && (ends("MODE") || ends("BRG"))) return name.substr(0, 2);
  if (name == "I2CBRG") return "I2C";
  if (name.compare(0, 6, "DCICON") == 0) return "DCI";
  if (name.compare(0, 3, "SPI") == 0 && ends("CON")) return name.substr(0, 4);
  if ((name.compare(0, 2, "IC") == 0 || name.compare(0, 2, "OC") == 0) && ends("CON"))
    return name.substr(0, 3);
  return "";
}

struct Resources {
  std::vector<std::string> names;
  std::array<std::int8_t, kSfrBytes / 2> at{};  // index of names by word; -1 none
};

Resources list_resources() {
  Resources all;
  all.at.fill(-1);
  for (const SfrInfo* info = sfr_begin(); info != sfr_end(); ++info) {
    const std::string name = resource_of(info->name);
    if (name.empty()) continue;
    const auto found = std::find(all.names.begin(), all.names.end(), name);
    all.at[info->address / 2] = static_cast<std::int8_t>(found - all.names.begin());
    if (found == all.names.end()) all.names.push_back(name);
  }
  return all;
}

const Resources& resources() {
  static const Resources all = list_resources();
  return all;
}

}  // namespace

void Claims::claim(std::size_t resource, const std::string& name, Cycle now) {
  const char*& owner = owners_[resource];
  if (owner && owner != author_ && std::strcmp(owner, author_) != 0)
    diagnostics_.report(
        Cause::TwoAuthors, name,
        name + " is set up by " + owner + " and by " + author_ + "; one of them will not work as it expects",
        now);
  owner = author_;
}

void Claims::claim_register(unsigned address, Cycle now) {
  if (address >= kSfrBytes) return;
  const int index = resources().at[address / 2];
  if (index >= 0)
    claim(static_cast<std::size_t>(index), resources().names[static_cast<std::size_t>(index)], now);
}

void Claims::note_enabled(std::uint64_t irqs, Cycle now) {
  if (!author_) return;
  for (; irqs; irqs &= irqs - 1) {
    const int i = __builtin_ctzll(irqs);
    claim(kFirstVector + static_cast<std::size_t>(i),
          std::string("vector ") + vector_name(kFirstIrqVector + i), now);
  }
}

}  // namespace dspic
