// SPDX-License-Identifier: MIT
#include "import/import.h"

#include "import/carried.h"
#include "import/walk.h"
#include "import/wbt_reader.h"

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
  out.objects = static_cast<int>(carried.world.objects.size() + carried.world.ramps.size() +
                                 carried.world.walls.size());
  out.toml = write_toml(carried, options, out.report, read.version);
  return out;
}

}  // namespace wbt
