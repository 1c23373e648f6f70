// SPDX-License-Identifier: MIT
#include "viewer/debugging.h"

#include <stdexcept>

namespace viewer {

std::unique_ptr<Debugging> Debugging::open(debug::Session::Setup setup, debug::Cycle from, Tell tell,
                                           std::function<bool()> has_news,
                                           std::vector<std::string>& problems) {
  std::unique_ptr<debug::Session> session = debug::Session::open(std::move(setup), problems);
  if (!session) return nullptr;
  if (from > session->now()) session->go_to(from);
  std::unique_ptr<Debugging> debugging(new Debugging);
  debugging->robot_ = session->robot();
  debugging->session_ = session.get();
  debugging->tell_ = std::move(tell);
  debugging->server_ = std::make_unique<debug::DapServer>(
      [d = debugging.get()](const Json& message) { d->take(message); }, std::move(has_news),
      [&session](const Json&, const std::function<void(const std::string&)>&, std::vector<std::string>&) {
        return std::move(session);
      });
  debugging->ask({{"command", "launch"}, {"arguments", {{"stopOnEntry", true}}}});
  debugging->ask({{"command", "configurationDone"}});
  return debugging;
}

void Debugging::take(const Json& message) {
  if (message.at("type") == "response")
    answer_ = message;
  else
    tell_(message.at("event").get<std::string>(), message.value("body", Json::object()));
}

Debugging::Json Debugging::ask(const Json& message) {
  const auto command = message.at("command").get<std::string>();
  if (command == "disconnect" || command == "terminate")
    throw std::runtime_error("dap: got " + command + ", expected `debug` without a robot");
  Json request{{"seq", 1}, {"type", "request"}, {"command", command}};
  request["arguments"] = message.value("arguments", Json::object());
  answer_ = nullptr;
  server_->handle(request);
  if (!answer_.is_object()) throw std::runtime_error("dap: " + command + " was not answered");
  if (!answer_.at("success").get<bool>()) throw std::runtime_error(answer_.at("message").get<std::string>());
  return answer_.value("body", Json::object());
}

}  // namespace viewer
