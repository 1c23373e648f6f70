// SPDX-License-Identifier: MIT
#include <cstdio>
#include <vector>

#include "dspic30/load/firmware_file.h"
#include "dspic30/memory/hex.h"
#include "dspic30/memory/program_memory.h"
#include "dspic30/periph/nvm.h"

namespace dspic {

namespace {

constexpr std::uint8_t kData = 0, kEnd = 1, kSegment = 2, kSegmentStart = 3, kUpper = 4, kStart = 5;
constexpr int kRecordHead = 5;  // length, address, type, checksum
constexpr std::size_t kRecordBytes = 16;

int digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

class HexReader {
 public:
  HexReader(const std::string& text, const std::string& name, FirmwareFile& file)
      : text_(text), name_(name), file_(file) {}

  bool read(std::string& error) {
    std::size_t from = 0;
    while (from < text_.size() && error_.empty() && !ended_) {
      std::size_t end = text_.find('\n', from);
      if (end == std::string::npos) end = text_.size();
      std::string line = text_.substr(from, end - from);
      while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
      ++line_;
      if (!line.empty()) record(line);
      from = end + 1;
    }
    if (error_.empty() && !ended_)
      error_ = name_ + ": the file ends without an end record (:00000001FF); is it cut off?";
    if (error_.empty() && file_.words.empty()) error_ = name_ + ": there is no program in it";
    error = error_;
    return error_.empty();
  }

 private:
  void fail(const std::string& what) { error_ = name_ + ": line " + std::to_string(line_) + ": " + what; }

  void record(const std::string& line) {
    if (line[0] != ':')
      return fail("got '" + line.substr(0, 8) + "', expected a record that begins with ':'");
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 1; i < line.size(); i += 2) {
      const int high = digit(line[i]), low = i + 1 < line.size() ? digit(line[i + 1]) : -1;
      if (high < 0 || low < 0)
        return fail("column " + std::to_string(i + 1) + ": expected pairs of hexadecimal digits");
      bytes.push_back(static_cast<std::uint8_t>(high << 4 | low));
    }
    if (bytes.size() < kRecordHead || bytes.size() != bytes[0] + std::size_t{kRecordHead})
      return fail("got " + std::to_string(bytes.size()) + " bytes, expected " +
                  std::to_string((bytes.empty() ? 0 : bytes[0]) + kRecordHead));
    unsigned sum = 0;
    for (std::size_t i = 0; i + 1 < bytes.size(); ++i) sum += bytes[i];
    const unsigned expected = (0 - sum) & 0xFF;
    if (bytes.back() != expected)
      return fail("checksum got " + hex(bytes.back(), 2) + ", expected " + hex(expected, 2));
    carry_out(bytes);
  }

  void carry_out(const std::vector<std::uint8_t>& bytes) {
    const unsigned length = bytes[0], address = bytes[1] << 8 | bytes[2], type = bytes[3];
    const unsigned value = length == 2 ? bytes[4] << 8 | bytes[5] : 0;
    switch (type) {
      case kData:
        // XC16 writes records that run on over a border of 64 KB; only segments wrap
        // round (Intel's specification)
        for (unsigned i = 0; i < length && error_.empty(); ++i)
          put(base_ + (segmented_ ? (address + i) & 0xFFFF : address + i), bytes[4 + i]);
        break;
      case kEnd:
        ended_ = true;
        break;
      case kUpper:
      case kSegment:
        if (length != 2) return fail("an address record of " + std::to_string(length) + " bytes, expected 2");
        segmented_ = type == kSegment;
        base_ = segmented_ ? value << 4 : value << 16;
        break;
      case kSegmentStart:
      case kStart:
        break;  // the chip starts at 0
      default:
        fail("record type got " + hex(type, 2) + ", expected 0x00 to 0x05");
    }
  }

  void put(std::uint32_t at, std::uint8_t byte) {
    const std::uint32_t address = at / 4 * 2, lane = at % 4;
    if (lane == 3) return;  // the phantom byte
    if (!is_program_memory(address))
      return fail("address " + hex(address, 6) + " is in no memory of this chip");
    std::uint32_t& word = file_.words.emplace(address, kErasedWord).first->second;
    unsigned& lanes = written_[address];
    const std::uint32_t mask = 0xFFu << 8 * lane, value = static_cast<std::uint32_t>(byte) << 8 * lane;
    if ((lanes >> lane & 1) && (word & mask) != value)
      return fail("address " + hex(address, 6) + " comes a second time, with another value");
    lanes |= 1u << lane;
    word = (word & ~mask) | value;
  }

  const std::string& text_;
  const std::string& name_;
  FirmwareFile& file_;
  std::map<std::uint32_t, unsigned> written_;  // lanes of each word
  std::uint32_t base_ = 0;
  bool segmented_ = false;  // base_ comes from a record of segments
  int line_ = 0;
  bool ended_ = false;
  std::string error_;
};

std::string record(unsigned type, unsigned address, const std::vector<std::uint8_t>& data) {
  std::vector<std::uint8_t> bytes{static_cast<std::uint8_t>(data.size()),
                                  static_cast<std::uint8_t>(address >> 8), static_cast<std::uint8_t>(address),
                                  static_cast<std::uint8_t>(type)};
  bytes.insert(bytes.end(), data.begin(), data.end());
  unsigned sum = 0;
  for (const std::uint8_t b : bytes) sum += b;
  bytes.push_back(static_cast<std::uint8_t>(0 - sum));
  std::string text = ":";
  char pair[4];
  for (const std::uint8_t b : bytes) {
    std::snprintf(pair, sizeof pair, "%02X", b);
    text += pair;
  }
  return text + "\n";
}

}  // namespace

bool is_program_memory(std::uint32_t address) {
  return address < kFlashEnd || address - kEepromStart < 2 * kEepromWordCount ||
         address - kUnitIdStart < 2 * kUnitIdWords || address - kConfigurationStart < 2 * kConfigurationWords;
}

bool load_hex(const std::string& bytes, const std::string& name, FirmwareFile& file, std::string& error) {
  return HexReader(bytes, name, file).read(error);
}

std::string to_hex(const FirmwareFile& file) {
  std::string text;
  std::vector<std::uint8_t> data;
  std::uint32_t begin = 0, upper = ~0u;
  const auto flush = [&] {
    if (data.empty()) return;
    if (begin >> 16 != upper) {
      upper = begin >> 16;
      text += record(kUpper, 0, {static_cast<std::uint8_t>(upper >> 8), static_cast<std::uint8_t>(upper)});
    }
    text += record(kData, begin & 0xFFFF, data);
    data.clear();
  };
  for (const auto& [address, word] : file.words) {
    const std::uint32_t at = 2 * address;
    if (data.size() == kRecordBytes || at != begin + data.size() || at % kRecordBytes == 0) flush();
    if (data.empty()) begin = at;
    for (int lane = 0; lane < 4; ++lane)
      data.push_back(static_cast<std::uint8_t>(lane < 3 ? word >> 8 * lane : 0));
  }
  flush();
  return text + record(kEnd, 0, {});
}

}  // namespace dspic
