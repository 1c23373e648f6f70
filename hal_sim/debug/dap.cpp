// SPDX-License-Identifier: MIT
#include "hal_sim/debug/dap.h"

#include <fmt/format.h>

#include "dspic30/asm/expression.h"
#include "dspic30/memory/sfr_table.h"
#include "sim_core/base/base64.h"

namespace debug {

namespace {

using dspic::assembly::trimmed;

constexpr int kThread = 1;  // there is one
// a level of calls has its scopes: the innermost one these, each further out kScopes more
enum Scope { kRegisters = 1, kVariables, kPeripherals, kScopes };

/// "0x900", or a number alone, of that key, with its offset. False: it is none.
bool reference_of(const nlohmann::json& arguments, const char* key, std::int64_t& address) {
  const std::string text = arguments.at(key);
  char* end = nullptr;
  address = std::strtoll(text.c_str(), &end, 0) + arguments.value("offset", std::int64_t{0});
  return !text.empty() && *end == 0;
}

std::string file_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

/// False: there is an id of that name, and it is none from `first` to `last`.
bool is_id(const nlohmann::json& arguments, const char* key, std::int64_t first, std::int64_t last) {
  const auto id = arguments.find(key);
  return id == arguments.end() || (id->is_number_integer() && *id >= first && *id <= last);
}

}  // namespace

void DapServer::send_event(const std::string& event, Json body) {
  send_({{"type", "event"}, {"event", event}, {"body", std::move(body)}});
}

void DapServer::respond(const Json& request, Json body) {
  send_({{"type", "response"},
         {"request_seq", request["seq"]},
         {"command", request["command"]},
         {"success", true},
         {"body", std::move(body)}});
}

void DapServer::refuse(const Json& request, const std::string& why) {
  send_({{"type", "response"},
         {"request_seq", request["seq"]},
         {"command", request["command"]},
         {"success", false},
         {"message", why},
         {"body", {{"error", {{"id", 1}, {"format", why}, {"showUser", true}}}}}});
}

void DapServer::handle(const Json& request) {
  try {
    answer(request);
  } catch (const Json::exception&) {  // a field that is missing or of the wrong kind
    refuse(request, "arguments: got none or others, expected those of the Debug Adapter Protocol");
  }
}

// --- running

void DapServer::begin_run(Plan plan) {
  plan_ = plan;
  runs_ = true;
}

void DapServer::run_on() {
  const Stop stop = pause_asked_ ? Stop{Stop::Why::Pause, 0, "paused"} : session_->run(plan_, has_input_);
  if (stop.why == Stop::Why::Pause && !pause_asked_) return;  // a message has come
  runs_ = pause_asked_ = false;
  if (stop.why == Stop::Why::End) return send_event("terminated");
  static const std::map<Stop::Why, const char*> kReasons{
      {Stop::Why::Entry, "entry"},           {Stop::Why::Step, "step"},
      {Stop::Why::Breakpoint, "breakpoint"}, {Stop::Why::Pause, "pause"},
      {Stop::Why::Trap, "exception"},        {Stop::Why::Watchpoint, "data breakpoint"},
      {Stop::Why::Reset, "exception"}};
  Json body{{"reason", kReasons.at(stop.why)}, {"threadId", kThread}, {"allThreadsStopped", true}};
  if (!stop.text.empty()) body["description"] = body["text"] = stop.text;
  if (stop.id > 0) body["hitBreakpointIds"] = {stop.id};
  send_event("stopped", body);
}

// --- requests

void DapServer::launch(const Json& request) {
  if (session_) return refuse(request, "launch: got a second one, expected one a session");
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
  monitor_ = std::make_unique<Monitor>(*session_, has_input_);
  stops_on_entry_ = arguments.value("stopOnEntry", false);
  respond(request);
  send_event("initialized");
}

void DapServer::answer(const Json& request) {
  const std::string command = request["command"];
  const Json arguments = request.value("arguments", Json::object());
  if (command == "initialize") {
    first_line_ = arguments.value("linesStartAt1", true) ? 1 : 0;
    first_column_ = arguments.value("columnsStartAt1", true) ? 1 : 0;
    return respond(request, {{"supportsConfigurationDoneRequest", true},
                             {"supportsFunctionBreakpoints", true},
                             {"supportsConditionalBreakpoints", true},
                             {"supportsDataBreakpoints", true},
                             {"supportsEvaluateForHovers", true},
                             {"supportsSetVariable", true},
                             {"supportsStepBack", true},
                             {"supportsSteppingGranularity", true},
                             {"supportsReadMemoryRequest", true},
                             {"supportsDisassembleRequest", true},
                             {"supportsInstructionBreakpoints", true},
                             {"supportsTerminateRequest", true}});
  }
  // Requests that need no program.
  if (command == "disconnect" || command == "terminate") {
    respond(request);
    ended_ = true;
    return;
  }
  if (command == "launch") return launch(request);
  if (!session_) return refuse(request, command + ": nothing is launched");
  if (!is_id(arguments, "threadId", kThread, kThread))
    return refuse(request, fmt::format("threadId: got {}, expected {}, the robot's program",
                                       arguments["threadId"].dump(), kThread));
  if (const std::int64_t frames =
          arguments.contains("frameId") ? static_cast<std::int64_t>(session_->frames().size()) : 0;
      !is_id(arguments, "frameId", 0, std::max<std::int64_t>(1, frames) - 1))
    return refuse(request, fmt::format("frameId: got {}, expected 0 to {}, as stackTrace has them",
                                       arguments["frameId"].dump(), std::max<std::int64_t>(1, frames) - 1));
  if (!select_level(arguments)) return refuse(request, "variablesReference: got none of scopes");
  if (command == "setBreakpoints") return set_breakpoints(request);
  if (command == "setFunctionBreakpoints") return set_function_breakpoints(request);
  if (command == "dataBreakpointInfo") return data_breakpoint_info(request);
  if (command == "setDataBreakpoints") return set_data_breakpoints(request);
  if (command == "setExceptionBreakpoints") return respond(request);  // traps always stop
  if (command == "threads")
    return respond(request, {{"threads", {{{"id", kThread}, {"name", session_->robot()}}}}});
  if (command == "stackTrace") return stack_trace(request);
  if (command == "scopes") {
    const int level = kScopes * arguments.value("frameId", 0);
    return respond(
        request,
        {{"scopes",
          {{{"name", "Variables"}, {"variablesReference", level + kVariables}, {"expensive", false}},
           {{"name", "Registers"}, {"variablesReference", level + kRegisters}, {"expensive", false}},
           {{"name", "Peripherals"}, {"variablesReference", level + kPeripherals}, {"expensive", true}}}}});
  }
  if (command == "variables") return variables(request);
  if (command == "setVariable") return set_variable(request);
  if (command == "setInstructionBreakpoints") return set_instruction_breakpoints(request);
  if (command == "readMemory") return read_memory(request);
  if (command == "disassemble") return disassemble(request);
  if (command == "evaluate") return evaluate(request);
  // From here on the program runs, or is asked to stand.
  if (command == "configurationDone") {
    respond(request);
    if (stops_on_entry_)
      return send_event("stopped", {{"reason", "entry"}, {"threadId", kThread}, {"allThreadsStopped", true}});
    return begin_run(Plan::Continue);
  }
  if (command == "pause") {
    pause_asked_ = runs_;
    return respond(request);
  }
  // What is left lets the program run, or steps it.
  const bool by_instruction = arguments.value("granularity", "") == "instruction";
  const std::map<std::string, Plan> plans{
      {"continue", Plan::Continue},
      {"next", by_instruction ? Plan::NextInstruction : Plan::NextLine},
      {"stepIn", by_instruction ? Plan::Instruction : Plan::Line},
      {"stepOut", Plan::Finish},
      {"stepBack", by_instruction ? Plan::BackInstruction : Plan::BackLine},
      {"reverseContinue", Plan::BackContinue}};
  const auto plan = plans.find(command);
  if (plan == plans.end())
    return refuse(request, "command: got '" + command + "', expected one of the Debug Adapter Protocol");
  respond(request, command == "continue" ? Json{{"allThreadsContinued", true}} : Json::object());
  begin_run(plan->second);
}

// --- breakpoints

nlohmann::json DapServer::told(const Breakpoint* b, const std::string& error) {
  if (!b) return {{"verified", false}, {"message", error}};
  Json out{{"verified", true}, {"id", b->id}};
  const std::size_t colon = b->what.rfind(':');
  if (!b->addresses.empty() && colon != std::string::npos)
    out["line"] = told_line(std::atoi(b->what.c_str() + colon + 1));
  if (const std::string note = session_->note_of(*b); !note.empty()) out["message"] = note;
  return out;
}

void DapServer::set_all(const Json& request, std::set<int>& ours, const Adds& add) {
  for (const int id : ours) session_->remove(id);
  ours.clear();
  Json all = Json::array();
  for (const Json& wanted : request.at("arguments").at("breakpoints")) {
    std::string error;
    const Breakpoint* b = add(wanted, wanted.value("condition", ""), error);
    if (b) ours.insert(b->id);
    all.push_back(told(b, error));
  }
  respond(request, {{"breakpoints", all}});
}

void DapServer::set_breakpoints(const Json& request) {
  const std::string path = request.at("arguments").at("source").at("path");
  for (const std::size_t file : session_->files_meant(path)) paths_[file] = path;
  Json given = request;
  given["arguments"].emplace("breakpoints", Json::array());
  set_all(given, of_source_[path], [&](const Json& wanted, const std::string& condition, std::string& error) {
    return session_->add_breakpoint(
        fmt::format("{}:{}", path, wanted.at("line").get<int>() + 1 - first_line_), condition, error);
  });
}

void DapServer::set_function_breakpoints(const Json& request) {
  set_all(request, of_functions_, [&](const Json& wanted, const std::string& condition, std::string& error) {
    return session_->add_breakpoint(wanted.at("name").get<std::string>(), condition, error);
  });
}

void DapServer::set_instruction_breakpoints(const Json& request) {
  set_all(request, of_instructions_,
          [&](const Json& wanted, const std::string& condition, std::string& error) {
            std::int64_t address = 0;
            if (!reference_of(wanted, "instructionReference", address)) {
              error = "got '" + wanted.at("instructionReference").get<std::string>() +
                      "', expected an address such as 0x1a0";
              return static_cast<const Breakpoint*>(nullptr);
            }
            return session_->add_breakpoint(fmt::format("{:#x}", address), condition, error);
          });
}

void DapServer::data_breakpoint_info(const Json& request) {
  const std::string name = request.at("arguments").at("name");
  if (!session_->values().find_data(name))
    return respond(request, {{"dataId", nullptr}, {"description", name + " is no variable or register"}});
  respond(request, {{"dataId", name}, {"description", name}, {"accessTypes", {"write"}}});
}

void DapServer::set_data_breakpoints(const Json& request) {
  set_all(request, of_data_, [&](const Json& wanted, const std::string& condition, std::string& error) {
    return session_->add_watchpoint(wanted.at("dataId").get<std::string>(), condition, error);
  });
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
      frame["line"] = told_line(line->line);
      frame["column"] = first_column_;
      frame["source"] = told_source(line->file);
    }
    frames.push_back(frame);
  }
  respond(request, {{"stackFrames", frames}, {"totalFrames", frames.size()}});
}

