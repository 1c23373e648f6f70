// SPDX-License-Identifier: MIT
#include "supervisor/program.h"

#include <cxxabi.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <ucontext.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <exception>
#include <mutex>
#include <sstream>

#include "sim_core/base/check.h"

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/asan_interface.h>
#include <sanitizer/common_interface_defs.h>
#endif

namespace supervisor {

namespace {

constexpr std::size_t kStackBytes = 8 * 1024 * 1024;  // as a process has; only what is used takes memory
constexpr std::size_t kRecoveryBytes = 256 * 1024;

thread_local Program* running = nullptr;

char* recovery_stack() {
  thread_local std::unique_ptr<char[]> stack(new char[kRecoveryBytes]);
  return stack.get();
}

const char* signal_words(int signal) {
  switch (signal) {
    case SIGSEGV:
      return "access through a wild or null pointer, or a stack overflow (SIGSEGV)";
    case SIGBUS:
      return "access to memory that is not there (SIGBUS)";
    case SIGFPE:
      return "division by zero or another arithmetic fault (SIGFPE)";
    case SIGILL:
      return "illegal instruction (SIGILL)";
    case SIGABRT:
      return "abort(), a failed assert() or an exception that may not leave (SIGABRT)";
    default:
      return "a signal";
  }
}

#if defined(__SANITIZE_ADDRESS__)
__attribute__((no_sanitize("address"))) void tell_sanitizer() {
  ASAN_UNPOISON_MEMORY_REGION(recovery_stack(), kRecoveryBytes);
  __sanitizer_start_switch_fiber(nullptr, recovery_stack(), kRecoveryBytes);
  __sanitizer_finish_switch_fiber(nullptr, nullptr, nullptr);
}
#else
void tell_sanitizer() {}
#endif

struct sigaction abort_before;

/// The process works in a folder for as long as this lives. Programs run between ticks, one after the other,
/// and nothing else runs then that opens files.
class InFolder {
 public:
  explicit InFolder(const std::string& folder) {
    if (folder.empty()) return;
    before_ = open(".", O_PATH | O_DIRECTORY | O_CLOEXEC);
    if (before_ >= 0 && chdir(folder.c_str()) != 0) leave();
  }
  ~InFolder() {
    if (before_ < 0) return;
    CHECK(fchdir(before_) == 0, "the folder of the run is gone");
    leave();
  }
  InFolder(const InFolder&) = delete;
  InFolder& operator=(const InFolder&) = delete;

