// SPDX-License-Identifier: MIT
#include "programs/puck/program_runner.h"

#include <algorithm>
#include <cstring>

#include "programs/puck/records.h"

namespace programs {

namespace {

/// Of a program of the PC nobody sees data or code.
class UnseenData final : public host::ProgramData {
 public:
  explicit UnseenData(std::string robot) : robot_(std::move(robot)) {}
  const host::Variable* find_variable(const std::string& expression, std::string& error) const override {
    error =
        "got '" + expression + "', but " + robot_ + " runs a program of the PC, whose variables nobody sees";
    return nullptr;
  }
  std::vector<char> read_variable(const std::string&, std::size_t) const override { return {}; }
  void read_memory(std::uintptr_t, void* to, std::size_t bytes) const override { std::memset(to, 0, bytes); }
  void write_memory(std::uintptr_t, const void*, std::size_t) override {}
  host::Place place_of(std::uintptr_t) const override { return {}; }
  host::Place place_now() const override { return {}; }

 private:
  const std::string robot_;
};

}  // namespace

ProgramRunner::ProgramRunner(std::string name, std::shared_ptr<Seat> seat, board::Board& board, Cycle start)
    : Runner(std::move(name)),
      seat_(std::move(seat)),
      board_(board),
      puck_(std::make_unique<Puck>(board, start)),
      data_(std::make_unique<UnseenData>(this->name())),
      end_(start),
      began_(board.clock().click_at(start)) {
  seat_->runner = this;
  ++seat_->began;
}

ProgramRunner::~ProgramRunner() {
  if (seat_->runner == this) seat_->runner = nullptr;
  link_free(&samples_);
}

/// Exact, however many steps there were: rounded from the whole time.
Cycle ProgramRunner::step_end() const {
  const std::int64_t ms = time_ms_ + step_ms_;
  const sim::Clicks clicks = clicks_of_ms(ms);
  return board_.clock().cycle_at(began_ + clicks);
}

void ProgramRunner::begin_step(std::int64_t milliseconds) {
  step_ms_ = std::max<std::int64_t>(1, milliseconds);
  ++turns_;
  // of steps shorter than a tick several end in one
  if (step_end() <= end_) end_step(end_);
}

void ProgramRunner::end_step(Cycle at) {
  puck_->run(at);
  link_clear(&samples_);
  puck_->sample(step_ms_, at, samples_);
  time_ms_ += step_ms_;
  step_ms_ = 0;
  is_due_ = true;
}

void ProgramRunner::run_until(Cycle end) {
  if (step_ms_ > 0 && step_end() <= end) end_step(std::max(step_end(), end_));
  puck_->run(end);
  end_ = std::max(end_, end);
  ++turns_;
}

Cycle ProgramRunner::idle_until() const {
  const Cycle step = step_ms_ > 0 ? step_end() : board::kNever;
  return std::min(step, puck_->next_event());
}

void ProgramRunner::end() {
  step_ms_ = 0;
  ++turns_;
}

void ProgramRunner::fail(host::TrapReport report) {
  traps_.push_back(std::move(report));
  has_failed_ = true;
  puck_->stop(end_);
  end();
}

void ProgramRunner::reset_processor() {
  board_.processor_reset(end_);
  is_due_ = has_failed_ = false;
  link_clear(&samples_);
  ++turns_;
}

// the new program finds the time of the world, in whole ms that are over
void ProgramRunner::restart() {
  reset_processor();
  puck_.reset();  // its drivers let go of the pins first
  puck_ = std::make_unique<Puck>(board_, end_);
  time_ms_ = ms_of_clicks(board_.clock().click_at(end_) - began_);
  step_ms_ = 0;
  ++seat_->began;
}

void ProgramRunner::begin_again() {
  began_ = board_.clock().click_at(end_);
  time_ms_ = 0;
}

void ProgramRunner::reset_under_program() {
  reset_processor();
  begin_again();
  const auto kept = puck_->keep();
  puck_.reset();  // its drivers let go of the pins first
  puck_ = std::make_unique<Puck>(board_, end_);
  puck_->adopt(*kept, end_);
}

}  // namespace programs
