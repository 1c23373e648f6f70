// SPDX-License-Identifier: MIT
#include "programs/process/partner.h"

#include <dirent.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <set>

extern char** environ;

namespace programs {

namespace {

constexpr int kSocketInProgram = 3;
constexpr rlim_t kMostDataBytes = rlim_t{8}
                                  << 30;  // of a program; NumPy's threads reserve much and use little
constexpr int kSocketBytes = 212992;      // Linux's usual limit [man 7 socket: wmem_max]

std::string error_text() { return std::strerror(errno); }

/// What a program gets beside its socket, in C's form; the strings outlive it.
struct CallWords {
  explicit CallWords(const std::vector<std::string>& words) {
    for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
    pointers.push_back(nullptr);
  }
  std::vector<char*> pointers;
};

std::string name_in(const std::string& assignment) { return assignment.substr(0, assignment.find('=') + 1); }

std::vector<std::string> merged_environment(const std::vector<std::string>& ours) {
  std::vector<std::string> all;
  for (char** e = environ; *e; ++e) {
    const std::string theirs = *e;
    bool replaced = name_in(theirs) == "TWINPUCK_CONTROLLER=";
    for (const std::string& own : ours) replaced = replaced || name_in(own) == name_in(theirs);
    if (!replaced) all.push_back(theirs);
  }
  all.insert(all.end(), ours.begin(), ours.end());
  all.push_back("TWINPUCK_CONTROLLER=fd:" + std::to_string(kSocketInProgram));
  return all;
}

/// The child's side of vfork(): system calls only, for its memory is the parent's. Returns when it cannot.
void become(const char* program, char* const* words, char* const* environment, const char* folder, int socket,
            int text, int nothing, pid_t parent, const sigset_t& before, int* why) {
  setsid();
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);  // it has ended meanwhile
  for (const int s : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
    signal(s, SIG_DFL);
  const rlimit data{kMostDataBytes, kMostDataBytes}, core{0, 0};
  setrlimit(RLIMIT_DATA, &data);
  setrlimit(RLIMIT_CORE, &core);
  // the socket may lie where its copy goes
  const int high = fcntl(socket, F_DUPFD, 64);
  if (chdir(folder) == 0 && high >= 0 && dup2(nothing, 0) >= 0 && dup2(text, 1) >= 0 && dup2(text, 2) >= 0 &&
      dup2(high, kSocketInProgram) >= 0) {
    syscall(SYS_close_range, kSocketInProgram + 1, ~0U, 0);
    sigprocmask(SIG_SETMASK, &before, nullptr);
    execvpe(program, words, environment);
  }
  *why = errno;
}

/// Orphans of programs become ours, so that they can be ended with them.
void adopt_orphans() {
  static std::once_flag once;
  std::call_once(once, [] { prctl(PR_SET_CHILD_SUBREAPER, 1); });
}

struct ProcessLine {
  pid_t pid = 0, parent = 0, session = 0;
};

/// All processes of the machine that can be seen.
std::vector<ProcessLine> all_processes() {
  std::vector<ProcessLine> all;
  DIR* folder = opendir("/proc");
  if (!folder) return all;
  while (const dirent* entry = readdir(folder)) {
    char* rest = nullptr;
    const long pid = std::strtol(entry->d_name, &rest, 10);
    if (pid <= 0 || *rest) continue;
    char text[512];
    const int file = open(("/proc/" + std::string(entry->d_name) + "/stat").c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) continue;
    const ssize_t n = read(file, text, sizeof text - 1);
    close(file);
    if (n <= 0) continue;
    text[n] = 0;
    // the name between brackets may hold anything
    const char* behind = std::strrchr(text, ')');
    char state;
    int parent, group, session;
    if (behind && std::sscanf(behind + 1, " %c %d %d %d", &state, &parent, &group, &session) == 4 &&
        state != 'Z')
      all.push_back({static_cast<pid_t>(pid), parent, session});
  }
  closedir(folder);
  return all;
}

/// Those of its session, and all that descend from them.
std::vector<pid_t> family_of(pid_t leader) {
  const std::vector<ProcessLine> all = all_processes();
  std::vector<pid_t> family{leader};
  for (const ProcessLine& p : all)
    if (p.session == leader && p.pid != leader) family.push_back(p.pid);
  for (std::size_t i = 0; i < family.size(); ++i)
    for (const ProcessLine& p : all)
      if (p.parent == family[i] && std::find(family.begin(), family.end(), p.pid) == family.end())
        family.push_back(p.pid);
  return family;
}

/// Programs that were started and not yet ended. What else is our child, in a session of its own, is an
/// orphan of theirs.
struct Leaders {
  std::mutex changing;
  std::set<pid_t> pids;
};
Leaders& leaders() {
  static Leaders all;
  return all;
}

/// Orphans in sessions of their own belong to nobody's family: they end with the last program.
void note_end(pid_t leader) {
  Leaders& all = leaders();
  const std::lock_guard<std::mutex> lock(all.changing);
  all.pids.erase(leader);
  if (!all.pids.empty()) return;
  constexpr int kRounds = 50;
  const pid_t we = getpid(), session = getsid(0);
  for (int round = 0; round < kRounds; ++round) {
    bool is_any = false;
    for (const ProcessLine& p : all_processes())
      if (p.parent == we && p.session != session) {
        is_any = true;
        // its children are ours in the next round
        ::kill(p.pid, SIGKILL);
        waitpid(p.pid, nullptr, 0);
      }
    if (!is_any) break;
  }
}

int remaining(const timespec& until) {
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  const long long ms = (until.tv_sec - now.tv_sec) * 1000LL + (until.tv_nsec - now.tv_nsec) / 1000000;
  return ms < 0 ? 0 : static_cast<int>(ms);
}

timespec in(int milliseconds) {
  timespec at;
  clock_gettime(CLOCK_MONOTONIC, &at);
  at.tv_sec += milliseconds / 1000;
  at.tv_nsec += milliseconds % 1000 * 1000000L;
  if (at.tv_nsec >= 1000000000) {
    at.tv_nsec -= 1000000000;
    ++at.tv_sec;
  }
  return at;
}

/// Where the sockets of this user's waiting robots lie; empty with `why` when that is no safe place.
std::string socket_folder(std::string& why) {
  const char* base = std::getenv("XDG_RUNTIME_DIR");
  std::string folder =
      std::string(base && *base == '/' ? base : "/tmp") + "/twinpuck-" + std::to_string(getuid());
  mkdir(folder.c_str(), 0700);
  struct stat is;
  if (lstat(folder.c_str(), &is) != 0 || !S_ISDIR(is.st_mode) || is.st_uid != getuid() ||
      (is.st_mode & 077)) {
    why = folder +
          ": got a folder that others may write or that is not yours, expected your own with mode 0700";
    return "";
  }
  return folder;
}

}  // namespace

std::string words_of(const ProcessEnd& end) {
  if (end.signal == 0) return "exit status " + std::to_string(end.status);
  return "signal " + std::to_string(end.signal) + " (" + strsignal(end.signal) + ")";
}

std::unique_ptr<Partner> Partner::start(const Start& start, std::string& why) {
  adopt_orphans();
  // A socket for the link, a pipe for what it prints, nothing to read.
  int sockets[2] = {-1, -1}, pipes[2] = {-1, -1};
  const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
  const bool have_sockets = socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, sockets) == 0;
  const bool have_all = nothing >= 0 && have_sockets && pipe2(pipes, O_CLOEXEC) == 0;
  int wrong = have_all ? 0 : errno;
  pid_t pid = -1;
  if (have_all) {
    const std::vector<std::string> environment = merged_environment(start.environment);
    std::vector<std::string> named = start.words;
    if (!start.name.empty()) named[0] = start.name;
    const CallWords words(named), assignments(environment);
    // vfork() shares our memory until the program begins, so no signal may come in between
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const pid_t parent = getpid();
    volatile int failed = 0;
    pid = vfork();
    if (pid == 0) {
      become(start.words[0].c_str(), words.pointers.data(), assignments.pointers.data(), start.folder.c_str(),
             sockets[1], pipes[1], nothing, parent, before, const_cast<int*>(&failed));
      _exit(127);
    }
    wrong = pid < 0 ? errno : failed;
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    if (pid > 0 && wrong != 0) {
      while (waitpid(pid, nullptr, 0) < 0 && errno == EINTR) continue;
      pid = -1;
    }
  }
  // The child has its ends, and ours are enough.
  for (const int fd : {nothing, sockets[1], pipes[1]})
    if (fd >= 0) close(fd);
  if (pid < 0) {
    for (const int fd : {sockets[0], pipes[0]})
      if (fd >= 0) close(fd);
    why = start.words[0] + ": cannot be started: " + std::strerror(wrong);
    return nullptr;
  }
  // Its group can be ended from now on, whatever happens here.
  {
    const std::lock_guard<std::mutex> lock(leaders().changing);
    leaders().pids.insert(pid);
  }
  std::unique_ptr<Partner> p(new Partner);
  p->socket_ = sockets[0];
  p->text_ = pipes[0];
  p->pid_ = pid;
  p->process_ = static_cast<int>(syscall(SYS_pidfd_open, pid, 0));
  fcntl(p->text_, F_SETFL, O_NONBLOCK);
  setsockopt(p->socket_, SOL_SOCKET, SO_SNDBUF, &kSocketBytes, sizeof kSocketBytes);
  return p;
}

