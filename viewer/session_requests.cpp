// SPDX-License-Identifier: MIT
// What requests of pages do. Each is a JSON object with "do" and an "id" that the answer repeats; the table
// in requests.cpp says what may be in it. What cannot be done is answered with "error".
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "install/places.h"
#include "sim_core/base/did_you_mean.h"
#include "sim_core/load/world_loader.h"
#include "viewer/events.h"
#include "viewer/requests.h"
#include "viewer/session.h"
#include "viewer/text_file.h"
#include "viewer/world_json.h"
#include "viewer/worlds.h"

namespace viewer {

namespace fs = std::filesystem;

namespace {

const Json kDone{{"ok", true}};

std::string examples_folder() { return (places::share_root() / "worlds").string(); }

std::string shown(const std::string& word) { return word.substr(0, 60); }

}  // namespace

/// Who does what; a request of the table that is not here is an input of the run.
struct Handlers {
  static const std::map<std::string, Session::Handler>& all() {
    static const std::map<std::string, Session::Handler> handlers{
        {"play", &Session::do_play},        {"pause", &Session::do_pause},
        {"step", &Session::step},           {"speed", &Session::set_speed},
        {"restart", &Session::restart},     {"steer", &Session::steer},
        {"state", &Session::tell_state_to}, {"subscribe", &Session::subscribe},
        {"rays", &Session::rays},           {"look", &Session::look},
        {"trace", &Session::trace},         {"floor", &Session::floor},
        {"edit", &Session::edit},           {"undo", &Session::undo},
        {"redo", &Session::redo},           {"reload", &Session::reload},
        {"text_of", &Session::text_of},     {"save", &Session::save},
        {"save_as", &Session::save_as},     {"worlds", &Session::worlds},
        {"open", &Session::open_world},     {"new_world", &Session::new_world},
        {"source", &Session::source},       {"write_source", &Session::write_source},
        {"debug", &Session::debug},         {"dap", &Session::dap},
    };
    return handlers;
  }
};

void Session::handle(const Mailbox::Message& message) {
  // Clients come and go; the first that is there steers.
  if (message.kind == Mailbox::Kind::Left) {
    pages_.leave(message.client);
    if (steering_ == message.client) {
      steering_ = pages_.first();
      tell_state();
    }
    return;
  }
  if (message.kind == Mailbox::Kind::Came) {
    pages_.come(message.client);
    if (steering_ == 0) steering_ = message.client;
    pages_.send(message.client, {{"event", "hello"},
                                 {"version", kProtocolVersion},
                                 {"you", message.client},
                                 {"revision", revision_},
                                 {"state", state_json()},
                                 {"world", world_json_now()},
                                 {"programs", programs_.json(run_ ? &run_->twin() : nullptr)},
                                 {"problems", problems_},
                                 {"diagnoses", diagnoses_told_},
                                 {"traps", traps_json()},
                                 {"names", names_of_robots()},
                                 {"schema", schema_json()}});
    return;
  }
  // A request always gets an answer, an error if need be.
  Json reply;
  const Json request = Json::parse(message.text, nullptr, false);
  try {
    if (!request.is_object()) throw std::runtime_error("got no JSON object, expected one");
    reply = answer(message.client, request);
  } catch (const Refusal& refusal) {
    reply = refusal.more();
    reply["error"] = refusal.what();
  } catch (const std::exception& e) {
    reply = {{"error", e.what()}};
  }
  reply["answer"] = request.is_object() ? request.value("id", Json()) : Json();
  pages_.send(message.client, reply);
}

Json Session::answer(ClientId client, const Json& request) {
  const auto what =
      request.contains("do") && request["do"].is_string() ? request["do"].get<std::string>() : "";
  const Request* known = find_request(what);
  if (!known) {
    std::vector<std::string> names;
    for (const Request& r : requests()) names.emplace_back(r.name);
    const std::string like = sim::did_you_mean(what, names);
    throw std::runtime_error(fmt::format("do: got '{}', expected a request of docs/connecting.md{}",
                                         shown(what), like.empty() ? "" : "; did you mean " + like + "?"));
  }
  check_request(*known, request);
  if (known->right != Right::Look && client != steering_)
    throw std::runtime_error("another page steers; take the wheel first");
  const auto handler = Handlers::all().find(what);
  return handler == Handlers::all().end() ? touch(client, request)
                                          : (this->*handler->second)(client, request);
}

Run& Session::running() const {
  if (!run_) throw std::runtime_error("the world does not run: mend its problems first");
  return *run_;
}

Json Session::touch(ClientId, const Json& request) {
  running();
  Json bare = request;
  bare.erase("id");
  input(bare);
  return kDone;
}

// --- time

Json Session::do_play(ClientId, const Json&) {
  running();
  if (ended_) throw std::runtime_error("the run has ended; restart it");
  if (debugging_ && !debugging_->runs())
    debugging_->ask({{"command", "continue"}, {"arguments", {{"threadId", 1}}}});
  pace_.play(!debugging_, now());
  tell_state();
  return kDone;
}

Json Session::do_pause(ClientId, const Json&) {
  running();
  if (debugging_ && debugging_->runs())
    debugging_->ask({{"command", "pause"}, {"arguments", {{"threadId", 1}}}});
  pace_.play(false, now());
  tell_state();
  return kDone;
}

Json Session::step(ClientId, const Json& request) {
  running();
  if (debugging_) throw std::runtime_error("a robot is debugged: step its program, or end that first");
  if (ended_) throw std::runtime_error("the run has ended; restart it");
  const auto unit = request.value("unit", std::string("tick"));
  const int robot = unit == "interrupt" ? robot_named(request.value("robot", std::string())) : -1;
  pace_.play(false, now());
  for (int left = request.value("count", 1); left > 0 && !run_->has_ended(); --left) {
    if (unit == "tick") {
      step_until(now());
    } else if (unit == "control") {
      const double step_s = run_->twin().world().webots.time_step_s;
      // the first multiple behind here; ticks lie between
      const auto number = static_cast<std::int64_t>(sim::to_seconds(now()) / step_s + 1e-9) + 1;
      const sim::Clicks end = sim::from_seconds(static_cast<double>(number) * step_s);
      while (now() < end && !run_->has_ended()) {
        const sim::Clicks before = now();
        step_until(end);
        if (now() == before) break;
      }
    } else if (!step_interrupt(robot)) {
      throw std::runtime_error("no interrupt came within 10 s");
    }
  }
  after_ticks();
  tell_state();
  return kDone;
}

Json Session::set_speed(ClientId, const Json& request) {
  const Json& factor = request.at("factor");
  const double speed = factor == "max" ? 0 : factor.is_number() ? factor.get<double>() : -1;
  if (factor != "max" && !(speed > 0 && speed <= 1e6))
    throw std::runtime_error("factor: got " + shown(factor.dump()) + ", expected max or a number above 0");
  pace_.set_speed(speed, now());
  tell_state();
  return kDone;
}

Json Session::restart(ClientId, const Json& request) {
  if (request.contains("seed")) opening_.seed = request.at("seed").get<std::uint64_t>();
  pace_.play(request.value("play", pace_.plays()), 0);
  begin_anew();
  return kDone;
}

// --- looking

Json Session::steer(ClientId client, const Json&) {
  steering_ = client;
  tell_state();
  return kDone;
}

Json Session::tell_state_to(ClientId, const Json&) {
  Json state = state_json();
  if (run_) {
    state["digest"] = fmt::format("{:016x}", run_->twin().simulation().digest());
    state["diagnoses"] = diagnoses_json(run_->twin());
    state["clicks"] = now();
  }
  return {{"ok", true}, {"state", state}};
}

Json Session::subscribe(ClientId client, const Json& request) {
  std::vector<std::string> units;
  const std::uint32_t number =
      pages_.subscribe(client, running().twin(), request.at("names").get<std::vector<std::string>>(), units);
  return {{"ok", true}, {"subscription", number}, {"units", units}};
}

Json Session::rays(ClientId client, const Json& request) {
  running();
  std::vector<int> robots;
  for (const Json& name : request.at("robots")) robots.push_back(robot_named(name.get<std::string>()));
  pages_.want_rays(client, std::move(robots));
  return kDone;
}

Json Session::look(ClientId client, const Json& request) {
  const auto robot = request.at("robot").get<std::string>();
  if (!robot.empty()) robot_named(robot);
  pages_.look_at(client, robot);
  return kDone;
}

Json Session::trace(ClientId, const Json& request) {
  const auto robot = request.at("robot").get<std::string>();
  if (robot.empty()) {
    if (run_) run_->trace_no_more();
    return kDone;
  }
  if (debugging_) throw std::runtime_error("a robot is debugged: its time line is not drawn meanwhile");
  running().trace(robot_named(robot), request.value("signals", std::vector<std::string>()));
  return kDone;
}

Json Session::floor(ClientId, const Json&) {
  const sim::LoadedWorld& loaded = document_.loaded();
  return floor_json((loaded.world ? *loaded.world : loaded.draft).floor);
}

// --- the world file

/// The document is another one: the run follows, or, unless it may begin anew, all is as it was.
Json Session::changed(const Json& request, const std::function<void()>& take_back, Json reply) {
  reply["ok"] = true;
  if (!document_.loaded().world) {
    document_changed({});
    return reply;
  }
  const LiveEdit asked = live_edit_now();
  const bool has_begun = run_ && now() > 0;
  if (debugging_ && !asked.why_not.empty()) {
    take_back();
    throw std::runtime_error(asked.why_not + ": a robot is debugged, end that first");
  }
  if (!asked.why_not.empty() && has_begun && !request.value("anew", false)) {
    take_back();  // as if nobody had asked
    throw Refusal(asked.why_not + ": the run would begin anew", {{"anew", true}});
  }
  document_changed(asked);
  return reply;
}

Json Session::edit(ClientId, const Json& request) {
  const std::string before = document_.text().text();
  const std::vector<int> fresh = document_.edit(request);
  return changed(request,
                 [&] {
                   if (document_.text().text() != before) document_.take_back();
                 },
                 {{"thing", fresh.empty() ? 0 : fresh[0]}, {"things", fresh}});
}

Json Session::undo(ClientId, const Json& request) {
  if (!document_.undo()) return {{"ok", true}, {"done", false}};
  return changed(request, [&] { document_.redo(); }, {{"done", true}});
}

Json Session::redo(ClientId, const Json& request) {
  if (!document_.redo()) return {{"ok", true}, {"done", false}};
  return changed(request, [&] { document_.undo(); }, {{"done", true}});
}

Json Session::reload(ClientId, const Json& request) {
  const std::string before = document_.text().text();
  document_.reload();
  return changed(request,
                 [&] {
                   if (document_.text().text() != before) document_.take_back();
                 },
                 {});
}

Json Session::text_of(ClientId, const Json& request) {
  return {{"ok", true}, {"text", document_.text_of(request.at("things").get<std::vector<int>>())}};
}

Json Session::save(ClientId, const Json& request) {
  document_.save(request.value("overwrite", false));
  tell_state();
  return {{"ok", true}, {"file", document_.file()}};
}

Json Session::save_as(ClientId, const Json& request) {
  const std::string before = document_.file();
  document_.save_as(home_, request.at("name").get<std::string>(), request.value("overwrite", false));
  if (document_.file() != before) {
    opening_.file = document_.file();
    tell_world();
  }
  tell_state();
  return {{"ok", true}, {"file", document_.file()}};
}

Json Session::worlds(ClientId, const Json&) {
  return {{"ok", true}, {"here", worlds_json(home_)}, {"examples", worlds_json(examples_folder())}};
}

/// The view shows another world from now on.
void Session::open_document(const std::string& file, bool discard) {
  if (!document_.is_saved() && !discard)
    throw Refusal("the world has changes that are not saved", {{"unsaved", true}});
  const auto bytes = bytes_at(file, sim::kLongestWorld);
  if (!bytes) throw std::runtime_error("file: got '" + shown(file) + "', which cannot be read");
  close_run();
  replay_.reset();
  document_ = Document(file, *bytes);
  const sim::LoadedWorld& loaded = document_.loaded();
  opening_.seed = (loaded.world ? *loaded.world : loaded.draft).seed;
  opening_.file = file;
  // programs that were chosen for robots of the other world
  opening_.options.firmware.clear();
  opening_.supervisors.clear();
  pace_.play(false, 0);
  begin_anew();
}

Json Session::open_world(ClientId, const Json& request) {
  const auto file = request.at("file").get<std::string>();
  for (const std::string& folder : {home_, examples_folder()})
    for (const Json& world : worlds_json(folder))
      if (world.at("file") == file) {
        open_document(file, request.value("discard", false));
        return kDone;
      }
  throw std::runtime_error("file: got '" + shown(file) + "', expected one of `worlds`");
}

Json Session::new_world(ClientId, const Json& request) {
  if (!document_.is_saved() && !request.value("discard", false))
    throw Refusal("the world has changes that are not saved", {{"unsaved", true}});
  Document fresh((fs::path(home_) / "new").string(), kNewWorld);
  fresh.save_as(home_, request.at("name").get<std::string>(), false);
  open_document(fresh.file(), true);
  return {{"ok", true}, {"file", fresh.file()}};
}

// --- programs

Json Session::source(ClientId, const Json& request) {
  const Programs::Program* program = programs_.find(request.at("program").get<std::string>());
  if (!program) throw std::runtime_error("program: expected one that a robot runs");
  const SourceText source = program->sources.read(request.at("file").get<std::string>());
  return {{"ok", true},
          {"text", source.text},
          {"base", source.base},
          {"writable", source.writable},
          {"encoding", source.is_latin ? "latin-1" : "utf-8"}};
}

Json Session::write_source(ClientId, const Json& request) {
  Programs::Program* program = programs_.find(request.at("program").get<std::string>());
  if (!program) throw std::runtime_error("program: expected one that a robot runs");
  const std::string base =
      program->sources.write(request.at("file").get<std::string>(), request.at("text").get<std::string>(),
                             request.value("base", std::string()), request.value("overwrite", false));
  next_watch_ = {};  // at once
  return {{"ok", true}, {"base", base}};
}

// --- debugging

Json Session::debug(ClientId, const Json& request) {
  running();
  const auto name = request.at("robot").get<std::string>();
  if (debugging_ && debugging_->robot() == name) return kDone;
  const int robot = name.empty() ? -1 : robot_named(name);
  if (debugging_) debug_no_more();
  if (robot >= 0) debug_robot(robot);
  return kDone;
}

Json Session::dap(ClientId, const Json& request) {
  if (!debugging_) throw std::runtime_error("no robot is debugged; debug one first");
  const Json& message = request.at("message");
  if (!message.contains("command") || !message["command"].is_string())
    throw std::runtime_error("message: got no command, expected one of the Debug Adapter Protocol");
  const bool ran = debugging_->runs();
  Json body = debugging_->ask(message);
  if (debugging_->runs() != ran) {
    pace_.begin(now());
    tell_state();
  }
  return {{"ok", true}, {"body", body}};
}

}  // namespace viewer
