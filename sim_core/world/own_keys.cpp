// SPDX-License-Identifier: MIT
#include "sim_core/world/own_keys.h"

#include <cstdlib>

#include "sim_core/base/check.h"

namespace sim {

namespace {

/// The numbers in a default such as "0.1" or "[0.03, 0]".
std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> out;
  for (const char* p = text.c_str(); *p;) {
    char* end = nullptr;
    const double value = std::strtod(p, &end);
    if (end == p) {
      ++p;
    } else {
      out.push_back(value);
      p = end;
    }
  }
  return out;
}

}  // namespace

const OwnKey& OwnSettings::key_of(const std::string& key) const {
  for (const OwnKey& k : *keys_)
    if (k.key == key) return k;
  CHECK(false, "somebody asks for a key that the kind does not list");
  return keys_->front();
}

const OwnValue* OwnSettings::written(const std::string& key) const {
  const auto found = values_.find(key);
  return found == values_.end() ? nullptr : &found->second;
}

std::vector<double> OwnSettings::numbers(const std::string& key) const {
  const OwnKey& k = key_of(key);
  const OwnValue* value = written(key);
  return value ? value->numbers : numbers_in(k.fallback);
}

double OwnSettings::number(const std::string& key) const {
  const std::vector<double> all = numbers(key);
  CHECK(!all.empty(), "somebody asks for the number of a key that has none and no default");
  return all.front();
}

bool OwnSettings::flag(const std::string& key) const {
  const OwnKey& k = key_of(key);
  const OwnValue* value = written(key);
  return value ? value->flag : k.fallback == "true";
}

std::string OwnSettings::text(const std::string& key) const {
  const std::string& f = key_of(key).fallback;  // in quotes
  if (const OwnValue* value = written(key)) return value->text;
  return f.size() >= 2 && f.front() == '"' ? f.substr(1, f.size() - 2) : std::string();
}

}  // namespace sim
