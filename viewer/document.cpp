// SPDX-License-Identifier: MIT
#include "viewer/document.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "hal_sim/board/part.h"
#include "hal_sim/twin/world_file.h"
#include "sim_core/load/schema.h"

namespace viewer {

namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr std::size_t kMostUndo = 200;
constexpr double kGrain = 1e5;  // numbers are written to 10 um, or 1e-5 degrees

[[noreturn]] void refuse(const std::string& what) { throw std::runtime_error(what); }

/// A JSON value as TOML writes it.
std::string literal(const Json& value) {
  if (value.is_null()) return "";
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  if (value.is_number_integer()) return value.dump();
  if (value.is_number()) {
    const double rounded = std::round(value.get<double>() * kGrain) / kGrain;
    if (!std::isfinite(rounded)) refuse("value: expected a number");
    return fmt::format("{}", rounded == 0 ? 0.0 : rounded);
  }
  if (value.is_string()) {
    std::string out = "\"";
    for (const char c : value.get<std::string>()) {
      if (c == '"' || c == '\\') out += '\\';
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
        refuse("value: got a control character in a text");
      out += c;
    }
    return out + '"';
  }
  if (!value.is_array()) refuse("value: got an object, expected a number, text, flag or list");
  std::string out = "[";
  for (const Json& part : value) out += (out.size() > 1 ? ", " : "") + literal(part);
  return out + "]";
}

/// Keys and paths come from the page: only those that the format has.
void check_key(const std::string& path, const std::string& key) {
  for (const sim::SectionSpec& section : sim::world_schema())
    if (path == section.path)
      for (const sim::KeySpec& k : section.keys)
        if (key == k.key) return;
  if (path == "robot")
    for (const sim::RobotModel& model : twin::robot_models())
      for (const auto& k : model.keys)
        if (key == k.key) return;
  refuse(fmt::format("key: got '{}', expected a key of {}", key.substr(0, 60),
                     path.empty() ? "the file" : path));
}

void check_part_key(const std::string& key) {
  if (key == "kind") return;
  for (const sim::PartKind& kind : board::part_kinds())
    for (const auto& k : kind.keys)
      if (key == k.key) return;
  refuse(fmt::format("key: got '{}', expected a key of robot.part", key.substr(0, 60)));
}

}  // namespace

std::string replace_file(const std::string& path, const std::string& bytes) {
  std::error_code none;
  const fs::path target = fs::weakly_canonical(path, none);  // a link goes on being one
  const std::string fresh =
      (target.parent_path() / (".#" + target.filename().string() + "." + std::to_string(::getpid())))
          .string();
  struct stat was {};
  const mode_t mode = ::stat(target.c_str(), &was) == 0 ? was.st_mode & 07777 : 0644;
  const int file = ::open(fresh.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, mode);
  const auto fail = [&] {
    const std::string why = std::strerror(errno);
    ::unlink(fresh.c_str());
    return path + ": cannot be written: " + why;
  };
  if (file < 0) return fail();
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = ::write(file, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    done += static_cast<std::size_t>(n);
  }
  const bool good = done == bytes.size() && ::fchmod(file, mode) == 0 && ::fsync(file) == 0;
  if (::close(file) != 0 || !good || ::rename(fresh.c_str(), target.c_str()) != 0) return fail();
  return "";
}

Document::Document(std::string file, std::string text)
    : file_(std::move(file)), saved_(text), text_(std::move(text)) {
  load();
}

void Document::load() { loaded_ = twin::parse_world(text_.text(), file_); }

void Document::take_back() {
  if (!before_) return;
  text_ = std::move(before_->text);
  redo_ = std::move(before_->redo);
  if (before_->remembered) undo_.pop_back();
  group_ = before_->group;
  before_.reset();
  load();
}

void Document::remember(int group) {
  group_ = group;
  undo_.push_back(text_);
  if (undo_.size() > kMostUndo) undo_.erase(undo_.begin());
  redo_.clear();
}

int Document::edit(const Json& request) {
  const auto op = request.at("op").get<std::string>();
  sim::WorldText next = text_;
  int fresh = 0;
  const auto piece = [&]() -> const sim::WorldText::Element& {
    const auto* element = next.find(request.at("thing").get<int>());
    if (!element) refuse("thing: got one that is not there");
    return *element;
  };
  if (op == "set") {
    const sim::WorldText::Element element = piece();
    for (const auto& [key, value] : request.at("values").items()) {
      check_key(element.path, key);
      next.set(element.id, key, literal(value));
    }
  } else if (op == "add") {
    const auto path = request.at("path").get<std::string>();
    sim::WorldText::Values values;
    for (const auto& [key, value] : request.at("values").items()) {
      check_key(path, key);
      values.emplace_back(key, literal(value));
    }
    fresh = next.add(path, values);
  } else if (op == "remove") {
    next.remove(piece().id);
  } else if (op == "copy") {
    const sim::WorldText::Element element = piece();
    fresh = next.copy(element.id);
    if (fresh == 0) refuse("thing: got one of which there is only one");
    const Json values = request.value("values", Json::object());
    for (const auto& [key, value] : values.items()) {
      check_key(element.path, key);
      next.set(fresh, key, literal(value));
    }
  } else if (op == "add_inner") {
    const auto path = request.at("path").get<std::string>();
    if (path != "robot.part" || piece().path != "robot") refuse("path: expected robot.part, of a robot");
    sim::WorldText::Values values;
    for (const auto& [key, value] : request.at("values").items()) {
      check_part_key(key);
      values.emplace_back(key, literal(value));
    }
    next.add_inner(piece().id, path, values);
  } else if (op == "remove_inner") {
    if (!next.remove_inner(piece().id, request.at("path").get<std::string>(), request.at("index").get<int>()))
      refuse("index: got one that is not there");
  } else if (op == "text") {
    next.replace(request.at("text").get<std::string>());
  } else {
    refuse("op: got '" + op + "', expected set, add, remove, copy, add_inner, remove_inner or text");
  }
  before_.reset();
  if (next.text() == text_.text()) return fresh;
  const int group = request.value("group", 0);
  before_ = Before{text_, redo_, group == 0 || group != group_, group_};
  if (before_->remembered) remember(group);
  text_ = std::move(next);
  load();
  return fresh;
}

bool Document::undo() {
  if (undo_.empty()) return false;
  redo_.push_back(std::move(text_));
  text_ = std::move(undo_.back());
  undo_.pop_back();
  group_ = 0;
  load();
  return true;
}

bool Document::redo() {
  if (redo_.empty()) return false;
  undo_.push_back(std::move(text_));
  text_ = std::move(redo_.back());
  redo_.pop_back();
  group_ = 0;
  load();
  return true;
}

std::string Document::save(const std::string& name) {
  std::string file = file_;
  if (!name.empty()) {
    const bool plain =
        name.find('/') == std::string::npos && name[0] != '.' && name.find('\0') == std::string::npos;
    if (!plain || fs::path(name).extension() != ".toml")
      return "name: got '" + name + "', expected a file name that ends in .toml, for the world's own folder";
    file = (fs::path(file_).parent_path() / name).string();
  }
  const std::string wrong = replace_file(file, text_.text());
  if (!wrong.empty()) return wrong;
  saved_ = text_.text();
  if (file != file_) {
    file_ = file;
    load();
  }
  return "";
}

}  // namespace viewer
