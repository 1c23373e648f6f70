// SPDX-License-Identifier: MIT
// What a program stands for in the world: a robot, or a supervisor's node without a body. The team asks it
// for devices, hands it commands and takes its samples.
#pragma once
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "programs/link/packet.h"
#include "programs/puck/program_runner.h"
#include "sim_core/radio/packet_medium.h"
#include "sim_core/world/world_desc.h"

namespace programs {

class Body {
 public:
  virtual ~Body() = default;
  /// Appends a DEVICE for each device.
  virtual void tell_devices(const sim::WorldDesc& world, link_packet& to) = 0;
  /// Appends DEVICE or NOTHING.
  virtual void find_device(const std::string& name, link_packet& to) = 0;
  /// Name of the device with this tag; empty: there is none.
  virtual std::string device_name(std::int64_t tag) const = 0;
  /// Empty, or what was wrong with the command.
  virtual std::string command(const link_record& record) = 0;
  /// The next step, of 1 ms or more, begins.
  virtual void begin_step(std::int64_t milliseconds) = 0;
  /// Has its step ended by `now` (clicks)?
  virtual bool is_due(sim::Clicks now) = 0;
  /// The samples of its step's end, appended. Returns the ms of that step.
  virtual std::int64_t take_samples(link_packet& to) = 0;
  /// ms since the program began.
  virtual std::int64_t time_ms() const = 0;
  /// The program is started anew.
  virtual void restart() = 0;
};

/// An e-puck; its runner may change.
class RobotBody final : public Body {
 public:
  explicit RobotBody(std::shared_ptr<Seat> seat) : seat_(std::move(seat)) {}
  ProgramRunner* runner() const { return seat_->runner; }
  std::uint64_t began() const { return seat_->began; }

  void tell_devices(const sim::WorldDesc& world, link_packet& to) override {
    runner()->puck().tell_devices(world, to);
  }
  void find_device(const std::string& name, link_packet& to) override {
    runner()->puck().find_device(name, to);
  }
  std::string device_name(std::int64_t tag) const override {
    return runner() ? runner()->puck().device_name(tag) : "";
  }
  std::string command(const link_record& record) override {
    runner()->note_command();
    return runner()->puck().command(record, runner()->now());
  }
  void begin_step(std::int64_t milliseconds) override {
    step_ms_ = milliseconds;
    runner()->begin_step(milliseconds);
  }
  bool is_due(sim::Clicks) override { return runner() && runner()->is_due(); }
  std::int64_t take_samples(link_packet& to) override;
  std::int64_t time_ms() const override { return runner() ? runner()->time_ms() : 0; }
  void restart() override {}

 private:
  std::shared_ptr<Seat> seat_;
  std::int64_t step_ms_ = 0;
};

/// A supervisor of the world's: emitters and receivers without a place, displays, a keyboard on which nobody
/// types. Motors it may name turn nothing.
class BodilessBody final : public Body, public sim::PacketPort {
 public:
  explicit BodilessBody(const sim::SupervisorDesc& desc);

  void tell_devices(const sim::WorldDesc& world, link_packet& to) override;
  void find_device(const std::string& name, link_packet& to) override;
  std::string device_name(std::int64_t tag) const override {
    return tag >= 1 && tag <= static_cast<std::int64_t>(devices_.size())
               ? devices_[static_cast<std::size_t>(tag - 1)].name
               : "";
  }
  std::string command(const link_record& record) override;
  void begin_step(std::int64_t milliseconds) override { step_ms_ = milliseconds; }
  bool is_due(sim::Clicks now) override;
  std::int64_t take_samples(link_packet& to) override;
  std::int64_t time_ms() const override { return time_ms_; }
  void restart() override;
  /// The world begins again and the program goes on: its time begins anew.
  void begin_again(sim::Clicks now) {
    began_ = now;
    time_ms_ = 0;
    for (Device& device : devices_) device.queue.clear();
  }
  /// World time at which the program begins.
  void begin(sim::Clicks now) { began_ = now; }

  bool listens(int channel) const override;
  void on_packet(const sim::ReceivedPacket& packet) override;

 private:
  struct Device {
    std::string name;
    int node;
    std::vector<double> needs;
    int channel = 0;      // of emitters and receivers
    double range_m = -1;  // of emitters
    std::int64_t period_ms = 0, elapsed_ms = 0;
    std::deque<sim::ReceivedPacket> queue{};
  };
  void tell(std::size_t device, link_packet& to) const;

  const sim::SupervisorDesc desc_;
  std::vector<Device> devices_;
  sim::Clicks began_ = 0;
  std::int64_t time_ms_ = 0, step_ms_ = 0;
};

}  // namespace programs
