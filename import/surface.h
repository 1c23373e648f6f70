// SPDX-License-Identifier: MIT
// Appearance nodes in, colours out. Pictures count with their average colour, where the file is there; known
// names of wood, stone, metal and so on otherwise.
#pragma once
#include <map>
#include <optional>
#include <string>

#include "import/piece.h"
#include "import/report.h"

namespace wbt {

/// Red, green and blue of a field, each 0 to 1; `otherwise` where it is not written.
sim::Colour colour_of(const Node& n, const char* field, double otherwise);

class Surfaces {
 public:
  /// `folder`: of the world; empty: no file is read.
  Surfaces(std::string folder, Report& report) : folder_(std::move(folder)), report_(report) {}

  /// Of an Appearance, a PBRAppearance or a PROTO of one; null: white.
  Surface of(const Node* appearance);
  /// File of the first picture in an appearance, empty when there is none.
  std::string picture_of(const Node* appearance) const;
  /// Average colour of a PNG or JPEG file.
  std::optional<sim::Colour> average(const std::string& file);

 private:
  sim::Colour textured(sim::Colour base, const Node& texture);
  std::string find(const std::string& url) const;

  std::string folder_;
  Report& report_;
  std::map<std::string, std::optional<sim::Colour>> averages_;  // by url
};

}  // namespace wbt
