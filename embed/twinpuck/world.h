// SPDX-License-Identifier: MIT
// A world that runs in this process.
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "twinpuck/robot.h"

namespace twinpuck {

/// What is wrong with an input, in the words of the command `twinpuck`.
class TWINPUCK_PUBLIC Error : public std::runtime_error {
 public:
  explicit Error(std::vector<std::string> lines);
  ~Error() override;
  /// "where: what: got X, expected Y", one each; what() is all of them.
  const std::vector<std::string>& lines() const { return lines_; }

 private:
  std::vector<std::string> lines_;
};

/// What a world is opened with beyond its file.
struct Settings {
  /// By a robot's name, or "*" for all others: an .elf or .hex, a folder of C files, which is built, or the
  /// name of a controller that Twinpuck brings along. Without one, what the world says.
  std::map<std::string, std::string> firmware;
  std::string hal;  ///< of controllers that are built: "sim" or "dspic"; empty: the world's, else sim
  std::string optimisation;  ///< "-O0" to "-Os"; empty: the project's, else -O1
  bool sanitize = false;     ///< check every access of memory, and 16-bit overflow
  long long seed = -1;       ///< 0 or more; else the world's
  int threads = 1;           ///< that run firmware; results do not depend on it
  /// Told what compilers, board and programs of the PC have to say, a line each; empty: nobody.
  std::function<void(const std::string&)> tell;
};

class TWINPUCK_PUBLIC World {
 public:
  /// A world file, or the name of one that Twinpuck brings along: "maze". Builds the robots' programs, which
  /// takes a moment the first time. Throws Error.
  explicit World(const std::string& file, const Settings& settings = {});
  /// The same of a world file's text; relative paths in it begin in the current folder.
  static World of_text(const std::string& text, const Settings& settings = {});
  ~World();
  World(World&& other) noexcept;
  World& operator=(World&& other) noexcept;

  /// As when it was opened. What robots are asked for after that begins anew, too.
  void reset();
  /// Simulated seconds from now on, to the end of the tick that reaches them. Ends early when a supervisor
  /// ends the run.
  void run(double seconds);
  /// Until `is_done`, which is asked after each tick. False: it was not within so many simulated seconds.
  bool run_until(const std::function<bool()>& is_done, double at_most_s);
  /// One tick.
  void step();

  double time_s() const;
  /// A hash of the whole run so far: equal for equal runs.
  std::uint64_t digest() const;
  /// In the order of the world file.
  std::vector<std::string> robots() const;
  /// Throws Error for a name that no robot has.
  Robot robot(const std::string& name);

 private:
  explicit World(std::unique_ptr<Opened> opened);
  std::unique_ptr<Opened> opened_;
};

}  // namespace twinpuck
