// SPDX-License-Identifier: MIT
#include "hal_sim/chip/chip_image.h"

#include <cstdlib>

#include "dspic30/routines/known_routines.h"

namespace chip {

std::shared_ptr<const dspic::KnownCalls> ChipImage::known(const dspic::ProgramMemory& program) const {
  if (std::getenv("TWINPUCK_INTERPRET")) return nullptr;
  std::call_once(looked_for_, [&] { known_ = dspic::known_calls(file_.functions, program); });
  return known_;
}

bool ChipImage::is_endless(const std::string& line, std::uint64_t enabled,
                           const std::function<bool()>& find) const {
  const std::lock_guard lock(mutex_);
  const auto [known, is_new] = endless_.try_emplace({line, enabled});
  if (is_new) known->second = find();
  return known->second;
}

}  // namespace chip
