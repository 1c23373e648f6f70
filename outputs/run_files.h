// SPDX-License-Identifier: MIT
// Which files a run reads and writes, for sim::FileUses: one place knows them all.
#pragma once
#include <string>
#include <vector>

#include "hal_sim/twin/firmware_store.h"
#include "outputs/run_outputs.h"
#include "sim_core/base/file_uses.h"

namespace outputs {

/// The world's file and those that it names; programs of robots and supervisors, those of the command line in
/// their places; the files of serial lines.
void note_world(const sim::WorldDesc& world, twin::Options options,
                const std::vector<std::string>& supervisors, sim::FileUses& files);

/// What the outputs of a run in that world are written to.
void note_outputs(const OutputArguments& arguments, const sim::WorldDesc& world, sim::FileUses& files);

}  // namespace outputs
