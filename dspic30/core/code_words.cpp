// SPDX-License-Identifier: MIT
#include "dspic30/core/code_words.h"

#include <algorithm>
#include <utility>

#include "dspic30/core/host_place.h"
#include "dspic30/core/known_calls.h"

namespace dspic {

CodeWords::CodeWords(ProgramMemory& memory, std::shared_ptr<CodeStore> store)
    : program(memory), store_(std::move(store)), code_version_(memory.version()) {
  if (!store_) forget_code();
}

void CodeWords::forget_code(bool is_other) {
  if (is_own_)
    store_->forget(is_other);
  else if (store_)
    have_own_store(store_->told(), is_other ? nullptr : store_->known());
  else
    have_own_store({});
  code_is_stale = true;
}

void CodeWords::tell_calls(std::vector<std::uint32_t> addresses) {
  std::sort(addresses.begin(), addresses.end());
  if (!store_->tell(addresses)) have_own_store(addresses, store_->known());
  code_is_stale = true;
}

void CodeWords::know(std::shared_ptr<const KnownCalls> calls) {
  if (!store_->know(calls)) {
    have_own_store(store_->told());
    store_->know(std::move(calls));
  }
  code_is_stale = true;
}

void CodeWords::have_own_store(const std::vector<std::uint32_t>& told,
                               std::shared_ptr<const KnownCalls> known) {
  store_ = std::make_shared<CodeStore>();
  store_->tell(told);
  if (known) store_->know(std::move(known));
  is_own_ = true;
}

unsigned CodeWords::address_of_any(const Decoded* d) const {
  if (const unsigned place = address_of_host_place(d)) return place;
  const auto index = static_cast<unsigned>(d - code_);
  return index < kFlashWords ? 2 * index : bad_address_;
}

}  // namespace dspic
