// SPDX-License-Identifier: MIT
// What is read of an ELF file when somebody asks first: most runs never do.
#pragma once
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace dspic {

/// Copies share it; several threads may ask. Beside `Value` stands read_elf(std::string& elf, Value& into).
template <typename Value>
class Late {
 public:
  /// Of the file's bytes, which stay as they are; `begin` is what it is read into.
  void keep(const std::shared_ptr<std::string>& elf, Value begin = {}) {
    kept_ = std::make_shared<Kept>();
    kept_->elf = elf;
    kept_->value = std::move(begin);
  }
  /// Empty where nothing was kept.
  const Value& value() const {
    static const Value none;
    if (!kept_) return none;
    std::call_once(kept_->read, [this] {
      read_elf(*kept_->elf, kept_->value);
      kept_->elf.reset();
    });
    return kept_->value;
  }

 private:
  struct Kept {
    std::shared_ptr<std::string> elf;
    std::once_flag read;
    Value value;
  };
  std::shared_ptr<Kept> kept_;
};

}  // namespace dspic
