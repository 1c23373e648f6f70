// SPDX-License-Identifier: MIT
#include "viewer/report.h"

#include <zlib.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "sim_core/base/base64.h"
#include "sim_core/base/input_file.h"
#include "sim_core/base/output_file.h"
#include "sim_core/load/world_loader.h"
#include "viewer/events.h"
#include "viewer/frame.h"
#include "viewer/sources.h"
#include "viewer/world_json.h"

namespace viewer {

namespace {

using Json = nlohmann::json;

constexpr std::size_t kMostFrames = 3600;  // more than a minute at 50 a second
constexpr sim::Clicks kFirstEvery = sim::kClicksPerSecond / 50;
constexpr std::size_t kMostValues = 500;        // of a frame: about ten robots
constexpr std::size_t kMostSerial = 1u << 20;   // bytes
constexpr std::size_t kMostSources = 1u << 20;  // bytes
constexpr std::size_t kMostLooked = 1u << 20;   // bytes
constexpr sim::Clicks kLookEvery = sim::kClicksPerSecond / 10;
constexpr std::size_t kMostTraced = 40000;  // spans and changes of the time line
constexpr std::size_t kLongestPage = 16u << 20;

// coils and steps would fill it
const std::vector<std::string> kSignals{"LED0", "LED1",     "LED2",      "LED3",     "LED4", "LED5", "LED6",
                                        "LED7", "BODY_LED", "FRONT_LED", "AUDIO_ON", "TX1",  "RX1"};

/// Frames change little from one to the next: the same byte of all of them together packs well.
std::string packed(const std::vector<std::string>& frames) {
  std::string plain;
  const std::size_t size = frames.empty() ? 0 : frames.front().size();
  plain.reserve(size * frames.size());
  for (std::size_t byte = 0; byte < size; ++byte)
    for (const std::string& frame : frames) plain += frame[byte];
  uLongf length = compressBound(plain.size());
  std::string out(length, '\0');
  compress2(reinterpret_cast<Bytef*>(out.data()), &length, reinterpret_cast<const Bytef*>(plain.data()),
            plain.size(), Z_DEFAULT_COMPRESSION);
  out.resize(length);
  return sim::base64(out);
}

void replace(std::string& text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
}

std::string dumped(const Json& json) {
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  replace(text, "<", "\\u003c");  // nothing in it ends the element that it stands in
  return text;
}

}  // namespace

Report::Report(std::string path, twin::Twin& twin, const std::string& page_folder, bool time_line)
    : path_(std::move(path)), twin_(twin), every_(kFirstEvery) {
  for (auto [name, text] : {std::pair<const char*, std::string*>{"index.html", &html_},
                            {"page.js", &script_},
                            {"page.css", &style_}})
    if (!sim::read_input_file(page_folder + "/" + name, kLongestPage, *text).empty()) {
      error_ = path_ + ": --report: got no bundled page, expected one in " + page_folder +
               "; `make page` makes it";
      return;
    }
  for (const auto& robot : twin.world().robots)
    for (const std::string& name : names_of_robots()) {
      if (names_.size() == kMostValues) break;
      names_.push_back(robot.name + "." + name);
      values_.push_back(find_named(twin, names_.back()));
      units_.push_back(values_.back().unit);
    }
  for (int r = 0; r < twin.robots(); ++r) {
    for (int port = 0; port <= 2; ++port) {
      lines_.push_back(std::make_unique<Line>(Line{r, port, ""}));
      if (port > 0) twin.mind(r).board().uart(port).listen(&lines_.back()->text);
    }
    auto& console = twin.mind(r).board().virtual_devices().on_console;
    console = [before = console, line = lines_[lines_.size() - 3].get()](const std::string& text) {
      if (before) before(text);
      line->text += text + "\n";
    };
    if (!look_ && twin.mind(r).runner()) look_ = std::make_unique<RobotLook>(twin, r);
    if (time_line && !trace_ && twin.mind(r).runner())
      trace_ = std::make_unique<TraceFeed>(twin, r, kSignals);
  }
}

Report::~Report() = default;

void Report::hear() {
  for (const auto& line : lines_) {
    if (line->text.empty()) continue;
    if (heard_ < kMostSerial) events_.push_back(serial_event(twin_, line->robot, line->port, line->text));
    heard_ += line->text.size();
    line->text.clear();
  }
}

/// What numbers do not say; as long as there is room.
void Report::look() {
  if (!look_ || twin_.simulation().now() < next_look_ || looked_ > kMostLooked) return;
  next_look_ = twin_.simulation().now() + kLookEvery;
  Json event = look_->take();
  if (event.is_null()) return;
  looked_ += event.dump(-1, ' ', false, Json::error_handler_t::replace).size();
  events_.push_back(std::move(event));
}

/// Every other frame is enough.
void Report::thin() {
  std::size_t kept = 1;
  for (std::size_t i = 2; i < frames_.size(); i += 2) frames_[kept++] = std::move(frames_[i]);
  frames_.resize(kept);
  every_ *= 2;
  next_ = static_cast<sim::Clicks>(kept) * every_;
}

void Report::sample() {
  if (trace_) trace_->keep_last(kMostTraced);
  if (twin_.simulation().now() < next_) return;
  hear();
  look();
  if (frames_.size() == kMostFrames) thin();
  if (twin_.simulation().now() < next_) return;
  next_ += every_;
  std::vector<double> values;
  for (const Named& named : values_) values.push_back(named.value(twin_));
  FrameHead head;
  head.revision = 1;
  frames_.push_back(frame(twin_, head, values, frame_bodies(twin_), ""));
}

/// The controllers' sources, as far as there is room.
void Report::add_sources(Json& programs, Json& sources) const {
  std::size_t bytes = 0;
  const std::string folder = std::filesystem::path(twin_.world().file).parent_path().string();
  for (const auto& robot : twin_.world().robots) {
    const auto known = std::find_if(programs.begin(), programs.end(),
                                    [&](const Json& p) { return p.at("name") == robot.firmware; });
    if (known != programs.end()) (*known)["robots"].push_back(robot.name);
    if (known != programs.end() || robot.firmware.empty()) continue;
    std::vector<std::string> none;
    const Sources found(twin::find_firmware(robot.firmware, folder, none));
    Json files = Json::array();
    for (const std::string& file : found.files()) {
      std::string text;
      try {
        text = found.read(file).text;
      } catch (const std::runtime_error&) {
        continue;  // gone, or too long
      }
      if ((bytes += text.size()) > kMostSources) break;
      files.push_back(file);
      sources[robot.firmware + "/" + file] = std::move(text);
    }
    programs.push_back(
        {{"name", robot.firmware}, {"robots", {robot.name}}, {"folder", found.folder()}, {"files", files}});
  }
}

std::string Report::finish(const std::string& summary) {
  // All that the page would have been told in the course of the run.
  hear();
  for (const auto& trap : twin_.traps()) events_.push_back(trap_event(trap));
  if (trace_) {
    events_.push_back(trace_->take(kMostTraced));
    trace_.reset();
  }
  Json programs = Json::array(), sources = Json::object();
  add_sources(programs, sources);
  // The world as a page gets it that connects, of a run that stands and cannot be steered.
  const sim::FloorDesc& floor = twin_.world().floor;
  sim::LoadedWorld loaded;
  loaded.world = twin_.world();
  std::string text;
  sim::read_input_file(twin_.world().file, sim::kLongestWorld, text);  // a world without a file has no text
  const Json piece{
      {"hello",
       {{"event", "hello"},
        {"you", 0},
        {"revision", 1},
        {"state",
         {{"playing", false},
          {"speed", 1},
          {"ended", false},
          {"time_s", 0},
          {"seed", twin_.world().seed},
          {"saved", true},
          {"undo", false},
          {"redo", false},
          {"steering", 0},
          {"runs", false}}},
        {"world", world_json(loaded, sim::WorldText(text), "", &twin_,
                             movable_ids(loaded.world ? *loaded.world : loaded.draft, sim::WorldText(text)))},
        {"programs", programs},
        {"diagnoses", diagnoses_json(twin_)},
        {"traps", Json::array()},  // events, in their time
        {"names", names_of_robots()},
        {"schema", Json::object()}}},
      {"sources", sources},
      {"floor", floor.image_rgb.empty() ? Json() : floor_json(floor)},
      {"events", events_},
      {"summary", Json::parse(summary)},
      {"names", names_},
      {"units", units_},
      {"frame_bytes", frames_.empty() ? 0 : frames_.front().size()}};
  // One file: style, data and script stand in the page itself.
  replace(script_, "</script", "<\\/script");
  std::string page = html_;
  replace(page, "<link rel=\"stylesheet\" href=\"page.css\">", "<style>\n" + style_ + "</style>");
  const std::string pieces = "<script type=\"application/json\" id=\"report\">" + dumped(piece) +
                             "</script>\n<script type=\"text/plain\" id=\"frames\">" + packed(frames_) +
                             "</script>\n<script>\n" + script_ + "</script>";
  const std::string slot = "<script src=\"start.js\"></script>";
  const std::size_t at = page.find(slot);
  if (at == std::string::npos) return path_ + ": --report: the bundled page has no place for it";
  page.replace(at, slot.size(), pieces);
  sim::OutputFile file(path_, "--report");
  file.append(page);
  file.close();
  return file.error();
}

}  // namespace viewer