std::unique_ptr<Partner> Partner::listen(const std::string& name, std::string& why) {
  const std::string folder = socket_folder(why);
  if (folder.empty()) return nullptr;
  std::string file = name;
  for (char& c : file)
    if (c == '/' || c <= ' ') c = '_';
  std::unique_ptr<Partner> p(new Partner);
  p->path_ = folder + "/" + std::to_string(getpid()) + "-" + file + ".sock";
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (p->path_.size() >= sizeof address.sun_path) {
    why = p->path_ + ": got a path of " + std::to_string(p->path_.size()) +
          " characters, expected fewer than 108";
    p->path_.clear();
    return nullptr;
  }
  std::memcpy(address.sun_path, p->path_.c_str(), p->path_.size());
  unlink(p->path_.c_str());
  p->listener_ = ::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
  if (p->listener_ < 0 || bind(p->listener_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 ||
      ::listen(p->listener_, 1) != 0) {
    why = p->path_ + ": cannot wait there: " + error_text();
    return nullptr;
  }
  return p;
}

Partner::~Partner() {
  kill();
  if (pid_ > 0) note_end(pid_);
  for (const int fd : {socket_, listener_, text_, process_})
    if (fd >= 0) close(fd);
  if (!path_.empty()) unlink(path_.c_str());
}

bool Partner::accept() {
  const int fd = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
  if (fd < 0) return false;
  ucred who{};
  socklen_t size = sizeof who;
  if (getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &who, &size) != 0 || who.uid != getuid()) {
    close(fd);
    return false;
  }
  socket_ = fd;
  setsockopt(socket_, SOL_SOCKET, SO_SNDBUF, &kSocketBytes, sizeof kSocketBytes);
  close(listener_);  // one program only; another finds nobody
  listener_ = -1;
  unlink(path_.c_str());
  return true;
}

