// SPDX-License-Identifier: MIT
#include "dspic30/translate/machine_code.h"

#include <dlfcn.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <functional>
#include <string_view>

namespace dspic::translate {

namespace {

constexpr char kWordMark = '#';

void* address_of(const std::string& name, void* self) {
  if (name.empty()) return self;
  if (name == kArrive) return reinterpret_cast<void*>(&Cpu::arrive_from);
  if (name[0] == kWordMark)
    return reinterpret_cast<void*>(
        function_of(static_cast<std::uint32_t>(std::strtoul(name.c_str() + 1, nullptr, 16))));
  return dlsym(RTLD_DEFAULT, name.c_str());
}

std::uint64_t sum_of(std::string_view text) { return std::hash<std::string_view>{}(text); }

void put(std::string& text, std::uint64_t number) {
  text.append(reinterpret_cast<const char*>(&number), sizeof number);
}
void put(std::string& text, const std::string& part) {
  put(text, part.size());
  text += part;
}

/// Past the end everything is 0 and empty.
struct Reader {
  std::string_view rest;
  std::string_view take(std::uint64_t bytes) {
    const std::string_view part = rest.substr(0, bytes);
    rest.remove_prefix(part.size());
    return part;
  }
  std::uint64_t number() {
    std::uint64_t value = 0;
    const std::string_view part = take(sizeof value);
    std::memcpy(&value, part.data(), part.size());
    return value;
  }
  std::string_view part() { return take(number()); }
};

}  // namespace

std::string interpreter(std::uint32_t word) { return kWordMark + hex(word, 6).substr(2); }

Run placed(const MachineCode& code) {
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const std::size_t room = (code.bytes.size() + page - 1) / page * page;
  void* const memory = mmap(nullptr, room, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return nullptr;
  auto* const bytes = static_cast<char*>(memory);
  std::memcpy(bytes, code.bytes.data(), code.bytes.size());
  bool is_whole = true;
  for (const MachineCode::Address& a : code.addresses) {
    void* const target = address_of(a.name, memory);
    const std::uint64_t value = reinterpret_cast<std::uint64_t>(target) + a.addend;
    is_whole &= target != nullptr && a.offset + sizeof value <= code.bytes.size();
    if (is_whole) std::memcpy(bytes + a.offset, &value, sizeof value);
  }
  if (!is_whole || mprotect(memory, room, PROT_READ | PROT_EXEC) != 0) {
    munmap(memory, room);
    return nullptr;
  }
  return reinterpret_cast<Run>(memory);
}

std::string text_of(const std::string& key, const MachineCode& code) {
  std::string text;
  put(text, key);
  put(text, code.bytes);
  put(text, code.addresses.size());
  for (const MachineCode::Address& a : code.addresses) {
    put(text, a.offset);
    put(text, a.name);
    put(text, a.addend);
  }
  put(text, sum_of(text));
  return text;
}

bool read_text(const std::string& text, const std::string& key, MachineCode& code) {
  constexpr std::size_t kSumBytes = sizeof(std::uint64_t);
  if (text.size() < kSumBytes) return false;
  Reader in{std::string_view(text).substr(0, text.size() - kSumBytes)};
  if (Reader{std::string_view(text).substr(in.rest.size())}.number() != sum_of(in.rest) || in.part() != key)
    return false;
  code.bytes = in.part();
  for (std::uint64_t left = in.number(); left > 0 && !in.rest.empty(); --left) {
    const auto offset = static_cast<std::uint32_t>(in.number());
    std::string name(in.part());
    code.addresses.push_back({offset, std::move(name), in.number()});
  }
  return true;
}

}  // namespace dspic::translate
