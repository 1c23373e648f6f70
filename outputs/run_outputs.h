// SPDX-License-Identifier: MIT
// The files a run leaves behind: recording, summary, coverage, pictures, sounds. Files are opened before the
// run, so a bad path costs no simulated second; the recording is whole up to the last line after any crash.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "hal_sim/runs/run.h"
#include "outputs/picture_outputs.h"
#include "outputs/saved_images.h"
#include "outputs/sound_output.h"
#include "outputs/summary.h"
#include "outputs/trace_outputs.h"

namespace sim {
class CsvRecorder;
}  // namespace sim
namespace viewer {
class Report;
}  // namespace viewer

namespace outputs {

struct OutputArguments {
  std::string record, summary, coverage, images, sound_folder, report;
  double record_every_s = 0.01;
  PictureArguments pictures;
  TraceArguments traces;
};

/// `files` but for those that a line of `problems` begins with.
std::vector<std::string> without_lost(std::vector<std::string> files,
                                      const std::vector<std::string>& problems);

class RunOutputs {
 public:
  /// Of a run that outlives it, and that was opened with `arguments.coverage`.
  RunOutputs(const OutputArguments& arguments, runs::Run& run);
  ~RunOutputs();
  /// Checks all, then opens all; false and one line per problem otherwise.
  bool open(std::vector<std::string>& problems);
  void before_run();
  void after_tick();
  /// True when an output needs every tick.
  bool wants_ticks() const;
  /// An output was lost (disk full): the run should end.
  bool failed() const;
  /// The process ends between two ticks that it will not come back from: what is in memory goes to the file.
  void rescue();
  void finish(const Summary& summary, std::vector<std::string>& problems);
  /// Files and folders that were asked for, for people.
  std::vector<std::string> written() const;

 private:
  void sample();

  const OutputArguments arguments_;
  runs::Run& run_;
  twin::Twin& twin_;  // the run's
  std::unique_ptr<sim::CsvRecorder> recorder_;
  std::unique_ptr<SavedImages> images_;
  std::unique_ptr<SoundOutput> sound_;
  PictureOutputs pictures_;
  TraceOutputs traces_;
  std::unique_ptr<viewer::Report> report_;
};

}  // namespace outputs
