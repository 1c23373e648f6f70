// SPDX-License-Identifier: MIT
#include "tools/run_guard.h"

#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <ctime>
#include <mutex>
#include <string>
#include <thread>

#include "compiler/cache/child_process.h"
#include "sim_core/base/check.h"
#include "tools/verbs.h"

namespace tools {

namespace {

// for a tick or two, and the supervisors' last go: of the processor's time, since a busy PC gives little of
// it, and at most so long for who waits for something else
constexpr double kGraceCpu_s = 0.3, kGrace_s = 2, kLook_s = 0.05;
constexpr double kRescue_s = 0.6;       // for stopping the threads and writing what is left
constexpr long long kOneWish_ms = 100;  // timeout(1) signals a process and its group: that is no second wish

std::atomic<int> asked{0};   // exit code
std::atomic<int> wishes{0};  // so far
std::atomic<long long> wished_ms{0};
sem_t news;  // posted by wishes, limits and scopes

std::mutex changing;  // what follows
std::function<void()> rescue;
bool is_graceful = false, is_finishing = false;
double limit_s = 0;  // --host-limit; 0 none
timespec limit_at{};

timespec after(double seconds) {
  timespec at;
  clock_gettime(CLOCK_MONOTONIC, &at);
  const double whole = std::floor(seconds);
  at.tv_sec += static_cast<time_t>(whole);
  at.tv_nsec += static_cast<long>((seconds - whole) * 1e9);
  if (at.tv_nsec >= 1'000'000'000) {
    at.tv_nsec -= 1'000'000'000;
    ++at.tv_sec;
  }
  return at;
}

bool has_passed(const timespec& at) {
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec > at.tv_sec || (now.tv_sec == at.tv_sec && now.tv_nsec >= at.tv_nsec);
}

/// Until news come or `at` has passed.
void wait_for_news(const timespec* at) {
  while ((at ? sem_clockwait(&news, CLOCK_MONOTONIC, at) : sem_wait(&news)) != 0 && errno == EINTR) {
  }
}

double process_cpu_s() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void tell(const char* text) {
  const ssize_t written = write(STDERR_FILENO, text, std::strlen(text));
  (void)written;
}

std::string limit_text() {
  std::string text = std::to_string(limit_s);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text;
}

[[noreturn]] void end_hard() {
  const int code = asked.load();
  // nothing of the following may last: the last word has the alarm
  signal(SIGALRM, [](int) {
    tell("twinpuck: ended without writing what was left of the outputs\n");
    _exit(asked.load());
  });
  sigset_t alarm_only;
  sigemptyset(&alarm_only);
  sigaddset(&alarm_only, SIGALRM);
  pthread_sigmask(SIG_UNBLOCK, &alarm_only, nullptr);
  timer_t timer;
  sigevent event{};
  event.sigev_notify = SIGEV_SIGNAL;
  event.sigev_signo = SIGALRM;
  itimerspec when{};
  when.it_value.tv_nsec = static_cast<long>(kRescue_s * 1e9);
  if (timer_create(CLOCK_MONOTONIC, &event, &timer) != 0 || timer_settime(timer, 0, &when, nullptr) != 0)
    _exit(code);
  std::function<void()> write_rest;
  bool was_graceful;
  {
    std::lock_guard<std::mutex> lock(changing);
    was_graceful = is_graceful && !is_finishing;
    write_rest = rescue;
  }
  std::string text = "\ntwinpuck: ";
  text += code == kHostTime
              ? "host time: got more than " + limit_text() + " s, expected at most " + limit_text() + " s"
              : "interrupted";
  if (was_graceful) text += "; the simulator did not come back from a step; recordings hold what was written";
  tell((text + '\n').c_str());
  if (was_graceful && write_rest) write_rest();
  _exit(code);
}

void watch() {
  for (;;) {
    bool graceful, finishing, limited;
    timespec at;
    {
      std::lock_guard<std::mutex> lock(changing);
      graceful = is_graceful;
      finishing = is_finishing;
      limited = limit_s > 0;
      at = limit_at;
    }
    if (asked == 0 && limited && has_passed(at)) asked = kHostTime;
    if (asked == 0) {
      wait_for_news(limited ? &at : nullptr);
      continue;
    }
    cc::end_children();
    if (!graceful || wishes > 1) end_hard();
    if (finishing) {
      wait_for_news(nullptr);
      continue;
    }
    static const timespec grace = after(kGrace_s);
    static const double cpu_before_s = process_cpu_s();
    if (!has_passed(grace) && process_cpu_s() - cpu_before_s <= kGraceCpu_s) {
      const timespec next = after(kLook_s);
      wait_for_news(&next);
      continue;
    }
    {
      std::lock_guard<std::mutex> lock(changing);
      if (is_finishing) continue;  // it came back meanwhile
    }
    end_hard();
  }
}

void on_signal(int) { ask_for_end(); }

}  // namespace

long long steady_ms() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1000LL + now.tv_nsec / 1'000'000;
}

void ask_for_end() {
  const int before = errno;
  int none = 0;
  asked.compare_exchange_strong(none, kInterrupted);
  const long long now_ms = steady_ms();
  if (now_ms - wished_ms.exchange(now_ms) > kOneWish_ms) ++wishes;
  sem_post(&news);
  errno = before;
}

void guard_process() {
  CHECK(sem_init(&news, 0, 0) == 0, "cannot make a semaphore");
  // the guard's thread takes no signals, so that they come to where they always came
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread(watch).detach();
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART | SA_ONSTACK;
  sigemptyset(&action.sa_mask);
  // SIGQUIT is somebody's Ctrl-\, too; who wants a core file has SIGABRT
  for (int s : {SIGINT, SIGTERM, SIGQUIT}) sigaction(s, &action, nullptr);
  // nohup(1) has the end of the terminal ignored
  struct sigaction inherited {};
  if (sigaction(SIGHUP, nullptr, &inherited) == 0 && inherited.sa_handler != SIG_IGN)
    sigaction(SIGHUP, &action, nullptr);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);  // what came meanwhile is handled
}

int end_asked() { return asked.load(std::memory_order_relaxed); }

void limit_host_time(double seconds) {
  if (seconds <= 0) return;
  std::lock_guard<std::mutex> lock(changing);
  limit_s = seconds;
  limit_at = after(std::min(seconds, 1e9));
  sem_post(&news);
}

GracefulEnd::GracefulEnd(std::function<void()> write_rest) {
  std::lock_guard<std::mutex> lock(changing);
  rescue = std::move(write_rest);
  is_graceful = true;
  is_finishing = false;
}

GracefulEnd::~GracefulEnd() {
  std::lock_guard<std::mutex> lock(changing);
  rescue = nullptr;
  // whoever was asked to end has done so and returns: what it said is yet to be written
  is_graceful = is_finishing = asked.load() != 0;
  limit_s = 0;
}

void GracefulEnd::finishing() {
  std::lock_guard<std::mutex> lock(changing);
  is_finishing = true;
}

}  // namespace tools
