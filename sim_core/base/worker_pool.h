// SPDX-License-Identifier: MIT
// A few threads that do the same job, each on its own share, and wait for one another.
#pragma once
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace sim {

class WorkerPool {
 public:
  /// `size` shares; the caller's thread does share 0 itself.
  explicit WorkerPool(int size);
  ~WorkerPool();
  int size() const { return static_cast<int>(threads_.size()) + 1; }
  /// Runs job(0) .. job(size - 1) side by side and returns when all are done.
  void run(const std::function<void(std::size_t)>& job);

 private:
  void serve(std::size_t share);

  std::mutex mutex_;
  std::condition_variable start_, done_;
  const std::function<void(std::size_t)>* job_ = nullptr;
  std::size_t round_ = 0;
  std::size_t busy_ = 0;
  bool quit_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace sim
