// SPDX-License-Identifier: MIT
// The controllers that the robots of a run have: their sources as the page edits them, and builds of them
// beside the run. What becomes of a build is the session's business.
#pragma once
#include <future>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hal_sim/twin/twin.h"
#include "viewer/sources.h"

namespace viewer {

/// What a compiler says of a place.
struct Finding {
  std::string kind;  ///< "error", "warning", "note"
  std::string file;  ///< as told: a path; empty: of no file
  int line = 0, column = 0;
  std::string text;
};
/// Of a line as the compiler prints it: "main.c:3:5: error: expected ';'"; `kind` where it says none.
Finding finding_of(const std::string& line, const std::string& kind);

class Programs {
 public:
  struct Program {
    std::string name;
    std::vector<int> robots;
    Sources sources;
    bool stale = false;        ///< its sources have changed since it was built
    std::vector<int> waiting;  ///< robots that get it when it is built, and run another one until then
    bool is_built = false;     ///< once; `problems` and `warnings` say how it went
    std::vector<std::string> problems, warnings;
  };
  struct Built {
    std::string name, path;  ///< of the program, of its image
    std::vector<std::string> problems, warnings;
    double took_s = 0;
    bool for_all = false;     ///< for all robots that run it,
    std::vector<int> robots;  ///< and for these
  };

  ~Programs() { forget(); }
  /// Those of another run come.
  void clear() { programs_.clear(); }
  /// Waits for a build that is under way; what it built is for nobody.
  void forget();
  std::vector<Program>& all() { return programs_; }
  /// The one of that name; a new one, found from `folder`, where there is none.
  Program& named(const std::string& name, const std::string& folder);
  /// Null: no robot runs it.
  Program* find(const std::string& name);
  /// What compilers said when a run was opened: each line to the program whose file it names; `ok`: nothing
  /// kept the run from beginning.
  void take_opening(const std::vector<std::string>& problems, const std::vector<std::string>& told);

  /// A file of a program that became another on the disk.
  struct Change {
    std::string program, file, base;
  };
  /// Looks at all sources; what changed is stale.
  std::vector<Change> look();
  bool is_building() const { return build_.valid(); }
  /// The one that is to be built next; null: none, or a build is under way.
  Program* next_to_build();
  void build(Program& program, twin::Options options);
  /// A build that is done; it is noted with its program. Nothing: none is.
  std::optional<Built> take_built();
  void shift_robot(int robot, Program& to);

  nlohmann::json json(const twin::Twin* twin) const;

 private:
  std::vector<Program> programs_;
  std::future<Built> build_;
};

}  // namespace viewer
