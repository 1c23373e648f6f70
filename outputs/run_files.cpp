// SPDX-License-Identifier: MIT
#include "outputs/run_files.h"

#include <filesystem>

#include "outputs/output_folder.h"
#include "sim_core/load/world_loader.h"

namespace outputs {

void note_world(const sim::WorldDesc& world, twin::Options options,
                const std::vector<std::string>& supervisors, sim::FileUses& files) {
  if (options.world_folder.empty())
    options.world_folder = std::filesystem::path(world.file).parent_path().string();
  files.reads(world.file, "the world");
  const auto named = [&](const std::string& name, const char* key) {
    if (!name.empty()) files.reads(sim::resolve_path(world, name), key);
  };
  named(world.floor.image, "the world's floor.image");
  named(world.webots.world, "the world's webots.world");
  for (const sim::SoundDesc& sound : world.sounds) named(sound.file, "the world's sound.file");
  runs::note_programs(world, options, supervisors, files);
}

void note_outputs(const OutputArguments& a, const sim::WorldDesc& world, sim::FileUses& files) {
  files.writes(a.record, "--record");
  files.writes(a.summary, "--summary");
  files.writes(a.coverage, "--coverage");
  files.writes(a.pictures.picture, "--picture");
  files.writes(a.pictures.film, "--film");
  for (const std::string& file : a.pictures.heatmaps) files.writes(file, "--heatmap");
  files.writes(a.traces.vcd, "--vcd");
  files.writes(a.traces.timeline, "--trace");
  files.writes(a.report, "--report");
  for (int r = 0; r < static_cast<int>(world.robots.size()); ++r) {
    if (!a.sound_folder.empty()) files.writes(output_file(a.sound_folder, world, r) + ".wav", "--save-sound");
    if (!a.images.empty()) files.writes_pictures(output_file(a.images, world, r), "--save-images");
  }
}

}  // namespace outputs
