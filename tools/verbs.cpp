// SPDX-License-Identifier: MIT
#include "tools/verbs.h"

#include <fmt/format.h>

#include <iostream>

namespace tools {

void complain(const std::vector<std::string>& problems) {
  for (const auto& p : problems) std::cerr << p << '\n';
}

CLI::Validator between(double least, double most) {
  return CLI::Validator(
      [least, most](std::string& text) {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && value >= least && value <= most) return std::string();
        return fmt::format("got {}, expected {:g} to {:g}", text, least, most);
      },
      fmt::format("{:g} to {:g}", least, most));
}

}  // namespace tools
