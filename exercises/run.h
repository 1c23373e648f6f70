// SPDX-License-Identifier: MIT
// An exercise with the programs of somebody: all its trials, and the verdict. Trials are shared among
// processes, as a world and its programs belong to one; results come back by the trial's number, so they do
// not depend on how many processes there are.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "exercises/mine.h"
#include "exercises/report.h"
#include "exercises/table.h"

namespace lab {

/// How exercises are tried.
struct Setting {
  std::string hal;       ///< of programs that the world names; empty: as the world says
  int seeds = 0;         ///< of everything left to chance; 0: the table's
  int first_seed = 1;    ///< those are first_seed, first_seed + 1 ...
  bool full = false;     ///< as many and as long as the table has for figures
  int jobs = 1;          ///< processes
  bool is_mine = false;  ///< exercises S are looked at, not judged
  /// Somebody wants no more trials: what is under way has no verdict.
  std::function<bool()> is_over = [] { return false; };
};

enum class Verdict {
  Pass,
  Fail,
  Seen,      ///< nothing to be right or wrong
  None,      ///< there is no program for it
  Open,      ///< it was not tried, or not to its end
  Broken,    ///< its program does not build
  TimedOut,  ///< it took longer than it may
  Died       ///< the simulator did
};
/// "pass", "FAIL", "seen", "none", "open"; what else did not come to a verdict is a FAIL as well.
const char* verdict_text(Verdict verdict);
bool is_failure(Verdict verdict);

/// One exercise, tried.
struct Cell {
  const Exercise* exercise = nullptr;
  Verdict verdict = Verdict::None;
  std::string why;  ///< why there is no result: no program, it does not build, time
  std::vector<StepResult> steps;
  std::vector<std::string> problems;  ///< traps, compilers' errors, a line each
};

/// The trials of a step, not made yet.
std::vector<TrialResult> trials_of(const Step& step, const Setting& setting, const Programs& programs);

/// Tries all of an exercise; `tell` gets problems as they come.
Cell try_exercise(const Exercise& exercise, const Setting& setting, const Programs& programs,
                  const std::function<void(const std::vector<std::string>&)>& tell);

/// "4 of 4 runs neither stuck nor at a wall, max standstill 3.3 s (needs all 4: standstill at most 5 s)".
std::string to_text(const Cell& cell, const Setting& setting, bool times);

/// The trial that tells why it failed, as `lab --replay` takes it: "I1:corners:3". Empty: none.
std::string telling_trial_name(const Cell& cell);
/// "I1:corners:3", with a noise scale "S15:u_obstacle:3:0.5".
std::string trial_name(const Exercise& exercise, const Trial& trial);

/// From one process to another: what came out, without what both know.
std::string pack(const Cell& cell);
/// False: the text is no cell's. `trials`: of the same exercise, setting and programs.
bool unpack(const std::string& text, const Setting& setting, const Programs& programs, Cell& cell);

}  // namespace lab
