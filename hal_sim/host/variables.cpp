// SPDX-License-Identifier: MIT
#include "hal_sim/host/variables.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace host {

double variable_value(const Variable& v, const char* at) {
  if (v.kind == Variable::Kind::Float) {
    if (v.bytes == sizeof(float)) {
      float f;
      std::memcpy(&f, at, sizeof f);
      return static_cast<double>(f);
    }
    double d = 0;
    if (v.bytes == sizeof d) std::memcpy(&d, at, sizeof d);
    return d;
  }
  std::uint64_t word = 0;
  std::memcpy(&word, at, std::min(v.bytes, sizeof word));
  const int width = v.bits > 0 ? v.bits : static_cast<int>(8 * std::min(v.bytes, sizeof word));
  word >>= v.first_bit;
  if (width < 64) word &= (std::uint64_t{1} << width) - 1;
  if (v.kind == Variable::Kind::Signed && (word >> (width - 1) & 1) != 0)
    return width < 64 ? static_cast<double>(static_cast<std::int64_t>(word) - (std::int64_t{1} << width))
                      : static_cast<double>(static_cast<std::int64_t>(word));
  return static_cast<double>(word);
}

void set_variable_value(const Variable& v, char* at, double value) {
  if (v.kind == Variable::Kind::Float) {
    const float f = static_cast<float>(value);
    if (v.bytes == sizeof f) std::memcpy(at, &f, sizeof f);
    if (v.bytes == sizeof value) std::memcpy(at, &value, sizeof value);
    return;
  }
  // whole numbers wrap as the variable's width does; what no 64 bits hold becomes the nearest that they do
  const double whole = std::isnan(value) ? 0 : std::trunc(value);
  const std::uint64_t number =
      whole < 0 ? static_cast<std::uint64_t>(static_cast<std::int64_t>(std::max(whole, -9.2e18)))
                : static_cast<std::uint64_t>(std::min(whole, 1.8e19));
  std::uint64_t word = 0;
  const std::size_t bytes = std::min(v.bytes, sizeof word);
  std::memcpy(&word, at, bytes);
  const int width = v.bits > 0 ? v.bits : static_cast<int>(8 * bytes);
  const std::uint64_t mask = (width < 64 ? (std::uint64_t{1} << width) - 1 : ~std::uint64_t{0})
                             << v.first_bit;
  word = (word & ~mask) | (number << v.first_bit & mask);
  std::memcpy(at, &word, bytes);
}

}  // namespace host
