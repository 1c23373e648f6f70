// SPDX-License-Identifier: MIT
#include "hal_sim/board/radio_turret.h"

#include <algorithm>
#include <cmath>

#include "sim_core/base/hash.h"
#include "sim_core/radio/radio_params.h"

namespace board {

void RadioTurret::mix(std::uint64_t word) { hash_ = sim::mix64(hash_ ^ word); }

double RadioTurret::power_db() const {
  const int level = std::clamp(32 - int{soft_attenuator_}, kPowerRows.front().level, kPowerRows.back().level);
  double db = kPowerRows.front().db;
  for (std::size_t i = 1; i < kPowerRows.size(); ++i) {
    const PowerRow& low = kPowerRows[i - 1];
    const PowerRow& high = kPowerRows[i];
    if (level >= low.level) db = low.db + (high.db - low.db) * (level - low.level) / (high.level - low.level);
    if (level <= high.level) break;
  }
  return config_ & kRadioHardAttenuator ? db - kHardAttenuatorDb : db;
}

void RadioTurret::send(Cycle at) {
  const bool can = (status_ & kRadioIdle) && (config_ & kRadioEnabled);
  status_ &= static_cast<std::uint8_t>(~kRadioSendError);
  if (!can) {
    status_ |= kRadioSendError;
    return;
  }
  const int length = std::min(has_length_ ? int{send_[kMessageLength]} : written_, kRadioPayload);
  sim::RadioRequest request;
  request.at = clock_.click_at(at);
  request.air_octets = sim::kRadioHeaderOctets + kRadioFrameOctets + length;
  request.power_db = power_db();
  request.bytes.assign(send_.begin(), send_.begin() + kMessageData + length);
  request.bytes[kMessageLength] = static_cast<std::uint8_t>(length);
  outbox.push_back(std::move(request));
  status_ &= static_cast<std::uint8_t>(~kRadioIdle);
  written_ = 0;
  has_length_ = false;
}

bool RadioTurret::write_register(std::uint8_t number, std::uint8_t value, Cycle at) {
  mix(number | value << 8 | static_cast<std::uint64_t>(at) << 16);
  switch (number) {
    case kRadioStatus:
      return true;  // read only
    case kRadioConfig:
      if ((value ^ config_) & kRadioEnabled)
        listening_since = value & kRadioEnabled ? clock_.click_at(at) : kOff;
      config_ = value;
      return true;
    case kRadioSend:
      if (value != 0) send(at);
      return true;
    case kRadioSoftAttenuator:
      soft_attenuator_ = value;
      return true;
    case kRadioGroup:
      group_ = value;
      return true;
    case kRadioAddressLow:
      own_address_ = static_cast<std::uint16_t>((own_address_ & 0xFF00) | value);
      return true;
    case kRadioAddressHigh:
      own_address_ = static_cast<std::uint16_t>((own_address_ & 0x00FF) | value << 8);
      return true;
    default:
      break;
  }
  // The send buffer: how far it was filled is the packet's length, where none is written.
  if (number < kRadioReceiveBuffer) {
    const int offset = number - kRadioSendBuffer;
    send_[static_cast<std::size_t>(offset)] = value;
    if (offset == kMessageLength) has_length_ = true;
    if (offset >= kMessageData && offset < kMessageStrength)
      written_ = std::max(written_, offset - kMessageData + 1);
  }
  return true;
}

std::uint8_t RadioTurret::read_register(std::uint8_t number, Cycle) {
  switch (number) {
    case kRadioStatus:
      return status_;
    case kRadioConfig:
      return config_;
    case kRadioSend:
      return 0;
    case kRadioSoftAttenuator:
      return soft_attenuator_;
    case kRadioGroup:
      return group_;
    case kRadioAddressLow:
      return static_cast<std::uint8_t>(own_address_);
    case kRadioAddressHigh:
      return static_cast<std::uint8_t>(own_address_ >> 8);
    default:
      break;
  }
  if (number < kRadioReceiveBuffer) return send_[static_cast<std::size_t>(number - kRadioSendBuffer)];
  if (number > kRadioReceiveEnd) return 0xFF;
  if (number == kRadioReceiveEnd)
    status_ &= static_cast<std::uint8_t>(~(kRadioPacketReady | kRadioPacketLost));
  return receive_[static_cast<std::size_t>(number - kRadioReceiveBuffer)];
}

void RadioTurret::on_frame(const sim::RadioFrame& frame, double level_db) {
  const std::vector<std::uint8_t>& bytes = frame.bytes;
  if (bytes.size() < kMessageData) return;  // not one of ours
  const std::uint8_t group = bytes[kMessageGroup];
  if (group != group_ && group != kRadioBroadcastGroup) return;
  const auto to =
      static_cast<std::uint16_t>(bytes[kMessageDestination] | bytes[kMessageDestination + 1] << 8);
  if (to != own_address_ && to != kRadioBroadcastShort && to != kRadioBroadcastLong) return;
  if (status_ & kRadioPacketReady) {
    status_ |= kRadioPacketLost;
    ++lost_;
    return;
  }
  receive_.fill(0);
  std::copy(bytes.begin(), bytes.end(), receive_.begin());
  const double strength = std::clamp(kWeakestStrength + level_db, -128.0, 127.0);
  receive_[kMessageStrength] = static_cast<std::uint8_t>(static_cast<int>(std::lround(strength)));
  receive_[kMessageQuality] = kGoodQuality;
  receive_[kMessageCrc] = 1;
  status_ |= kRadioPacketReady;
  mix(static_cast<std::uint64_t>(frame.end) ^ static_cast<std::uint64_t>(frame.sender) << 48);
  for (std::uint8_t byte : bytes) mix(byte);
}

void RadioTurret::on_sent(bool given_up, sim::Clicks) {
  status_ |= kRadioIdle;
  if (given_up) status_ |= kRadioSendError;
  mix(given_up);
}

void RadioTurret::begin_again(Cycle) {
  outbox.clear();
  listening_since = kOff;
  status_ = kRadioIdle;
  config_ = 0;
  soft_attenuator_ = 1;
  group_ = kRadioDefaultGroup;
  own_address_ = 0;
  send_ = receive_ = {};
  written_ = 0;
  has_length_ = false;
}

}  // namespace board
