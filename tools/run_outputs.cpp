// SPDX-License-Identifier: MIT
#include "tools/run_outputs.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>

#include "sim_core/record/csv_recorder.h"
#include "sim_core/record/picture.h"

namespace tools {

namespace {

// a file that cannot be written is found out before the run
bool can_write(const std::string& path, const char* option, std::vector<std::string>& problems) {
  if (path.empty()) return true;
  const bool existed = std::filesystem::exists(path);
  std::ofstream out(path, std::ios::app);
  if (out) {
    out.close();
    if (!existed) std::filesystem::remove(path);
    return true;
  }
  problems.push_back(path + ": " + option + ": got '" + std::strerror(errno) +
                     "', expected a file that can be written");
  return false;
}

// the whole text or an error; a file that could not be finished is named
bool write_text(const std::string& path, const std::string& text, const char* option,
                std::vector<std::string>& problems) {
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  errno = 0;
  out << text;
  out.close();
  if (out) return true;
  problems.push_back(path + ": " + option + ": cannot be written: " + std::strerror(errno ? errno : EIO));
  return false;
}

// lcov's tracefile format: one record a source file, DA:line,count
std::string lcov_of(const twin::Twin& twin) {
  std::map<std::string, std::map<long long, long long>> lines;
  for (const auto& image : twin.images())
    for (const auto& copy : image->copies()) {
      const tp_image& d = copy->description();
      std::map<std::pair<std::string, long long>, long long> here;  // of this copy: a line's busiest block
      for (const auto* c = d.coverage; c != d.coverage_end; ++c) {
        auto& count = here[{c->file, c->line}];
        count = std::max<long long>(count, *c->count);
      }
      for (const auto& [place, count] : here) lines[place.first][place.second] += count;
    }
  std::string text;
  for (const auto& [file, counts] : lines) {
    text += fmt::format("TN:\nSF:{}\n", file);
    long hit = 0;
    for (const auto& [line, count] : counts) {
      text += fmt::format("DA:{},{}\n", line, count);
      hit += count > 0;
    }
    text += fmt::format("LF:{}\nLH:{}\nend_of_record\n", counts.size(), hit);
  }
  return text;
}

}  // namespace

void add_output_options(CLI::App& verb, OutputArguments& a) {
  verb.add_option("--record", a.record, "CSV of poses, steps, sensors and LEDs");
  verb.add_option("--record-every", a.record_every_s, "seconds between rows of a robot")
      ->check(CLI::Range(1e-4, 1e6))
      ->capture_default_str();
  verb.add_option("--summary", a.summary, "JSON of what the run came to");
  verb.add_option("--picture", a.picture, "PNG or SVG of the world with the robots' ways");
  verb.add_option("--save-images", a.images,
                  "folder for every picture that a program gets from its camera (PNG)");
  verb.add_flag("--rays", a.rays, "draw the sensors' rays in the picture");
  verb.add_option("--save-sound", a.sound_folder,
                  "folder for what each robot's loudspeaker plays, a WAV file each");
  verb.add_option("--coverage", a.coverage,
                  "lcov file of the lines that firmware executed; builds controllers with counters");
}

RunOutputs::RunOutputs(const OutputArguments& arguments, twin::Twin& twin, const supervisor::Team* team)
    : arguments_(arguments), twin_(twin), team_(team) {}
RunOutputs::~RunOutputs() = default;

bool RunOutputs::open(std::vector<std::string>& problems) {
  const std::size_t before = problems.size();
  const auto& a = arguments_;
  can_write(a.summary, "--summary", problems);
  can_write(a.picture, "--picture", problems);
  can_write(a.coverage, "--coverage", problems);
  if (!a.picture.empty()) {
    const std::string kind = std::filesystem::path(a.picture).extension();
    if (kind != ".png" && kind != ".svg")
      problems.push_back(a.picture + ": --picture: got the ending '" + kind + "', expected .png or .svg");
    paths_ = std::make_unique<sim::Trajectories>(twin_.robots());
  }
  if (!a.sound_folder.empty()) {
    sound_ = std::make_unique<SoundOutput>(a.sound_folder, twin_);
    sound_->open(problems);
  }
  if (!a.record.empty() && can_write(a.record, "--record", problems)) {
    recorder_ = std::make_unique<sim::CsvRecorder>(a.record, a.record_every_s);
    if (!recorder_->is_good()) problems.push_back(recorder_->error());
  }
  if (!a.images.empty()) {
    images_ = std::make_unique<SavedImages>(a.images);
    images_->open(twin_, problems);
  }
  return problems.size() == before;
}

void RunOutputs::before_run() { after_tick(); }

void RunOutputs::after_tick() {
  const auto& simulation = twin_.simulation();
  if (paths_ && team_)
    for (int robot : team_->moved_robots()) paths_->lift_pen(robot);
  if (paths_) paths_->sample(simulation.scene());
  if (recorder_) recorder_->sample(simulation.scene(), simulation.minds());
  if (sound_) sound_->after_tick();
}

bool RunOutputs::failed() const {
  return (recorder_ && !recorder_->is_good()) || (images_ && images_->failed()) ||
         (sound_ && !sound_->error().empty());
}

void RunOutputs::finish(const Summary& summary, std::vector<std::string>& problems) {
  const auto& a = arguments_;
  if (recorder_ && !recorder_->flush()) problems.push_back(recorder_->error());
  if (images_ && images_->failed())
    problems.push_back(images_->folder() + ": --save-images: a picture cannot be written");
  if (sound_ && !sound_->error().empty()) problems.push_back(sound_->error());
  if (!a.summary.empty()) write_text(a.summary, to_json(summary), "--summary", problems);
  if (!a.coverage.empty()) write_text(a.coverage, lcov_of(twin_), "--coverage", problems);
  if (!a.picture.empty()) {
    sim::PictureOptions options;
    options.sensor_rays = a.rays;
    if (team_) options.labels = team_->labels();
    options.caption = fmt::format("{:g} s, seed {}, {} robot{}", summary.simulated_s, summary.seed,
                                  summary.robots.size(), summary.robots.size() == 1 ? "" : "s");
    const std::string error = sim::write_picture(a.picture, twin_.simulation().scene(),
                                                 twin_.simulation().minds(), paths_.get(), options);
    if (!error.empty()) problems.push_back(error);
  }
}

}  // namespace tools