 private:
  void leave() {
    close(before_);
    before_ = -1;
  }
  int before_ = -1;
};

}  // namespace

/// abort() raises a signal that the host does not handle for firmware.
struct AbortHandler {
  static void on_signal(int signal, siginfo_t*, void* context) {
    if (running && running->take(signal, context, 0)) return;
    sigaction(SIGABRT, &abort_before, nullptr);  // not a program's: abort() goes on as it would have
  }
  static void install() {
    static std::once_flag once;
    std::call_once(once, [] {
      struct sigaction action {};
      action.sa_sigaction = on_signal;
      action.sa_flags = SA_SIGINFO | SA_ONSTACK;
      sigemptyset(&action.sa_mask);
      CHECK(sigaction(SIGABRT, &action, &abort_before) == 0, "cannot install a handler for abort()");
    });
  }
};

Program::Program(std::string path, std::string name, void* owner)
    : path_(std::move(path)), name_(std::move(name)), owner_(owner), fiber_(kStackBytes), symbols_(path_) {}

Program::~Program() = default;

std::unique_ptr<Program> Program::open(const std::string& path, const std::string& name,
                                       const std::string& folder, const std::string& args, void* owner,
                                       std::vector<std::string>& problems) {
  std::unique_ptr<Program> p(new Program(path, name, owner));
  p->folder_ = folder;
  p->words_ = {name};
  std::istringstream words(args);
  for (std::string word; words >> word;) p->words_.push_back(word);
  for (std::string& word : p->words_) p->arguments_.push_back(word.data());
  p->arguments_.push_back(nullptr);
  std::string why;
  p->object_ = host::SharedObject::open(path, true, why);
  if (!p->object_) {
    const std::size_t symbol = why.find("undefined symbol: ");
    if (symbol != std::string::npos)
      why = "a call of " + why.substr(symbol + 18) + ", which supervisors do not have";
    problems.push_back(path + ": supervisor '" + name + "': got " + why +
                       ", expected a program of supervisor.h or of Webots' supervisor functions");
    return nullptr;
  }
  p->main_ = reinterpret_cast<int (*)(int, char**, char**)>(p->object_->symbol("main"));
  if (!p->main_ || !p->object_->locate(reinterpret_cast<std::uintptr_t>(p->main_))) {
    problems.push_back(path + ": supervisor '" + name +
                       "': got a shared object without main(), expected a program");
    return nullptr;
  }
  Dl_info own;
  if (dladdr(reinterpret_cast<void*>(p->main_), &own) &&
      std::strstr(own.dli_fname, "/proc/self/fd/") == nullptr) {
    problems.push_back(path + ": supervisor '" + name +
                       "': got a shared object without main(), expected a program");
    return nullptr;
  }
  p->fiber_.restart(enter, p.get());
  return p;
}

void* Program::current() { return running ? running->owner_ : nullptr; }

void Program::run() {
  if (state_ != State::Waiting) return;
  host::catch_faults_on_this_thread();
  recovery_stack();
  AbortHandler::install();
  Program* const outer = running;
  running = this;
  host::set_fault_guest(this);
  const InFolder here(folder_);
  fiber_.enter();
  host::set_fault_guest(outer);
  running = outer;
}

void Program::wait() { running->fiber_.yield(); }

void Program::leave(State state) {
  state_ = state;
  fiber_.yield();
  CHECK(false, "a program that is over went on");
  std::abort();
}

void Program::exit(int status) {
  CHECK(running, "exit() of a program outside its turn");
  running->exit_status_ = status;
  running->exited_ = true;
  running->leave(State::Done);
}

void Program::enter(void* raw) {
  auto* self = static_cast<Program*>(raw);
  std::string thrown;
  try {
    self->exit_status_ = self->main_(static_cast<int>(self->words_.size()), self->arguments_.data(),
                                     self->arguments_.data() + self->words_.size());
  } catch (const std::exception& e) {
    thrown = std::string("an exception that nobody caught: ") + e.what();
  } catch (...) {
    thrown = "an exception that nobody caught";
  }
  if (!thrown.empty()) self->crash_with(std::move(thrown), 0, 0);
  self->leave(State::Done);
}

bool Program::take(int signal, void* raw, std::uintptr_t address) {
  auto& r = static_cast<ucontext_t*>(raw)->uc_mcontext.gregs;
  fault_ = {signal, static_cast<std::uintptr_t>(r[REG_RIP]), static_cast<std::uintptr_t>(r[REG_RBP]),
            address};
  // a library function of the PC: the return address on top of the stack may be the program's
  const auto sp = static_cast<std::uintptr_t>(r[REG_RSP]);
  if (!is_code(fault_.pc) && fiber_.is_on_stack(sp)) {
    std::uintptr_t back;
    std::memcpy(&back, reinterpret_cast<const void*>(sp), sizeof back);
    if (is_code(back)) fault_.pc = back - 1;
  }
  const auto top = reinterpret_cast<std::uintptr_t>(recovery_stack()) + kRecoveryBytes;
  r[REG_RSP] = static_cast<greg_t>((top & ~std::uintptr_t{15}) - 8);
  r[REG_RBP] = 0;
  r[REG_RIP] = static_cast<greg_t>(reinterpret_cast<std::uintptr_t>(&land));
  return true;
}

__attribute__((no_sanitize("address"))) void Program::land() {
  tell_sanitizer();
  sigset_t set;
  sigemptyset(&set);
  for (int s : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) sigaddset(&set, s);
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
  const Fault& f = running->fault_;
  running->crash_with(signal_words(f.signal), f.pc, f.frame);
}

void Program::crash_with(std::string what, std::uintptr_t pc, std::uintptr_t frame) {
  crash_ = std::move(what);
  if (pc) crash_ += place_of(pc, frame);
  leave(State::Crashed);
}

std::string Program::what_runs(std::uintptr_t pc, std::uintptr_t frame) const {
  return "supervisor '" + name_ + "' was running" + place_of(pc, frame);
}

std::string Program::place_of(std::uintptr_t pc, std::uintptr_t frame) const {
  // the innermost frame that is the program's own; frames are linked through the frame pointer
  for (int depth = 0; depth < 32; ++depth) {
    if (is_code(pc)) {
      host::Place place = symbols_.find(pc - object_->base());
      const std::string symbol = place.function.substr(0, place.function.find('.'));
      int wrong = 0;
      if (char* readable = abi::__cxa_demangle(symbol.c_str(), nullptr, nullptr, &wrong)) {
        place.function = readable;
        std::free(readable);
      }
      return " at " + to_string(place);
    }
    if (frame % sizeof(void*) != 0 || !fiber_.is_on_stack(frame) ||
        !fiber_.is_on_stack(frame + 2 * sizeof(void*) - 1))
      break;
    std::uintptr_t link[2];
    std::memcpy(link, reinterpret_cast<const void*>(frame), sizeof link);
    if (link[0] <= frame) break;
    pc = link[1] - 1;
    frame = link[0];
  }
  return "";
}

}  // namespace supervisor
