// SPDX-License-Identifier: MIT
// The programs of `twinpuck timings`: what they do one thing after the other, a row each, and their C source.
#pragma once
#include <string>
#include <vector>

namespace tools::timing {

struct Less {
  const char* name;  // a row before
  int times = 1;
};

constexpr int kLeastGap = 30;  ///< cycles; a round of the loop that watches takes less without a handler

/// A handler is measured by the mean of `count` gaps above `above` cycles, one of `every`, the first `skip`
/// left out. `runs_natively`: it is no share there, so that what it takes more in the register way is
/// missing.
struct Gaps {
  int count = 0, above = kLeastGap, every = 1, skip = 0;
  bool runs_natively = false;
};

struct Row {
  const char* name;  // in the table, after T_; empty: a call that is held to take the same in both ways
  int table;
  const char* before;      // C code that is not measured
  const char* call;        // C code that is; of a handler what goes on meanwhile
  std::vector<Less> less;  // parts of it that have rows of their own
  const char* what;
  int tolerance = 2;  // cycles
  Gaps gaps = {};     // of handlers
  int times = 1;      // of a call: so often in it; of a handler: so often in the table
};

/// Drivers of which a program can have one variant each.
struct Program {
  const char* name;
  const char* head;
  std::vector<Row> rows;
  const char* camera = nullptr;  // of the robot; null: its usual one
};

/// All of them; their named rows, in this order, are the table.
const std::vector<Program>& programs();
/// Its source, which leaves what it has counted in `took`, a word for each row, and sets `done`.
/// `with_shares`: handlers that are shares of the time in the native way are measured, too; there they have
/// no gaps to see.
std::string source(const Program& program, bool with_shares);

}  // namespace tools::timing
