// SPDX-License-Identifier: MIT
#include "outputs/serial_text.h"

#include <algorithm>

namespace outputs {

namespace {

constexpr std::size_t kLongestLine = 400;  // bytes without a line's end: shown as they are

// tabs and what a terminal can show; bytes above 127 may be Latin-1 or UTF-8
bool is_text(const std::string& line) {
  return std::all_of(line.begin(), line.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte >= 32 && byte != 127) || c == '\t';
  });
}

}  // namespace

void SerialText::listen(twin::Twin& twin, int robot, int port) {
  const std::string name = twin.world().robots[static_cast<std::size_t>(robot)].name;
  const std::string suffix = port == 1 ? "" : std::to_string(port);
  lines_.push_back(std::make_unique<Line>());
  lines_.back()->prefix = port == 1 ? name : name + " uart2";
  lines_.back()->name = "--uart" + suffix + " " + name;
  twin.mind(robot).board().uart(port).listen(&lines_.back()->text);
}

void SerialText::show() {
  for (const auto& line : lines_)
    if (!line->text.empty()) show(*line, false);
}

void SerialText::forget() {
  for (const auto& line : lines_) line->text.clear();
}

// lines end with CR, LF or both, as programs have it
void SerialText::show(Line& line, bool all) {
  std::size_t begin = 0;
  while (begin < line.text.size()) {
    const std::size_t end = line.text.find_first_of("\r\n", begin);
    const std::size_t length = (end == std::string::npos ? line.text.size() : end) - begin;
    if (end == std::string::npos && length < kLongestLine && !all) break;
    const std::string text = line.text.substr(begin, length);
    if (!is_text(text))
      line.binary += length;
    else if (!text.empty())
      say_(line.prefix + ": " + text);
    begin += length + (end == std::string::npos ? 0 : 1);
  }
  line.text.erase(0, begin);
}

void SerialText::finish() {
  for (const auto& line : lines_) {
    show(*line, true);
    if (line->binary > 0)
      say_(line->prefix + ": " + std::to_string(line->binary) + " bytes that are no text; " + line->name +
           "=file:F keeps them");
    line->binary = 0;
  }
}

}  // namespace outputs
