// SPDX-License-Identifier: MIT
// A part of a page in docs/ that a program writes: the lines between "<!-- NAME: ... -->" and "<!-- end -->".
#pragma once
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

namespace tools {

/// Where the part's text begins and ends in the page; both npos: the page has no such part.
struct DocPart {
  std::size_t begin = std::string::npos, end = std::string::npos;
};

inline DocPart find_doc_part(const std::string& page, const std::string& name) {
  const std::size_t mark = page.find("<!-- " + name + ": ");
  if (mark == std::string::npos) return {};
  const std::size_t begin = page.find('\n', mark) + 1, end = page.find("<!-- end -->\n", mark);
  return begin == 0 || end == std::string::npos ? DocPart{} : DocPart{begin, end};
}

/// The page with this text as its part; empty: it has no such part.
inline std::string with_doc_part(const std::string& page, const std::string& name, const std::string& text) {
  const DocPart part = find_doc_part(page, name);
  if (part.end == std::string::npos) return "";
  return page.substr(0, part.begin) + text + page.substr(part.end);
}

/// main() of a program that prints a part, or writes it into the page that is named. Returns the exit code.
inline int write_doc_part(int argc, char** argv, const std::string& name, const std::string& text) {
  if (argc < 2) {
    std::cout << text << std::flush;
    return std::cout ? 0 : 2;
  }
  std::ifstream in(argv[1], std::ios::binary);
  std::ostringstream page;
  page << in.rdbuf();
  const std::string written = with_doc_part(page.str(), name, text);
  if (written.empty()) {
    std::cerr << argv[1] << ": got no '<!-- " << name << ": ... -->' and '<!-- end -->', expected both\n";
    return 2;
  }
  std::ofstream out(argv[1], std::ios::binary);
  out << written << std::flush;
  return out ? 0 : 2;
}

}  // namespace tools
