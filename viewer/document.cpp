// SPDX-License-Identifier: MIT
#include "viewer/document.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>

#include "hal_sim/board/part.h"
#include "hal_sim/twin/world_file.h"
#include "sim_core/load/key_rules.h"
#include "sim_core/load/schema.h"
#include "viewer/requests.h"

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

/// The numbers of a list as it is written; empty: it is none.
std::vector<double> numbers_in(const std::string& list) {
  std::vector<double> out;
  if (list.empty() || list[0] != '[') return out;
  for (std::size_t at = 1; at < list.size();) {
    char* end = nullptr;
    const double value = std::strtod(list.c_str() + at, &end);
    const auto next = static_cast<std::size_t>(end - list.c_str());
    if (next == at) {
      ++at;
    } else {
      out.push_back(value);
      at = next;
    }
  }
  return out;
}

bool is_many(const std::string& path) {
  for (const sim::SectionSpec& section : sim::world_schema())
    if (path == section.path) return section.many;
  return true;
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

/// Keys that say nothing any more beside those that were written just now.
void take_idle(sim::WorldText& text, int id, const std::string& path, const Json& fresh) {
  const auto value_of = [&](const char* key) -> std::optional<std::string> {
    std::string value = text.value(id, key);
    if (value.empty()) return std::nullopt;
    if (value[0] == '"' || value[0] == '\'') return value.substr(1, value.size() - 2);
    return value == "true" || value == "false" ? value : std::string();
  };
  for (const sim::IdleKey& idle : sim::idle_keys(sim::section(path), value_of)) {
    if (!fresh.contains(idle.key) && fresh.contains(idle.other)) text.set(id, idle.key, "");
    if (fresh.contains(idle.key) && !fresh.contains(idle.other) && idle.is_same) text.set(id, idle.other, "");
  }
}

}  // namespace

Document::Document(std::string file, std::string bytes)
    : file_(std::move(file)),
      bytes_(std::move(bytes)),
      saved_text_(plain_text(bytes_).text),
      disk_(base_of(bytes_)),
      stamp_(stamp_of(file_)),
      text_(saved_text_) {
  is_new_ = stamp_.first < 0;
  remove_left_over(file_);
  load();
}

void Document::load() { loaded_ = twin::parse_world(text_.text(), file_, &known_); }

std::string Document::base() const { return base_of(text_.text()); }

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

void Document::put(sim::WorldText next, int group) {
  before_.reset();
  if (next.text() == text_.text()) return;
  before_ = Before{text_, redo_, group == 0 || group != group_, group_};
  if (before_->remembered) remember(group);
  text_ = std::move(next);
  load();
}

std::vector<int> Document::edit(const Json& request) {
  sim::WorldText next = text_;
  std::vector<int> fresh;
  if (!request.contains("edits")) fresh = edit_one(next, request);
  for (const Json& one : request.value("edits", Json::array())) {
    const std::vector<int> more = edit_one(next, one);
    fresh.insert(fresh.end(), more.begin(), more.end());
  }
  put(std::move(next), request.value("group", 0));
  return fresh;
}

std::vector<int> Document::edit_one(sim::WorldText& next, const Json& request) const {
  if (!request.is_object()) refuse("edits: got " + request.dump() + ", expected an object");
  const Request& known = *find_request("edit");
  check_request(known, request);
  need_fields(known, request, {"op"});
  const auto op = request.at("op").get<std::string>();
  static const std::map<std::string, std::vector<std::string>> kNeeds{
      {"set", {"thing", "values"}},
      {"add", {"path", "values"}},
      {"remove", {"thing"}},
      {"copy", {"thing"}},
      {"add_inner", {"thing", "path", "values"}},
      {"remove_inner", {"thing", "path", "index"}},
      {"text", {"text"}},
      {"paste", {"text"}}};
  if (const auto needs = kNeeds.find(op); needs != kNeeds.end()) need_fields(known, request, needs->second);
  // The piece that is meant, a copy: what is written moves it. Keys are judged before that.
  const auto piece = [&]() -> sim::WorldText::Element {
    const int id = request.at("thing");
    const auto* element = next.find(id);
    if (!element) refuse("thing: got " + std::to_string(id) + ", expected the id of a thing of the world");
    return *element;
  };
  const auto set = [&](int id, const std::string& path, const Json& values) {
    for (const auto& [key, value] : values.items()) {
      check_key(path, key);
      next.set(id, key, literal(value));
    }
    take_idle(next, id, path, values);
  };
  if (op == "set") {
    const sim::WorldText::Element element = piece();
    set(element.id, element.path, request.at("values"));
  } else if (op == "add") {
    const auto path = request.at("path").get<std::string>();
    sim::WorldText::Values values;
    for (const auto& [key, value] : request.at("values").items()) {
      check_key(path, key);
      values.emplace_back(key, literal(value));
    }
    for (const auto& element : next.elements())
      if (element.path == path && !is_many(path)) refuse("path: got '" + path + "', which is there once");
    return {next.add(path, values, is_many(path))};
  } else if (op == "remove") {
    next.remove(piece().id);
  } else if (op == "copy") {
    const sim::WorldText::Element element = piece();
    const int fresh = next.copy(element.id);
    if (fresh == 0) refuse("thing: got one of which there is only one");
    set(fresh, element.path, request.value("values", Json::object()));
    return {fresh};
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
    const int index = request.at("index");
    if (!next.remove_inner(piece().id, request.at("path").get<std::string>(), index))
      refuse("index: got " + std::to_string(index) + ", expected that of a piece of the thing");
  } else if (op == "text") {
    if (request.contains("base") && request.at("base") != base())
      throw Refusal("base: the text was changed meanwhile",
                    {{"conflict", {{"base", base()}, {"text", text_.text()}}}});
    next.replace(plain_text(request.at("text").get<std::string>()).text);
  } else if (op == "paste") {
    return paste(next, request);
  } else {
    refuse("op: got '" + op + "', expected set, add, remove, copy, paste, add_inner, remove_inner or text");
  }
  return {0};
}

