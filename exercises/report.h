// SPDX-License-Identifier: MIT
// What the trials of an exercise come to: one line for people, rows for a CSV file, a plot of shares.
#pragma once
#include <string>
#include <vector>

#include "exercises/trial.h"
#include "sim_core/record/share_plot.h"

namespace lab {

struct TrialResult : TrialEnd {
  explicit TrialResult(Trial which) : trial(std::move(which)) {}
  Trial trial;
};

/// One step of an exercise with all its trials, in order.
struct StepResult {
  const Step* step = nullptr;
  std::vector<TrialResult> trials;
  std::string problem;  ///< why it could not be tried; empty: it was
};

/// Every trial was made, without a trap.
bool has_run(const StepResult& result);

/// Part of the trials that ran and kept the step's bounds; of one noise scale unless that is not a number.
double share_of(const StepResult& result, double noise_scale);
bool is_passed(const StepResult& result);

/// What the step asks of its trials: "needs 9 of 10: escape at most 60 s, wall touch at most 0.5
/// s". Empty: nothing.
std::string asked_by(const Step& step, std::size_t trials);

/// A trial that tells why the step has failed: the first that kept its bounds not, or that should not have;
/// null: there is none.
const TrialResult* telling_trial(const StepResult& result);

/// "30 of 30 escape, median escape 9.1 s". `times` false leaves out what depends on the PC.
std::string to_text(const StepResult& result, bool times);

/// What a trial measured of what its step asks or shows: "standstill 3.31 s, wall touch 0 s".
std::string measures_text(const TrialResult& trial);

std::string csv_header();
/// A line per trial.
std::string csv_rows(const std::string& exercise, const StepResult& result);

/// Share against noise scale, for a step with several.
sim::SharePlot share_plot(const StepResult& result);

}  // namespace lab
