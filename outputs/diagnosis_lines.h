// SPDX-License-Identifier: MIT
// What board and chip had to say about a run's programs, for people. A program that writes wherever it likes is
// answered at each place; that is for --summary. Here neighbouring addresses are one line, and there are at most
// kMostOfACause lines of one cause.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "hal_sim/board/diagnosis.h"

namespace outputs {

/// `all`, in which neighbouring words of one cause and one sentence are one diagnosis: "0x0780 to 0x07fe".
std::vector<board::Diagnosis> joined(const std::vector<board::Diagnosis>& all);

/// The lines of a run, robot by robot.
class DiagnosisLines {
 public:
  static constexpr int kMostOfACause = 10;
  std::vector<std::string> of(const std::string& robot, const std::vector<board::Diagnosis>& all);
  /// Behind the last robot: a line for each cause that had more.
  std::vector<std::string> left_out() const;

 private:
  std::map<std::string, int> told_;  // by cause, those left out among them
};

}  // namespace outputs
