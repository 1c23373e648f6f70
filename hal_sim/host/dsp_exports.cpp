// SPDX-License-Identifier: MIT
// The functions of pins_dsp.h. Arithmetic as the DSP library's butterflies do it on the engine [DS70143 2.4]:
//
//   upper' = round((a + b) / 2)                   a, b: upper and lower leg
//   lower' = round((a - b) w / 2)                 w: twiddle factor
//
// a - b wraps at 16 bits; products are 1.31 fractions, sums have 40 bits and saturate at 9.31; storing
// halves, rounds to nearest with ties to even and saturates to 16 bits: the library runs the engine with
// CORCON = 0x00F0 [vendor].
#include <cstdint>
#include <utility>

#include "hal_sim/host/context.h"
#include "hal_sim/host/pins_dsp.h"

namespace {

constexpr std::int64_t kHighest = (std::int64_t{1} << 39) - 1;
constexpr int kMostStages = 12;

struct Pair {
  std::int16_t real, imag;
};

std::int64_t saturate(std::int64_t value) {
  return value > kHighest ? kHighest : value < -kHighest - 1 ? -kHighest - 1 : value;
}

/// Accumulator to memory, halved.
std::int16_t store_half(std::int64_t accumulator) {
  const std::int64_t halved = accumulator >> 1;
  std::int64_t word = halved >> 16;
  const std::int64_t rest = halved & 0xFFFF;
  if (rest > 0x8000 || (rest == 0x8000 && (word & 1))) ++word;
  return static_cast<std::int16_t>(word > 32767 ? 32767 : word < -32768 ? -32768 : word);
}

std::int64_t product(std::int16_t a, std::int16_t b) { return 2 * std::int64_t{a} * b; }

bool is_sensible(tp_i64 log2n) { return log2n >= 1 && log2n <= kMostStages; }

}  // namespace

extern "C" {

void tp_dsp_fft(tp_i64 log2n, void* data, const void* twiddles) {
  host::Context::current().note_write();
  if (!is_sensible(log2n)) return;
  auto* points = static_cast<Pair*>(data);
  const auto* factors = static_cast<const Pair*>(twiddles);
  const std::size_t n = std::size_t{1} << log2n;
  for (std::size_t groups = n / 2, step = 1; groups > 0; groups /= 2, step *= 2)
    for (std::size_t first = 0; first < n; first += 2 * groups)
      for (std::size_t g = 0; g < groups; ++g) {
        Pair& upper = points[first + g];
        Pair& lower = points[first + g + groups];
        const Pair w = factors[g * step], a = upper, b = lower;
        const auto real = static_cast<std::int16_t>(a.real - b.real);
        const auto imag = static_cast<std::int16_t>(a.imag - b.imag);
        lower.real = store_half(saturate(product(real, w.real) - product(imag, w.imag)));
        lower.imag = store_half(saturate(product(real, w.imag) + product(imag, w.real)));
        upper.real = store_half((std::int64_t{a.real} + b.real) * 65536);
        upper.imag = store_half((std::int64_t{a.imag} + b.imag) * 65536);
      }
}

void tp_dsp_bit_reverse(tp_i64 log2n, void* data) {
  host::Context::current().note_write();
  if (!is_sensible(log2n)) return;
  auto* points = static_cast<Pair*>(data);
  for (unsigned i = 0; i < 1u << log2n; ++i) {
    unsigned reversed = 0;
    for (int bit = 0; bit < log2n; ++bit) reversed |= (i >> bit & 1u) << (log2n - 1 - bit);
    if (reversed > i) std::swap(points[i], points[reversed]);
  }
}

}  // extern "C"
