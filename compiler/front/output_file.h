// SPDX-License-Identifier: MIT
// A file that twinpuck-cc writes: what the disk refuses is a line for the user.
#pragma once
#include <string>

#include "llvm/Support/FileSystem.h"
#include "llvm/Support/raw_ostream.h"

namespace cc {

/// LLVM's own streams end the process when a write fails and nobody asks.
class OutputFile {
 public:
  OutputFile(std::string path, llvm::sys::fs::OpenFlags flags = llvm::sys::fs::OF_None)
      : path_(std::move(path)), out_(path_, opened_, flags) {}
  ~OutputFile() { out_.clear_error(); }
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  llvm::raw_pwrite_stream& stream() { return out_; }
  /// Whether it could be opened; else it is told why, on standard error.
  bool is_open() const { return !opened_ || tell(opened_); }
  /// Ends it. False, and told, when not all of it could be written.
  bool finish() {
    if (opened_) return tell(opened_);
    out_.close();
    const std::error_code failed = out_.error();
    return !failed || tell(failed);
  }

 private:
  bool tell(std::error_code why) const {
    llvm::errs() << path_ << ": output: got " << why.message() << ", expected a file that can be written\n";
    return false;
  }

  std::string path_;
  std::error_code opened_;
  llvm::raw_fd_ostream out_;
};

}  // namespace cc