nlohmann::json DapServer::told_source(std::size_t file) const {
  const auto known = paths_.find(file);
  const std::string& path = known == paths_.end() ? session_->file().code.lines().files[file] : known->second;
  return {{"name", file_name(path)}, {"path", path}};
}

nlohmann::json DapServer::reference(const CValue& value) const {
  std::optional<Address> address;
  if (value.type.stars > 0 && !value.part && !value.data) address = value.raw;
  if (const auto place = session_->values().place_of(value); place) address = place->address;
  return address ? Json(fmt::format("{:#x}", *address)) : Json();
}

/// What is asked about a level of calls means its values; of no level: of the innermost one. False: there is none.
bool DapServer::select_level(const Json& arguments) {
  constexpr int kMost = 64;
  const auto reference = arguments.find("variablesReference"), frame = arguments.find("frameId");
  const bool is_of_scope = reference != arguments.end() && reference->is_number_integer();
  const std::int64_t level = is_of_scope                ? reference->get<std::int64_t>() / kScopes
                             : frame != arguments.end() ? frame->get<std::int64_t>()
                                                        : 0;
  if (level < 0 || level >= kMost) return false;
  return runs_ || session_->select_frame(static_cast<std::size_t>(level)) || !is_of_scope;
}

void DapServer::variables(const Json& request) {
  const auto* const level = session_->selected();
  const std::uint32_t pc = level ? level->call : session_->pc();
  Json all = Json::array();
  const auto add = [&](const std::string& name, const std::string& value, const Json& memory = {}) {
    all.push_back({{"name", name}, {"value", value}, {"variablesReference", 0}, {"evaluateName", name}});
    if (!memory.is_null()) all.back()["memoryReference"] = memory;
  };
  switch (request.at("arguments").at("variablesReference").get<int>() % kScopes) {
    case kRegisters:
      for (const auto& [name, value] : session_->machine().register_list()) add(name, value);
      add("pc", fmt::format("{:#08x}", session_->pc()));
      add("cycle", std::to_string(session_->now()));
      break;
    case kVariables:
      for (const auto& variable : session_->file().debug.value().variables)
        if (pc >= variable.begin && pc < variable.end) {
          CValue value;
          value.part = Part{{&variable, variable.type}, {}, pc};
          add(variable.name, session_->values().typed(*value.part), reference(value));
        }
      // Globals that the debug information may not know, such as those of assembler text.
      for (const auto& [name, address] : session_->file().objects) {
        const auto bytes = session_->file().object_bytes.find(name);
        if (bytes == session_->file().object_bytes.end() || bytes->second > 4) continue;
        CValue known;
        std::string none;
        if (!session_->values().compute(name, Want::Place, known, none)) continue;
        const Address at = address;
        const auto value = session_->values().read({at, bytes->second});
        add(name,
            known.part ? session_->values().typed(*known.part) : fmt::format("{} ({:#x})", value, value),
            fmt::format("{:#x}", at));
      }
      break;
    case kPeripherals:
      for (const dspic::SfrInfo& info : dspic::kSfrRows)
        if (const auto data = session_->machine().find_register(info.name);
            data && info.address > dspic::sfr("DISICNT"))
          add(info.name, fmt::format("{:#06x}", session_->values().read(*data)));
      break;
    default:
      return refuse(request, "variablesReference: got none of scopes");
  }
  respond(request, {{"variables", all}});
}

