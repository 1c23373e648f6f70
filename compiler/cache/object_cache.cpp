// SPDX-License-Identifier: MIT
// See object_cache.h. For each object `<key>.o` stands `<key>.deps`: the object's own hash, then a line per
// file read, its hash before it. Two builds at once may leave one's object beside the other's list: that is
// no pair.
#include "object_cache.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <sstream>
#include <thread>

#include "inputs.h"

namespace cc {
namespace fs = std::filesystem;

std::string content_hash(const std::string& bytes) {
  // two sums of words with different factors: 128 bits, plenty against accidents
  uint64_t a = 0x9e3779b97f4a7c15ull + bytes.size(), b = 1469598103934665603ull ^ bytes.size();
  for (size_t at = 0; at < bytes.size(); at += 8) {
    uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, std::min<size_t>(8, bytes.size() - at));
    a = (a ^ word) * 0xd6e8feb86659fd93ull;
    a ^= a >> 32;
    b = (b ^ word) * 0x9fb21c651e98df25ull;
    b ^= b >> 29;
  }
  char text[33];
  std::snprintf(text, sizeof text, "%016lx%016lx", (unsigned long)a, (unsigned long)b);
  return text;
}

std::string bytes_of(const fs::path& path) {
  std::error_code none;
  if (!fs::is_regular_file(path, none)) return "";  // a pipe would never end
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  std::string all(in ? size_t(std::max<std::streamoff>(0, in.tellg())) : 0, '\0');
  in.seekg(0);
  in.read(all.data(), std::streamsize(all.size()));
  all.resize(size_t(std::max<std::streamsize>(0, in.gcount())));
  return all;
}

std::string read_text(const fs::path& path) {
  BuildInputs* inputs = inputs_of_build();
  return inputs ? inputs->read(path) : bytes_of(path);
}

fs::path unfinished(const fs::path& path) {
  static std::atomic<int> count{0};
  return path.string() + ".half" + std::to_string(getpid()) + "_" + std::to_string(count++);
}

FileLock::FileLock(const fs::path& file) {
  std::error_code ec;
  fs::create_directories(file.parent_path(), ec);
  file_ = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  // without one, as on a disk that cannot, builds go on as if they were alone
  while (file_ >= 0 && flock(file_, LOCK_EX) != 0 && errno == EINTR) {
  }
}

FileLock::~FileLock() {
  if (file_ >= 0) close(file_);
}

bool write_text(const fs::path& path, const std::string& text) {
  fs::path half = unfinished(path);
  {
    std::ofstream out(half, std::ios::binary);
    out << text;
    if (!out.flush()) {
      std::error_code ignored;
      fs::remove(half, ignored);
      return false;
    }
  }
  std::error_code ec;
  fs::rename(half, path, ec);
  return !ec;
}

