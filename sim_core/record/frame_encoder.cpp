// SPDX-License-Identifier: MIT
#include "sim_core/record/frame_encoder.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace sim {

FilmFile::FilmFile(std::string path) : path_(std::move(path)) {
  file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file_ < 0) fail(std::strerror(errno));
}

FilmFile::~FilmFile() { close(); }

void FilmFile::write_at(std::int64_t at, const std::vector<std::uint8_t>& bytes) {
  std::size_t done = 0;
  while (error_.empty() && done < bytes.size()) {
    const ssize_t wrote =
        ::pwrite(file_, bytes.data() + done, bytes.size() - done, at + static_cast<std::int64_t>(done));
    if (wrote > 0) {
      done += static_cast<std::size_t>(wrote);
    } else if (wrote == 0 || errno != EINTR) {
      fail(std::strerror(wrote == 0 ? EIO : errno));
    }
  }
}

void FilmFile::append(const std::vector<std::uint8_t>& bytes, const std::vector<std::uint8_t>& end) {
  const bool was_good = error_.empty();
  write_at(size_, bytes);
  if (error_.empty()) {
    size_ += static_cast<std::int64_t>(bytes.size());
  } else if (was_good && file_ >= 0) {
    // a device cannot be cut, and the first error is known already
    const bool cut = ::ftruncate(file_, size_) == 0;
    if (cut && !end.empty() && ::pwrite(file_, end.data(), end.size(), size_) < 0) fail("its end is lost");
  }
}

void FilmFile::close() {
  if (file_ >= 0 && ::close(file_) != 0) fail(std::strerror(errno));
  file_ = -1;
}

void FilmFile::fail(const std::string& reason) {
  if (error_.empty()) error_ = path_ + ": cannot be written: " + reason;
}

}  // namespace sim
