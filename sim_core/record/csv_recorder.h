// SPDX-License-Identifier: MIT
// The --record file: one CSV row per robot and instant, SI units. Whole lines are written at once, so
// whatever happens the file ends with a whole line. The first I/O error is kept; later calls do nothing.
#pragma once
#include <string>

#include "sim_core/base/clock.h"
#include "sim_core/base/output_file.h"
#include "sim_core/world/robot_mind.h"

namespace sim {

class CsvRecorder {
 public:
  /// every_s: time between rows of one robot, s, > 0; rows appear at the first tick at or
  /// after each multiple.
  CsvRecorder(const std::string& path, double every_s = 0.01);
  ~CsvRecorder();
  CsvRecorder(const CsvRecorder&) = delete;
  CsvRecorder& operator=(const CsvRecorder&) = delete;

  /// Call once before the first step and after every step.
  void sample(const Scene& scene, const Minds& minds);
  /// Writes what is still in memory to the file. True when all went well so far.
  bool flush();

  bool is_good() const { return file_.error().empty(); }
  /// "F.csv: cannot be written: No space left on device"; empty while all is well.
  const std::string& error() const { return file_.error(); }

 private:
  void write_buffer();

  OutputFile file_;
  Clicks every_;
  Clicks next_ = 0;
  std::string buffer_;
};

}  // namespace sim
