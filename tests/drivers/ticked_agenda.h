// SPDX-License-Identifier: MIT
// The yardstick for AgendaTimer: Timer 2, its interrupt and the motor agendas written out tick by tick, as
// the processor runs them. Slow and plain on purpose. Times in cycles; a handler's own time is the sum of
// its callbacks' durations.
#pragma once
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <memory>
#include <vector>

#include "hal_sim/board/stepper.h"

namespace ticked {

using board::Cycle;

constexpr Cycle kTick = 1475;

struct Motor {
  explicit Motor(int forward) : stepper(forward) { stepper.connect(true); }
  board::Stepper stepper;
  std::int16_t speed = 0;
  std::int16_t steps = 0;
  int phase = 0;
  bool phase_on = false;
};

class Agendas {
 public:
  static constexpr int kLeft = 1000;   // run_left_motor
  static constexpr int kRight = 1001;  // run_right_motor

  struct Node {
    std::uint16_t cycle;
    std::int16_t counter;
    bool active;
    int function;
  };

  /// What a callback does: may call anything of this class; returns how many cycles it takes.
  std::function<Cycle(int function, Cycle at)> callback;

  Motor left{-1}, right{+1};
  bool trapped = false;

  void start(Cycle at) {
    running_ = true;
    next_tick_ = at + kTick;
    flag_ = false;
  }
  void stop() { running_ = false; }

  int activate(int function, int cycle) {
    for (Node* n : list_)
      if (n->function == function) return 1;
    all_.push_back(std::make_unique<Node>(Node{static_cast<std::uint16_t>(cycle), 0, true, function}));
    list_.insert(list_.begin(), all_.back().get());
    return 1;
  }
  int destroy(int function) {
    for (std::size_t i = 0; i < list_.size(); ++i) {
      if (list_[i]->function != function) continue;
      list_.erase(list_.begin() + static_cast<std::ptrdiff_t>(i));  // the node itself is left alone
      return 1;
    }
    return 2;
  }
  int with(int function, const std::function<void(Node&)>& change) {
    for (Node* n : list_) {
      if (n->function != function) continue;
      change(*n);
      return 1;
    }
    return 2;
  }
  int set_cycle(int function, int cycle) {
    return with(function, [&](Node& n) { n.cycle = static_cast<std::uint16_t>(cycle); });
  }

  void set_speed(bool is_left, int speed) {
    Motor& m = is_left ? left : right;
    m.stepper.set_coils_only(0);
    if (speed > 1000) speed = 1000;
    if (speed < -1000) speed = -1000;
    m.speed = static_cast<std::int16_t>(speed);
    set_cycle(is_left ? kLeft : kRight, speed == 0 ? 0 : 10000 / std::abs(speed));
  }

  /// Lets time pass up to `until`; returns the time at which the program goes on (later if
  /// a handler ran over).
  Cycle run(Cycle until) {
    for (;;) {
      if (!running_ || next_tick_ > until) return until;
      flag_ = true;
      Cycle at = next_tick_;
      next_tick_ += kTick;
      while (flag_ && !trapped) {
        flag_ = false;
        at = interrupt(at);
        while (running_ && next_tick_ <= at) {
          flag_ = true;
          next_tick_ += kTick;
        }
        if (!running_) flag_ = false;
      }
      if (trapped) return at;
      if (at > until) until = at;
    }
  }

 private:
  Cycle interrupt(Cycle began) {
    Cycle at = began;
    Cycle fires_at = began;                 // what is delayed by less than a tick counts as in time
    const std::vector<Node*> walk = list_;  // nodes activated meanwhile stand before the one being processed
    for (Node* n : walk) {
      bool alive = false;
      for (Node* m : list_) alive = alive || m == n;
      if (!alive) continue;
      if (!n->active || n->cycle == 0) continue;
      ++n->counter;
      if (static_cast<std::uint16_t>(n->counter) > static_cast<std::uint16_t>(n->cycle - 1)) {
        if (n->function == kLeft) {
          fire(left, fires_at, kLeft);
        } else if (n->function == kRight) {
          fire(right, fires_at, kRight);
        } else {
          at += callback(n->function, at);
          if (running_ && at - fires_at >= kTick) fires_at = at;
        }
        if (trapped) return at;
        n->counter = 0;
      }
    }
    return at;
  }

  void fire(Motor& m, Cycle at, int self) {
    const int magnitude = std::abs(m.speed);
    if (m.phase_on && magnitude < 601) {
      m.stepper.set_coils_only(0);
      m.phase_on = false;
      if (magnitude == 0) {
        trapped = true;
        return;
      }
      set_cycle(self, 10000 / magnitude - 10000 / 650);
      return;
    }
    int turn;
    if (self == kLeft) {
      turn = m.speed > 0 ? -1 : +1;
      m.steps = static_cast<std::int16_t>(m.steps + (m.speed > 0 ? 1 : -1));
    } else {
      turn = m.speed < 0 ? -1 : +1;
      m.steps = static_cast<std::int16_t>(m.steps + (m.speed < 0 ? -1 : 1));
    }
    m.phase = (m.phase + turn + 4) % 4;
    m.stepper.energise(board::kPhaseCoils[m.phase], at);
    if (magnitude < 601) {
      m.phase_on = true;
      set_cycle(self, 10000 / 650);
    }
  }

  std::vector<Node*> list_;                 // newest first; nodes of this short test program are never freed
  std::vector<std::unique_ptr<Node>> all_;  // destroyed nodes too: a walk may still stand on one
  bool running_ = false;
  bool flag_ = false;
  Cycle next_tick_ = 0;
};

}  // namespace ticked
