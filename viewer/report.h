// SPDX-License-Identifier: MIT
// A run as one HTML file: the page of the live view with all that it would have been told, to scrub through
// without a server or a network. Frames are those of docs/connecting.md, at most kMostFrames of them: a
// longer run has them farther apart. In: the run, tick by tick. Out: the file, at the end.
//
//   {"hello": {..}, "events": [..], "summary": {..}, "names": [..], "units": [..], "frame_bytes": n}
//   and in a second piece the frames, byte 0 of all of them, byte 1 .., deflated, in base64
#pragma once
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hal_sim/twin/twin.h"
#include "viewer/names.h"
#include "viewer/robot_look.h"
#include "viewer/trace_feed.h"

namespace viewer {

class Report {
 public:
  /// `page_folder`: of the bundled page. `time_line`: of the first robot with a program; a robot has one
  /// observer, so not beside other traces.
  Report(std::string path, twin::Twin& twin, const std::string& page_folder, bool time_line);
  ~Report();
  /// Empty, or why there can be none.
  const std::string& error() const { return error_; }

  /// Before the first tick and after every tick.
  void sample();
  /// Writes the file; `summary` is the JSON of --summary. Empty, or what is wrong.
  std::string finish(const std::string& summary);

 private:
  struct Line {
    int robot, port;
    std::string text;
  };
  void add_sources(nlohmann::json& programs, nlohmann::json& sources) const;
  void hear();
  void look();
  void thin();

  std::string path_, error_, html_, script_, style_;
  twin::Twin& twin_;
  std::vector<std::string> names_, units_;
  std::vector<Named> values_;
  std::vector<std::string> frames_;
  sim::Clicks every_, next_ = 0;
  nlohmann::json events_ = nlohmann::json::array();
  std::size_t heard_ = 0;  // bytes of serial text kept
  std::vector<std::unique_ptr<Line>> lines_;
  std::unique_ptr<TraceFeed> trace_;  // of the first robot with a program
  std::unique_ptr<RobotLook> look_;   // likewise
  std::size_t looked_ = 0;            // bytes of what was seen there
  sim::Clicks next_look_ = 0;
};

}  // namespace viewer
