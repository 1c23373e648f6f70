// SPDX-License-Identifier: MIT
#include "hal_sim/board/analogue_inputs.h"

#include <algorithm>
#include <cmath>

#include "hal_sim/board/accelerometer.h"

namespace board {

/// The library's raw value on AN7.
static int battery_counts(double volts) {
  constexpr double kPerVolt = (kBatteryRawAt4V2 - kBatteryRawAt3V4) / (4.2 - 3.4);
  return static_cast<int>(std::lround(kBatteryRawAt3V4 + (volts - 3.4) * kPerVolt));
}

std::optional<double> AnalogueInputs::part_v(int channel, Cycle at) const {
  for (const auto& part : parts_)
    if (const auto level_v = part->analogue_v(channel, at)) return level_v;
  return std::nullopt;
}

int AnalogueInputs::counts(int channel, Cycle at, Cycle lit_for) const {
  if (channel < 0 || channel > 15) return 0;
  if (channel >= kIrChannel) return ir_.counts(channel - kIrChannel, at, lit_for);
  if (channel >= kMicChannel && channel < kMicChannel + kMicrophones)
    return ears_.counts(channel - kMicChannel, at);
  if (const auto level_v = part_v(channel, at))
    return static_cast<int>(
        std::clamp(std::floor(*level_v / kAdcReferenceV * (kAdcMax + 1)), 0.0, double{kAdcMax}));
  if (channel < kAccChannel) return -1;
  if (robot_.setup().revision == Revision::Analogue)
    return accelerometer_counts(robot_, channel - kAccChannel, at);
  return channel == kBatteryChannel ? battery_counts(power_.battery().voltage(at)) : 0;  // 5 and 6 are open
}

}  // namespace board
