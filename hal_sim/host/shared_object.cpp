// SPDX-License-Identifier: MIT
#include "hal_sim/host/shared_object.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <sys/mman.h>
#include <unistd.h>

namespace host {

namespace {

struct Found {
  std::uintptr_t probe, base = 0, code_begin = 0, code_end = 0;
};

int look(dl_phdr_info* info, std::size_t, void* raw) {
  auto& found = *static_cast<Found*>(raw);
  bool holds_probe = false;
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const auto& segment = info->dlpi_phdr[i];
    if (segment.p_type != PT_LOAD) continue;
    const std::uintptr_t begin = info->dlpi_addr + segment.p_vaddr;
    const std::uintptr_t end = begin + segment.p_memsz;
    holds_probe = holds_probe || (found.probe >= begin && found.probe < end);
    if (segment.p_flags & PF_X) {
      found.code_begin = begin;
      found.code_end = end;
    }
  }
  found.base = info->dlpi_addr;
  return holds_probe;
}

int copy_of(const std::string& path) {
  const int from = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (from < 0) return -1;
  const int to = memfd_create("twinpuck", MFD_CLOEXEC);
  char buffer[65536];
  for (ssize_t n; (n = read(from, buffer, sizeof buffer)) > 0;)
    if (write(to, buffer, static_cast<std::size_t>(n)) != n) break;
  close(from);
  return to;
}

}  // namespace

std::unique_ptr<SharedObject> SharedObject::open(const std::string& path, bool private_copy,
                                                 std::string& error) {
  const int file = private_copy ? copy_of(path) : -1;
  std::string name = path.find('/') == std::string::npos ? "./" + path : path;
  if (private_copy) name = "/proc/self/fd/" + std::to_string(file);
  void* const handle = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) {
    error = dlerror();
    if (file >= 0) close(file);
    return nullptr;
  }
  return std::unique_ptr<SharedObject>(new SharedObject(std::move(name), handle, file));
}

SharedObject::~SharedObject() {
  dlclose(handle_);
  // some C++ code is never unloaded: then the descriptor stays open, for its number is the object's name and
  // must not come back with another file
  if (file_ >= 0 && !dlopen(name_.c_str(), RTLD_NOW | RTLD_NOLOAD)) close(file_);
}

void* SharedObject::symbol(const char* name) const { return dlsym(handle_, name); }

bool SharedObject::locate(std::uintptr_t probe) {
  Found found{probe};
  if (!dl_iterate_phdr(look, &found)) return false;
  base_ = found.base;
  code_begin_ = found.code_begin;
  code_end_ = found.code_end;
  return true;
}

}  // namespace host
