// SPDX-License-Identifier: MIT
// Work that may crash, hang or print: each piece in a process of its own, so that the others go on and
// whoever asked gets an end for every one of them.
//
//   work(i) in a child --its text--> pipe --> done(i, end) here, as each ends
#pragma once
#include <cstddef>
#include <functional>
#include <string>

namespace lab {

struct JobEnd {
  enum class How {
    Done,
    TimedOut,  ///< it took longer than the limit, and was ended with all that it had started
    Died       ///< by a signal, or by an exit of its own
  } how = How::Died;
  std::string result;  ///< what work() returned, when Done
  std::string errors;  ///< what it wrote to standard error, the last 64 KB of it
  std::string why;     ///< "ended by signal 11", when Died
};

/// Runs work(0) to work(count - 1), `at_once` at a time, each for at most `limit_s` real seconds. What a
/// child prints is not shown. done() is called here, in the order in which they end. Once `is_over` says so,
/// none is begun any more, and who has not ended is ended; done() hears of neither. Throws
/// std::runtime_error when no process can be made.
void run_contained(std::size_t count, int at_once, double limit_s, const std::function<bool()>& is_over,
                   const std::function<std::string(std::size_t)>& work,
                   const std::function<void(std::size_t, const JobEnd&)>& done);

}  // namespace lab
