// SPDX-License-Identifier: MIT
// What a supervisor asks, and answers to it.
#pragma once
#include <gtest/gtest.h>
#include <webots/supervisor.h>

#include <vector>

#include "tests/controller/fake_simulator.h"

namespace fake {

inline World supervised(bool nue = false) {
  World world;
  world.supervisor = true;
  world.nue = nue;
  return world;
}

/// A question that comes alone, or last in its packet.
inline Record asked(Simulator& sim, int number) {
  const auto said = sim.next();
  if (said.empty() || said.back().number != number) {
    ADD_FAILURE() << "expected record " << number;
    return {};
  }
  return said.back();
}

inline void give_node(Simulator& sim, int number, int kind = WB_NODE_SOLID, const char* def = "BALL") {
  sim.send(Packet().add(LINK_NODE, number, 1, kind, def, "Ball", "Solid"));
}
inline void give_field(Simulator& sim, int number, int type, int count, const char* name) {
  sim.send(Packet().add(LINK_FIELD, number, type, count, name));
}
inline void give(Simulator& sim, const std::vector<double>& numbers, const char* text = "", int count = -1,
                 int node = 0) {
  sim.send(Packet().add(LINK_VALUE, count, node, numbers, text));
}

}  // namespace fake
