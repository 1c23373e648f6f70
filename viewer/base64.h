// SPDX-License-Identifier: MIT
// Bytes within JSON and HTML.
#pragma once
#include <string>

namespace viewer {

std::string base64(const std::string& bytes);

}  // namespace viewer
