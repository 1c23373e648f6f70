// SPDX-License-Identifier: MIT
#include "dspic30/translate/machine_code.h"

#include <dlfcn.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <string_view>

#include "dspic30/load/cursor.h"
#include "dspic30/memory/hex.h"

namespace dspic::translate {

namespace {

constexpr char kWordMark = '#', kKnownMark = '!';

void* function_named(const std::string& name) {
  static const bool is_found = find_own_functions();
  return is_found ? dlsym(RTLD_DEFAULT, name.c_str()) : nullptr;
}

void* address_of(const std::string& name, void* self, const std::vector<Item>& items) {
  if (name.empty()) return self;
  if (name == kArrive) return reinterpret_cast<void*>(&Cpu::arrive_from);
  if (name == kGoOn) return reinterpret_cast<void*>(&Cpu::go_on);
  if (name == kReturn) return reinterpret_cast<void*>(&Cpu::return_from);
  if (name == kAnswered) return reinterpret_cast<void*>(&answered);
  if (name == kHost) return reinterpret_cast<void*>(&call_host);
  if (name == kTold) return reinterpret_cast<void*>(&tell);
  if (name == kHeard) return reinterpret_cast<void*>(&hear);
  if (name == kAlone) return reinterpret_cast<void*>(&Cpu::run_alone);
  if (name[0] == kKnownMark) {
    const auto item = static_cast<std::size_t>(std::strtoul(name.c_str() + 1, nullptr, 10));
    return item < items.size() && items[item].routine ? const_cast<KnownRoutine*>(items[item].routine)
                                                      : nullptr;
  }
  if (name[0] == kWordMark)
    return reinterpret_cast<void*>(
        function_of(static_cast<std::uint32_t>(std::strtoul(name.c_str() + 1, nullptr, 16))));
  return function_named(name);
}

std::uint32_t sum_of(std::string_view text) {
  return static_cast<std::uint32_t>(std::hash<std::string_view>{}(text));
}

constexpr std::size_t kNumberBytes = 4;

void put(std::string& text, std::size_t number) {
  for (std::size_t i = 0; i < kNumberBytes; ++i) text += static_cast<char>(number >> 8 * i & 0xFF);
}
void put(std::string& text, const std::string& part) {
  put(text, part.size());
  text += part;
}

std::string part_of(Cursor& in) {
  const Cursor part = in.part(in.number(kNumberBytes));
  return {reinterpret_cast<const char*>(part.here()), part.left()};
}

}  // namespace

std::string interpreter(std::uint32_t word) { return kWordMark + hex(word, 6).substr(2); }

std::string known_routine(std::size_t item) { return kKnownMark + std::to_string(item); }

Run placed(const MachineCode& code, const std::vector<Item>& items) {
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const std::size_t room = (code.bytes.size() + page - 1) / page * page;
  void* const memory = mmap(nullptr, room, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return nullptr;
  auto* const bytes = static_cast<char*>(memory);
  std::copy(code.bytes.begin(), code.bytes.end(), bytes);
  bool is_whole = true;
  for (const MachineCode::Address& a : code.addresses) {
    void* const target = address_of(a.name, memory, items);
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
  if (text.size() < kNumberBytes) return false;
  const std::size_t size = text.size() - kNumberBytes;
  Cursor in(reinterpret_cast<const unsigned char*>(text.data()), text.size());
  Cursor body = in.part(size);
  if (in.number(kNumberBytes) != sum_of({text.data(), size}) || part_of(body) != key) return false;
  code.bytes = part_of(body);
  for (std::uint32_t left = body.number(kNumberBytes); left > 0 && !body.is_at_end(); --left) {
    const std::uint32_t offset = body.number(kNumberBytes);
    std::string name = part_of(body);
    code.addresses.push_back({offset, std::move(name), body.number(kNumberBytes)});
  }
  return true;
}

bool find_own_functions() {
  static const char anything = 0;
  Dl_info here{};
  if (dladdr(&anything, &here) && here.dli_fname)
    dlopen(here.dli_fname, RTLD_LAZY | RTLD_NOLOAD | RTLD_GLOBAL);
  return true;
}

}  // namespace dspic::translate
