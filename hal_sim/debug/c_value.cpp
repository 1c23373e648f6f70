// SPDX-License-Identifier: MIT
#include "hal_sim/debug/c_value.h"

#include <algorithm>
#include <cmath>

namespace debug {

namespace {

using Held = dspic::DebugInfo::Kind;

constexpr unsigned kIntBits = 16;

double rounded(double value, unsigned bits) {
  return bits <= 32 ? static_cast<double>(static_cast<float>(value)) : value;
}

std::int64_t whole_part(double value) {
  constexpr double kMost = 9.2e18;
  return std::isnan(value) ? 0 : static_cast<std::int64_t>(std::clamp(value, -kMost, kMost));
}

}  // namespace

std::uint64_t cut(std::uint64_t raw, unsigned bits, bool is_signed) {
  if (bits == 0 || bits >= 64) return raw;
  raw <<= 64 - bits;
  return is_signed ? static_cast<std::uint64_t>(static_cast<std::int64_t>(raw) >> (64 - bits))
                   : raw >> (64 - bits);
}

CValue integer(CType type, std::uint64_t raw) {
  CValue v;
  v.type = type;
  v.raw = cut(raw, type.bits, type.kind == CType::Kind::Signed);
  return v;
}

CValue real_number(CType type, double value) {
  CValue v;
  v.type = type;
  v.real = rounded(value, type.bits);
  return v;
}

CType promoted(CType t) {
  if (!t.is_integer() || t.bits > kIntBits) return t;
  return t.bits == kIntBits ? t : CType{};
}

CType common_type(CType a, CType b) {
  if (a.is_float() || b.is_float()) {
    CType wide = a.is_float() ? a : b;
    if (a.is_float() && b.is_float()) wide.bits = std::max(a.bits, b.bits);
    return wide;
  }
  a = promoted(a), b = promoted(b);
  if (a.kind == b.kind) return a.bits >= b.bits ? a : b;
  const CType& without_sign = a.kind == CType::Kind::Unsigned ? a : b;
  const CType& with_sign = a.kind == CType::Kind::Unsigned ? b : a;
  return without_sign.bits >= with_sign.bits ? without_sign : with_sign;
}

std::int64_t CValue::whole() const {
  return type.is_float() ? whole_part(real) : static_cast<std::int64_t>(raw);
}

CType type_of(const dspic::DebugInfo& debug, int index) {
  CType type;
  const auto* known = &debug.types[static_cast<std::size_t>(index)];
  while (known->kind == Held::Pointer) {
    ++type.stars;
    index = known->element;
    known = &debug.types[static_cast<std::size_t>(index)];
    constexpr int kMostStars = 16;  // of a hostile file
    if (type.stars == kMostStars) break;
  }
  type.bits = 8 * known->bytes;
  switch (known->kind) {
    case Held::Signed:
      type.kind = CType::Kind::Signed;
      break;
    case Held::Unsigned:
      type.kind = CType::Kind::Unsigned;
      type.is_truth = known->is_truth;
      break;
    case Held::Float:
      type.kind = CType::Kind::Float;
      break;
    case Held::Array:
    case Held::Struct:
      type.kind = CType::Kind::Image;
      type.index = index;
      break;
    default:
      type.kind = CType::Kind::Unknown;
  }
  return type;
}

CValue converted(const CValue& value, const CType& to) {
  CValue out;
  out.type = to;
  if (to.stars > 0) {
    out.raw = static_cast<std::uint64_t>(value.whole());
    return out;
  }
  if (to.kind == CType::Kind::Float) {
    const double number = value.type.is_float() ? value.real
                          : value.type.stars == 0 && value.type.kind == CType::Kind::Signed
                              ? static_cast<double>(static_cast<std::int64_t>(value.raw))
                              : static_cast<double>(value.raw);
    return real_number(to, number);
  }
  if (to.is_truth) return integer(to, value.is_true() ? 1 : 0);
  return integer(to, static_cast<std::uint64_t>(value.whole()));
}

}  // namespace debug
