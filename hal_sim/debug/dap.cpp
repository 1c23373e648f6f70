// SPDX-License-Identifier: MIT
#include "hal_sim/debug/dap.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include "dspic30/memory/sfr_table.h"

namespace debug {

namespace {

constexpr std::size_t kLongestMessage = 16u << 20;
enum Scope { kRegisters = 1, kVariables, kPeripherals };

std::string file_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

}  // namespace

// --- the line

bool DapServer::has_input() {
  pollfd one{in_, POLLIN, 0};
  return !buffer_.empty() || poll(&one, 1, 0) > 0;
}

bool DapServer::read_message(Json& message) {
  const auto more = [this] {
    char bytes[4096];
    const ssize_t n = ::read(in_, bytes, sizeof bytes);
    if (n > 0) buffer_.append(bytes, static_cast<std::size_t>(n));
    return n > 0;
  };
  std::size_t end;
  while ((end = buffer_.find("\r\n\r\n")) == std::string::npos)
    if (buffer_.size() > kLongestMessage || !more()) return false;
  const std::string key = "Content-Length:";
  const std::size_t at = buffer_.find(key);
  const std::size_t length =
      at < end ? std::strtoul(buffer_.c_str() + at + key.size(), nullptr, 10) : kLongestMessage + 1;
  is_broken_ = length > kLongestMessage;
  if (is_broken_) return false;
  while (buffer_.size() < end + 4 + length)
    if (!more()) return false;
  message = Json::parse(buffer_.substr(end + 4, length), nullptr, false);
  buffer_.erase(0, end + 4 + length);
  is_broken_ = !message.is_object() || !message.contains("command") || !message["command"].is_string() ||
               !message.contains("seq") || !message["seq"].is_number_unsigned();
  return !is_broken_;
}

void DapServer::send(Json message) {
  const std::lock_guard<std::mutex> lock(writing_);
  message["seq"] = ++sequence_;
  const std::string text = message.dump(-1, ' ', false, Json::error_handler_t::replace);
  const std::string whole = fmt::format("Content-Length: {}\r\n\r\n{}", text.size(), text);
  for (std::size_t sent = 0; sent < whole.size();) {
    const ssize_t n = ::write(out_, whole.data() + sent, whole.size() - sent);
    if (n <= 0) return;  // the editor has gone; read_message() ends
    sent += static_cast<std::size_t>(n);
  }
}

void DapServer::send_event(const std::string& event, Json body) {
  send({{"type", "event"}, {"event", event}, {"body", std::move(body)}});
}

void DapServer::respond(const Json& request, Json body) {
  send({{"type", "response"},
        {"request_seq", request["seq"]},
        {"command", request["command"]},
        {"success", true},
        {"body", std::move(body)}});
}

void DapServer::refuse(const Json& request, const std::string& why) {
  send({{"type", "response"},
        {"request_seq", request["seq"]},
        {"command", request["command"]},
        {"success", false},
        {"message", why},
        {"body", {{"error", {{"id", 1}, {"format", why}, {"showUser", true}}}}}});
}

bool DapServer::serve() {
  Json message;
  while (!ended_) {
    if (!read_message(message)) return !is_broken_;
    try {
      handle(message);
    } catch (const Json::exception& e) {  // a field of the wrong kind
      refuse(message, e.what());
    }
    if (runs_) go_on();
  }
  return !is_broken_;
}

// --- running

void DapServer::begin_run(Plan plan) {
  plan_ = plan;
  runs_ = true;
}

void DapServer::go_on() {
  while (runs_ && !ended_) {
    const Stop stop = session_->run(plan_, [this] { return has_input(); });
    if (stop.why == Stop::Why::Pause) {  // a message has come
      Json message;
      if (!read_message(message)) {
        ended_ = true;
        return;
      }
      pause_asked_ = false;
      try {
        handle(message);
      } catch (const Json::exception& e) {
        refuse(message, e.what());
      }
      if (!pause_asked_) continue;
    }
    runs_ = false;
    if (stop.why == Stop::Why::End) return send_event("terminated");
    static const std::map<Stop::Why, const char*> kReasons{
        {Stop::Why::Entry, "entry"},           {Stop::Why::Step, "step"},
        {Stop::Why::Breakpoint, "breakpoint"}, {Stop::Why::Pause, "pause"},
        {Stop::Why::Trap, "exception"},        {Stop::Why::Watchpoint, "data breakpoint"},
        {Stop::Why::Reset, "exception"}};
    Json body{{"reason", kReasons.at(stop.why)}, {"threadId", 1}, {"allThreadsStopped", true}};
    if (!stop.text.empty()) body["description"] = body["text"] = stop.text;
    if (stop.id > 0) body["hitBreakpointIds"] = {stop.id};
    send_event("stopped", body);
  }
}

// --- requests

void DapServer::launch(const Json& request) {
  const Json arguments = request.value("arguments", Json::object());
  std::vector<std::string> problems;
  session_ = open_(
      arguments,
      [this](const std::string& line) {
        send_event("output", {{"category", "stdout"}, {"output", line + "\n"}});
      },
      problems);
  if (!session_) {
    refuse(request, fmt::format("{}", fmt::join(problems, "\n")));
    send_event("terminated");
    return;
  }
  monitor_ = std::make_unique<Monitor>(*session_, [this] { return has_input(); });
  stops_on_entry_ = arguments.value("stopOnEntry", false);
  respond(request);
  send_event("initialized");
}

void DapServer::handle(const Json& request) {
  const std::string command = request["command"];
  const Json arguments = request.value("arguments", Json::object());
  if (command == "initialize")
    return respond(request, {{"supportsConfigurationDoneRequest", true},
                             {"supportsFunctionBreakpoints", true},
                             {"supportsConditionalBreakpoints", true},
                             {"supportsDataBreakpoints", true},
                             {"supportsEvaluateForHovers", true},
                             {"supportsSetVariable", true},
                             {"supportsStepBack", true},
                             {"supportsSteppingGranularity", true},
                             {"supportsTerminateRequest", true}});
  if (command == "disconnect" || command == "terminate") {
    respond(request);
    ended_ = true;
    return;
  }
  if (command == "launch") return launch(request);
  if (!session_) return refuse(request, command + ": nothing is launched");
  if (command == "setBreakpoints") return set_breakpoints(request);
  if (command == "setFunctionBreakpoints") return set_function_breakpoints(request);
  if (command == "dataBreakpointInfo") return data_breakpoint_info(request);
  if (command == "setDataBreakpoints") return set_data_breakpoints(request);
  if (command == "setExceptionBreakpoints") return respond(request);  // traps always stop
  if (command == "threads")
    return respond(request, {{"threads", {{{"id", 1}, {"name", session_->robot()}}}}});
  if (command == "stackTrace") return stack_trace(request);
  if (command == "scopes")
    return respond(
        request, {{"scopes",
                   {{{"name", "Variables"}, {"variablesReference", kVariables}, {"expensive", false}},
                    {{"name", "Registers"}, {"variablesReference", kRegisters}, {"expensive", false}},
                    {{"name", "Peripherals"}, {"variablesReference", kPeripherals}, {"expensive", true}}}}});
  if (command == "variables") return variables(request);
  if (command == "setVariable") return set_variable(request);
  if (command == "evaluate") return evaluate(request);
  if (command == "configurationDone") {
    respond(request);
    if (stops_on_entry_)
      return send_event("stopped", {{"reason", "entry"}, {"threadId", 1}, {"allThreadsStopped", true}});
    return begin_run(Plan::Continue);
  }
  if (command == "pause") {
    pause_asked_ = true;
    return respond(request);
  }
  const bool by_instruction = arguments.value("granularity", "") == "instruction";
  const std::map<std::string, Plan> plans{
      {"continue", Plan::Continue},
      {"next", by_instruction ? Plan::NextInstruction : Plan::NextLine},
      {"stepIn", by_instruction ? Plan::Instruction : Plan::Line},
      {"stepOut", Plan::Finish},
      {"stepBack", by_instruction ? Plan::BackInstruction : Plan::BackLine},
      {"reverseContinue", Plan::BackContinue}};
  const auto plan = plans.find(command);
  if (plan == plans.end()) return refuse(request, "got '" + command + "', which is not supported");
  respond(request, command == "continue" ? Json{{"allThreadsContinued", true}} : Json::object());
  begin_run(plan->second);
}

// --- breakpoints

void DapServer::replace(std::set<int>& old, std::set<int> now) {
  for (const int id : old) session_->remove(id);
  old = std::move(now);
}

nlohmann::json DapServer::told(const Breakpoint* b, const std::string& error) {
  if (!b) return {{"verified", false}, {"message", error}};
  Json out{{"verified", true}, {"id", b->id}};
  const std::size_t colon = b->what.rfind(':');
  if (!b->addresses.empty() && colon != std::string::npos)
    out["line"] = std::atoi(b->what.c_str() + colon + 1);
  return out;
}

void DapServer::set_breakpoints(const Json& request) {
  const Json& arguments = request.at("arguments");
  const std::string path = arguments.at("source").at("path");
  replace(of_source_[path], {});
  Json all = Json::array();
  for (const Json& wanted : arguments.value("breakpoints", Json::array())) {
    std::string error;
    const Breakpoint* b = session_->add_breakpoint(fmt::format("{}:{}", path, wanted.at("line").get<int>()),
                                                   wanted.value("condition", ""), error);
    if (b) of_source_[path].insert(b->id);
    all.push_back(told(b, error));
  }
  respond(request, {{"breakpoints", all}});
}

void DapServer::set_function_breakpoints(const Json& request) {
  replace(of_functions_, {});
  Json all = Json::array();
  for (const Json& wanted : request.at("arguments").at("breakpoints")) {
    std::string error;
    const Breakpoint* b =
        session_->add_breakpoint(wanted.at("name").get<std::string>(), wanted.value("condition", ""), error);
    if (b) of_functions_.insert(b->id);
    all.push_back(told(b, error));
  }
  respond(request, {{"breakpoints", all}});
}

void DapServer::data_breakpoint_info(const Json& request) {
  const std::string name = request.at("arguments").at("name");
  if (!session_->find_data(name))
    return respond(request, {{"dataId", nullptr}, {"description", name + " is no variable or register"}});
  respond(request, {{"dataId", name}, {"description", name}, {"accessTypes", {"write"}}});
}

void DapServer::set_data_breakpoints(const Json& request) {
  replace(of_data_, {});
  Json all = Json::array();
  for (const Json& wanted : request.at("arguments").at("breakpoints")) {
    std::string error;
    const Breakpoint* b = session_->add_watchpoint(wanted.at("dataId").get<std::string>(),
                                                   wanted.value("condition", ""), error);
    if (b) of_data_.insert(b->id);
    all.push_back(told(b, error));
  }
  respond(request, {{"breakpoints", all}});
}

// --- what is shown

void DapServer::stack_trace(const Json& request) {
  Json frames = Json::array();
  const dspic::CodeMap& map = session_->file().code;
  int id = 0;
  for (const Frame& f : session_->frames()) {
    Json frame{{"id", id++},
               {"name", (f.function ? f.function->name : fmt::format("{:#08x}", f.pc)) +
                            (f.is_handler ? " (interrupt)" : "")},
               {"line", 0},
               {"column", 0},
               {"instructionPointerReference", fmt::format("{:#x}", f.pc)}};
    if (const auto* line = map.line_at(f.call)) {
      frame["line"] = line->line;
      frame["source"] = {{"name", file_name(map.files[line->file])}, {"path", map.files[line->file]}};
    }
    frames.push_back(frame);
  }
  respond(request, {{"stackFrames", frames}, {"totalFrames", frames.size()}});
}

void DapServer::variables(const Json& request) {
  Json all = Json::array();
  const auto add = [&](const std::string& name, const std::string& value) {
    all.push_back({{"name", name}, {"value", value}, {"variablesReference", 0}, {"evaluateName", name}});
  };
  switch (request.at("arguments").at("variablesReference").get<int>()) {
    case kRegisters:
      for (const auto& [name, value] : session_->machine().register_list()) add(name, value);
      add("pc", fmt::format("{:#08x}", session_->pc()));
      add("cycle", std::to_string(session_->now()));
      break;
    case kVariables:
      for (const auto& variable : session_->file().debug.variables)
        if (session_->pc() >= variable.begin && session_->pc() < variable.end)
          add(variable.name, session_->typed({{&variable, variable.type}, {}, session_->pc()}));
      for (const auto& [name, address] : session_->file().objects) {
        const auto bytes = session_->file().object_bytes.find(name);
        if (bytes == session_->file().object_bytes.end() || bytes->second > 4) continue;
        const auto value = session_->read({session_->machine().data_base() + address, bytes->second});
        add(name, fmt::format("{} ({:#x})", value, value));
      }
      break;
    case kPeripherals:
      for (const dspic::SfrInfo& info : dspic::kSfrRows)
        if (const auto data = session_->machine().find_register(info.name);
            data && info.address > dspic::sfr("DISICNT"))
          add(info.name, fmt::format("{:#06x}", session_->read(*data)));
      break;
    default:
      break;
  }
  respond(request, {{"variables", all}});
}

void DapServer::set_variable(const Json& request) {
  const Json& arguments = request.at("arguments");
  const std::string name = arguments.at("name");
  std::int64_t value = 0;
  std::string error;
  const auto data = session_->find_data(name);
  if (!session_->evaluate(arguments.at("value").get<std::string>(), value, error))
    return refuse(request, error);
  if (!data || !session_->write(*data, static_cast<std::uint64_t>(value)))
    return refuse(request, name + " cannot be changed");
  respond(request, {{"value", fmt::format("{}", session_->read(*data))}});
}

void DapServer::evaluate(const Json& request) {
  const Json& arguments = request.at("arguments");
  const std::string text = arguments.at("expression");
  if (arguments.value("context", "") == "repl" && !runs_) {
    const Cycle before = session_->now();
    respond(request, {{"result", monitor_->execute(text)}, {"variablesReference", 0}});
    if (session_->has_ended()) return send_event("terminated");
    if (session_->now() != before)
      send_event("stopped", {{"reason", "step"}, {"threadId", 1}, {"allThreadsStopped", true}});
    return;
  }
  std::int64_t value = 0;
  std::string error;
  if (!session_->evaluate(text, value, error)) return refuse(request, error);
  respond(request, {{"result", fmt::format("{} ({:#x})", value, value)}, {"variablesReference", 0}});
}

}  // namespace debug
