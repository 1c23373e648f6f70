// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <iostream>

#include "hal_sim/debug/dap.h"

namespace debug {

namespace {

constexpr std::size_t kLongestMessage = 16u << 20, kLongestHeader = 4096;
constexpr std::size_t kShown = 40;  // bytes of what is no header

/// The number behind "Content-Length:" at the begin of a line of the header; -1: there is none.
long long length_in(const std::string& header) {
  const std::string key = "\r\nContent-Length:";
  const std::size_t at = ("\r\n" + header).find(key);
  if (at == std::string::npos) return -1;
  const char* const number = header.c_str() + at + key.size() - 2;
  char* end = nullptr;
  const long long length = std::strtoll(number, &end, 10);
  return end == number || (*end != 0 && *end != '\r') ? -1 : length;
}

}  // namespace

bool DapLine::has_input() {
  pollfd one{in_, POLLIN, 0};
  return !buffer_.empty() || poll(&one, 1, 0) > 0;
}

bool DapLine::read_more() {
  char bytes[4096];
  const ssize_t n = ::read(in_, bytes, sizeof bytes);
  if (n > 0) buffer_.append(bytes, static_cast<std::size_t>(n));
  return n > 0;
}

bool DapLine::read_header(std::size_t& length) {
  const auto wrong = [this](const std::string& got) {
    wrong_ = fmt::format(
        "dap: header: got {}, expected Content-Length: N, of {} bytes at most, and an empty line; is it an "
        "editor that speaks?",
        got, kLongestMessage);
    return false;
  };
  std::size_t end;
  while ((end = buffer_.find("\r\n\r\n")) == std::string::npos) {
    if (buffer_.size() > kLongestHeader)
      return wrong(fmt::format("more than {} bytes of others", kLongestHeader));
    if (read_more()) continue;
    return buffer_.empty() ? false : wrong("'" + buffer_.substr(0, kShown) + "' and then nothing more");
  }
  const std::string header = buffer_.substr(0, end);
  const long long said = length_in(header);
  if (said < 0 || said > static_cast<long long>(kLongestMessage))
    return wrong("'" + header.substr(0, kShown) + "'");
  length = static_cast<std::size_t>(said);
  buffer_.erase(0, end + 4);
  return true;
}

bool DapLine::read_message(nlohmann::json& message) {
  std::size_t length = 0;
  if (!read_header(length)) return false;
  while (buffer_.size() < length)
    if (!read_more()) {
      wrong_ = fmt::format("dap: message: got {} bytes and then nothing more, expected {}", buffer_.size(),
                           length);
      return false;
    }
  message = nlohmann::json::parse(buffer_.substr(0, length), nullptr, false);
  buffer_.erase(0, length);
  if (message.is_object() && message.contains("command") && message["command"].is_string() &&
      message.contains("seq") && message["seq"].is_number_unsigned())
    return true;
  wrong_ = "dap: message: got something else, expected an object with seq and command";
  return false;
}

void DapLine::send(nlohmann::json message) {
  const std::lock_guard<std::mutex> lock(writing_);
  message["seq"] = ++sequence_;
  const std::string text = message.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  const std::string whole = fmt::format("Content-Length: {}\r\n\r\n{}", text.size(), text);
  for (std::size_t sent = 0; sent < whole.size();) {
    const ssize_t n = ::write(out_, whole.data() + sent, whole.size() - sent);
    if (n <= 0) return;  // the editor has gone; read_message() ends
    sent += static_cast<std::size_t>(n);
  }
}

bool DapLine::serve(DapServer::Open open) {
  DapServer server([this](nlohmann::json message) { send(std::move(message)); },
                   [this] { return has_input(); }, std::move(open));
  nlohmann::json message;
  while (!server.has_ended()) {
    if (server.runs()) server.run_on();
    // it has stopped, and somebody will ask something; or somebody has
    if (!read_message(message)) {
      if (!wrong_.empty()) std::cerr << wrong_ << '\n';
      return wrong_.empty();
    }
    server.handle(message);
  }
  return true;
}

}  // namespace debug
