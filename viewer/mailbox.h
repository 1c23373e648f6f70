// SPDX-License-Identifier: MIT
// What clients say, from the server's threads to the one that has the world.
#pragma once
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>

#include "viewer/web_server.h"

namespace viewer {

class Mailbox {
 public:
  enum class Kind { Came, Said, Left };
  struct Message {
    ClientId client;
    Kind kind;
    std::string text;
  };

  void post(ClientId client, Kind kind, std::string text) {
    {
      std::lock_guard<std::mutex> lock(mutex_);
      messages_.push_back({client, kind, std::move(text)});
      has_news_ = true;
    }
    news_.notify_one();
  }
  /// Wakes who waits, now and from now on.
  void end() {
    ending_ = has_news_ = true;
    news_.notify_all();
  }
  bool is_ending() const { return ending_; }
  /// Cheap, by any thread.
  bool has_news() const { return has_news_; }
  std::deque<Message> take() {
    std::deque<Message> messages;
    std::lock_guard<std::mutex> lock(mutex_);
    messages.swap(messages_);
    has_news_ = ending_.load();
    return messages;
  }
  void wait(std::chrono::duration<double> at_most) {
    std::unique_lock<std::mutex> lock(mutex_);
    news_.wait_for(lock, at_most, [this] { return has_news_.load(); });
  }

 private:
  std::mutex mutex_;
  std::condition_variable news_;
  std::deque<Message> messages_;
  std::atomic<bool> has_news_{false}, ending_{false};
};

}  // namespace viewer
