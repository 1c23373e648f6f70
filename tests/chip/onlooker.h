// SPDX-License-Identifier: MIT
// Whoever is told all that happens, and does nothing.
#pragma once
#include "hal_sim/host/observer.h"

namespace hal_test {

struct Onlooker : host::Observer {
  int reaches = 0;
  void reached(host::Cycle) override { ++reaches; }
  void handler_begins(int, host::Cycle, host::Cycle, host::Cycle) override {}
  void handler_ends(host::Cycle) override {}
  void callback(std::uintptr_t, host::Cycle) override {}
  void waited(host::Cycle, host::Cycle, int) override {}
  void ended(host::Cycle) override {}
};

}  // namespace hal_test
