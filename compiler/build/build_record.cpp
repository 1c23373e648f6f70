// SPDX-License-Identifier: MIT
// See build_record.h. A record is a list of texts, each ended by a zero byte: the question, the result, then
// four for each input.
#include "build_record.h"

#include <algorithm>
#include <cstdlib>

#include "compiler/cache/object_cache.h"
#include "driver_id.h"
#include "install/cache_bound.h"
#include "install/places.h"

namespace cc {
namespace fs = std::filesystem;
namespace {

std::string numbers(const FileState& s) {
  return std::to_string(s.changed_ns) + " " + std::to_string(s.bytes) + " " + std::to_string(s.number);
}

FileState state_in(const std::string& text) {
  char* at = nullptr;
  FileState s;
  s.changed_ns = std::strtoll(text.c_str(), &at, 10);
  s.bytes = std::strtoull(at, &at, 10);
  s.number = std::strtoull(at, &at, 10);
  return s;
}

/// A list of texts: its length, then the texts.
void put(std::vector<std::string>& to, const std::vector<std::string>& texts) {
  to.push_back(std::to_string(texts.size()));
  to.insert(to.end(), texts.begin(), texts.end());
}

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += text + '\0';
  return all;
}

/// Reads what joined() wrote; asking beyond the end gives empty texts.
class Texts {
 public:
  explicit Texts(std::string all) : all_(std::move(all)) {}
  std::string next() {
    const std::size_t end = std::min(all_.find('\0', at_), all_.size());
    std::string text = all_.substr(std::min(at_, end), end - std::min(at_, end));
    at_ = end + 1;
    return text;
  }
  long number() { return std::atol(next().c_str()); }
  std::vector<std::string> list() {
    std::vector<std::string> texts;
    for (long n = number(); n > 0 && !is_over(); --n) texts.push_back(next());
    return texts;
  }
  bool is_over() const { return at_ >= all_.size(); }

 private:
  std::string all_;
  std::size_t at_ = 0;
};

}  // namespace

BuildRecord::BuildRecord(const BuildOptions& o) {
  std::vector<std::string> asked = {TWINPUCK_DRIVER_ID,
                                    places::product_share().string(),
                                    o.source_dir.is_absolute() ? "" : fs::current_path().string(),
                                    o.source_dir.string(),
                                    fs::absolute(o.output).string(),
                                    o.optimisation,
                                    o.sanitize ? "sanitize" : "",
                                    o.strict ? "strict" : "",
                                    o.hal,
                                    o.with_texts ? "texts" : "",
                                    o.name,
                                    o.webots_settings,
                                    o.standard,
                                    o.api_dir.string(),
                                    o.include_root.string(),
                                    o.within.string()};
  put(asked, o.defines);
  for (const auto* paths : {&o.include_dirs, &o.sources}) {
    asked.push_back(std::to_string(paths->size()));
    for (const fs::path& path : *paths) asked.push_back(fs::absolute(path).string());
  }
  question_ = content_hash(joined(asked));
  file_ = o.cache_dir / ("image-" + content_hash(fs::absolute(o.output).string()) + ".record");
}

std::optional<BuildResult> BuildRecord::recall() const {
  // What came of the same question last time.
  Texts record(bytes_of(file_));
  if (record.next() != question_) return std::nullopt;
  BuildResult result;
  result.ok = true;
  result.reused = int(record.number());
  result.files = int(record.number());
  result.ram_bytes = record.number();
  result.stack_bytes = record.number();
  result.recursive = record.next();
  result.no_room = record.next();
  result.size_report = record.next();
  result.warnings = record.list();
  result.conflicts = record.list();
  result.notes = record.list();
  // It holds while every file that was read is as it was then.
  std::map<std::string, BuildInputs::Input> inputs;
  bool is_touched = false;  // the same content at another time: the record learns it
  while (!record.is_over()) {
    const std::string path = record.next();
    FileState then = state_in(record.next());
    const std::string hash = record.next();
    if (const FileState state = state_of(path); !(state == then)) {
      if (hash_at(path, state) != hash) return std::nullopt;
      then = settled(state);
      is_touched = is_touched || then.changed_ns != 0;
    }
    inputs[path] = {then, hash};
  }
  if (is_touched)
    keep(result, inputs);
  else
    places::note_used(file_);
  return result;
}

void BuildRecord::keep(const BuildResult& result,
                       const std::map<std::string, BuildInputs::Input>& inputs) const {
  std::vector<std::string> texts = {question_,
                                    std::to_string(result.compiled + result.reused),
                                    std::to_string(result.files),
                                    std::to_string(result.ram_bytes),
                                    std::to_string(result.stack_bytes),
                                    result.recursive,
                                    result.no_room,
                                    result.size_report};
  put(texts, result.warnings);
  put(texts, result.conflicts);
  put(texts, result.notes);
  for (const auto& [path, input] : inputs)
    texts.insert(texts.end(), {path, numbers(input.state), input.hash});
  write_text(file_, joined(texts));
}

}  // namespace cc
