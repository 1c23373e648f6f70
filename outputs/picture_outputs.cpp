// SPDX-License-Identifier: MIT
#include "outputs/picture_outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "outputs/output_folder.h"
#include "sim_core/record/film.h"
#include "sim_core/record/heatmap.h"

namespace outputs {

namespace {

// a kind of file is found out before the run
void check_ending(const std::string& path, const char* option, const std::vector<const char*>& endings,
                  std::vector<std::string>& problems) {
  const std::string ending = std::filesystem::path(path).extension();
  if (std::find(endings.begin(), endings.end(), ending) != endings.end()) return;
  std::string expected;
  for (std::size_t i = 0; i < endings.size(); ++i)
    expected += (i == 0 ? "" : i + 1 < endings.size() ? ", " : " or ") + std::string(endings[i]);
  problems.push_back(path + ": " + option + ": got the ending '" + ending + "', expected " + expected);
}

}  // namespace

PictureOutputs::PictureOutputs(const PictureArguments& arguments, twin::Twin& twin)
    : arguments_(arguments), twin_(twin) {}
PictureOutputs::~PictureOutputs() = default;

void PictureOutputs::check(std::vector<std::string>& problems) const {
  const auto& a = arguments_;
  if (!a.picture.empty()) {
    check_ending(a.picture, "--picture", {".png", ".svg"}, problems);
    can_write(a.picture, "--picture", problems);
  }
  for (const auto& file : a.heatmaps) {
    check_ending(file, "--heatmap", {".png", ".svg", ".csv"}, problems);
    can_write(file, "--heatmap", problems);
  }
  if (!a.film.empty()) {
    check_ending(a.film, "--film", {".webm", ".png", ".apng"}, problems);
    can_write(a.film, "--film", problems);
  }
}

void PictureOutputs::open() {
  const auto& a = arguments_;
  if (!a.picture.empty()) paths_ = std::make_unique<sim::Trajectories>(twin_.robots());
  if (!a.heatmaps.empty()) heatmap_ = std::make_unique<sim::Heatmap>(twin_.robots(), a.heatmap_cell_m);
  if (a.film.empty()) return;
  sim::FilmOptions options;
  options.frames_per_s = a.film_fps;
  options.speed = a.film_speed;
  options.size_px = a.film_size_px;
  options.trail_s = a.film_trail_s;
  options.sensor_rays = a.rays;
  film_ = std::make_unique<sim::Film>(a.film, twin_.simulation().scene(), options);
  // a disk that is full already ends the run at its first tick, as one that fills up does later
}

void PictureOutputs::before_run() { sample(); }

void PictureOutputs::after_tick() {
  sample();
  if (heatmap_) heatmap_->sample(twin_.simulation().scene());
}

void PictureOutputs::lift_pen(int robot) {
  if (paths_) paths_->lift_pen(robot);
  if (film_) film_->lift_pen(robot);
}

void PictureOutputs::sample() {
  const auto& simulation = twin_.simulation();
  if (paths_) paths_->sample(simulation.scene());
  if (!film_) return;
  std::vector<sim::PictureLabel> labels;
  if (labels_ && film_->is_due(simulation.now())) labels = labels_();
  film_->sample(simulation.scene(), simulation.minds(), labels);
}

bool PictureOutputs::failed() const { return film_ && !film_->error().empty(); }

void PictureOutputs::finish(const Summary& summary, std::vector<std::string>& problems) {
  const auto& a = arguments_;
  const auto& simulation = twin_.simulation();
  const std::string caption = fmt::format("{:g} s, seed {}, {} robot{}", summary.simulated_s, summary.seed,
                                          summary.robots.size(), summary.robots.size() == 1 ? "" : "s");
  if (!a.picture.empty()) {
    sim::PictureOptions options;
    options.sensor_rays = a.rays;
    options.caption = caption;
    if (labels_) options.labels = labels_();
    const std::string error =
        sim::write_picture(a.picture, simulation.scene(), simulation.minds(), paths_.get(), options);
    if (!error.empty()) problems.push_back(error);
  }
  for (const auto& file : a.heatmaps) {
    sim::HeatmapOptions options;
    options.linear = a.heatmap_scale == "linear";
    options.caption = caption;
    const std::string error = sim::write_heatmap(file, *heatmap_, simulation.scene(), options);
    if (!error.empty()) problems.push_back(error);
  }
  if (film_) {
    film_->finish();
    if (!film_->error().empty()) problems.push_back(film_->error());
  }
}

}  // namespace outputs
