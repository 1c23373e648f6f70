// SPDX-License-Identifier: MIT
// A part of a page in docs/ that is made: the lines between "<!-- NAME: ... -->" and "<!-- end -->".
#pragma once
#include <string>

namespace dev {

/// The page with this text as its part; empty: it has no such part.
inline std::string with_doc_part(const std::string& page, const std::string& name, const std::string& text) {
  const std::size_t mark = page.find("<!-- " + name + ": ");
  if (mark == std::string::npos) return "";
  const std::size_t begin = page.find('\n', mark) + 1, end = page.find("<!-- end -->\n", mark);
  if (begin == 0 || end == std::string::npos) return "";
  return page.substr(0, begin) + text + page.substr(end);
}

}  // namespace dev
