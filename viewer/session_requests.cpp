// SPDX-License-Identifier: MIT
// What requests of pages do. Each is a JSON object with "do" and an "id" that the answer repeats; what cannot
// be done is answered with "error".
#include <fmt/format.h>

#include <filesystem>

#include "viewer/events.h"
#include "viewer/session.h"
#include "viewer/world_json.h"

namespace viewer {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

namespace {

constexpr int kMostSteps = 10000;        // of one request
constexpr std::size_t kMostNames = 256;  // of one page's subscription
constexpr auto kWatchEvery = 150ms;      // are sources what they were?

bool is_one_of(const std::string& what, std::initializer_list<const char*> words) {
  for (const char* word : words)
    if (what == word) return true;
  return false;
}

}  // namespace

void Session::handle(const Message& message) {
  if (message.kind == Kind::Left) {
    pages_.erase(message.client);
    if (steering_ == message.client) {
      steering_ = pages_.empty() ? 0 : pages_.begin()->first;
      tell_state();
    }
    return;
  }
  if (message.kind == Kind::Came) {
    pages_[message.client];
    if (steering_ == 0) steering_ = message.client;
    const Json hello{{"event", "hello"},
                     {"version", kProtocolVersion},
                     {"you", message.client},
                     {"revision", revision_},
                     {"state", state_json()},
                     {"world", world_json(document_.loaded(), document_.text())},
                     {"programs", programs_json()},
                     {"diagnoses", diagnoses_told_},
                     {"names", names_of_robots()},
                     {"schema", schema_json()}};
    outlet_.send(message.client, hello.dump(-1, ' ', false, Json::error_handler_t::replace));
    return;
  }
  Json reply;
  const Json request = Json::parse(message.text, nullptr, false);
  try {
    if (!request.is_object()) throw std::runtime_error("got no JSON object, expected one");
    reply = answer(message.client, request);
  } catch (const std::exception& e) {
    reply = {{"error", e.what()}};
  }
  reply["answer"] = request.is_object() ? request.value("id", Json()) : Json();
  outlet_.send(message.client, reply.dump(-1, ' ', false, Json::error_handler_t::replace));
}

Json Session::answer(ClientId client, const Json& request) {
  const auto what = request.at("do").get<std::string>();
  if (what == "steer") {
    steering_ = client;
    tell_state();
    return {{"ok", true}};
  }
  if (is_one_of(what, {"subscribe", "rays", "source", "state", "trace", "look", "floor"}))
    return look_request(client, what, request);
  if (client != steering_) throw std::runtime_error("another page steers; take the wheel first");
  if (is_one_of(what, {"edit", "undo", "redo", "save", "save_as"})) return edit_request(what, request);
  if (what == "write_source") return program_request(what, request);
  if (is_one_of(what, {"play", "pause", "step", "speed", "restart"})) return run_request(what, request);
  if (!inputs::Inputs::is_input(what) || what == "world")
    throw std::runtime_error(fmt::format("do: got '{}', expected a request of docs/connecting.md", what));
  if (!twin_) throw std::runtime_error("the world does not run: mend its problems first");
  input(request);
  return {{"ok", true}};
}

Json Session::run_request(const std::string& what, const Json& request) {
  if (what == "speed") {
    const Json& factor = request.at("factor");
    const double speed = factor == "max" ? 0 : factor.get<double>();
    if (!(speed == 0 ? factor == "max" : speed > 0 && speed <= 1e6))
      throw std::runtime_error("factor: got " + factor.dump() + ", expected max or a number above 0");
    speed_ = speed;
    play(playing_);
  } else if (what == "restart") {
    if (request.contains("seed")) opening_.seed = request.at("seed").get<std::uint64_t>();
    playing_ = request.value("play", playing_);
    restart();
  } else {
    if (!twin_) throw std::runtime_error("the world does not run: mend its problems first");
    if (what == "play") {
      if (ended_) throw std::runtime_error("the run has ended; restart it");
      play(true);
    } else if (what == "pause") {
      play(false);
    } else {
      const auto unit = request.value("unit", std::string("tick"));
      play(false);
      if (ended_) throw std::runtime_error("the run has ended; restart it");
      const int count = request.value("count", 1);
      if (count < 1 || count > kMostSteps)
        throw std::runtime_error(fmt::format("count: expected 1 to {}", kMostSteps));
      if (unit == "tick")
        step_ticks(0, count);
      else if (unit == "control")
        step_ticks(twin_->world().webots.time_step_s, count);
      else if (unit != "interrupt")
        throw std::runtime_error("unit: got '" + unit + "', expected tick, control or interrupt");
      else if (!step_interrupt(robot_named(request.at("robot").get<std::string>())))
        throw std::runtime_error("no interrupt came within 10 s");
    }
  }
  tell_state();
  return {{"ok", true}};
}

Json Session::edit_request(const std::string& what, const Json& request) {
  Json reply{{"ok", true}};
  if (what == "save" || what == "save_as") {
    const auto name = what == "save" ? std::string() : request.at("name").get<std::string>();
    if (!name.empty() && !request.value("overwrite", false) &&
        fs::exists(fs::path(document_.file()).parent_path() / fs::path(name).filename()))
      throw std::runtime_error("name: got '" + name + "', which is there already; overwrite it?");
    const std::string wrong = document_.save(name);
    if (!wrong.empty()) throw std::runtime_error(wrong);
    reply["file"] = document_.file();
    tell_state();
    return reply;
  }
  if (what == "edit")
    reply["thing"] = document_.edit(request);
  else
    reply["done"] = what == "undo" ? document_.undo() : document_.redo();
  if (!document_.loaded().world) {
    document_changed({});
    return reply;
  }
  const LiveEdit asked = live_edit_now();
  const bool has_begun = twin_ && twin_->simulation().now() > 0;
  if (!asked.why_not.empty() && has_begun && !request.value("anew", false)) {
    // as if nobody had asked
    if (what == "edit")
      document_.take_back();
    else
      what == "undo" ? document_.redo() : document_.undo();
    return {{"error", asked.why_not + ": the run would begin anew"}, {"anew", true}};
  }
  document_changed(asked);
  return reply;
}

Json Session::look_request(ClientId client, const std::string& what, const Json& request) {
  Page& page = pages_[client];
  if (what == "state") {
    Json state = state_json();
    if (twin_) {
      const std::uint64_t digest = twin_->simulation().digest();
      state["digest"] = fmt::format("{:016x}", digest);
      state["diagnoses"] = diagnoses_json(*twin_);
      state["clicks"] = twin_->simulation().now();
    }
    return {{"ok", true}, {"state", state}};
  }
  if (what == "source") {
    for (const Program& program : programs_)
      if (program.name == request.at("program"))
        return {{"ok", true}, {"text", program.sources.read(request.at("file").get<std::string>())}};
    throw std::runtime_error("program: expected one that a robot runs");
  }
  if (what == "floor") {
    const sim::LoadedWorld& loaded = document_.loaded();
    const sim::FloorDesc& floor = (loaded.world ? *loaded.world : loaded.draft).floor;
    return floor_json(floor);
  }
  if (!twin_) throw std::runtime_error("the world does not run: mend its problems first");
  if (what == "look") {
    page.looked_at = request.at("robot").get<std::string>();
    if (!page.looked_at.empty()) robot_named(page.looked_at);
    page.look_is_fresh = true;
    next_look_ = {};
    return {{"ok", true}};
  }
  if (what == "trace") {
    const auto robot = request.at("robot").get<std::string>();
    if (robot.empty())
      trace_.reset();
    else
      trace(robot_named(robot), request.value("signals", std::vector<std::string>()));
    return {{"ok", true}};
  }
  if (what == "rays") {
    std::vector<int> robots;
    for (const Json& name : request.at("robots")) robots.push_back(robot_named(name.get<std::string>()));
    page.rays = robots;
  } else {
    const auto names = request.at("names").get<std::vector<std::string>>();
    if (names.size() > kMostNames)
      throw std::runtime_error(fmt::format("names: expected at most {}", kMostNames));
    std::vector<Named> values;
    std::vector<std::string> units;
    for (const std::string& name : names) {
      values.push_back(find_named(*twin_, name));
      units.push_back(values.back().unit);
    }
    page.names = names;
    page.values = std::move(values);
    ++page.subscription;
    page.fresh = true;
    return {{"ok", true}, {"subscription", page.subscription}, {"units", units}};
  }
  page.fresh = true;
  return {{"ok", true}};
}

// --- programs

Json Session::programs_json() const {
  Json out = Json::array();
  for (const Program& program : programs_) {
    Json robots = Json::array();
    for (int r : program.robots) robots.push_back(twin_->world().robots[static_cast<std::size_t>(r)].name);
    out.push_back({{"name", program.name},
                   {"robots", robots},
                   {"folder", program.sources.folder()},
                   {"files", program.sources.files()}});
  }
  return out;
}

Json Session::program_request(const std::string&, const Json& request) {
  for (Program& program : programs_)
    if (program.name == request.at("program")) {
      program.sources.write(request.at("file").get<std::string>(), request.at("text").get<std::string>());
      next_watch_ = {};  // at once
      return {{"ok", true}};
    }
  throw std::runtime_error("program: expected one that a robot runs");
}

void Session::watch_programs() {
  if (Json diagnoses = twin_ ? diagnoses_json(*twin_) : Json::array(); diagnoses != diagnoses_told_) {
    diagnoses_told_ = std::move(diagnoses);
    tell_all({{"event", "diagnoses"}, {"diagnoses", diagnoses_told_}});
  }
  next_watch_ = Wall::now() + kWatchEvery;
  if (build_.valid() && build_.wait_for(0s) == std::future_status::ready) finish_build();
  for (Program& program : programs_) {
    if (program.sources.has_changed()) program.stale |= !program.robots.empty();
    if ((program.stale || !program.waiting.empty()) && !build_.valid()) build_program(program);
  }
  // a build that is under way is looked for more often
  if (build_.valid()) next_watch_ = Wall::now() + 5ms;
}

void Session::build_program(Program& program) {
  building_stale_ = program.stale;
  building_for_ = std::move(program.waiting);
  program.waiting.clear();
  program.stale = false;
  building_ = program.name;
  tell_all({{"event", "building"}, {"program", program.name}});
  twin::Options options = opening_.options;
  options.world_folder = fs::path(opening_.file).parent_path().string();
  const int robot = program.robots.empty() ? building_for_.front() : program.robots.front();
  // with the HAL that it runs with
  if (options.hal.empty() && twin_->hal(robot) != "own") options.hal = twin_->hal(robot);
  options.webots_settings = twin::webots_settings_of(twin_->world());
  build_ = std::async(std::launch::async, [options, name = program.name]() mutable {
    Built built;
    built.name = name;
    const auto begin = Wall::now();
    options.tell = [&built](const std::string& line) { built.warnings.push_back(line); };
    built.path = twin::provide_image(name, options.world_folder, options, built.problems);
    built.took_s = std::chrono::duration<double>(Wall::now() - begin).count();
    return built;
  });
}

/// The new program begins where its robots stand; one that does not compile leaves the old one running.
void Session::finish_build() {
  Built built = build_.get();
  building_.clear();
  const auto program = std::find_if(programs_.begin(), programs_.end(),
                                    [&](const Program& p) { return p.name == built.name; });
  if (built.problems.empty() && program != programs_.end() && twin_) {
    try {
      std::vector<int> robots = building_for_;
      if (building_stale_) robots.insert(robots.end(), program->robots.begin(), program->robots.end());
      if (!robots.empty()) input({{"do", "program"}, {"robots", robots}, {"image", built.path}});
      for (const int robot : building_for_) {
        for (Program& other : programs_)
          other.robots.erase(std::remove(other.robots.begin(), other.robots.end(), robot),
                             other.robots.end());
        program->robots.push_back(robot);
      }
      if (!building_for_.empty()) tell_all({{"event", "programs"}, {"programs", programs_json()}});
    } catch (const std::exception& e) {
      built.problems.push_back(e.what());
    }
    resubscribe();
  }
  tell_all({{"event", "built"},
            {"program", built.name},
            {"ok", built.problems.empty()},
            {"problems", built.problems},
            {"warnings", built.warnings},
            {"took_s", built.took_s}});
}

}  // namespace viewer
