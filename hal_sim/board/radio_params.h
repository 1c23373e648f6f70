// SPDX-License-Identifier: MIT
// Numbers of the SWIS radio turret. Those of the channel stand in sim_core/radio/radio_params.h.
#pragma once
#include <array>
#include <cstdint>

namespace board {

inline constexpr std::uint8_t kRadioAddress = 0x3F << 1;  // [lib: contrib/SWIS_com_module/ComModule.c]
inline constexpr int kRadioPayload = 108;                 // bytes [lib: contrib/SWIS_com_module/ComModule.h]
// bytes of a message buffer less one [lib: contrib/SWIS_com_module/ComModule.c: payload + 14]
inline constexpr int kRadioBufferLast = kRadioPayload + 14;

// registers [lib: contrib/SWIS_com_module/ComModule.c]
enum RadioRegister : int {
  kRadioStatus = 0,
  kRadioConfig = 1,
  kRadioSend = 2,
  kRadioSoftAttenuator = 3,
  kRadioGroup = 4,
  kRadioAddressLow = 5,
  kRadioAddressHigh = 6,
  kRadioSendBuffer = 7,
  kRadioReceiveBuffer = kRadioSendBuffer + kRadioBufferLast + 1,
  kRadioReceiveEnd = kRadioReceiveBuffer + kRadioBufferLast,
};

// status and configuration bits [lib: contrib/SWIS_com_module/ComModule.c]
inline constexpr std::uint8_t kRadioPacketReady = 0x01;
inline constexpr std::uint8_t kRadioIdle = 0x02;
inline constexpr std::uint8_t kRadioPacketLost = 0x04;
inline constexpr std::uint8_t kRadioSendError = 0x08;
inline constexpr std::uint8_t kRadioHardAttenuator = 0x01;
inline constexpr std::uint8_t kRadioEnabled = 0x80;

// offsets in a message [TinyOS 1.x: TOS_Msg of the CC2420; 6 to 10 also lib: ComModule.c]
enum RadioMessage : int {
  kMessageLength = 0,
  kMessageDestination = 6,  // low byte, high byte
  kMessageType = 8,
  kMessageGroup = 9,
  kMessageData = 10,
  kMessageStrength = kMessageData + kRadioPayload,
  kMessageQuality = kMessageStrength + 1,
  kMessageCrc = kMessageStrength + 2,
};

inline constexpr std::uint8_t kRadioBroadcastGroup = 0xFF;  // [lib: contrib/SWIS_com_module/ComModule.h]
// 0xFF as the library's header says, 0xFFFF as TinyOS does [lib: contrib/SWIS_com_module/ComModule.h]
inline constexpr std::uint16_t kRadioBroadcastShort = 0x00FF;
inline constexpr std::uint16_t kRadioBroadcastLong = 0xFFFF;  // [TinyOS 1.x: TOS_BCAST_ADDR]
inline constexpr std::uint8_t kRadioDefaultGroup = 0x7D;      // [lib: contrib/SWIS_com_module/ComModule.h]

// control 2, number 1, network 2, address 2, type 1, group 1, check 2 [TinyOS 1.x: TOS_Msg of the CC2420]
inline constexpr int kRadioFrameOctets = 11;
inline constexpr double kHardAttenuatorDb = 25;  // of what is sent [lib: contrib/SWIS_com_module/ComModule.h]

/// Output power by level, dB below full power; linear between the rows.
struct PowerRow {
  int level;
  double db;
};
// The attenuator counts down from level 31: 1 is full power, 31 the least. [CC2420 SWRS041 tab. 9]
inline constexpr std::array<PowerRow, 8> kPowerRows{
    {{3, -25}, {7, -15}, {11, -10}, {15, -7}, {19, -5}, {23, -3}, {27, -1}, {31, 0}}};

// strength byte of the weakest frame: its -95 dBm and the register's offset of 45
inline constexpr double kWeakestStrength = -95 + 45;  // [CC2420 SWRS041 sec. 23 and tab. 4]
inline constexpr std::uint8_t kGoodQuality = 110;  // [CC2420 SWRS041 sec. 24: about 110 for the best frames]

}  // namespace board
