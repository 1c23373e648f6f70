// SPDX-License-Identifier: MIT
// A shared object in memory, under its own name or as a private copy with globals of its own.
#pragma once
#include <cstdint>
#include <memory>
#include <string>

namespace host {

class SharedObject {
 public:
  /// Loads `path`; `private_copy`: from a copy that the dynamic linker takes for another file, so that
  /// nothing is shared with other loads of it. On failure null and `error` holds what the dynamic linker
  /// said.
  static std::unique_ptr<SharedObject> open(const std::string& path, bool private_copy, std::string& error);
  ~SharedObject();
  SharedObject(const SharedObject&) = delete;
  SharedObject& operator=(const SharedObject&) = delete;

  /// Address of an exported name, its own or of a library it needs; null when there is none.
  void* symbol(const char* name) const;
  /// Takes load address and executable segment from the object that holds `probe`. False: nothing loaded
  /// does.
  bool locate(std::uintptr_t probe);
  /// After locate(): address in the file = address in memory - base().
  std::uintptr_t base() const { return base_; }
  bool is_code(std::uintptr_t address) const { return address >= code_begin_ && address < code_end_; }

 private:
  SharedObject(std::string name, void* handle, int file)
      : name_(std::move(name)), handle_(handle), file_(file) {}
  std::string name_;
  void* handle_;
  int file_;  // the private copy's descriptor, -1 if none; open as long as the object is: the name holds its
              // number
  std::uintptr_t base_ = 0, code_begin_ = 0, code_end_ = 0;
};

}  // namespace host
