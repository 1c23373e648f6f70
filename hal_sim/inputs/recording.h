// SPDX-License-Identifier: MIT
// Inputs with their ticks, written down: they repeat a run bit by bit.
//
//   {"twinpuck_inputs": 1, "file": "maze.toml", "text": "...", "seed": 1, "firmware": [["*", "obstacle"]]}
//   {"at": 7372800, "do": "selector", "robot": "puck", "position": 3}
//   {"at": 29491200, "do": "end", "digest": "165a659790c166b6"}
//
// The programs that ran are kept beside the file, FILE.images/HASH.elf: sources may be others by then.
#pragma once
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hal_sim/inputs/inputs.h"
#include "hal_sim/twin/twin.h"
#include "sim_core/base/output_file.h"

namespace inputs {

/// How a world was opened: what a recording begins with.
struct Opening {
  std::string file, text;
  std::uint64_t seed = 1;
  twin::Options options;
  std::vector<std::string> supervisors;
  /// What robots ran when the run began, of a recording; empty: it does not say.
  struct Image {
    std::string robot, program, file, hash;  ///< its name, what it was built from, where it is kept, content
  };
  std::vector<Image> images;
};
Json to_json(const Opening& opening);

/// What robots run, as it is now.
struct RunImages {
  std::vector<Opening::Image> images;        ///< `file`: where it lies
  std::map<std::string, std::string> bytes;  ///< by hash
  std::string error;                         ///< "FILE: what is wrong"; empty: all could be read
};
RunImages images_of(const twin::Twin& twin);

/// Writes inputs down as they happen.
class Recorder {
 public:
  /// `run`: as it was opened; its images are kept. `option`: what the file was asked for with.
  Recorder(const std::string& path, const Opening& opening, const RunImages& run, const std::string& option);
  void note(sim::Clicks at, const Json& input);
  /// The run is over.
  void end(sim::Clicks at, std::uint64_t digest);
  const std::string& error() const { return file_.error(); }

 private:
  std::string keep(const std::string& bytes, const std::string& hash);

  std::string path_, option_;
  sim::OutputFile file_;
};

/// A recording, done again.
class Replay {
 public:
  /// Null, with a line in `problems`, when the file is none.
  static std::unique_ptr<Replay> open(const std::string& path, std::vector<std::string>& problems);
  /// What it was opened with; the rest of the options are the caller's.
  Opening opening;
  /// When the next input is due; kEver: no more come.
  sim::Clicks next() const {
    return at_ < inputs_.size() ? inputs_[at_].at("at").get<sim::Clicks>() : sim::kEver;
  }
  /// The options with which it was opened, over those of the command; programs that cannot be built as they
  /// were, from where they lay, run as they were kept.
  void resume(twin::Options& options) const;
  /// What was done at the end, then: is it the same run? Otherwise a line in `problems`.
  void finish(Inputs& inputs, sim::Simulation& simulation, std::vector<std::string>& problems);
  /// Does all that are due now.
  void apply_due(Inputs& inputs, sim::Clicks now);
  /// All of it, in the order of their ticks.
  const std::vector<Json>& inputs() const { return inputs_; }
  /// Where the recording ends, and with which digest; negative: it was cut off.
  sim::Clicks end() const { return end_; }
  std::uint64_t digest() const { return digest_; }
  /// What there is to say of a recording that was cut off; `path`: its file.
  static std::string cut_off(const std::string& path);

 private:
  std::vector<Json> inputs_;
  std::size_t at_ = 0;
  sim::Clicks end_ = -1;
  std::uint64_t digest_ = 0;
};

}  // namespace inputs
