// SPDX-License-Identifier: MIT
// Pictures of a world and of what happened in it, by cairo: PNG or SVG by the file's extension.
// North is up. Robots at their last poses, one trajectory each, a scale bar, a legend.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "sim_core/record/trajectories.h"
#include "sim_core/world/robot_mind.h"

namespace sim {

/// Text laid over a picture, such as a score. Lines are separated by \n.
struct PictureLabel {
  int id = 0;  ///< a later label of the same id replaces an earlier one
  std::string text;
  double x = 0;             ///< left edge, fraction of the picture's width
  double y = 0;             ///< top edge, fraction of its height, from the top
  double size = 0.1;        ///< height of a line as a fraction of the picture's height
  std::uint32_t rgb = 0;    ///< 0xRRGGBB
  double transparency = 0;  ///< 0 solid, 1 invisible
};

struct PictureOptions {
  int width_px = 1200;       ///< the longer side of the map; PNG pixels, SVG units
  bool sensor_rays = false;  ///< rays of every proximity sensor, coloured by what they met
  bool names = true;         ///< robots' names, up to a few dozen robots
  std::string caption;       ///< second line under the title, such as time and seed; may be empty
  std::vector<PictureLabel> labels;
};

/// Draws and writes the file. Returns an empty string, or "FILE: what is wrong: got ..., expected ...".
std::string write_picture(const std::string& path, const Scene& scene, const Minds& minds,
                          const Trajectories* trajectories, const PictureOptions& options = {});

}  // namespace sim