/// Pieces of some world's text come to this one's end, moved by (dx, dy); what has a name of something that
/// is there gets another.
std::vector<int> Document::paste(sim::WorldText& next, const Json& request) const {
  const double dx = request.value("dx", 0.0), dy = request.value("dy", 0.0);
  const sim::WorldText from(plain_text(request.at("text").get<std::string>()).text);
  std::set<std::string> names;
  for (const auto& element : next.elements()) names.insert(next.value(element.id, "name"));
  std::vector<int> fresh;
  for (const auto& element : from.elements()) {
    if (!element.many) continue;  // the arena and the settings are this world's
    const int id = next.append(from.text_of(element.id));
    fresh.push_back(id);
    if (const std::string name = next.value(id, "name"); name.size() > 2 && names.count(name) > 0) {
      std::string stem = name.substr(1, name.size() - 2);
      stem.erase(stem.find_last_not_of("0123456789") + 1);
      int number = 2;
      while (names.count(fmt::format("\"{}{}\"", stem, number)) > 0) ++number;
      next.set(id, "name", fmt::format("\"{}{}\"", stem, number));
    }
    names.insert(next.value(id, "name"));
    // It lies elsewhere, by its place or by its points.
    if (std::vector<double> at = numbers_in(next.value(id, "position")); at.size() >= 2) {
      at[0] += dx;
      at[1] += dy;
      next.set(id, "position", literal(at));
    }
    if (std::vector<double> points = numbers_in(next.value(id, "points")); !points.empty()) {
      Json moved = Json::array();
      for (std::size_t i = 0; i + 1 < points.size(); i += 2)
        moved.push_back({points[i] + dx, points[i + 1] + dy});
      next.set(id, "points", literal(moved));
    }
  }
  if (fresh.empty()) refuse("text: got no piece of a world, expected [[box]], [[robot]] and the like");
  return fresh;
}

std::string Document::text_of(const std::vector<int>& ids) const {
  std::string out;
  for (const int id : ids) {
    std::string text = text_.text_of(id);
    if (text.empty()) refuse("things: got " + std::to_string(id) + ", expected ids of things of the world");
    while (!text.empty() && text.back() == '\n') text.pop_back();
    out += text + "\n\n";
  }
  return out;
}

bool Document::undo() { return go_to_last(undo_, redo_); }
bool Document::redo() { return go_to_last(redo_, undo_); }

bool Document::go_to_last(std::vector<sim::WorldText>& from, std::vector<sim::WorldText>& back) {
  if (from.empty()) return false;
  back.push_back(std::move(text_));
  text_ = std::move(from.back());
  from.pop_back();
  group_ = 0;
  load();
  return true;
}

/// The file was read, or written, and is this.
void Document::disk_holds(std::string bytes) {
  bytes_ = std::move(bytes);
  saved_text_ = plain_text(bytes_).text;
  disk_ = base_of(bytes_);
  stamp_ = stamp_of(file_);
}

void Document::save(bool overwrite) {
  const std::string fresh = bytes_like(bytes_, text_.text());
  replace_known(file_, fresh, base_of(bytes_), overwrite || is_new_);
  is_new_ = false;
  disk_holds(fresh);
}

void Document::save_as(const std::string& folder, const std::string& name, bool overwrite) {
  const bool plain = !name.empty() && name.find('/') == std::string::npos && name[0] != '.' &&
                     name.find('\0') == std::string::npos;
  if (!plain || fs::path(name).extension() != ".toml")
    refuse("name: got '" + name + "', expected a file name that ends in .toml, for the world's own folder");
  const std::string file = (fs::path(folder) / name).string();
  std::error_code none;
  const fs::file_status there = fs::symlink_status(file, none);
  if (fs::is_symlink(there))
    refuse("name: got '" + name + "', which is a link, expected a file of the world's folder");
  if (fs::exists(there) && !fs::is_regular_file(there)) refuse("name: got '" + name + "', which is no file");
  if (fs::exists(there) && !overwrite)
    refuse("name: got '" + name + "', which is there already; overwrite it?");
  if (!is_writable(file)) throw Refusal(name + ": is read-only, and stays as it is", {{"readonly", true}});
  const std::string fresh = bytes_like(bytes_, text_.text());
  if (const std::string wrong = replace_file(file, fresh); !wrong.empty()) refuse(wrong);
  file_ = file;
  is_new_ = false;
  disk_holds(fresh);
  load();
}

void Document::reload() {
  auto bytes = bytes_at(file_, sim::kLongestWorld);
  if (!bytes) refuse(file_ + ": cannot be read");
  disk_holds(std::move(*bytes));
  sim::WorldText next = text_;
  next.replace(saved_text_);
  put(std::move(next), 0);
}

std::optional<std::string> Document::disk_change() {
  const auto stamp = stamp_of(file_);
  if (stamp == stamp_) return std::nullopt;
  stamp_ = stamp;
  const auto bytes = bytes_at(file_, sim::kLongestWorld);
  const std::string base = bytes ? base_of(*bytes) : "";
  if (base == disk_) return std::nullopt;
  disk_ = base;
  return base;
}

}  // namespace viewer
