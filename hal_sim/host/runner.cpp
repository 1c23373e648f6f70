// SPDX-License-Identifier: MIT
#include "hal_sim/host/runner.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace host {

const char* trap_name(int kind) {
  switch (kind) {
    case kUnexpectedReset:
      return "unexpected reset";
    case kTrapMath:
      return "math error";
    case kTrapAddress:
      return "address error";
    case kTrapStack:
      return "stack error";
    case kTrapAbort:
      return "abort";
    case kTrapInterrupt:
      return "interrupt trouble";
    case kTrapIllegal:
      return "illegal instruction";
    case kTrapSanitizer:
      return "sanitizer";
    case kTrapUnsimulated:
      return "not simulated";
    case kProgramEnded:
      return "its program";
    default:
      return "trap";
  }
}

std::string to_string(const Place& place) {
  if (place.line == 0) return place.function;
  return place.function + " (" + place.file + ":" + std::to_string(place.line) + ")";
}

std::vector<board::Diagnosis> Runner::dated(std::vector<board::Diagnosis> all,
                                            std::vector<board::Diagnosis> of_board) const {
  std::move(of_board.begin(), of_board.end(), std::back_inserter(all));
  for (board::Diagnosis& d : all) d.first_s = to_world_s ? to_world_s(d.first) : 0;
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return all;
}

}  // namespace host
