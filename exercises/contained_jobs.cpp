// SPDX-License-Identifier: MIT
#include "exercises/contained_jobs.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <vector>

#include "compiler/cache/child_process.h"

namespace lab {

namespace {

constexpr std::size_t kMostErrors = 64u << 10;  // bytes of standard error that are kept
constexpr std::size_t kMostResult = 64u << 20;  // bytes of a result; more is no result
constexpr long kLook_ms = 100;                  // between two looks whether it is over

using JobClock = std::chrono::steady_clock;

struct Job {
  std::size_t index = 0;
  pid_t pid = 0;
  int result_end = -1, error_end = -1;
  JobClock::time_point until;
  bool timed_out = false;
  JobEnd end;
  std::unique_ptr<cc::ChildGroup> group;
};

[[noreturn]] void be_child(const std::function<std::string(std::size_t)>& work, std::size_t index, int result,
                           int error) {
  const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
  dup2(nothing, STDIN_FILENO);
  dup2(nothing, STDOUT_FILENO);
  dup2(error, STDERR_FILENO);
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
  int code = EXIT_SUCCESS;
  try {
    const std::string text = work(index);
    for (std::size_t at = 0; at < text.size();) {
      const ssize_t n = write(result, text.data() + at, text.size() - at);
      if (n <= 0) _exit(EXIT_FAILURE);
      at += static_cast<std::size_t>(n);
    }
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    code = EXIT_FAILURE;
  }
  std::fflush(nullptr);
  _exit(code);
}

std::unique_ptr<Job> begin_job(std::size_t index, double limit_s,
                               const std::function<std::string(std::size_t)>& work) {
  int result[2], error[2];
  if (pipe2(result, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  if (pipe2(error, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  std::fflush(nullptr);  // what is buffered here is not the child's to write
  const pid_t parent = getpid(), pid = fork();
  if (pid < 0) throw std::runtime_error("no process");
  if (pid == 0) {
    cc::lead_child_group(parent);
    be_child(work, index, result[1], error[1]);
  }
  setpgid(pid, pid);  // whoever of the two is first
  close(result[1]);
  close(error[1]);
  auto job = std::make_unique<Job>();
  job->index = index;
  job->pid = pid;
  job->result_end = result[0];
  job->error_end = error[0];
  job->until = JobClock::now() + std::chrono::milliseconds(static_cast<long>(1000 * limit_s));
  job->group = std::make_unique<cc::ChildGroup>(pid);
  return job;
}

/// Takes what has come; false: nothing more will.
bool take(int end, std::string& text, std::size_t most, bool keep_the_last) {
  char bytes[65536];
  const ssize_t n = read(end, bytes, sizeof bytes);
  if (n < 0) return errno == EINTR || errno == EAGAIN;
  if (n == 0) return false;
  text.append(bytes, static_cast<std::size_t>(n));
  if (text.size() > most && keep_the_last) text.erase(0, text.size() - most);
  return text.size() <= most;
}

/// The child has closed its ends, or was ended.
void finish_job(Job& job) {
  kill(-job.pid, SIGKILL);  // what it started goes with it
  job.group.reset();        // what is waited for has no number any more
  int status = 0;
  while (waitpid(job.pid, &status, 0) < 0 && errno == EINTR) {
  }
  for (const int end : {job.result_end, job.error_end})
    if (end >= 0) close(end);
  if (job.timed_out)
    job.end.how = JobEnd::How::TimedOut;
  else if (WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS)
    job.end.how = JobEnd::How::Done;
  else
    job.end.why = WIFSIGNALED(status) ? "ended by signal " + std::to_string(WTERMSIG(status))
                                      : "ended with " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

void run_contained(std::size_t count, int at_once, double limit_s, const std::function<bool()>& is_over,
                   const std::function<std::string(std::size_t)>& work,
                   const std::function<void(std::size_t, const JobEnd&)>& done) {
  std::vector<std::unique_ptr<Job>> running;
  for (std::size_t next = 0; next < count || !running.empty();) {
    if (is_over()) {
      for (const auto& job : running) finish_job(*job);
      return;
    }
    while (next < count && running.size() < static_cast<std::size_t>(std::max(1, at_once)))
      running.push_back(begin_job(next++, limit_s, work));
    std::vector<pollfd> ends;
    JobClock::time_point first = running.front()->until;
    for (const auto& job : running) {
      ends.push_back({job->result_end, POLLIN, 0});
      ends.push_back({job->error_end, POLLIN, 0});
      first = std::min(first, job->until);
    }
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(first - JobClock::now()).count();
    poll(ends.data(), ends.size(), static_cast<int>(std::clamp<long>(left + 1, 0, kLook_ms)));
    for (std::size_t i = 0; i < running.size(); ++i) {
      Job& job = *running[i];
      const auto look = [&](int& end, short events, std::string& text, std::size_t most, bool last) {
        if (end < 0 || events == 0 || take(end, text, most, last)) return;
        close(end);
        end = -1;
      };
      look(job.result_end, ends[2 * i].revents, job.end.result, kMostResult, false);
      look(job.error_end, ends[2 * i + 1].revents, job.end.errors, kMostErrors, true);
      // children of its own may hold the pipe for its errors
      job.timed_out = job.result_end >= 0 && JobClock::now() >= job.until;
    }
    for (auto it = running.begin(); it != running.end();) {
      if ((*it)->result_end >= 0 && !(*it)->timed_out) {
        ++it;
        continue;
      }
      const std::unique_ptr<Job> job = std::move(*it);
      it = running.erase(it);
      if (job->result_end < 0) {
        // it has written all, and exits
        siginfo_t info;
        waitid(P_PID, static_cast<id_t>(job->pid), &info, WEXITED | WNOWAIT);
        for (char bytes[4096]; job->error_end >= 0;) {
          pollfd end{job->error_end, POLLIN, 0};
          if (poll(&end, 1, 0) <= 0) break;
          const ssize_t n = read(job->error_end, bytes, sizeof bytes);
          if (n <= 0) break;
          job->end.errors.append(bytes, static_cast<std::size_t>(n));
        }
      }
      finish_job(*job);
      if (!is_over()) done(job->index, job->end);  // who ends it all may have ended this one
    }
  }
}

}  // namespace lab
