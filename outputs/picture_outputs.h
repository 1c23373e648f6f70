// SPDX-License-Identifier: MIT
// What a run leaves behind to look at: --picture, --heatmap, --film and their options.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hal_sim/twin/twin.h"
#include "outputs/summary.h"
#include "sim_core/record/picture.h"

namespace sim {
class Film;
class Heatmap;
}  // namespace sim

namespace outputs {

struct PictureArguments {
  std::string picture, film, heatmap_scale = "log";
  std::vector<std::string> heatmaps;
  bool rays = false;
  double heatmap_cell_m = 0.02;
  int film_fps = 25, film_size_px = 640;
  double film_speed = 1, film_trail_s = 10;
};

class PictureOutputs {
 public:
  PictureOutputs(const PictureArguments& arguments, twin::Twin& twin);
  ~PictureOutputs();
  /// Whether the files can be written, which stay as they are; one line per problem otherwise.
  void check(std::vector<std::string>& problems) const;
  void open();
  void before_run();
  void after_tick();
  /// Where text laid over the picture and each frame comes from; asked when one is drawn.
  void set_labels(std::function<std::vector<sim::PictureLabel>()> labels) { labels_ = std::move(labels); }
  /// A robot was put somewhere else: its line is broken there.
  void lift_pen(int robot);
  /// The film was lost (disk full): the run should end.
  bool failed() const;
  void finish(const Summary& summary, std::vector<std::string>& problems);

 private:
  void sample();

  const PictureArguments arguments_;
  twin::Twin& twin_;
  std::function<std::vector<sim::PictureLabel>()> labels_;
  std::unique_ptr<sim::Trajectories> paths_;
  std::unique_ptr<sim::Heatmap> heatmap_;
  std::unique_ptr<sim::Film> film_;
};

}  // namespace outputs
