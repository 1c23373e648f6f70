// SPDX-License-Identifier: MIT
// The module's command packets: parsing, and what each command does.
#include <algorithm>

#include "hal_sim/board/bluetooth_module.h"

namespace board {

void BluetoothModule::take_command_byte(std::uint8_t byte, sim::Clicks at) {
  if (command_.empty() && byte != kBtStart) return;
  command_.push_back(byte);
  if (command_.size() < kBtHeadBytes) return;
  const std::size_t length = command_[3] | static_cast<std::size_t>(command_[4]) << 8;
  const auto check = static_cast<std::uint8_t>(command_[1] + command_[2] + command_[3] + command_[4]);
  if (command_[1] != kBtRequest || command_[5] != check || length > kBtLongestPayload) {
    command_.clear();  // not a packet: the next start byte begins one
    return;
  }
  if (command_.size() < kBtHeadBytes + length + 1) return;
  const Bytes packet = std::move(command_);
  command_.clear();
  if (packet.back() != kBtEnd) return;
  obey(packet[2], Bytes(packet.begin() + kBtHeadBytes, packet.end() - 1), at);
}

void BluetoothModule::packet(std::uint8_t type, std::uint8_t opcode, const Bytes& payload, sim::Clicks at) {
  if (event_filter_ >= kBtSilentFilter) return;
  if (!out_.empty()) at = std::max(at, out_.back().at);
  const auto low = static_cast<std::uint8_t>(payload.size());
  const auto high = static_cast<std::uint8_t>(payload.size() >> 8);
  Bytes all{kBtStart, type, opcode, low, high, static_cast<std::uint8_t>(type + opcode + low + high)};
  all.insert(all.end(), payload.begin(), payload.end());
  all.push_back(kBtEnd);
  if (out_.size() + all.size() > kBtBufferBytes) return;  // nobody reads: lost as a whole
  for (std::uint8_t byte : all) out_.push_back({byte, at});
}

void BluetoothModule::drop_everything(sim::Clicks at) {
  if (peer != kNobody) tell(peer, kRelease, {}, at, true);
  end_link(kBtReleasedHere, at, false);
  inquiry_ = {};
  naming_.until = paging_.until = -1;
  out_.clear();
}

void BluetoothModule::obey(std::uint8_t opcode, const Bytes& p, sim::Clicks at) {
  const sim::Clicks then = at + kBtAnswerTime;
  // Texts travel with a byte of their length before them.
  const auto text_in = [&](std::size_t from) {
    std::string text(p.begin() + static_cast<std::ptrdiff_t>(from), p.end());
    return text.substr(0, std::min(text.size(), std::size_t{p[from - 1]}));
  };
  const auto with_text = [](Bytes head, const std::string& text, bool with_end) {
    head.push_back(static_cast<std::uint8_t>(text.size() + (with_end ? 1 : 0)));
    head.insert(head.end(), text.begin(), text.end());
    if (with_end) head.push_back(0);
    return head;
  };
  switch (opcode) {
    case kBtReadLocalName:
      return confirm(opcode, with_text({kBtOk}, name_, true), then);
    case kBtWriteLocalName: {
      if (p.empty()) return confirm(opcode, {kBtWrongLength}, then);
      std::string name = text_in(1);
      name = name.substr(0, name.find('\0'));
      if (name.size() > kBtLongestName) return confirm(opcode, {kBtNameTooLong}, then);
      name_ = name;
      return confirm(opcode, {kBtOk}, then);
    }
    case kBtReadLocalAddress: {
      Bytes payload{kBtOk};
      add(payload, address_);
      return confirm(opcode, payload, then);
    }
    case kBtGetPin:
      return confirm(opcode, with_text({kBtOk}, pin_, false), then);
    case kBtSetPin: {
      if (p.empty()) return confirm(opcode, {kBtWrongLength}, then);
      const std::string pin = text_in(1);
      if (pin.size() > kBtLongestPin) return confirm(opcode, {kBtPinTooLong}, then);
      pin_ = pin;
      return confirm(opcode, {kBtOk}, then);
    }
    case kBtListPaired: {
      Bytes payload{kBtOk, static_cast<std::uint8_t>(paired_.size())};
      for (const BtAddress& a : paired_) add(payload, a);
      return confirm(opcode, payload, then);
    }
    case kBtRemovePairing: {
      if (p.size() != 6) return confirm(opcode, {kBtWrongLength}, then);
      const auto found = std::find_if(paired_.begin(), paired_.end(), [&](const BtAddress& a) {
        return std::equal(a.begin(), a.end(), p.begin());
      });
      const bool known = found != paired_.end();
      if (known) paired_.erase(found);
      return confirm(opcode, {known ? kBtOk : kBtUnknownDevice}, then);
    }
    case kBtFactorySettings:
      name_ = kBtFactoryName;
      pin_ = kBtFactoryPin;
      paired_.clear();
      event_filter_ = kBtDefaultFilter;
      return confirm(opcode, {kBtOk}, then);
    case kBtReset:
      drop_everything(at);
      return indicate(kBtReady, with_text({}, kBtVersion, false), at + kBtResetTime);
    case kBtSetEventFilter:
      if (p.size() != 1) return confirm(opcode, {kBtWrongLength}, then);
      event_filter_ = p[0];
      return confirm(opcode, {kBtOk}, then);
    case kBtGetEventFilter:
      return confirm(opcode, {event_filter_}, then);
    default:
      return obey_link_command(opcode, p, at);
  }
}

void BluetoothModule::obey_link_command(std::uint8_t opcode, const Bytes& p, sim::Clicks at) {
  const sim::Clicks then = at + kBtAnswerTime;
  switch (opcode) {
    case kBtInquiry:
      if (p.size() != 3) return confirm(opcode, {kBtWrongLength}, then);
      inquiry_ = {};
      inquiry_.until = at + sim::from_seconds(kBtInquiryUnitS * p[0]);
      inquiry_.most = p[1];
      ++inquiries_;
      return tell(sim::LinkMessage::kEverybody, kInquire, {}, at, false);
    case kBtRemoteName:
      if (p.size() != 6) return confirm(opcode, {kBtWrongLength}, then);
      std::copy(p.begin(), p.end(), naming_.address.begin());
      naming_.until = at + kBtPageTimeout;
      return tell(sim::LinkMessage::kEverybody, kAskName, p, at, false);
    case kBtEstablishLink: {
      if (p.size() != 8) return confirm(opcode, {kBtWrongLength}, then);
      std::copy(p.begin() + 1, p.begin() + 7, paging_.address.begin());
      confirm(opcode, {kBtOk, kBtPort}, then);
      if (is_linked()) {
        page_status_ = kBtLinkBusy;
        linked_at_ = then;
        return;
      }
      paging_.until = at + kBtPageTimeout;
      Bytes page(p.begin() + 1, p.begin() + 7);
      add(page, address_);
      page.insert(page.end(), pin_.begin(), pin_.end());
      return tell(sim::LinkMessage::kEverybody, kPage, std::move(page), at, false);
    }
    case kBtReleaseLink:
      if (!is_linked()) return confirm(opcode, {kBtNoLink, kBtPort}, then);
      confirm(opcode, {kBtOk, kBtPort}, then);
      if (peer != kNobody) tell(peer, kRelease, {}, at, true);
      return end_link(kBtReleasedHere, then, true);
    case kBtSendData: {
      if (p.size() < 3 || p.size() != 3 + (p[1] | static_cast<std::size_t>(p[2]) << 8))
        return confirm(opcode, {kBtWrongLength, kBtPort}, then);
      if (!is_linked()) return confirm(opcode, {kBtNoLink, kBtPort}, then);
      confirm(opcode, {kBtOk, kBtPort}, then);
      return send_data(Bytes(p.begin() + 3, p.end()), at);
    }
    case kBtTransparent:
      if (!is_linked()) return confirm(opcode, {kBtNoLink, kBtPort}, then);
      confirm(opcode, {kBtOk, kBtPort}, then);
      transparent_ = true;
      return;
    default:
      return;  // no answer
  }
}

}  // namespace board
