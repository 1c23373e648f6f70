// SPDX-License-Identifier: MIT
#include "hal_sim/twin/coverage_run.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "hal_sim/chip/chip_runner.h"
#include "hal_sim/chip/coverage.h"
#include "install/places.h"
#include "sim_core/base/input_file.h"

namespace twin {

namespace {

constexpr std::size_t kLongestCoverage = 256u << 20;  // bytes

/// Not the library's, nor what serves it.
bool is_own_source(const std::string& path) {
  const std::string root = places::share_root().string() + "/";
  if (path.empty() || path.compare(0, root.size(), root) != 0) return path.find('/') != std::string::npos;
  for (const char* room : {"hal_dspic/", "hal_sim/", "compiler/", "firmware/library/", "firmware/include/",
                           "firmware/webots/", "firmware/libc/"})
    if (path.compare(root.size(), std::strlen(room), room) == 0) return false;
  return true;
}

std::string not_addable(const std::string& file, const std::string& error) {
  return file + ": --coverage: " + error + "; remove the file, or give another one, to count anew";
}

/// A device or a pipe is written to, and holds nothing.
bool is_regular(const std::string& file) {
  struct stat info;
  return ::stat(file.c_str(), &info) == 0 && S_ISREG(info.st_mode);
}

/// The counts that the file holds so far; none if there is no such file.
bool read_counts(const std::string& file, chip::Lcov& counts, std::vector<std::string>& problems) {
  std::string text, error;
  if (!is_regular(file)) return true;
  if (const std::string wrong = sim::read_input_file(file, kLongestCoverage, text); !wrong.empty())
    problems.push_back(file + ": --coverage: " + wrong);
  else if (!counts.read(text, error))
    problems.push_back(not_addable(file, error));
  else
    return true;
  return false;
}

/// In the place of what the file holds.
bool write_whole(int file, const std::string& text) {
  if (::lseek(file, 0, SEEK_SET) == 0 && ::ftruncate(file, 0) != 0 && errno != EINVAL) return false;
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t wrote = ::write(file, text.data() + at, text.size() - at);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) return false;
    at += static_cast<std::size_t>(wrote);
  }
  return true;
}

}  // namespace

struct CoverageRun::Counted {
  explicit Counted(chip::ChipRunner& runner)
      : image(runner.image()), counts(runner.image()->file()), watched(&runner) {}
  const std::shared_ptr<const chip::ChipImage> image;
  chip::StepCounts counts;
  chip::ChipRunner* watched;
};

CoverageRun::CoverageRun(Twin& twin, std::string file) : twin_(twin), file_(std::move(file)) {}

std::unique_ptr<CoverageRun> CoverageRun::open(Twin& twin, const std::string& file,
                                               std::vector<std::string>& problems) {
  std::unique_ptr<CoverageRun> run(new CoverageRun(twin, file));
  run->look();
  if (run->counted_.empty()) {
    problems.push_back(
        "command line: --coverage: got no robot that runs code of the chip, expected one; programs "
        "for Webots do with --hal sim");
    return nullptr;
  }
  // what cannot be added is said before the run
  chip::Lcov known;
  if (!read_counts(file, known, problems)) return nullptr;
  std::string error;
  for (const auto& counted : run->counted_) {
    if (known.add(chip::coverage_of(counted->image->file(), nullptr, is_own_source), error)) continue;
    problems.push_back(not_addable(file, error));
    return nullptr;
  }
  return run;
}

CoverageRun::~CoverageRun() {
  for (const auto& [robot, counted] : now_)
    if (counted && twin_.mind(robot).runner() == counted->watched)
      counted->watched->watch_steps(&counted->counts, false);
}

void CoverageRun::look() {
  for (int robot = 0; robot < twin_.robots(); ++robot) {
    auto* const runner = dynamic_cast<chip::ChipRunner*>(twin_.mind(robot).runner());
    Counted*& counted = now_[robot];
    if (!runner) continue;
    // another image may have been flashed, or the same one into another runner
    if (!counted || counted->watched != runner || counted->image != runner->image()) {
      counted_.push_back(std::make_unique<Counted>(*runner));
      counted = counted_.back().get();
    }
    runner->watch_steps(&counted->counts, true);
  }
}

void CoverageRun::finish(std::vector<std::string>& problems) {
  chip::Lcov all;
  std::string error;
  for (const auto& counted : counted_)
    all.add(chip::coverage_of(counted->image->file(), &counted->counts, is_own_source), error);
  // another process that does the same waits here
  const int file = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  chip::Lcov sum;
  if (file >= 0 && ::flock(file, LOCK_EX) == 0 && read_counts(file_, sum, problems)) {
    const std::string before = sum.text();
    if (!sum.add(all, error)) {
      problems.push_back(not_addable(file_, error));
    } else if (!write_whole(file, sum.text())) {
      problems.push_back(file_ + ": --coverage: cannot be written: " + std::strerror(errno));
      // on a full disk there is room for what was there
      if (is_regular(file_)) write_whole(file, before);
    }
  } else if (problems.empty()) {
    problems.push_back(file_ + ": --coverage: cannot be written: " + std::strerror(errno));
  }
  if (file >= 0) ::close(file);
}

}  // namespace twin
