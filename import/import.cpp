// SPDX-License-Identifier: MIT
#include "import/import.h"

#include "import/carried.h"
#include "import/walk.h"

namespace wbt {

Imported import_world(std::string_view text, const Options& options) {
  Imported out;
  const WorldText read = read_world_text(text);
  out.errors = read.errors;
  if (!out.errors.empty()) return out;
  Report report;
  Carried carried = settle(Walk(read, options, report).scene(), options, report);
  make_room(carried, options, report);
  out.report = report.lines();
  out.robots = static_cast<int>(carried.world.robots.size());
  out.objects = static_cast<int>(carried.world.objects.size());  // as `check` counts them
  out.toml = write_toml(carried, options, out.report, read.version);
  return out;
}

Furniture furniture_of(const std::vector<NodePtr>& nodes, const WorldText& of, const Options& options,
                       double floor_z) {
  WorldText text;
  text.version = of.version;
  text.year = of.year;
  text.letter = of.letter;
  text.major = of.major;
  text.extern_protos = of.extern_protos;
  text.protos = of.protos;
  for (const NodePtr& n : of.nodes)
    if (n->type == "WorldInfo") text.nodes.push_back(n);
  text.nodes.insert(text.nodes.end(), nodes.begin(), nodes.end());
  Report report;
  const Scene scene = Walk(text, options, report).scene();
  Carried carried = settle(scene, options, report, floor_z);
  return {std::move(carried.world.objects), std::move(carried.world.lamps), report.lines(),
          static_cast<int>(scene.robots.size() + scene.supervisors.size())};
}

}  // namespace wbt