namespace {

/// File names of a make rule ("x: a.c b.h \").
std::vector<std::string> names_of_rule(const std::string& rule) {
  std::vector<std::string> names;
  std::string name;
  size_t i = rule.find(':');
  for (i = i == std::string::npos ? rule.size() : i + 1; i <= rule.size(); ++i) {
    char c = i < rule.size() ? rule[i] : ' ';
    if (c == '\\' && i + 1 < rule.size() && rule[i + 1] == '\n') {
      ++i;
    } else if (c == '\\' && i + 1 < rule.size() && (rule[i + 1] == ' ' || rule[i + 1] == '#')) {
      name += rule[++i];
    } else if (c == ' ' || c == '\n' || c == '\t') {
      if (!name.empty()) names.push_back(name);
      name.clear();
    } else {
      name += c;
    }
  }
  return names;
}

bool is_fresh(const fs::path& object, const fs::path& deps, BuildInputs& inputs) {
  std::ifstream in(deps);
  std::string hash, path;
  if (!std::getline(in, hash) || hash != content_hash(bytes_of(object))) return false;
  bool any = false;
  while (std::getline(in, hash, '\t') && std::getline(in, path)) {
    any = true;
    if (inputs.look_at(path) != hash) return false;
  }
  return any;
}

CompileOutcome compile(const CompileJob& job, const fs::path& compiler, const std::string& salt,
                       const fs::path& cache, BuildInputs& inputs) {
  CompileOutcome outcome;
  outcome.source = job.source;
  // debug information and messages name the files as the compiler was given them, from where it ran
  std::string key = job.source.string() + "\n" + job.salt + "\n" + salt;
  if (job.source.is_relative()) key += "\n" + fs::current_path().string();
  for (const auto& f : job.flags) key += "\n" + f;
  fs::path base = cache / (job.source.stem().string() + "-" + content_hash(key));
  outcome.object = base.string() + ".o";
  fs::path deps = base.string() + ".deps", notes = base.string() + ".txt", facts = base.string() + ".facts";
  if (fs::exists(outcome.object) && is_fresh(outcome.object, deps, inputs)) {
    outcome.ok = outcome.reused = true;
    outcome.messages = bytes_of(notes);
    if (job.has_facts) outcome.facts = bytes_of(facts);
    return outcome;
  }
  const std::string half = unfinished(base).string();
  std::vector<std::string> argv = {compiler.string(), "-c",       job.source.string(), "-o", half,
                                   "--depfile",       half + ".d"};
  argv.insert(argv.end(), job.flags.begin(), job.flags.end());
  if (job.has_facts) argv.insert(argv.end(), {"--facts", half + ".facts"});
  const int64_t began_ns = now_ns();
  auto result = run_process(argv);
  outcome.messages = result.output;
  outcome.ok = result.status == 0;
  std::error_code ec;
  if (outcome.ok) {
    std::string lines = content_hash(bytes_of(half)) + "\n";
    for (const auto& name : names_of_rule(bytes_of(half + ".d")))
      lines += inputs.look_at(name, began_ns) + "\t" + name + "\n";
    std::istringstream missing(bytes_of(half + ".d.missing"));
    for (std::string name; std::getline(missing, name);)
      if (job.listed_below.empty() || name.rfind(job.listed_below, 0) != 0)
        lines += inputs.look_at(name, began_ns) + "\t" + name + "\n";
    write_text(notes, result.output);
    if (job.has_facts) {
      outcome.facts = bytes_of(half + ".facts");
      fs::rename(half + ".facts", facts, ec);
    }
    fs::rename(half, outcome.object, ec);
    if (ec || !write_text(deps, lines)) {
      outcome.ok = false;
      outcome.messages += outcome.object.string() + ": cannot write the object; is the disk full?\n";
    }
  } else if (result.status != 1) {
    outcome.messages +=
        job.source.string() + ": the compiler stopped with status " + std::to_string(result.status) + "\n";
  }
  fs::remove(half, ec);
  fs::remove(half + ".d", ec);
  fs::remove(half + ".facts", ec);
  fs::remove(half + ".d.missing", ec);
  return outcome;
}

}  // namespace

std::vector<CompileOutcome> compile_all(const std::vector<CompileJob>& jobs, const fs::path& compiler,
                                        const fs::path& cache_dir, int parallel) {
  std::error_code ec;
  fs::create_directories(cache_dir, ec);
  // a rebuilt compiler invalidates everything; its time and size tell
  auto time = fs::last_write_time(compiler, ec).time_since_epoch().count();
  std::string salt =
      compiler.string() + " " + std::to_string(time) + " " + std::to_string(fs::file_size(compiler, ec));
  look_at(compiler);
  std::vector<CompileOutcome> outcomes(jobs.size());
  BuildInputs& inputs = *inputs_of_build();
  std::atomic<size_t> next{0};
  auto work = [&] {
    for (size_t i; (i = next++) < jobs.size();)
      outcomes[i] = compile(jobs[i], compiler, salt, cache_dir, inputs);
  };
  std::vector<std::thread> others;
  for (int t = 1; t < parallel && size_t(t) < jobs.size(); ++t) others.emplace_back(work);
  work();
  for (auto& t : others) t.join();
  return outcomes;
}

}  // namespace cc
