// SPDX-License-Identifier: MIT
// Bytes of UART 1, the computer's side, and time. The commands stand in bluetooth_commands.cpp.
#include "hal_sim/board/bluetooth_module.h"

#include <algorithm>
#include <cstdio>

#include "sim_core/random/counter_random.h"

namespace board {

BtAddress bt_address_of(int number) {
  return {static_cast<std::uint8_t>(number),
          static_cast<std::uint8_t>(number >> 8),
          0,
          kBtMaker[0],
          kBtMaker[1],
          kBtMaker[2]};
}

BluetoothModule::BluetoothModule(const BluetoothSetup& setup, const RobotClock& clock, int robot_index,
                                 std::unique_ptr<UartEnd> computer)
    : setup_(setup), clock_(clock), address_(bt_address_of(setup.number)), computer_(std::move(computer)) {
  robot = robot_index;
  power_up();
}

void BluetoothModule::power_up() {
  char digits[8];
  std::snprintf(digits, sizeof digits, "%04d", std::clamp(setup_.number, 0, 9999));
  name_ = setup_.name.empty() ? std::string("e-puck_") + digits : setup_.name;
  pin_ = setup_.pin.empty() ? digits : setup_.pin;
  to_computer_ = transparent_ = computer_ != nullptr;
  settle_idle();
}

void BluetoothModule::begin_again() {
  peer = kNobody;
  blocked = lost_computer_ = false;
  paired_.clear();
  event_filter_ = kBtDefaultFilter;
  to_send_.clear();
  blocked_since_ = linked_at_ = -1;
  command_.clear();
  out_.clear();
  inquiry_ = {};
  inquiries_ = 0;
  naming_ = paging_ = {};
  page_status_ = kBtOk;
  other_ = {};
  power_up();
}

void BluetoothModule::connect_computer(std::shared_ptr<UartEnd> computer) {
  computer_ = std::move(computer);
  to_computer_ = transparent_ = true;
  set_idle(false);
}

void BluetoothModule::settle_idle() {
  set_idle(!computer_ && out_.empty() && inquiry_.until < 0 && naming_.until < 0 && paging_.until < 0 &&
           linked_at_ < 0);
  if (!is_idle() && wake) wake();
}

// --- UART 1

void BluetoothModule::deliver(const std::uint8_t* bytes, const Cycle* ends, std::size_t count) {
  std::size_t i = 0;
  while (i < count && !transparent_) {
    take_command_byte(bytes[i], clock_.click_at(ends[i]));
    ++i;
  }
  if (i == count) return settle_idle();
  if (to_computer_ && !blocked && to_send_.empty()) return computer_->deliver(bytes + i, ends + i, count - i);
  send_data(Bytes(bytes + i, bytes + count), clock_.click_at(ends[count - 1]));
}

void BluetoothModule::send_data(Bytes bytes, sim::Clicks at) {
  if (to_computer_) {
    const std::size_t room = kBtBufferBytes - std::min(kBtBufferBytes, to_send_.size());
    to_send_.insert(to_send_.end(), bytes.begin(),
                    bytes.begin() + static_cast<std::ptrdiff_t>(std::min(room, bytes.size())));
    if (!blocked) follow_computer(at);
  } else if (peer != kNobody) {
    tell(peer, kData, std::move(bytes), at, true);
  }
}

void BluetoothModule::take_data(const Bytes& bytes, sim::Clicks at) {
  if (!transparent_) {
    Bytes payload(3 + bytes.size());
    payload[0] = kBtPort;
    payload[1] = static_cast<std::uint8_t>(bytes.size());
    payload[2] = static_cast<std::uint8_t>(bytes.size() >> 8);
    std::copy(bytes.begin(), bytes.end(), payload.begin() + 3);
    return indicate(kBtIncomingData, payload, at);
  }
  for (std::uint8_t byte : bytes)
    if (out_.size() < kBtBufferBytes) out_.push_back({byte, at});
}

std::size_t BluetoothModule::collect(std::uint8_t* bytes, std::size_t room, Cycle at) {
  const sim::Clicks now = clock_.click_at(at);
  if (computer_) follow_computer(now);
  run_deadlines(now);
  std::size_t count = 0;
  while (count < room && !out_.empty() && out_.front().at <= now) {
    bytes[count++] = out_.front().byte;
    out_.pop_front();
  }
  if (to_computer_ && transparent_ && !blocked && out_.empty() && count < room)
    count += computer_->collect(bytes + count, room - count, at);
  settle_idle();
  return count;
}

void BluetoothModule::on_break(Cycle) {
  command_.clear();
  transparent_ = false;
}

/// What the computer's link does by itself: waits, is lost, comes back.
void BluetoothModule::follow_computer(sim::Clicks now) {
  if (blocked) {
    if (blocked_since_ < 0) blocked_since_ = now;
    if (to_computer_ && now - blocked_since_ >= sim::from_seconds(setup_.timeout_s)) on_link_lost(now);
    return;
  }
  const bool comes_back = blocked_since_ >= 0 && !to_computer_ && peer == kNobody && lost_computer_;
  blocked_since_ = -1;
  if (comes_back) {
    to_computer_ = transparent_ = true;
    lost_computer_ = false;
  }
  if (!to_computer_) {
    // nobody listens here: what the computer says is lost
    std::uint8_t lost[64];
    computer_->collect(lost, sizeof lost, clock_.cycle_at(now));
    return;
  }
  if (!to_send_.empty()) {
    const std::vector<Cycle> ends(to_send_.size(), clock_.cycle_at(now));
    computer_->deliver(to_send_.data(), ends.data(), to_send_.size());
    to_send_.clear();
  }
  if (!transparent_) {
    std::uint8_t bytes[64];
    const std::size_t count = computer_->collect(bytes, sizeof bytes, clock_.cycle_at(now));
    if (count > 0) take_data(Bytes(bytes, bytes + count), now);
  }
}

// --- links

void BluetoothModule::tell(int to, Kind kind, Bytes bytes, sim::Clicks at, bool reliable) {
  sim::LinkMessage message;
  message.to = to;
  message.at = at;
  message.kind = kind;
  message.reliable = reliable;
  message.bytes = std::move(bytes);
  send(std::move(message));
}

void BluetoothModule::end_link(std::uint8_t reason, sim::Clicks at, bool tell_firmware) {
  peer = kNobody;
  to_computer_ = transparent_ = false;
  to_send_.clear();
  linked_at_ = -1;
  if (!tell_firmware) return;
  indicate(kBtLinkReleased, {reason, kBtPort}, at);
  if (event_filter_ == 0) {
    Bytes payload(other_.begin(), other_.end());
    payload.push_back(reason);
    indicate(kBtAclTerminated, payload, at);
  }
}

void BluetoothModule::on_link_lost(sim::Clicks now) {
  lost_computer_ = to_computer_;
  end_link(kBtReleasedLost, now, true);
  settle_idle();
}

bool BluetoothModule::is_paired(const BtAddress& other) const {
  return std::find(paired_.begin(), paired_.end(), other) != paired_.end();
}

void BluetoothModule::pair_with(const BtAddress& other) {
  if (is_paired(other)) return;
  if (paired_.size() >= kBtMostPaired) paired_.erase(paired_.begin());
  paired_.push_back(other);
}

std::uint8_t BluetoothModule::answer_page(const BtAddress& from, const std::string& pin) const {
  if (is_linked() || paging_.until >= 0) return kBtLinkBusy;
  return is_paired(from) || pin == pin_ ? kBtOk : kBtLinkRefused;
}

void BluetoothModule::on_message(const sim::LinkMessage& message, sim::Clicks now) {
  const Bytes& b = message.bytes;
  const auto address_in = [&](std::size_t from) {
    BtAddress a{};
    std::copy_n(b.begin() + static_cast<std::ptrdiff_t>(from), a.size(), a.begin());
    return a;
  };
  const Bytes mine(address_.begin(), address_.end());
  // Each question has its answer, and an answer counts only while somebody waits for it.
  switch (message.kind) {
    case kInquire:
      tell(message.from, kHere, mine, now, false);
      break;
    case kHere:
      if (inquiry_.until >= 0) {
        // it answers at some time of the inquiry, its own one each time
        const BtAddress found = address_in(0);
        const sim::RandomKey key{setup_.seed, static_cast<std::uint32_t>(robot), kBtInquiryStream};
        const double share =
            sim::random_uniform(key, inquiries_ << 32 | static_cast<std::uint32_t>(message.from));
        const double left_s = sim::to_seconds(inquiry_.until - now);
        inquiry_.coming.push_back({found, now + sim::from_seconds(left_s * 0.95 * share)});
        std::stable_sort(inquiry_.coming.begin(), inquiry_.coming.end(),
                         [](const Found& a, const Found& c) { return a.at < c.at; });
      }
      break;
    case kAskName:
      if (address_in(0) == address_) {
        Bytes answer = mine;
        answer.insert(answer.end(), name_.begin(), name_.end());
        tell(message.from, kMyName, std::move(answer), now, false);
      }
      break;
    case kMyName:
      if (naming_.until >= 0 && address_in(0) == naming_.address) {
        naming_.until = -1;
        Bytes payload{kBtOk};
        add(payload, address_in(0));
        payload.push_back(static_cast<std::uint8_t>(b.size() - 6));
        payload.insert(payload.end(), b.begin() + 6, b.end());
        confirm(kBtRemoteName, payload, now + kBtNameTime);
      }
      break;
    case kPage:
      // It is called: unless answer_page() refuses, it is linked and transparent from now on.
      if (address_in(0) == address_) {
        const BtAddress from = address_in(6);
        const std::uint8_t status = answer_page(from, std::string(b.begin() + 12, b.end()));
        if (status == kBtOk) {
          peer = message.from;
          other_ = from;
          transparent_ = true;
          command_.clear();
          pair_with(from);
        }
        tell(message.from, kPageAnswer, {status}, now, true);
      }
      break;
    case kPageAnswer:
      if (paging_.until >= 0) {
        page_status_ = b[0];
        linked_at_ = now + kBtPageTime;
        if (b[0] == kBtOk) {
          peer = message.from;
          other_ = paging_.address;
          pair_with(other_);
        }
        paging_.until = -1;
      } else if (b[0] == kBtOk && peer != message.from) {
        tell(message.from, kRelease, {}, now, true);  // too late: nobody waits for this link any more
      }
      break;
    case kData:
      if (peer == message.from) take_data(b, now);
      break;
    case kRelease:
      if (peer == message.from) end_link(kBtReleasedThere, now, true);
      break;
    default:
      break;
  }
  settle_idle();
}

void BluetoothModule::run_deadlines(sim::Clicks now) {
  // Robots that an inquiry found are indicated one by one, up to as many as were asked for.
  Inquiry& q = inquiry_;
  while (q.until >= 0 && !q.coming.empty() && q.coming.front().at <= now) {
    Bytes payload(q.coming.front().address.begin(), q.coming.front().address.end());
    payload.resize(payload.size() + 3);  // class of device: 0
    indicate(kBtDeviceFound, payload, now);
    q.coming.erase(q.coming.begin());
    if (++q.found == q.most) q.until = now;
  }
  if (q.until >= 0 && q.until <= now) {
    q.until = -1;
    confirm(kBtInquiry, {kBtOk}, now);
  }
  // Nobody has told its name in time.
  if (naming_.until >= 0 && naming_.until <= now) {
    naming_.until = -1;
    Bytes payload{kBtTimeout};
    add(payload, naming_.address);
    payload.push_back(0);
    confirm(kBtRemoteName, payload, now);
  }
  const auto announce = [&](std::uint8_t status, const BtAddress& address) {
    Bytes payload{status};
    add(payload, address);
    payload.push_back(kBtPort);
    payload.push_back(kBtPort);
    indicate(kBtLinkEstablished, payload, now);
  };
  // The robot that was called has not answered, or its answer has come.
  if (paging_.until >= 0 && paging_.until <= now) {
    paging_.until = -1;
    announce(kBtTimeout, paging_.address);
  }
  if (linked_at_ >= 0 && linked_at_ <= now) {
    linked_at_ = -1;
    announce(page_status_, paging_.address);
  }
}

}  // namespace board
