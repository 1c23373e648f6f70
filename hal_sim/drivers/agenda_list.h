// SPDX-License-Identifier: MIT
// The library's list of agendas: functions, each with the ticks after which it is due. A new one comes to the
// front, and the handler walks from the front, so each node has a number that grows.
// Source: [lib: motor_led/advance_one_timer/e_agenda.c], facts restated.
#pragma once
#include <cstdint>
#include <vector>

#include "hal_sim/board/stepper.h"
#include "hal_sim/drivers/agenda_motor.h"
#include "hal_sim/drivers/agenda_ticks.h"

namespace drivers {

class AgendaList {
 public:
  /// Identifies an agenda: the address of its C function. Only compared, never followed here.
  using Function = const void*;
  enum class Kind : std::uint8_t { User, Left, Right };
  struct Node {
    Function function = nullptr;
    std::uint32_t serial = 0;  ///< grows with each activation: the list's order, newest first
    Kind kind = Kind::User;
    AgendaCount count;  ///< of user nodes; motors keep theirs in AgendaMotor
  };
  static board::Wheel wheel_of(Kind kind) {
    return kind == Kind::Left ? board::Wheel::Left : board::Wheel::Right;
  }

  AgendaList() { nodes_.reserve(4); }

  int size() const { return static_cast<int>(nodes_.size()); }
  bool has(Function function) const { return passed(function) < size(); }
  /// Nodes that a search for this function passes before it finds its own: those added later; all when it
  /// has none.
  int passed(Function function) const {
    int passed = 0;
    for (std::size_t i = nodes_.size(); i-- > 0 && nodes_[i].function != function;) ++passed;
    return passed;
  }
  /// The function that the walk has called, while its node is there; which comes next in it. Null: none.
  Function running(const AgendaTicks& ticks) const {
    if (ticks.is_calling())
      for (const Node& node : nodes_)
        if (node.serial == ticks.walked()) return node.function;
    return nullptr;
  }
  Function following(const AgendaTicks& ticks) const {
    if (ticks.is_walking())
      for (std::size_t i = nodes_.size(); i-- > 0;)
        if (nodes_[i].serial < ticks.walked()) return nodes_[i].function;
    return nullptr;
  }

  /// Which functions are run_left_motor and run_right_motor.
  void name_motor(board::Wheel wheel, Function function) { motors_[static_cast<int>(wheel)] = function; }
  bool is_of(board::Wheel wheel, Function function) const {
    return motors_[static_cast<int>(wheel)] == function;
  }

  /// Oldest first; the list is walked from the back.
  std::vector<Node>& nodes() { return nodes_; }
  const std::vector<Node>& nodes() const { return nodes_; }
  Node* find(Function function) {
    for (Node& node : nodes_)
      if (node.function == function) return &node;
    return nullptr;
  }
  std::uint32_t next_serial() { return ++last_serial_; }
  void erase(const Node* node) { nodes_.erase(nodes_.begin() + (node - nodes_.data())); }
  /// As after loading.
  void reset() {
    nodes_.clear();
    last_serial_ = 0;
    motors_[0] = motors_[1] = nullptr;
  }

 private:
  std::vector<Node> nodes_;
  Function motors_[2] = {nullptr, nullptr};
  std::uint32_t last_serial_ = 0;
};

}  // namespace drivers