void Partner::read_text() {
  char text[65536];
  // at most what a pipe holds: a program that prints without end is looked at again with the next packet
  if (text_ < 0) return;
  const ssize_t n = read(text_, text, sizeof text);
  if (n > 0) {
    if (on_text) on_text(text, static_cast<std::size_t>(n));
  } else if (n == 0) {
    close(text_);
    text_ = -1;
  }
}

/// Of what has come; Nothing: nothing has.
Partner::Got Partner::take_packet() {
  iovec part{buffer_.data(), LINK_MOST_BYTES};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  const ssize_t n = recvmsg(socket_, &message, MSG_DONTWAIT);
  if (n < 0 && (errno == EAGAIN || errno == EINTR)) return Got::Nothing;
  if (n <= 0) return Got::Gone;
  bytes_ = static_cast<std::size_t>(n);
  read_text();  // what it printed before
  return message.msg_flags & MSG_TRUNC ? Got::Too_long : Got::Packet;
}

Partner::Got Partner::receive(int milliseconds) {
  // of many programs most have answered by the time that they are asked
  if (socket_ >= 0)
    if (const Got got = take_packet(); got != Got::Nothing) return got;
  const timespec until = in(milliseconds);
  for (;;) {
    // a negative descriptor is left out
    pollfd watched[3] = {{socket_ >= 0 ? socket_ : listener_, POLLIN, 0},
                         {text_, POLLIN, 0},
                         {has_ended_ ? -1 : process_, POLLIN, 0}};
    const int ready = poll(watched, 3, remaining(until));
    if (ready < 0 && errno != EINTR) return Got::Gone;
    if (ready == 0) return Got::Nothing;
    if (ready < 0) continue;
    if (watched[1].revents) read_text();
    if (socket_ < 0) {
      if (watched[0].revents) accept();
      continue;
    }
    if (watched[0].revents) {
      if (const Got got = take_packet(); got != Got::Nothing) return got;
    } else if (watched[2].revents) {
      return Got::Gone;
    }
  }
}

