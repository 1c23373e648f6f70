// SPDX-License-Identifier: MIT
// The robot's Bluetooth module (LMX9820A, LMX9838) between UART 1 and whoever it is linked to.
//
//   e_bt_* -> UART 1 -> command packets ------> this module <-- sim::LinkMedium --> another robot's module
//   e_send_uart1_char -> transparent bytes -/       \-- a UartEnd: the computer behind `uart1`
//
// With a computer behind it the module is linked and transparent from the beginning. Without, it takes
// commands; a link from another robot makes it transparent, without a word, as the computer's does; the end
// of a link is indicated. Nothing answers a break, a broken packet, or any command while all events are
// switched off. Modelled: the commands of the library, inquiry, names, PINs and pairing, one serial link,
// transparent mode and its end by a break, reset, factory settings, drop-outs. Not modelled: several links,
// service discovery, audio, power saving, other commands (no answer). Source: [lib: bluetooth/e_bluetooth.c]
// and AN1699, facts restated; bluetooth_params.h.
#pragma once
#include <array>
#include <list>
#include <memory>
#include <string>
#include <vector>

#include "hal_sim/board/bluetooth_params.h"
#include "hal_sim/board/clock.h"
#include "hal_sim/board/uart_end.h"
#include "sim_core/radio/link_medium.h"

namespace board {

/// Six bytes, low byte first.
using BtAddress = std::array<std::uint8_t, 6>;

/// 08:00:17:00 and the number in two bytes.
BtAddress bt_address_of(int number);

struct BluetoothSetup {
  int number = 1;    ///< 0 to 9999
  std::string name;  ///< empty: e-puck_NNNN
  std::string pin;   ///< empty: NNNN
  std::uint64_t seed = 1;
  double timeout_s = 20;  ///< silence after which the computer's link is lost
};

class BluetoothModule final : public UartEnd, public sim::LinkPort {
 public:
  /// `computer`: the end the robot is linked to when the world begins; may be null.
  BluetoothModule(const BluetoothSetup& setup, const RobotClock& clock, int robot_index,
                  std::unique_ptr<UartEnd> computer);

  /// A computer links itself to the robot, which had none.
  void connect_computer(std::shared_ptr<UartEnd> computer);

  // --- UART 1
  void deliver(const std::uint8_t* bytes, const Cycle* ends, std::size_t count) override;
  std::size_t collect(std::uint8_t* bytes, std::size_t room, Cycle at) override;
  void on_break(Cycle at) override;
  bool takes_packets() const override { return to_computer_ && transparent_ && computer_->takes_packets(); }
  std::string name() const override { return computer_ ? computer_->name() : ""; }
  std::string error() const override { return computer_ ? computer_->error() : ""; }

  void begin() override {
    if (computer_) computer_->begin();
  }
  void begin_again() override;

  // --- the air, between ticks
  void on_message(const sim::LinkMessage& message, sim::Clicks now) override;
  void on_link_lost(sim::Clicks now) override;

  const BtAddress& address() const { return address_; }
  bool is_transparent() const { return transparent_; }
  bool is_linked() const { return peer != kNobody || to_computer_; }

 private:
  using Bytes = std::vector<std::uint8_t>;
  enum Kind { kInquire, kHere, kAskName, kMyName, kPage, kPageAnswer, kData, kRelease };

  static void add(Bytes& to, const BtAddress& address) {
    for (std::uint8_t byte : address) to.push_back(byte);
  }
  void take_command_byte(std::uint8_t byte, sim::Clicks at);
  void obey(std::uint8_t opcode, const Bytes& payload, sim::Clicks at);
  void obey_link_command(std::uint8_t opcode, const Bytes& payload, sim::Clicks at);
  void packet(std::uint8_t type, std::uint8_t opcode, const Bytes& payload, sim::Clicks at);
  void confirm(std::uint8_t opcode, const Bytes& payload, sim::Clicks at) {
    packet(kBtConfirm, opcode, payload, at);
  }
  void indicate(std::uint8_t opcode, const Bytes& payload, sim::Clicks at) {
    packet(kBtIndication, opcode, payload, at);
  }
  void run_deadlines(sim::Clicks now);
  void send_data(Bytes bytes, sim::Clicks at);
  void take_data(const Bytes& bytes, sim::Clicks at);
  void end_link(std::uint8_t reason, sim::Clicks at, bool tell_firmware);
  void drop_everything(sim::Clicks at);
  void follow_computer(sim::Clicks now);
  void tell(int to, Kind kind, Bytes bytes, sim::Clicks at, bool reliable);
  void pair_with(const BtAddress& other);
  bool is_paired(const BtAddress& other) const;
  std::uint8_t answer_page(const BtAddress& from, const std::string& pin) const;
  void settle_idle();
  void power_up();

  BluetoothSetup setup_;
  const RobotClock& clock_;
  BtAddress address_;
  std::string name_, pin_;
  std::vector<BtAddress> paired_;  // oldest first
  std::uint8_t event_filter_ = kBtDefaultFilter;
  bool transparent_ = false;

  std::shared_ptr<UartEnd> computer_;
  bool to_computer_ = false;
  Bytes to_send_;  // for the computer, while the link is blocked
  sim::Clicks blocked_since_ = -1;

  Bytes command_;  // the packet so far
  struct Out {
    std::uint8_t byte;
    sim::Clicks at;
  };
  std::list<Out> out_;

  struct Found {
    BtAddress address;
    sim::Clicks at;
  };
  struct Inquiry {
    sim::Clicks until = -1;  // negative: none
    int most = 0;            // 0: any number
    int found = 0;
    std::vector<Found> coming;  // in order of their time
  } inquiry_;
  std::uint64_t inquiries_ = 0;
  struct Call {
    sim::Clicks until = -1;  // negative: none
    BtAddress address{};
  } naming_, paging_;
  std::uint8_t page_status_ = kBtOk;
  sim::Clicks linked_at_ = -1;  // when the answer to the page is announced; negative: none
  BtAddress other_{};           // of the peer
  bool lost_computer_ = false;  // it comes back when it can
};

}  // namespace board
