// SPDX-License-Identifier: MIT
// See crash_words.h. The handler has a stack of its own and writes what was put together before: of a stack that
// has run out, nothing can be called.
#include "crash_words.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace cc {
namespace {

constexpr std::array kSignals = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT};
constexpr std::size_t kHandlersStack = std::size_t{64} << 10;
constexpr std::size_t kLongest = 4096;

/// Texts in which nothing moves when the handler reads them.
struct Told {
  std::array<std::string, kSignals.size()> words;
  std::array<char, kLongest> file{}, place{};
  std::array<char, kHandlersStack> stack{};
};
Told& told() {
  static Told all;
  return all;
}

void put(std::array<char, kLongest>& to, const std::string& text) {
  const std::size_t length = std::min(text.size(), to.size() - 1);
  std::memcpy(to.data(), text.data(), length);
  to[length] = 0;
}

void say(const char* text, std::size_t length) {
  if (write(STDERR_FILENO, text, length) < 0) _exit(2);
}

void end(int number) {
  const Told& all = told();
  const char* const where = all.place[0] ? all.place.data() : all.file.data();
  say(where, std::strlen(where));
  for (std::size_t i = 0; i < kSignals.size(); ++i)
    if (kSignals[i] == number) say(all.words[i].data(), all.words[i].size());
  _exit(1);
}

}  // namespace

std::string crash_words(int number) {
  return "compiler: got a program that it cannot take (signal " + std::to_string(number) + ", " +
         strsignal(number) +
         "), expected shorter, or less deeply nested, expressions and blocks; split the longest";
}

void tell_crashes(const std::string& file) {
  Told& all = told();
  put(all.file, file);
  for (std::size_t i = 0; i < kSignals.size(); ++i)
    all.words[i] = ": error: " + crash_words(kSignals[i]) + "\n";
  stack_t other{};
  other.ss_sp = all.stack.data();
  other.ss_size = all.stack.size();
  sigaltstack(&other, nullptr);
  struct sigaction action {};
  action.sa_handler = end;
  action.sa_flags = SA_ONSTACK | int(SA_RESETHAND);
  for (const int number : kSignals) sigaction(number, &action, nullptr);
}

void note_place(const std::string& place) { put(told().place, place); }

}  // namespace cc