void DapServer::set_variable(const Json& request) {
  const Json& arguments = request.at("arguments");
  const std::string name = arguments.at("name");
  const int scope = arguments.at("variablesReference").get<int>() % kScopes;
  if (scope != kVariables && scope != kRegisters && scope != kPeripherals)
    return refuse(request, "variablesReference: got none of scopes");
  std::string error;
  if (!session_->assign(name, arguments.at("value").get<std::string>(), error)) return refuse(request, error);
  CValue now;
  if (!session_->values().compute(name, Want::Number, now, error)) return refuse(request, error);
  const std::string text = session_->values().shown(now);
  respond(request, {{"value", text.substr(0, text.find(" ("))}});
}

void DapServer::evaluate(const Json& request) {
  const Json& arguments = request.at("arguments");
  const std::string text = arguments.at("expression");
  if (arguments.value("context", "") == "repl" && !runs_) {
    const Cycle before = session_->now();
    respond(request, {{"result", monitor_->execute(text)}, {"variablesReference", 0}});
    if (session_->has_ended()) return send_event("terminated");
    if (session_->now() != before)
      send_event("stopped", {{"reason", "step"}, {"threadId", kThread}, {"allThreadsStopped", true}});
    return;
  }
  CValue value, number;
  std::string error;
  if (!session_->values().compute(text, Want::Place, value, error)) {
    // a console's line that is no expression is meant as a command
    const bool is_command = arguments.value("context", "") == "repl";
    return refuse(request, is_command ? "'" + text + "': the program runs; pause it first" : error);
  }
  // what pointers point to is what one wants to see
  const bool is_pointer =
      value.type.stars > 0 && session_->values().compute(text, Want::Number, number, error);
  if (!value.part && !session_->values().compute(text, Want::Number, number, error))
    return refuse(request, error);
  Json body{{"result", value.part ? session_->values().shown(value) : session_->values().shown(number)},
            {"variablesReference", 0}};
  if (const Json memory = reference(is_pointer ? number : value); !memory.is_null())
    body["memoryReference"] = memory;
  respond(request, body);
}

