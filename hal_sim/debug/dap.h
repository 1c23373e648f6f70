// SPDX-License-Identifier: MIT
// The debugger's face for editors and for the page: a server of the Debug Adapter Protocol.
//
//   editor --Content-Length, requests--> DapLine --> DapServer --> Session
//          <--responses, events--
//   page ----requests of its own protocol----------------^
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

  /// Takes a response or an event, all but its "seq"; by any thread.
  using Send = std::function<void(nlohmann::json)>;
  /// Has a message come? Asked while the program runs, by the thread that runs it.
  using HasInput = std::function<bool()>;

  DapServer(Send send, HasInput has_input, Open open)
      : send_(std::move(send)), has_input_(std::move(has_input)), open_(std::move(open)) {}

  /// A request: an object with "seq" and "command". It is answered before this returns, by a response; one
  /// that runs the program makes runs() true.
  void handle(const nlohmann::json& request);
  /// Does the program run on, as soon as run_on() is called?
  bool runs() const { return runs_; }
  /// Runs the program until it stops, which an event tells, or until a message has come; handle() that, and
  /// call this again.
  void run_on();
  /// The editor has disconnected.
  bool has_ended() const { return ended_; }

 private:
  using Json = nlohmann::json;
  void send_event(const std::string& event, Json body = Json::object());
  void respond(const Json& request, Json body = Json::object());
  void refuse(const Json& request, const std::string& why);

  // --- requests
  void answer(const Json& request);
  void launch(const Json& request);
  void set_breakpoints(const Json& request);
  void set_function_breakpoints(const Json& request);
  void set_data_breakpoints(const Json& request);
  void data_breakpoint_info(const Json& request);
  void stack_trace(const Json& request);
  void variables(const Json& request);
  bool select_level(const Json& arguments);
  void set_variable(const Json& request);
  void evaluate(const Json& request);
  void set_instruction_breakpoints(const Json& request);
  void read_memory(const Json& request);
  void disassemble(const Json& request);
  /// Of what lies in memory: where.
  Json reference(const CValue& value) const;
  /// Name and path of a source, the path as the editor has it.
  Json told_source(std::size_t file) const;
  /// As the editor counts.
  int told_line(int line) const { return line - 1 + first_line_; }
  void begin_run(Plan plan);
  using Adds =
      std::function<const Breakpoint*(const Json& wanted, const std::string& condition, std::string& error)>;
  void set_all(const Json& request, std::set<int>& ours, const Adds& add);
  Json told(const Breakpoint* b, const std::string& error);

  Send send_;
  HasInput has_input_;
  Open open_;
  std::unique_ptr<Session> session_;
  std::unique_ptr<Monitor> monitor_;
  std::map<std::string, std::set<int>> of_source_;
  std::map<std::size_t, std::string> paths_;  // of sources, as the editor named them
  std::set<int> of_functions_, of_data_, of_instructions_;
  int first_line_ = 1, first_column_ = 1;  // numbers that the editor gives them
  bool stops_on_entry_ = false, runs_ = false, pause_asked_ = false, ended_ = false;
  Plan plan_ = Plan::Continue;
};

/// The line that editors speak on: messages with their length before them, on two file descriptors.
class DapLine {
 public:
  DapLine(int in, int out) : in_(in), out_(out) {}
  /// Until the editor disconnects or closes the line. False: it sent what is no message, which was told.
  bool serve(DapServer::Open open);

 private:
  /// False: the line has ended, or what comes is none, which wrong_ says.
  bool read_message(nlohmann::json& message);
  bool read_header(std::size_t& length);
  bool read_more();
  bool has_input();
  void send(nlohmann::json message);

  int in_, out_;
  std::string buffer_;
  std::mutex writing_;  // the world's thread sends text
  int sequence_ = 0;
  std::string wrong_;
};

}  // namespace debug
