// SPDX-License-Identifier: MIT
// The exercises of the lab as a table: docs/lab.toml says what each runs, what it measures and what must come
// out. One home for names of measures; bad input gives `file:line:column: key: got X, expected Y`.
#pragma once
#include <array>
#include <limits>
#include <string>
#include <vector>

namespace lab {

/// What a run, or a look at a sensor, is measured by.
enum class Measure {
  StandstillS,   ///< longest time without 2 cm of progress, s; worst robot
  WallTouchS,    ///< longest touch of a wall or fixed object, s; worst robot
  TouchS,        ///< longest touch of anything, s; worst robot
  Collisions,    ///< touches begun, all robots
  DistanceM,     ///< way over the floor, m; laziest robot
  EscapeS,       ///< when the last robot left the region, s; infinite: not in time
  SlipM,         ///< way that the wheels turned and the robot did not make, m; worst robot
  Speed,         ///< simulated s per s of processor time, one thread
  Rows,          ///< of the sensor's lookup table
  RangeM,        ///< last distance of the table, m
  DetectionM,    ///< farthest wall of the world's material that is not read as nothing, m
  CentreWeight,  ///< of the ray on the axis, 0 to 1
  OuterWeight,   ///< of one of the others
  Restarts,      ///< times that somebody put an object into the air, more than 5 cm up at once
  RestartM,      ///< lowest height of its underside right after that, m
  Straightness,  ///< square of the correlation between distance and value: 1 for a linear sensor
  Count
};
inline constexpr std::size_t kMeasures = static_cast<std::size_t>(Measure::Count);
/// As docs/lab.toml spells it, unit included.
const char* measure_name(Measure m);

/// One row of measures; not a number where nothing was measured.
struct Measures {
  Measures() { value.fill(std::numeric_limits<double>::quiet_NaN()); }
  double& operator[](Measure m) { return value[static_cast<std::size_t>(m)]; }
  double operator[](Measure m) const { return value[static_cast<std::size_t>(m)]; }
  std::array<double, kMeasures> value;
};

struct Bound {
  Measure measure;
  double low, high;
};

/// "max wall_touch_s": one number for many runs.
struct Shown {
  enum class How { Max, Min, Mean, Median } how;
  Measure measure;
};

struct Span {
  double low = 0, high = 0;
};

/// Where robots start: at random in the free room of the arena, or at random around the place in the file.
struct Start {
  bool anywhere = false;
  Span x_m, y_m, heading_deg;  ///< added to the place in the file
};

struct Step {
  enum class Kind { Runs, Sensor, Answer } kind = Kind::Runs;
  std::string says;                 ///< what a run that keeps the bounds has done
  std::vector<std::string> worlds;  ///< files in worlds/, without ending
  /// For every robot; empty: as the world says. "lab/NAME": the solution of an exercise in which a
  /// student writes NAME.
  std::string firmware;
  std::string supervisor;  ///< in the place of the world's; empty: the world's
  double seconds = 60, full_seconds = 60;
  int quick_seeds = 1, full_seeds = 1;
  std::vector<double> noise_scales;  ///< of the proximity sensors; empty: as the world says
  std::vector<Span> shares;          ///< of runs that keep the bounds; one for all, or one per noise scale
  double gain_spread = 0, offset_spread_counts = 0, wheel_spread = 0;
  Start start;
  std::vector<double> region;  ///< x0 y0 x1 y1, m; empty: nothing to escape from
  std::vector<Bound> bounds;
  std::vector<Shown> shown;
  bool by_world = false;  ///< one figure per world
  std::string answer;     ///< heading in docs/lab-answers.md
};

/// What the student's program is called that a step asks for; empty when it asks for none.
std::string own_program(const Step& step);

struct Exercise {
  std::string id, title;
  std::vector<Step> steps;
};

/// Reads the table; empty, with lines in `problems`, when anything is wrong.
std::vector<Exercise> read_table(const std::string& file, std::vector<std::string>& problems);
/// The same from text; `file` is the name for messages.
std::vector<Exercise> parse_table(const std::string& text, const std::string& file,
                                  std::vector<std::string>& problems);

}  // namespace lab
