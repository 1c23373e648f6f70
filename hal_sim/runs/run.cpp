// SPDX-License-Identifier: MIT
#include "hal_sim/runs/run.h"

#include <filesystem>

namespace runs {

void note_programs(const sim::WorldDesc& world, const twin::Options& options,
                   const std::vector<std::string>& supervisors, sim::FileUses& files) {
  programs::note_supervisors(world, options.world_folder, supervisors, files);
  twin::note_programs(world, options, files);
  twin::note_uart_files(world, options, files);
}

std::unique_ptr<Run> Run::open(sim::WorldDesc world, twin::Options options,
                               const std::vector<std::string>& supervisors,
                               std::vector<std::string>& problems) {
  if (options.world_folder.empty())
    options.world_folder = std::filesystem::path(world.file).parent_path().string();
  std::unique_ptr<Run> run(new Run);
  run->twin_ = twin::Twin::open(std::move(world), options, problems);
  if (!run->twin_) return nullptr;
  run->team_ = programs::Team::open(*run->twin_, options, supervisors, problems);
  if (!run->team_) return nullptr;
  if (!options.coverage.empty()) {
    run->coverage_ = twin::CoverageRun::open(*run->twin_, options.coverage, problems);
    if (!run->coverage_) return nullptr;
  }
  run->inputs_ = std::make_unique<inputs::Inputs>(*run->twin_);
  return run;
}

}  // namespace runs
