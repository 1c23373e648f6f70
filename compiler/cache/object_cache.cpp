// SPDX-License-Identifier: MIT
// See object_cache.h. `<key>.deps` holds the name of what came of a compilation, then a line per file
// read, its hash before it. That name is a hash of `<key>.<name>.o`, .txt (messages) and .facts together,
// so what is there is never replaced: whoever has found an object, such as the linker of another build,
// keeps it, or misses it.
#include "object_cache.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <sstream>
#include <thread>

#include "crash_words.h"
#include "inputs.h"
#include "install/cache_bound.h"

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

bool FileLock::is_gone() const {
  struct stat s;
  return file_ < 0 || (fstat(file_, &s) == 0 && s.st_nlink == 0);
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
    } else if ((c == '\\' && i + 1 < rule.size() && (rule[i + 1] == ' ' || rule[i + 1] == '#')) ||
               (c == '$' && i + 1 < rule.size() && rule[i + 1] == '$')) {
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

/// What of a compiler stays the same when it is copied, moved or stripped: the linker's note of its content.
std::string identity_of(const fs::path& program) {
  std::ifstream in(program, std::ios::binary);
  std::string head(std::size_t{64} << 10, '\0');
  in.read(head.data(), std::streamsize(head.size()));
  head.resize(std::size_t(std::max<std::streamsize>(0, in.gcount())));
  static const std::string kOwner("\3\0\0\0GNU\0", 8);  // NT_GNU_BUILD_ID's, behind the two lengths
  constexpr std::size_t kIdBytes = 20;
  if (const std::size_t at = head.find(kOwner); at != std::string::npos)
    return content_hash(head.substr(at + kOwner.size(), kIdBytes));
  std::error_code ec;
  return program.string() + " " +
         std::to_string(fs::last_write_time(program, ec).time_since_epoch().count()) + " " +
         std::to_string(fs::file_size(program, ec));
}

/// Names of files that stay right when the job's home has moved.
class Names {
 public:
  explicit Names(const CompileJob& job) : home_(job.home) {}
  /// Of a path, or of a word with paths in it: "-I@/hal_dspic".
  std::string told(std::string text) const {
    if (home_.empty()) return text;
    for (std::size_t at = 0; (at = text.find(home_, at)) != std::string::npos;) {
      const std::size_t end = at + home_.size();
      if (end == text.size() || text[end] == '/')
        text.replace(at, home_.size(), kHome);
      else
        at = end;
    }
    return text;
  }
  std::string here(const std::string& told) const {
    return told.rfind(kHome, 0) == 0 ? home_ + told.substr(1) : told;
  }

 private:
  static constexpr const char* kHome = "@";
  std::string home_;
};

/// What a compilation leaves, by the name without its kind.
struct Files {
  explicit Files(std::string base) : base_(std::move(base)) {}
  fs::path object() const { return base_ + ".o"; }
  fs::path messages() const { return base_ + ".txt"; }
  fs::path facts() const { return base_ + ".facts"; }

 private:
  std::string base_;
};
std::string name_of(const std::string& object, const std::string& messages, const std::string& facts) {
  return content_hash(content_hash(object) + content_hash(messages) + content_hash(facts));
}

/// Takes what an earlier build left at `base`, if it would come out the same.
bool recall(const std::string& base, const CompileJob& job, BuildInputs& inputs, CompileOutcome& outcome) {
  std::ifstream in(base + ".deps");
  const Names names(job);
  std::string name, hash, path;
  if (!std::getline(in, name)) return false;
  bool any = false;
  while (std::getline(in, hash, '\t') && std::getline(in, path)) {
    any = true;
    if (inputs.look_at(names.here(path)) != hash) return false;
  }
  const Files files(base + "." + name);
  std::string messages = bytes_of(files.messages());
  std::string facts = job.has_facts ? bytes_of(files.facts()) : "";
  if (!any || name_of(bytes_of(files.object()), messages, facts) != name) return false;
  outcome.ok = outcome.reused = true;
  outcome.object = files.object();
  inputs.take(outcome.object);
  outcome.messages = std::move(messages);
  outcome.facts = std::move(facts);
  return true;
}

CompileOutcome compile(const CompileJob& job, const fs::path& compiler, const std::string& salt,
                       const ObjectFolders& folders, BuildInputs& inputs) {
  CompileOutcome outcome;
  outcome.source = job.source;
  const Names names(job);
  std::string key = names.told(job.source.string()) + "\n" + job.salt + "\n" + salt;
  // debug information and messages name the files as the compiler was given them: whole names from the top folder,
  // so that none is relative to where this runs
  const std::string folder = job.source.is_relative() ? fs::current_path().string() : "/";
  key += "\n" + folder;
  for (const auto& f : job.flags) key += "\n" + names.told(f);
  const std::string stem = job.source.stem().string() + "-" + content_hash(key);
  if (!folders.ready.empty() && recall((folders.ready / stem).string(), job, inputs, outcome)) return outcome;
  const std::string base = (folders.cache / stem).string();
  if (recall(base, job, inputs, outcome)) {
    for (const fs::path& used : {fs::path(base + ".deps"), outcome.object}) places::note_used(used);
    return outcome;
  }
  const std::string half = unfinished(base).string();
  std::vector<std::string> argv = {compiler.string(), "-c",       job.source.string(), "-o", half,
                                   "--depfile",       half + ".d"};
  argv.insert(argv.end(), job.flags.begin(), job.flags.end());
  if (job.has_facts) argv.insert(argv.end(), {"--facts", half + ".facts"});
  argv.push_back("-fdebug-compilation-dir=" + folder);
  if (!job.home.empty()) argv.push_back("-ffile-prefix-map=" + job.home + "=" + job.called);
  const int64_t began_ns = now_ns();
  std::error_code ec;
  fs::create_directories(folders.cache, ec);  // somebody may have removed it since
  auto result = run_process(argv);
  outcome.messages = result.output;
  outcome.ok = result.status == 0;
  if (outcome.ok) {
    if (job.has_facts) outcome.facts = bytes_of(half + ".facts");
    const std::string name = name_of(bytes_of(half), outcome.messages, outcome.facts);
    std::string lines = name + "\n";
    for (const auto& read : names_of_rule(bytes_of(half + ".d")))
      lines += inputs.look_at(read, began_ns) + "\t" + names.told(read) + "\n";
    std::istringstream missing(bytes_of(half + ".d.missing"));
    for (std::string path; std::getline(missing, path);)
      if (job.listed_below.empty() || path.rfind(job.listed_below, 0) != 0)
        lines += inputs.look_at(path, began_ns) + "\t" + names.told(path) + "\n";
    const Files files(base + "." + name);
    outcome.object = files.object();
    inputs.take(outcome.object);
    const bool has_texts = (outcome.messages.empty() || write_text(files.messages(), outcome.messages)) &&
                           (!job.has_facts || write_text(files.facts(), outcome.facts));
    errno = 0;
    fs::rename(half, outcome.object, ec);
    if (ec || !has_texts || !write_text(base + ".deps", lines)) {
      outcome.ok = false;
      const int why = ec ? ec.value() : errno ? errno : ENOSPC;
      outcome.messages += outcome.object.string() + ": output: got " + std::strerror(why) +
                          ", expected a file that can be written\n";
    }
  } else if (result.status != 1) {
    outcome.messages +=
        job.source.string() + ": " +
        (result.status > kBySignal ? crash_words(result.status - kBySignal)
                                   : "the compiler stopped with status " + std::to_string(result.status)) +
        "\n";
  }
  for (const char* kind : {"", ".d", ".facts", ".d.missing"}) fs::remove(half + kind, ec);
  return outcome;
}

}  // namespace

std::vector<CompileOutcome> compile_all(const std::vector<CompileJob>& jobs, const fs::path& compiler,
                                        const ObjectFolders& folders, int parallel) {
  const std::string salt = identity_of(compiler);  // a rebuilt compiler invalidates everything
  look_at(compiler);
  std::vector<CompileOutcome> outcomes(jobs.size());
  BuildInputs& inputs = *inputs_of_build();
  std::atomic<size_t> next{0};
  auto work = [&] {
    for (size_t i; (i = next++) < jobs.size();)
      outcomes[i] = compile(jobs[i], compiler, salt, folders, inputs);
  };
  std::vector<std::thread> others;
  for (int t = 1; t < parallel && size_t(t) < jobs.size(); ++t) others.emplace_back(work);
  work();
  for (auto& t : others) t.join();
  return outcomes;
}

}  // namespace cc
