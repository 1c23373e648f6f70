// SPDX-License-Identifier: MIT
// The host as board_exports.cpp sees it, without fibers: a cycle counter, and a record of what was asked.
#pragma once
#include <map>
#include <stdexcept>
#include <string>

#include "hal_sim/host/context.h"
#include "tests/drivers/driven_board.h"

class FakeContext : public host::Context {
 public:
  explicit FakeContext(DrivenBoard& robot) : Context(robot) {
    drivers_ = &robot.drivers();
    host::detail::running_here = this;
  }
  ~FakeContext() override { host::detail::running_here = nullptr; }

  host::Cycle now() override { return cycle; }
  void note_write() override { ++writes; }
  void spend(host::Cycle cycles) override { spent += cycles; }
  void follow_handlers() override { handler_share = drivers().handler_share_q32(); }
  void wait_until(host::Cycle at) override { cycle = std::max(cycle, at); }
  void irq_install(int vector, void (*handler)(), int, host::Cycle) override { handlers[vector] = handler; }
  void irq_at(int vector, host::Cycle at) override { requested[vector] = at; }
  void set_background(int slot, host::Cycle period, host::Cycle cost) override {
    background[slot] = {period, cost};
  }
  [[noreturn]] void trap(int, std::string_view message) override {
    throw std::runtime_error(std::string(message));
  }

  host::Cycle cycle = 0;
  host::Cycle spent = 0;
  host::Cycle& horizon = horizon_;
  int writes = 0;
  std::uint64_t handler_share = 0;  // as told last
  std::map<int, void (*)()> handlers;
  std::map<int, host::Cycle> requested;
  std::map<int, std::pair<host::Cycle, host::Cycle>> background;
};
