// SPDX-License-Identifier: MIT
// The stamp at the end of a firmware image: `twinpuck build` writes it, the host asks for it before anything
// of the file runs. It tells an image from any other shared object, and a damaged one from a whole one. No
// protection against somebody who means it.
//
//   | the shared object, any length | "TPSTAMP1" | checksum of all before "TPSTAMP1", 8 bytes |
#pragma once
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace host {

inline constexpr std::string_view kStampMark = "TPSTAMP1";
inline constexpr std::size_t kStampBytes = 16;

/// Eight bytes at a time; a changed bit changes it.
inline std::uint64_t image_checksum(std::string_view bytes) {
  std::uint64_t sum = 0x9E3779B97F4A7C15u + bytes.size();
  for (std::size_t at = 0; at < bytes.size(); at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, bytes.size() - at < 8 ? bytes.size() - at : 8);
    sum = (sum ^ word) * 0xD6E8FEB86659FD93u;
    sum ^= sum >> 32;
  }
  return sum;
}

/// What goes to the end of a shared object with these bytes.
inline std::string image_stamp(std::string_view bytes) {
  const std::uint64_t sum = image_checksum(bytes);
  std::string stamp(kStampMark);
  stamp.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  return stamp;
}

enum class Stamp { Missing, Wrong, Right };

inline Stamp check_stamp(std::string_view file) {
  if (file.size() < kStampBytes) return Stamp::Missing;
  const std::string_view object = file.substr(0, file.size() - kStampBytes),
                         stamp = file.substr(object.size());
  if (stamp.substr(0, kStampMark.size()) != kStampMark) return Stamp::Missing;
  return stamp == image_stamp(object) ? Stamp::Right : Stamp::Wrong;
}

}  // namespace host
