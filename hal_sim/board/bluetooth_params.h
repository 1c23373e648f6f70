// SPDX-License-Identifier: MIT
// Numbers of the robot's Bluetooth module (National LMX9820A, later LMX9838) and of its command packets.
#pragma once
#include <cstddef>
#include <cstdint>

#include "sim_core/base/clock.h"

namespace board {

// framing: start, type, opcode, length (2), check, payload, end [lib: bluetooth/e_bluetooth.c]
inline constexpr std::uint8_t kBtStart = 0x02;
inline constexpr std::uint8_t kBtEnd = 0x03;
inline constexpr std::uint8_t kBtRequest = 0x52;
inline constexpr std::uint8_t kBtConfirm = 0x43;
inline constexpr std::uint8_t kBtIndication = 0x69;
inline constexpr std::size_t kBtHeadBytes = 6;

// opcodes [AN1699 LMX9838 Software User's Guide: command set; lib: bluetooth/e_bluetooth.c]
enum BtOpcode : std::uint8_t {
  kBtInquiry = 0x00,
  kBtDeviceFound = 0x01,
  kBtRemoteName = 0x02,
  kBtReadLocalName = 0x03,
  kBtWriteLocalName = 0x04,
  kBtReadLocalAddress = 0x05,
  kBtEstablishLink = 0x0A,
  kBtLinkEstablished = 0x0B,
  kBtReleaseLink = 0x0D,
  kBtLinkReleased = 0x0E,
  kBtSendData = 0x0F,
  kBtIncomingData = 0x10,
  kBtTransparent = 0x11,
  kBtGetPin = 0x16,
  kBtSetPin = 0x17,
  kBtFactorySettings = 0x1A,
  kBtRemovePairing = 0x1B,
  kBtListPaired = 0x1C,
  kBtReady = 0x25,
  kBtReset = 0x26,
  kBtSetEventFilter = 0x4E,
  kBtGetEventFilter = 0x4F,
  kBtAclTerminated = 0x51,
};

// status bytes [AN1699: error codes, as far as named here]
inline constexpr std::uint8_t kBtOk = 0x00;
inline constexpr std::uint8_t kBtWrongLength = 0x01;
inline constexpr std::uint8_t kBtTimeout = 0x04;
inline constexpr std::uint8_t kBtNameTooLong = 0x06;
inline constexpr std::uint8_t kBtPinTooLong = 0x2E;
inline constexpr std::uint8_t kBtNoLink = 0x1F;  // [lib: bluetooth/e_bluetooth.c: release without a link]
// of a link that does not come about [assumed: the guide's table is not at hand]
inline constexpr std::uint8_t kBtLinkBusy = 0x02;
inline constexpr std::uint8_t kBtLinkRefused = 0x03;
inline constexpr std::uint8_t kBtUnknownDevice = 0x05;
// why a link ended: this side, the other side, lost [AN1699: SPP link released]
inline constexpr std::uint8_t kBtReleasedHere = 0x00;
inline constexpr std::uint8_t kBtReleasedThere = 0x01;
inline constexpr std::uint8_t kBtReleasedLost = 0x02;

// event filter: 0 everything, 1 no ACL events, 2 and 3 nothing [lib: bluetooth/e_bluetooth.c]
inline constexpr std::uint8_t kBtDefaultFilter = 1;
inline constexpr std::uint8_t kBtSilentFilter = 2;

inline constexpr std::uint8_t kBtPort = 1;             // [lib: bluetooth/e_bluetooth.c]
inline constexpr std::size_t kBtLongestName = 40;      // [AN1699: write local name]
inline constexpr std::size_t kBtLongestPin = 16;       // [AN1699: set fixed PIN]
inline constexpr std::size_t kBtMostPaired = 7;        // [assumed: the library's array has room for 8]
inline constexpr std::size_t kBtLongestPayload = 333;  // [AN1699: packet data 0 to 333]
inline constexpr const char* kBtFactoryName = "Serial Port Device";  // [assumed: the module's usual name]
inline constexpr const char* kBtFactoryPin = "0000";                 // [AN1699: fixed PIN by default]
inline constexpr const char* kBtVersion = "0212";  // [TI E2E 551668: what an LMX9838 says when ready]
// e-pucks have addresses 08:00:17:..., the maker's block [lib: bluetooth/e_bluetooth.c tests the 08]
inline constexpr std::uint8_t kBtMaker[3] = {0x17, 0x00, 0x08};

inline constexpr sim::Clicks kBtAnswerTime = sim::from_seconds(0.002);  // [assumed: a small processor's]
inline constexpr sim::Clicks kBtNameTime = sim::from_seconds(0.3);  // [assumed: half a page scan interval]
inline constexpr sim::Clicks kBtPageTime =
    sim::from_seconds(0.64);  // [Bluetooth core: half of 1.28 s page scan]
inline constexpr sim::Clicks kBtPageTimeout =
    sim::from_seconds(5.12);                                         // [Bluetooth core: default page timeout]
inline constexpr sim::Clicks kBtResetTime = sim::from_seconds(0.5);  // [assumed: start-up of the module]
inline constexpr double kBtInquiryUnitS = 1;         // [lib: bluetooth/e_bluetooth.c: time of inquiry in s]
inline constexpr std::size_t kBtBufferBytes = 2048;  // towards a blocked link [assumed: some seconds of text]

inline constexpr std::uint32_t kBtInquiryStream = 120;  // random numbers of the board [chosen: a free one]

}  // namespace board
