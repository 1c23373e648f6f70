// SPDX-License-Identifier: MIT
// The standard library's regular expressions follow a text by recursion, some 400 bytes of stack for each
// character of a long comment. A build therefore runs on a stack of its own that is large enough for the
// longest file it takes; the machine gives memory only to what is used of it.
#pragma once
#include <pthread.h>

#include <cstddef>
#include <exception>

namespace cc {

inline constexpr std::size_t kLargeStackBytes = std::size_t{2} << 30;
inline constexpr std::size_t kMostSources = 2000;  // of a project: ten times the largest, and a minute's work
inline constexpr std::size_t kLongestSourceBytes = std::size_t{2} << 20;

/// Calls `work` on a large stack and waits for it; where there is none, on the usual one.
template <typename Work>
auto on_large_stack(const Work& work) -> decltype(work()) {
  struct Task {
    const Work& work;
    decltype(work()) result{};
    std::exception_ptr thrown{};
  } task{work};
  const auto run = [](void* data) -> void* {
    auto& t = *static_cast<Task*>(data);
    try {
      t.result = t.work();
    } catch (...) {
      t.thrown = std::current_exception();
    }
    return nullptr;
  };
  pthread_attr_t attributes;
  pthread_t thread;
  pthread_attr_init(&attributes);
  const bool started = pthread_attr_setstacksize(&attributes, kLargeStackBytes) == 0 &&
                       pthread_create(&thread, &attributes, run, &task) == 0;
  pthread_attr_destroy(&attributes);
  if (!started) return work();
  pthread_join(thread, nullptr);
  if (task.thrown) std::rethrow_exception(task.thrown);
  return task.result;
}

}  // namespace cc
