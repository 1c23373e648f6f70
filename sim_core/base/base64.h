// SPDX-License-Identifier: MIT
// Bytes within JSON and HTML.
#pragma once
#include <string>

namespace sim {

std::string base64(const std::string& bytes);

}  // namespace sim