Partner::Sent Partner::send(const link_packet& packet, int milliseconds) {
  const timespec until = in(milliseconds);
  while (socket_ >= 0) {
    const ssize_t n = ::send(socket_, packet.bytes, packet.size, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (n >= 0) return Sent::Yes;
    if (errno == EINTR) continue;
    if (errno != EAGAIN && errno != EWOULDBLOCK) break;
    pollfd room{socket_, POLLOUT, 0};
    const int left = remaining(until);
    if (left == 0 || (poll(&room, 1, left) < 0 && errno != EINTR)) return Sent::Deaf;
  }
  return Sent::Gone;
}

std::optional<ProcessEnd> Partner::await_end(int milliseconds) {
  if (pid_ == 0) return std::nullopt;
  const timespec until = in(milliseconds);
  while (!has_ended_) {
    int status = 0;
    const pid_t ended = waitpid(pid_, &status, WNOHANG);
    if (ended == pid_ || (ended < 0 && errno != EINTR)) {
      has_ended_ = true;
      if (ended == pid_)
        end_ = WIFSIGNALED(status) ? ProcessEnd{WTERMSIG(status), 0} : ProcessEnd{0, WEXITSTATUS(status)};
      break;
    }
    const int left = remaining(until);
    if (left == 0) return std::nullopt;
    // it may print more than a pipe holds before it ends
    pollfd watched[2] = {{process_, POLLIN, 0}, {text_, POLLIN, 0}};
    poll(watched, 2, left);
    if (watched[1].revents) read_text();
  }
  for (int pieces = 0; pieces < 16 && text_ >= 0; ++pieces) {
    pollfd rest{text_, POLLIN, 0};
    if (poll(&rest, 1, 0) <= 0 || !(rest.revents & (POLLIN | POLLHUP))) break;
    read_text();
  }
  return end_;
}

int Partner::processes() const { return pid_ == 0 ? 0 : static_cast<int>(family_of(pid_).size()); }

void Partner::kill() {
  if (pid_ == 0) return;
  // who is started meanwhile is found in the next round
  constexpr int kRounds = 50;
  for (int round = 0; round < kRounds; ++round) {
    if (!has_ended_) ::kill(-pid_, SIGKILL);
    const std::vector<pid_t> family = family_of(pid_);
    for (const pid_t pid : family)
      if (pid != pid_ || !has_ended_) ::kill(pid, SIGKILL);
    const bool has_ended = await_end(200).has_value();
    // orphans are ours to wait for
    for (const pid_t pid : family)
      if (pid != pid_) waitpid(pid, nullptr, WNOHANG);
    if (has_ended && family.size() == 1) break;
  }
}

}  // namespace programs
