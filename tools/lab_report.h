// SPDX-License-Identifier: MIT
// What the trials of an exercise come to: one line for people, rows for a CSV file, a plot of shares.
#pragma once
#include <string>
#include <vector>

#include "sim_core/record/share_plot.h"
#include "tools/lab_trial.h"

namespace tools {

struct TrialResult {
  Trial trial;
  bool ran = false;
  Measures measures;
  std::string said;  ///< by a supervisor, at last
  std::vector<std::string> problems;
};

/// One step of an exercise with all its trials, in order.
struct StepResult {
  const LabStep* step = nullptr;
  std::vector<TrialResult> trials;
  std::string problem;  ///< why it could not be tried; empty: it was
};

/// Every trial was made, without a trap.
bool has_run(const StepResult& result);

/// Part of the trials that ran and kept the step's bounds; of one noise scale unless that is not a number.
double share_of(const StepResult& result, double noise_scale);
bool is_passed(const StepResult& result);

/// "30 of 30 escape, median escape 9.1 s". `times` false leaves out what depends on the PC.
std::string to_text(const StepResult& result, bool times);

std::string lab_csv_header();
/// A line per trial.
std::string lab_csv(const std::string& exercise, const StepResult& result);

/// Share against noise scale, for a step with several.
sim::SharePlot share_plot(const StepResult& result);

}  // namespace tools
