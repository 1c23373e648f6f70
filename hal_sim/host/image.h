// SPDX-License-Identifier: MIT
// A firmware image (.so from `twinpuck build`) in memory. One file may be loaded several times, once per
// worker thread; robots of one copy share its code and take turns in its data segment.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "hal_sim/host/image_abi.h"
#include "hal_sim/host/image_memory.h"

namespace host {

class Symbols;

/// One loaded copy. Robots bound to it swap their private data in and out of its data segment, so they run on
/// one thread at a time.
class ImageCopy {
 public:
  ImageCopy(std::string path, std::unique_ptr<ImageMemory> memory, const tp_image* image);
  ImageCopy(const ImageCopy&) = delete;
  ImageCopy& operator=(const ImageCopy&) = delete;

  const tp_image& description() const { return *image_; }
  tp_control& control() const { return *image_->control; }
  /// Start-up values of the private data.
  const std::vector<char>& start_values() const { return start_values_; }

  /// Where malloc() takes its memory from, as a part of start_values(); 0 bytes: the program has none of
  /// ours.
  std::size_t heap_offset() const { return heap_offset_; }
  std::size_t heap_bytes() const { return heap_bytes_; }

  void copy_out(char* to) const;         ///< live data -> a robot's own copy
  void copy_in(const char* from) const;  ///< a robot's own copy -> live data

  bool is_code(std::uintptr_t address) const { return memory_->is_code(address); }
  std::uintptr_t code_begin() const { return memory_->code_begin(); }
  std::uintptr_t code_end() const { return memory_->code_end(); }
  /// Load address: address in the file = address in memory - base().
  std::uintptr_t base() const { return memory_->base(); }
  /// In the addresses that belong to this copy alone.
  bool holds(std::uintptr_t address) const { return memory_->holds(address); }
  const std::string& path() const { return path_; }

  const void* owner = nullptr;  ///< the robot whose data is live; null: start-up values or nobody's

 private:
  std::string path_;
  std::unique_ptr<ImageMemory> memory_;
  const tp_image* image_;
  std::size_t private_bytes_;
  std::size_t heap_offset_ = 0, heap_bytes_ = 0;
  std::vector<char> start_values_;
};

/// All copies of one firmware file.
class Image {
 public:
  /// Opens `path` and checks that it is one of ours. On failure returns null and `error` holds one line
  /// `where: what: got X, expected Y; hint`.
  static std::shared_ptr<Image> open(const std::string& path, std::string& error);
  /// The same of a file that has been read.
  static std::shared_ptr<Image> open(const std::string& path, std::string file, std::string& error);
  /// Reads the bytes of a program's file, of whatever kind. False: `error` says why not.
  static bool read(const std::string& path, std::string& file, std::string& error);
  ~Image();

  const std::string& path() const { return path_; }
  /// The n-th copy; loaded when first asked for. Not thread-safe: ask while setting up.
  ImageCopy& copy(std::size_t n);
  const std::vector<std::unique_ptr<ImageCopy>>& copies() const { return copies_; }
  const Symbols& symbols() const { return *symbols_; }

 private:
  Image(std::string path, std::string file);
  std::unique_ptr<ImageCopy> load(std::string& error) const;

  std::string path_;
  std::string file_;  // its bytes: every copy is of the same
  std::vector<std::unique_ptr<ImageCopy>> copies_;
  std::unique_ptr<Symbols> symbols_;
};

}  // namespace host
