// SPDX-License-Identifier: MIT
// See fake_host.h. Leaving the firmware is a longjmp: nothing of the image needs destruction.
#include "fake_host.h"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <csetjmp>
#include <fstream>

namespace fake {

uint16_t registers[0x800];
long long event_interval = 0;

namespace {
std::jmp_buf leave;
Run* current;
const tp_image* running;
int last_poll;
const std::function<void(int)>* poll_hook;
constexpr long long kBudget = 1000000000000;

[[noreturn]] void stop(const std::string& end) {
  current->end = end;
  std::longjmp(leave, 1);
}
}  // namespace

Folder::Folder() {
  static std::atomic<int> count{0};
  path = std::filesystem::temp_directory_path() /
         ("twinpuck_cc_" + std::to_string(getpid()) + "_" + std::to_string(count++));
  std::filesystem::create_directories(path);
}
Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path, ignored);
}
std::filesystem::path Folder::file(const std::string& name, const std::string& text) const {
  auto where = path / name;
  std::filesystem::create_directories(where.parent_path());
  std::ofstream(where) << text;
  return where;
}

Image::Image(const std::filesystem::path& file) {
  handle_ = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle_) {
    error = dlerror();
    return;
  }
  image_ = static_cast<const tp_image*>(dlsym(handle_, "tp_image"));
}
Image::~Image() {
  if (handle_) dlclose(handle_);
}
void* Image::symbol(const char* name) const { return dlsym(handle_, name); }

Run Image::run(int stop_at_poll, const std::function<void(int)>& on_poll) {
  static Run run;
  run = Run();
  current = &run;
  running = image_;
  last_poll = stop_at_poll;
  poll_hook = &on_poll;
  const long long start = event_interval ? event_interval : kBudget;
  image_->control->budget = start;
  if (setjmp(leave) == 0) {
    image_->start();
    run.end = "return";
  }
  run.cycles += start - image_->control->budget;
  return run;
}

cc::BuildResult build(const Folder& folder, const std::string& main_c, const std::string& level,
                      const std::function<void(cc::BuildOptions&)>& change) {
  folder.file("prog/main.c", main_c);
  cc::BuildOptions options;
  options.source_dir = folder.path / "prog";
  options.output = folder.path / "prog.so";
  options.optimisation = level;
  if (change) change(options);
  return cc::build_image(options);
}

std::string text_of(const cc::BuildResult& result) {
  std::string all;
  for (const auto& e : result.errors) all += e + "\n";
  for (const auto& w : result.warnings) all += w + "\n";
  return all;
}

Run run_c(const std::string& main_c, const std::string& level, int stop_at_poll) {
  Folder folder;
  auto result = build(folder, main_c, level);
  EXPECT_TRUE(result.ok) << text_of(result);
  if (!result.ok) return Run();
  Image image(folder.path / "prog.so");
  EXPECT_EQ(image.error, "");
  if (!image.error.empty()) return Run();
  return image.run(stop_at_poll);
}

}  // namespace fake

using fake::current;

#define EXPORT extern "C" __attribute__((visibility("default"), used))
EXPORT void tp_event() {
  ++current->events;
  long long& budget = fake::running->control->budget;
  if (-budget > current->latest) current->latest = -budget;
  const long long more = fake::event_interval ? fake::event_interval - budget : 1000000000;
  budget += more;
  current->cycles += more;
}
EXPORT void tp_poll(tp_i64) {
  ++current->polls;
  if (*fake::poll_hook) (*fake::poll_hook)(current->polls);
  if (current->polls >= fake::last_poll) fake::stop("poll");
}
EXPORT void tp_rest(tp_i64 loop) {
  ++current->rests;
  tp_poll(loop);
}
EXPORT void tp_delay(tp_i64 rounds, tp_i64 cycles) {
  current->delays.emplace_back(rounds, cycles);
  current->cycles += rounds * cycles;
}
EXPORT void tp_trap(tp_i64 kind) { fake::stop("trap " + std::to_string(kind)); }
EXPORT void tp_trap_message(tp_i64 kind, const char* message) {
  current->message = message;
  fake::stop("trap " + std::to_string(kind));
}
EXPORT void tp_reset() { fake::stop("reset"); }
EXPORT void tp_disi(tp_i64 cycles) { current->calls.push_back("disi " + std::to_string(cycles)); }
EXPORT void tp_power_save(tp_i64 mode) { current->calls.push_back(mode ? "idle" : "sleep"); }
EXPORT void tp_clear_watchdog() { current->calls.push_back("clrwdt"); }
EXPORT tp_i64 tp_sfr_read(tp_i64 address, tp_i64 bits) {
  long long value = fake::registers[(address & ~1) & 0x7ff];
  if (bits == 8) value = value >> ((address & 1) * 8) & 0xff;
  current->accesses.push_back({address, value, bits, false});
  return value;
}
EXPORT void tp_sfr_write(tp_i64 address, tp_i64 value, tp_i64 bits) {
  current->accesses.push_back({address, value, bits, true});
  if (bits == 16) fake::registers[address & 0x7ff] = uint16_t(value);
}
EXPORT void tp_sfr_modify(tp_i64 address, tp_i64 keep, tp_i64 flip) {
  ++current->modified;
  tp_sfr_write(address, (tp_sfr_read(address, 16) & keep) ^ flip, 16);
}
EXPORT tp_i64 tp_rand() { return 1234; }
EXPORT void tp_srand(tp_i64 seed) { current->calls.push_back("srand " + std::to_string(seed)); }
EXPORT void tp_console(const char* bytes, tp_i64 length, tp_i64) {
  current->console.append(bytes, size_t(length));
}
EXPORT void tp_spend(tp_i64 cycles) { current->cycles += cycles; }
