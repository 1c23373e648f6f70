// SPDX-License-Identifier: MIT
#include "sim_core/base/output_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace sim {

int open_output(const std::string& path, int mode, std::string& why_not) {
  const int file = ::open(path.c_str(), mode | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) why_not = std::strerror(errno);
  struct stat info {};
  const bool is_file = file >= 0 && ::fstat(file, &info) == 0 && S_ISREG(info.st_mode);
  // where locks are not to be had, nothing is told
  if (!is_file || ::flock(file, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return file;
  ::close(file);
  why_not = "another run that goes on writes it";
  return -1;
}

OutputFile::OutputFile(const std::string& path, const std::string& option, bool keeps)
    : where_(option.empty() ? path : path + ": " + option) {
  std::string why_not;
  file_ = open_output(path, O_WRONLY, why_not);
  if (file_ < 0) fail(why_not);
  has_places_ = file_ >= 0 && ::lseek(file_, 0, SEEK_CUR) >= 0;
  if (!keeps) clear();
}

OutputFile::~OutputFile() { close(); }

std::size_t OutputFile::write_at(std::int64_t at, std::string_view bytes) {
  const std::size_t all = bytes.size();
  while (error_.empty() && !bytes.empty()) {
    const ssize_t wrote = has_places_ ? ::pwrite(file_, bytes.data(), bytes.size(), at)
                                      : ::write(file_, bytes.data(), bytes.size());
    if (wrote > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(wrote));
      at += wrote;
    } else if (wrote == 0 || errno != EINTR) {
      fail(std::strerror(wrote == 0 ? EIO : errno));
    }
  }
  return all - bytes.size();
}

void OutputFile::append_lines(std::string_view lines) {
  const bool was_good = error_.empty();
  const std::string_view done = lines.substr(0, write_at(size_, lines));
  size_ += static_cast<std::int64_t>(done.substr(0, done.rfind('\n') + 1).size());
  if (was_good && !error_.empty() && file_ >= 0 && ::ftruncate(file_, size_) != 0) return;  // a device
}

void OutputFile::append(std::string_view records, std::string_view end) {
  const bool was_good = error_.empty();
  write_at(size_, records);
  if (error_.empty()) {
    size_ += static_cast<std::int64_t>(records.size());
  } else if (was_good && file_ >= 0) {
    // a device cannot be cut, and the first error is known already
    const bool cut = ::ftruncate(file_, size_) == 0;
    if (cut && !end.empty() && ::pwrite(file_, end.data(), end.size(), size_) < 0) fail("its end is lost");
  }
}

void OutputFile::clear() {
  size_ = 0;
  struct stat info {};
  if (file_ < 0 || ::fstat(file_, &info) != 0 || !S_ISREG(info.st_mode)) return;
  if (::ftruncate(file_, 0) != 0) fail(std::strerror(errno));
}

void OutputFile::close() {
  if (file_ >= 0 && ::close(file_) != 0) fail(std::strerror(errno));
  file_ = -1;
}

void OutputFile::fail(const std::string& reason) {
  if (error_.empty()) error_ = where_ + ": cannot be written: " + reason;
}

}  // namespace sim
