// SPDX-License-Identifier: MIT
#include "outputs/run_outputs.h"

#include <algorithm>
#include <iostream>

#include "install/places.h"
#include "outputs/output_folder.h"
#include "sim_core/record/csv_recorder.h"
#include "viewer/report.h"

namespace outputs {

std::vector<std::string> without_lost(std::vector<std::string> files,
                                      const std::vector<std::string>& problems) {
  const auto is_lost = [&](const std::string& file) {
    // "FILE: cannot be written", "FOLDER/FILE: cannot be written"
    return std::any_of(problems.begin(), problems.end(), [&](const std::string& problem) {
      return problem.rfind(file + ":", 0) == 0 || problem.rfind(file + "/", 0) == 0;
    });
  };
  files.erase(std::remove_if(files.begin(), files.end(), is_lost), files.end());
  return files;
}

RunOutputs::RunOutputs(const OutputArguments& arguments, runs::Run& run)
    : arguments_(arguments),
      run_(run),
      twin_(run.twin()),
      pictures_(arguments.pictures, twin_),
      traces_(arguments.traces, twin_) {}
RunOutputs::~RunOutputs() = default;

bool RunOutputs::open(std::vector<std::string>& problems) {
  const std::size_t before = problems.size();
  const auto& a = arguments_;
  // what there is already stays as it is until all is well
  for (const auto& [file, option] : {std::pair{a.summary, "--summary"},
                                     {a.coverage, "--coverage"},  // counts are added to those of earlier runs
                                     {a.record, "--record"},
                                     {a.report, "--report"}})
    can_write(file, option, problems);
  pictures_.check(problems);
  traces_.check(problems);
  if (problems.size() != before) return false;

  if (!a.sound_folder.empty()) {
    sound_ = std::make_unique<SoundOutput>(a.sound_folder, twin_);
    sound_->open(problems);
  }
  if (!a.images.empty()) {
    images_ = std::make_unique<SavedImages>(a.images);
    images_->open(twin_, problems);
  }
  if (problems.size() != before) return false;

  if (!a.record.empty()) {
    recorder_ = std::make_unique<sim::CsvRecorder>(a.record, a.record_every_s);
    if (!recorder_->is_good()) problems.push_back(recorder_->error());
  }
  pictures_.open();
  traces_.open(problems);
  if (!a.report.empty()) {
    report_ = std::make_unique<viewer::Report>(a.report, twin_, places::page_folder().string(),
                                               a.traces.vcd.empty() && a.traces.timeline.empty());
    if (!report_->error().empty()) problems.push_back(report_->error());
  }
  return problems.size() == before;
}

void RunOutputs::before_run() {
  pictures_.set_labels([this] { return run_.team().labels(); });
  sample();
  pictures_.before_run();
}

void RunOutputs::after_tick() {
  for (int robot : run_.team().moved_robots()) pictures_.lift_pen(robot);
  sample();
  pictures_.after_tick();
  traces_.after_tick();
  if (auto* coverage = run_.coverage()) coverage->look();
}

bool RunOutputs::wants_ticks() const {
  const std::vector<std::string> files = written();
  return std::any_of(files.begin(), files.end(), [&](const auto& f) { return f != arguments_.summary; });
}

void RunOutputs::sample() {
  const auto& simulation = twin_.simulation();
  if (recorder_) recorder_->sample(simulation.scene(), simulation.minds());
  if (sound_) sound_->after_tick();
  if (report_) report_->sample();
}

bool RunOutputs::failed() const {
  return (recorder_ && !recorder_->is_good()) || (images_ && images_->failed()) ||
         (sound_ && !sound_->error().empty()) || pictures_.failed() || traces_.failed();
}

void RunOutputs::rescue() {
  std::cout.flush();
  if (recorder_) recorder_->flush();
}

std::vector<std::string> RunOutputs::written() const {
  const auto& a = arguments_;
  std::vector<std::string> files = a.pictures.heatmaps;
  for (const std::string& file : {a.record, a.summary, a.pictures.picture, a.pictures.film, a.traces.vcd,
                                  a.traces.timeline, a.coverage, a.images, a.sound_folder, a.report})
    if (!file.empty()) files.push_back(file);
  return files;
}

void RunOutputs::finish(const Summary& summary, std::vector<std::string>& problems) {
  const auto& a = arguments_;
  if (recorder_ && !recorder_->flush()) problems.push_back(recorder_->error());
  if (images_ && images_->failed()) problems.push_back(images_->error());
  if (sound_ && !sound_->error().empty()) problems.push_back(sound_->error());
  write_file(a.summary, to_json(summary), "--summary", problems);
  if (auto* coverage = run_.coverage()) coverage->finish(problems);
  for (int r = 0; r < twin_.robots(); ++r)
    for (int port = 1; port <= 2; ++port)
      if (const auto* end = twin_.mind(r).board().uart(port).end(); end && !end->error().empty())
        problems.push_back(end->error() + "; further bytes of the robot are lost");
  if (report_) {
    const std::string wrong = report_->finish(to_json(summary));
    if (!wrong.empty()) problems.push_back(wrong);
  }
  pictures_.finish(summary, problems);
  traces_.finish(problems);
}

}  // namespace outputs