// --- memory and instructions

void DapServer::read_memory(const Json& request) {
  const Json& arguments = request.at("arguments");
  std::int64_t address = 0;
  const std::int64_t wanted = arguments.at("count").get<std::int64_t>();
  constexpr std::int64_t kMost = 1 << 16;
  if (!reference_of(arguments, "memoryReference", address) || wanted < 0)
    return refuse(request, "readMemory: expected an address as a memoryReference, and a count of 0 or more");
  std::vector<std::uint8_t> bytes;
  const Address last = kAddressMask;
  for (std::int64_t i = 0; i < std::min(wanted, kMost) && address + i >= 0; ++i) {
    const auto at = static_cast<Address>(address + i);
    std::uint8_t byte = 0;
    if (at > last) break;
    session_->machine().read({at, 1}, &byte);
    bytes.push_back(byte);
  }
  Json body{{"address", fmt::format("{:#x}", std::max<std::int64_t>(0, address))},
            {"data", sim::base64({bytes.begin(), bytes.end()})}};
  if (const auto missing = wanted - static_cast<std::int64_t>(bytes.size()); missing > 0)
    body["unreadableBytes"] = missing;
  respond(request, body);
}

void DapServer::disassemble(const Json& request) {
  const Json& arguments = request.at("arguments");
  std::int64_t wanted = 0;
  const auto from = arguments.value("instructionOffset", std::int64_t{0});
  const auto count = arguments.at("instructionCount").get<std::int64_t>();
  constexpr std::int64_t kMost = 10000;
  const Machine& machine = session_->machine();
  if (!reference_of(arguments, "memoryReference", wanted) || count < 0 || count > kMost ||
      std::abs(from) > kMost)
    return refuse(
        request,
        fmt::format("disassemble: expected an address as a memoryReference, and counts up to {}", kMost));
  std::uint32_t next = 0;
  // instructions have one word or two: begin so far before that it does not matter how the first are taken
  const std::int64_t end = machine.code_end(),
                     begin = std::max<std::int64_t>(
                         0, (wanted & ~std::int64_t{1}) + 4 * std::min<std::int64_t>(0, from) - 64);
  std::vector<std::uint32_t> places;
  std::int64_t here = -1;  // among them
  for (std::int64_t at = begin; at < end; at = next) {
    if (at >= wanted && here < 0) here = static_cast<std::int64_t>(places.size());
    if (here >= 0 &&
        static_cast<std::int64_t>(places.size()) >= here + std::max<std::int64_t>(0, from) + count)
      break;
    places.push_back(static_cast<std::uint32_t>(at));
    machine.instruction(static_cast<std::uint32_t>(at), next);
    // a place where something begins is where an instruction begins
    if (at<wanted&& static_cast<std::int64_t>(next)> wanted) next = static_cast<std::uint32_t>(wanted);
  }
  // So many from there on; what lies beyond the memory is told as no memory.
  if (here < 0) here = static_cast<std::int64_t>(places.size());
  Json all = Json::array();
  const dspic::CodeMap& map = session_->file().code;
  const dspic::CodeMap::Line* last_line = nullptr;
  for (std::int64_t i = here + from; i < here + from + count; ++i) {
    if (i < 0 || i >= static_cast<std::int64_t>(places.size())) {
      const std::int64_t beyond = i < 0 ? 0 : end + 2 * (i - static_cast<std::int64_t>(places.size()));
      all.push_back({{"address", fmt::format("{:#08x}", beyond)},
                     {"instruction", "(no memory)"},
                     {"presentationHint", "invalid"}});
      continue;
    }
    const std::uint32_t at = places[static_cast<std::size_t>(i)];
    const std::string text = machine.instruction(at, next);
    const std::size_t gap = text.find("  ");
    Json one{{"address", fmt::format("{:#08x}", at)},
             {"instruction", text.empty() ? "(erased)" : trimmed(text.substr(gap))}};
    if (!text.empty()) one["instructionBytes"] = text.substr(0, gap);
    if (const auto* function = map.function_at(at); function && function->begin == at)
      one["symbol"] = function->name;
    if (const auto* line = map.line_at(at); line && line != last_line) {
      one["location"] = told_source(line->file);
      one["line"] = told_line(line->line);
      last_line = line;
    }
    all.push_back(std::move(one));
  }
  respond(request, {{"instructions", all}});
}

}  // namespace debug
