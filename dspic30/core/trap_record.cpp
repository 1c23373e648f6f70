// SPDX-License-Identifier: MIT
#include "dspic30/core/trap_record.h"

#include "dspic30/core/data_space.h"
#include "dspic30/memory/hex.h"

namespace dspic {

std::string text_of(const TrapRecord::Touch& touch) {
  using Access = TrapRecord::Access;
  if (touch.access == Access::Fetch)
    return "the program is led to " + hex(touch.address, 6) + ", where there is no flash";
  const std::string address = hex(touch.address, 4),
                    verb = touch.access == Access::Read ? " is read" : " is written";
  if (touch.is_odd_word) return "a word at the odd address " + address + verb;
  const bool is_window = touch.address >= DataSpace::kPsvStart;
  return address + verb + ", where nothing is; " +
         (!is_window                      ? "RAM ends at " + hex(DataSpace::kRamEnd - 1, 4)
          : touch.access == Access::Write ? "constants of the flash are read there, and none is written"
                                          : "constants of the flash are read there while CORCON.PSV is 1");
}

}  // namespace dspic
