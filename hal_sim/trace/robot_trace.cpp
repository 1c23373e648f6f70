// SPDX-License-Identifier: MIT
#include "hal_sim/trace/robot_trace.h"

#include "hal_sim/drivers/driver_params.h"

#include <algorithm>
#include <cstring>

#include "dspic30/device/dspic30f6014a.h"
#include "dspic30/memory/sfr_table.h"

namespace trace {

using host::Cycle;

namespace {

std::uint64_t bits_of(double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

std::uint64_t lowest(std::uint64_t value, int width) {
  return width >= 64 ? value : value & ((std::uint64_t{1} << width) - 1);
}

// what each instruction may change: W0 to W15, SR, RCOUNT ...
bool is_of_core(int address) { return address < static_cast<int>(dspic::sfr("DISICNT")); }

// TMR1 to TMR5: a tick may be a cycle
bool runs_freely(int address) {
  const char* name = dspic::Dspic30f6014a::register_name(static_cast<unsigned>(address));
  return std::strncmp(name, "TMR", 3) == 0 && name[4] == 0;
}

}  // namespace

RobotTrace::RobotTrace(board::Board& board, host::Runner* runner, std::vector<Signal> signals, bool spans)
    : board_(board), runner_(runner), signals_(std::move(signals)), keeps_spans_(spans) {
  for (std::size_t i = 0; i < signals_.size(); ++i) {
    const SignalSource& source = signals_[i].source;
    auto at =
        std::find_if(sampled_.begin(), sampled_.end(), [&](const Sampled& s) { return s.source == source; });
    if (at == sampled_.end()) {
      sampled_.push_back({source, 0, {}});
      at = sampled_.end() - 1;
    }
    at->signals.push_back(static_cast<int>(i));
    if (source.kind == Source::Variable) look_every = std::min(look_every, kVariableCycles);
    if (source.kind != Source::Register) continue;
    sees_registers = true;
    if (is_of_core(source.index)) look_every = 1;
    if (runs_freely(source.index)) shows_counters_ = true;
  }
  shown_.assign(signals_.size(), 0);
  for (int number : {1, 2}) board_.uart(number).watch(this, number);
  if (runner_) runner_->observe(this);
}

RobotTrace::~RobotTrace() {
  for (int number : {1, 2}) board_.uart(number).watch(nullptr, number);
  if (runner_) runner_->observe(nullptr);
}

// --- signals

void RobotTrace::reached(Cycle at) {
  if (at <= last_ || signals_.empty()) return;
  // what the chip does by itself before `at` comes back in about_to_change(). No further than the window: of
  // what comes from outside later nothing is known yet
  if (runner_ && runner_->chip()) runner_->chip()->carry_out(std::min(at - 1, runner_->cycles()));
  show_until(at);
}

void RobotTrace::about_to_change(Cycle at) {
  if (at > last_ && !signals_.empty()) show_until(at);
}

void RobotTrace::show_until(Cycle at) {
  sample(last_);
  for (Cycle t = horizon(last_); t < at; t = horizon(t)) sample(t);
  if (shows_counters_ && at - 1 > last_) sample(at - 1);
  last_ = at;
}

void RobotTrace::sample(Cycle at) {
  last_ = at;
  const sim::Clicks when = board_.clock().click_at(at);
  for (Sampled& s : sampled_) {
    const std::uint64_t value = value_of(s.source, at);
    if (begun_ && value == s.value) continue;
    s.value = value;
    for (int i : s.signals) {
      const Signal& signal = signals_[static_cast<std::size_t>(i)];
      const std::uint64_t bits = lowest(value >> signal.shift, signal.width);
      std::uint64_t& shown = shown_[static_cast<std::size_t>(i)];
      if (begun_ && bits == shown) continue;
      shown = bits;
      changes_.push_back({when, i, bits});
    }
  }
  begun_ = true;
}

std::uint64_t RobotTrace::value_of(const SignalSource& source, Cycle at) {
  using Register = board::Pins::Register;
  const char port = static_cast<char>(source.index);
  const std::size_t index = static_cast<std::size_t>(source.index);
  switch (source.kind) {
    case Source::Lat:
      return board_.pins().read(port, Register::Lat, at);
    case Source::Port:
      return board_.pins().read(port, Register::Port, at);
    case Source::Tris:
      return board_.pins().read(port, Register::Tris, at);
    case Source::Lights:
      return board_.pins().leds(at);
    case Source::Steps:
      return static_cast<std::uint64_t>(board_.motors().steps(static_cast<board::Wheel>(source.index), at));
    case Source::Flag:
      return runner_ && runner_->chip() && runner_->chip()->flag(source.index, at);
    case Source::Service:
      return std::any_of(open_.begin(), open_.end(),
                         [&](const Span& open) { return open.vector == source.index; });
    case Source::WireByte:
    case Source::WireBusy: {
      // frames come in time: those that are over give their byte, one that goes on makes the line busy
      auto& frames = frames_[index];
      while (!frames.empty() && frames.front().end <= at) frames.pop_front();
      const bool busy = !frames.empty() && frames.front().start <= at;
      if (busy) wire_byte_[index] = frames.front().byte;
      return source.kind == Source::WireBusy ? busy : wire_byte_[index];
    }
    case Source::Register:
      return runner_->chip()->peek(static_cast<unsigned>(source.index), at);
    case Source::Variable: {
      char bytes[16] = {};
      runner_->data().read_memory(source.variable.address, bytes,
                                  std::min(source.variable.bytes, sizeof bytes));
      const double value = host::variable_value(source.variable, bytes);
      if (source.variable.kind == host::Variable::Kind::Float) return bits_of(value);
      if (source.variable.bits > 0 || source.variable.bytes > sizeof(std::uint64_t))
        return static_cast<std::uint64_t>(static_cast<std::int64_t>(value));
      std::uint64_t raw = 0;
      std::memcpy(&raw, bytes, source.variable.bytes);
      return raw;
    }
  }
  return 0;
}

Cycle RobotTrace::horizon(Cycle at) {
  Cycle next = host::kNever;
  const auto port = [&](char letter) {
    // where a tick of the agendas is late, its own cycle has already passed
    const Cycle then = board_.pins().horizon(letter, at);
    next = std::min(next, then > at ? then : at + drivers::kAgendaTickCycles);
  };
  // The soonest instant at which any of the signals can change. What changes at calls only has none.
  for (const Sampled& s : sampled_) {
    switch (s.source.kind) {
      case Source::Lat:
      case Source::Port:
        port(static_cast<char>(s.source.index));
        break;
      case Source::Lights:
        port('C');
        break;
      case Source::Steps:
        port('D');
        break;
      case Source::Flag:
        if (runner_ && runner_->chip())
          next = std::min(next, runner_->chip()->flag_horizon(s.source.index, at));
        break;
      case Source::WireByte:
      case Source::WireBusy:
        for (const Frame& frame : frames_[static_cast<std::size_t>(s.source.index)]) {
          if (frame.start > at) next = std::min(next, frame.start);
          if (frame.end > at) {
            next = std::min(next, frame.end);
            break;
          }
        }
        break;
      case Source::Register:
        if (!runs_freely(s.source.index))
          next = std::min(next, runner_->chip()->register_horizon(static_cast<unsigned>(s.source.index), at));
        break;
      case Source::Tris:
      case Source::Service:
      case Source::Variable:
        break;
    }
  }
  return next;
}

void RobotTrace::frame(int uart, bool sent, std::uint8_t byte, Cycle start, Cycle end) {
  const std::size_t line = static_cast<std::size_t>((uart - 1) * 2 + (sent ? 0 : 1));
  if (!sent) ++received_;
  const bool shown = std::any_of(sampled_.begin(), sampled_.end(), [&](const Sampled& s) {
    return (s.source.kind == Source::WireByte || s.source.kind == Source::WireBusy) &&
           s.source.index == static_cast<int>(line);
  });
  if (shown) frames_[line].push_back({byte, start, end});
}

// --- the processor's course

void RobotTrace::handler_begins(int vector, Cycle flagged, Cycle entry, Cycle first) {
  reached(entry);
  Span span;
  span.kind = Span::Kind::Handler;
  span.begin = entry;
  span.vector = vector;
  span.flagged = flagged;
  span.first = first;
  span.depth = static_cast<int>(open_.size());
  open_.push_back(span);
}

void RobotTrace::handler_ends(Cycle at) {
  reached(at);
  if (open_.empty()) return;
  Span span = open_.back();
  open_.pop_back();
  span.end = at;
  if (keeps_spans_) spans_.push_back(span);
}

void RobotTrace::end_callback(Cycle at) {
  if (callback_.function == 0) return;
  callback_.end = at;
  if (keeps_spans_) spans_.push_back(callback_);
  callback_.function = 0;
}

void RobotTrace::callback(std::uintptr_t function, Cycle at) {
  end_callback(at);
  callback_.kind = Span::Kind::Callback;
  callback_.function = function;
  callback_.begin = at;
}

void RobotTrace::end_wait() {
  if (wait_.end > wait_.begin) spans_.push_back(wait_);
}

void RobotTrace::waited(Cycle from, Cycle to, int depth) {
  // the first rounds of a loop may have been told as delays of their own
  Cycle& told = depth > 0 ? waited_in_handler_ : wait_.end;
  from = std::max(from, told);
  if (!keeps_spans_ || to <= from) return;
  if (depth > 0) {
    waited_in_handler_ = to;
    Span span;
    span.kind = Span::Kind::HandlerWaiting;
    span.begin = from;
    span.end = to;
    span.depth = depth;
    spans_.push_back(span);
    return;
  }
  // Main's waits: one that goes straight on is one span, and between two the program was busy.
  if (wait_.end == from && wait_.end > wait_.begin) {
    wait_.end = to;
    return;
  }
  end_wait();
  if (from > wait_.end) {
    Span busy;
    busy.begin = wait_.end;
    busy.end = from;
    spans_.push_back(busy);
  }
  wait_.kind = Span::Kind::Waiting;
  wait_.begin = from;
  wait_.end = to;
}

void RobotTrace::ended(Cycle at) {
  reached(at);
  end_callback(at);
  while (!open_.empty()) handler_ends(at);
}

void RobotTrace::finish(Cycle now) {
  if (runner_) now = std::min(now, runner_->cycles());
  ended(now);
  if (!keeps_spans_) return;
  if (runner_ && runner_->waiting_since() < now) waited(runner_->waiting_since(), now, 0);
  end_wait();
  if (now <= wait_.end || !runner_) return;
  Span busy;
  busy.begin = wait_.end;
  busy.end = now;
  spans_.push_back(busy);
  wait_.begin = wait_.end = now;
}

}  // namespace trace
