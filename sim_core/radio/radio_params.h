// SPDX-License-Identifier: MIT
// Numbers of packet radios of the IEEE 802.15.4 kind in the 2.4 GHz band, and of the usual medium access on
// them. Defaults of what a world may choose stand in world/radio_desc.h.
#pragma once
#include <cstdint>

#include "sim_core/base/clock.h"

namespace sim {

// streams of random/counter_random.h [chosen: free numbers]
inline constexpr std::uint32_t kStreamRadioFading = 48;
inline constexpr std::uint32_t kStreamRadioLoss = 49;
inline constexpr std::uint32_t kStreamRadioWait = 50;
inline constexpr std::uint32_t kStreamLinkDropout = 51;

/// Height of infra-red devices for packets over a robot's origin, m. [assumed: half a small robot]
inline constexpr double kPacketInfraRedHeightM = 0.025;

/// One octet at 250 kbit/s: 32 us. [CC2420 SWRS041 p.1: effective data rate 250 kbps]
inline constexpr double kRadioOctetS = 8 / 250e3;
/// Preamble 4, start delimiter 1, length 1. [CC2420 SWRS041 fig. 17: synchronisation header and PHY header]
inline constexpr int kRadioHeaderOctets = 6;
/// Unit of waiting before a transmission: 20 symbols of 16 us. [CC2420 SWRS041:
/// aUnitBackoffPeriod of IEEE 802.15.4]
inline constexpr Clicks kBackoffUnit = from_seconds(320e-6);
/// The first wait is 1 to 16 units, later ones 1 to 64. [TinyOS 1.x: tos/lib/CC2420Radio]
inline constexpr int kFirstBackoffUnits = 16;
inline constexpr int kNextBackoffUnits = 64;
/// A frame is given up when the channel was busy that often. [TinyOS 1.x: tos/lib/CC2420Radio]
inline constexpr int kMostTries = 8;
/// From the listening to the first bit on the air; who starts within it is not heard.
/// [CC2420 SWRS041: 12 symbols]
inline constexpr Clicks kTurnaround = from_seconds(192e-6);
/// Carrier at which the channel counts as busy, above the weakest frame that can be received, dB. -77 against
/// -95 dBm. [CC2420 SWRS041 tab. 4: CCA threshold, sensitivity]
inline constexpr double kBusyAboveSensitivityDb = 18;

}  // namespace sim
