// SPDX-License-Identifier: MIT
// The debugger's face for editors: a server of the Debug Adapter Protocol on two file descriptors.
//
//   editor --requests--> DapServer --> Session
//          <--responses, events--
//
// One thread, one session, one thread of the program. A message that comes while the program runs pauses it,
// is answered, and the program goes on, if it was not the pause itself. What is typed in the editor's console
// is a command of the monitor.
#pragma once
#include <functional>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "hal_sim/debug/monitor.h"
#include "hal_sim/debug/session.h"

namespace debug {

class DapServer {
 public:
  /// Opens a session as "launch" asks, with `output` for the robots' text; null with lines in `problems`.
  using Open = std::function<std::unique_ptr<Session>(const nlohmann::json& launch,
                                                      const std::function<void(const std::string&)>& output,
                                                      std::vector<std::string>& problems)>;

  DapServer(int in, int out, Open open) : in_(in), out_(out), open_(std::move(open)) {}
  /// Until the editor disconnects or closes the line. False: it sent what is no message.
  bool serve();

 private:
  using Json = nlohmann::json;
  // --- the line
  bool read_message(Json& message);
  bool has_input();
  void send(Json message);
  void send_event(const std::string& event, Json body = Json::object());
  void respond(const Json& request, Json body = Json::object());
  void refuse(const Json& request, const std::string& why);

  // --- requests
  void handle(const Json& request);
  void launch(const Json& request);
  void set_breakpoints(const Json& request);
  void set_function_breakpoints(const Json& request);
  void set_data_breakpoints(const Json& request);
  void data_breakpoint_info(const Json& request);
  void stack_trace(const Json& request);
  void variables(const Json& request);
  void set_variable(const Json& request);
  void evaluate(const Json& request);
  void set_instruction_breakpoints(const Json& request);
  void read_memory(const Json& request);
  void disassemble(const Json& request);
  /// Of what lies in memory: where.
  Json reference(const CValue& value) const;
  /// Name and path of a source, the path as the editor has it.
  Json told_source(std::size_t file) const;
  void begin_run(Plan plan);
  void go_on();
  void replace(std::set<int>& old, std::set<int> now);
  Json told(const Breakpoint* b, const std::string& error);

  int in_, out_;
  Open open_;
  std::string buffer_;
  std::mutex writing_;  // the world's thread sends text
  int sequence_ = 0;
  std::unique_ptr<Session> session_;
  std::unique_ptr<Monitor> monitor_;
  std::map<std::string, std::set<int>> of_source_;
  std::map<std::size_t, std::string> paths_;  // of sources, as the editor named them
  std::set<int> of_functions_, of_data_, of_instructions_;
  bool stops_on_entry_ = false, runs_ = false, pause_asked_ = false, ended_ = false, is_broken_ = false;
  Plan plan_ = Plan::Continue;
};

}  // namespace debug
