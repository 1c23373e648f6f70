// SPDX-License-Identifier: MIT
// Runs of the shipped command whose programs are watched: a mark in the environment, which whatever they
// start inherits, finds their processes.
#pragma once
#include <dirent.h>
#include <signal.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "tests/cli/command.h"

namespace programs_test {

namespace fs = std::filesystem;
using cli_test::Said;

/// Processes whose first environment holds `mark`, and `also` if it is not empty.
inline std::vector<pid_t> processes_with(const std::string& mark, const std::string& also = "") {
  std::vector<pid_t> found;
  DIR* all = opendir("/proc");
  while (const dirent* entry = readdir(all)) {
    const long pid = std::strtol(entry->d_name, nullptr, 10);
    if (pid <= 0) continue;
    std::ifstream in("/proc/" + std::string(entry->d_name) + "/environ", std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    if (text.find(mark) != std::string::npos && text.find(also) != std::string::npos)
      found.push_back(static_cast<pid_t>(pid));
  }
  closedir(all);
  return found;
}
/// Those whose link is the one that the simulator gave them.
inline std::vector<pid_t> programs_with(const std::string& mark) {
  return processes_with(mark, "TWINPUCK_CONTROLLER=fd:");
}

/// Waits up to `seconds`; false: it has not come about.
template <typename Holds>
bool wait_until(Holds holds, double seconds) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!holds()) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

class WatchedRuns : public cli_test::CommandTest {
 protected:
  WatchedRuns() : mark("TWINPUCK_TEST_MARK=" + folder.filename().string()) {}
  ~WatchedRuns() override {
    for (const pid_t pid : processes_with(mark)) kill(pid, SIGKILL);  // of a test that failed
  }

  /// A program's folder: files and their texts; the first is named as the folder.
  std::string program(const std::string& name, const std::string& ending, const std::string& source) const {
    write(name + "/" + name + "." + ending, source);
    return path(name);
  }
  /// A world of robots a metre apart that run these programs.
  std::string world(const std::vector<std::pair<std::string, std::string>>& robots,
                    const std::string& more = "") const {
    std::string text = "twinpuck = 1\ntitle = \"programs\"\n" + more;
    for (std::size_t i = 0; i < robots.size(); ++i)
      text += "\n[[robot]]\nname = \"" + robots[i].first + "\"\nfirmware = \"" + robots[i].second +
              "\"\nposition = [0, " + std::to_string(i) + "]\n";
    return write("w.toml", text);
  }
  Said run(const std::string& arguments, const std::string& before = "") const {
    return cli_test::twinpuck("run " + path("w.toml") + " " + arguments, before + " env '" + mark + "'");
  }
  /// No process of the run is there any more; the kernel may take a moment.
  void expect_nothing_left(const std::string& what) const {
    EXPECT_TRUE(wait_until([&] { return processes_with(mark).empty(); }, 0.5))
        << what << ": a process goes on";
  }
  /// Every row has all columns, the last one ends, and they go on up to this time at least.
  void expect_whole(const std::string& file, double seconds, const std::string& what) const {
    const std::string text = read(file);
    ASSERT_FALSE(text.empty()) << what << ": no record";
    EXPECT_EQ(text.back(), '\n') << what << ": the last row is cut";
    const auto columns = [](const std::string& row) { return std::count(row.begin(), row.end(), ','); };
    std::istringstream rows(text);
    std::string row, head;
    while (std::getline(rows, head) && !head.empty() && head[0] == '#') continue;
    double last = -1;
    while (std::getline(rows, row)) {
      EXPECT_EQ(columns(row), columns(head)) << what << ": " << row;
      last = std::atof(row.c_str());
    }
    EXPECT_GE(last, seconds) << what << ": the record ends too early";
  }

  const std::string mark;
};

}  // namespace programs_test
