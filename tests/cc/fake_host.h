// SPDX-License-Identifier: MIT
// A host without a robot: gives images the tp_* functions, counts what they do, ends a run at a trap, a
// reset, a return from main or after some polls.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "hal_sim/cc/build.h"
#include "hal_sim/host/image_abi.h"

namespace fake {

struct Access {
  long long address, value, bits;
  bool is_write;
};

struct Run {
  std::string end;      // "return", "trap 1", "reset", "poll", "event"
  std::string message;  // of a trap
  std::string console;
  long long cycles = 0;  // charged to the budget, delays included
  int polls = 0, events = 0;
  int rests = 0;         // polls of endless loops without anything in them
  long long latest = 0;  // cycles by which the host got control too late, at worst
  std::vector<std::pair<long long, long long>> delays;
  std::vector<Access> accesses;
  int modified = 0;  // registers read, changed and written back by one call; both stand in `accesses`
  std::vector<std::string> calls;  // "disi 5", "clrwdt", "idle" ...
};

/// A folder below the system's temporary one, removed at the end.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  std::filesystem::path path;
  /// Writes a file; folders of `name` are made.
  std::filesystem::path file(const std::string& name, const std::string& text) const;
};

class Image {
 public:
  explicit Image(const std::filesystem::path& file);
  ~Image();
  const tp_image* operator->() const { return image_; }
  /// Runs main. stop_at_poll: the poll that ends the run. on_poll may change the image's data.
  Run run(int stop_at_poll = 1, const std::function<void(int poll)>& on_poll = {});
  /// A symbol of the image that has default visibility, else null.
  void* symbol(const char* name) const;
  std::string error;

 private:
  void* handle_ = nullptr;
  const tp_image* image_ = nullptr;
};

/// Register content for tp_sfr_read, 16-bit words by address.
extern uint16_t registers[0x800];

/// Cycles between two events; 0: no events in a usual run.
extern long long event_interval;

/// One main.c, compiled; messages in the result.
cc::BuildResult build(const Folder& folder, const std::string& main_c, const std::string& level = "-O1",
                      const std::function<void(cc::BuildOptions&)>& change = {});
/// Builds, expects success, runs.
Run run_c(const std::string& main_c, const std::string& level = "-O1", int stop_at_poll = 1);
/// All errors and warnings as one text.
std::string text_of(const cc::BuildResult& result);

}  // namespace fake
