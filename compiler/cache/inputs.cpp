// SPDX-License-Identifier: MIT
#include "inputs.h"

#include <sys/stat.h>

#include <algorithm>
#include <chrono>

#include "object_cache.h"

namespace cc {
namespace fs = std::filesystem;
namespace {

thread_local BuildInputs* noted = nullptr;

// the kernel stamps files with a clock that ticks every 1 to 10 ms: what changes again within that time may
// keep its stamp
constexpr std::int64_t kSameInstantNs = 20'000'000;

}  // namespace

FileState state_of(const std::string& path) {
  struct stat s;
  if (stat(path.c_str(), &s) != 0) return {};
  return {std::int64_t{s.st_ctim.tv_sec} * 1'000'000'000 + s.st_ctim.tv_nsec, std::uint64_t(s.st_size),
          s.st_ino};
}

std::string hash_at(const std::string& path, const FileState& state) {
  if (!state.number) return "gone";
  std::error_code ec;
  if (!fs::is_directory(path, ec)) return content_hash(bytes_of(path));
  std::vector<std::string> names;
  for (fs::directory_iterator it(path, ec), end; !ec && it != end; it.increment(ec))
    names.push_back(it->path().filename().string());
  std::sort(names.begin(), names.end());
  std::string list;
  for (const std::string& name : names) list += name + "/";
  return content_hash(list);
}

FileState settled(FileState state) {
  if (state.changed_ns > now_ns() - kSameInstantNs) state.changed_ns = 0;
  return state;
}

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

std::string BuildInputs::look_at(const fs::path& path, std::int64_t since_ns) {
  const std::string name = fs::absolute(path).string();
  {
    std::lock_guard<std::mutex> lock(mutex_);
    if (const auto known = all.find(name); known != all.end()) return known->second.hash;
  }
  const FileState state = state_of(name);
  Input input{settled(state), hash_at(name, state)};
  if (state.number && state.changed_ns >= since_ns - kSameInstantNs) input = {{}, "changed meanwhile"};
  std::lock_guard<std::mutex> lock(mutex_);
  return all.emplace(name, input).first->second.hash;
}

std::string BuildInputs::read(const fs::path& path) {
  const std::string name = fs::absolute(path).string();
  if (!readable.has(name)) return "";
  const FileState state = state_of(name);  // before reading: a later change shows
  std::string text = bytes_of(path);
  std::lock_guard<std::mutex> lock(mutex_);
  if (!all.count(name)) all[name] = {settled(state), state.number ? content_hash(text) : "gone"};
  return text;
}

void BuildInputs::refuse(const fs::path& file, const std::string& what) {
  std::error_code none;
  const fs::path real = fs::weakly_canonical(file, none);
  const std::string text = file.string() + ": " + readable.refusal(what, real.string());
  std::lock_guard<std::mutex> lock(mutex_);
  if (std::find(refusals_.begin(), refusals_.end(), text) == refusals_.end()) refusals_.push_back(text);
}

std::vector<std::string> BuildInputs::refusals() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return refusals_;
}

void BuildInputs::take(const fs::path& file) {
  std::lock_guard<std::mutex> lock(mutex_);
  taken_.push_back(file);
}

bool BuildInputs::has_lost_one() const {
  return std::any_of(taken_.begin(), taken_.end(), [](const fs::path& file) {
    std::error_code none;
    return !fs::exists(file, none);
  });
}

NotingInputs::NotingInputs(BuildInputs& inputs) : before_(noted) { noted = &inputs; }
NotingInputs::~NotingInputs() { noted = before_; }
BuildInputs* inputs_of_build() { return noted; }
void look_at(const fs::path& path) {
  if (noted) noted->look_at(path);
}

bool may_read(const fs::path& path) { return !noted || noted->readable.has(path); }

}  // namespace cc
