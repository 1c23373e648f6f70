// SPDX-License-Identifier: MIT
// See files.h.
#include "files.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <set>

#include "sim_core/base/hash.h"
#include "sim_core/base/words.h"

namespace programs {

namespace {

/// Folders with thousands of files of others.
bool is_foreign(const fs::path& folder) {
  std::error_code none;
  const std::string name = folder.filename().string();
  return name[0] == '.' || name == "node_modules" || name == "__pycache__" || name == "site-packages" ||
         fs::exists(folder / "pyvenv.cfg", none);
}

/// Every entry below a folder, those of the folder itself first; `look` is false when it has seen enough.
template <typename Look>
void look_below(const fs::path& top, const Look& look) {
  std::set<std::pair<dev_t, ino_t>> seen;  // folders, so that links in a circle end
  std::vector<fs::path> folders = {top};
  for (std::size_t i = 0; i < folders.size() && i < kMostFiles; ++i) {
    std::error_code none, odd;
    struct stat folder;
    if (stat(folders[i].c_str(), &folder) == 0 && !seen.insert({folder.st_dev, folder.st_ino}).second)
      continue;
    std::vector<fs::path> entries;
    for (fs::directory_iterator it(folders[i], none), end; !none && it != end && entries.size() < kMostFiles;
         it.increment(none))
      entries.push_back(it->path());
    std::sort(entries.begin(), entries.end());
    for (const fs::path& entry : entries) {
      if (fs::is_directory(entry, odd)) {
        if (!is_foreign(entry)) folders.push_back(entry);
      } else if (!look(entry)) {
        return;
      }
    }
  }
}

}  // namespace

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  look_below(folder, [&](const fs::path& file) {
    std::error_code odd;  // what cannot be looked at is no source
    if (file.filename().string()[0] != '.' && fs::is_regular_file(file, odd)) files.push_back(file);
    return files.size() < kMostFiles;
  });
  std::sort(files.begin(), files.end());
  return files;
}

fs::path odd_file_below(const fs::path& folder) {
  fs::path found;
  look_below(folder, [&](const fs::path& file) {
    std::error_code odd;
    const fs::file_type type = fs::status(file, odd).type();
    const bool is_odd = type == fs::file_type::fifo || type == fs::file_type::character ||
                        type == fs::file_type::block || type == fs::file_type::socket;
    const bool is_read = is_c(file) || is_cxx(file) || is_header(file) || kind_of(file) == ".py" ||
                         file.filename() == "Makefile" || file.filename() == "runtime.ini";
    if (is_odd && is_read) found = file;
    return found.empty();
  });
  return found;
}

std::string text_of(const fs::path& file) {
  std::error_code odd;
  if (!fs::is_regular_file(file, odd)) return "";
  std::ifstream in(file, std::ios::binary);
  std::string text;
  std::array<char, 65536> part;
  while (text.size() < kMostText && (in.read(part.data(), part.size()) || in.gcount() > 0))
    text.append(part.data(), std::size_t(in.gcount()));
  return text;
}

std::string without_comments(const std::string& source) {
  std::string bare;
  bare.reserve(source.size());
  for (std::size_t i = 0; i < source.size(); ++i) {
    const char c = source[i], next = i + 1 < source.size() ? source[i + 1] : '\0';
    if (c == '/' && next == '/') {
      while (i < source.size() && source[i] != '\n') ++i;
      bare += '\n';
    } else if (c == '/' && next == '*') {
      const std::size_t end = source.find("*/", i + 2);
      i = end == std::string::npos ? source.size() : end + 1;
      bare += ' ';
    } else if (c == '"' || c == '\'') {
      bare += c;
      for (++i; i < source.size() && source[i] != c && source[i] != '\n'; ++i)
        if (source[i] == '\\') ++i;
      bare += c;
    } else {
      bare += c;
    }
  }
  return bare;
}

bool defines_main(const std::string& bare) {
  const auto is_name = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  const auto is_blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  for (std::size_t at = 0; (at = bare.find("main", at)) != std::string::npos; at += 4) {
    if (at > 0 && (is_name(bare[at - 1]) || bare[at - 1] == '.' || bare[at - 1] == ':')) continue;
    std::size_t i = at + 4;
    while (i < bare.size() && is_blank(bare[i])) ++i;
    if (i >= bare.size() || bare[i] != '(') continue;
    int level = 0;
    for (; i < bare.size(); ++i) {
      level += bare[i] == '(' ? 1 : bare[i] == ')' ? -1 : 0;
      if (level == 0) break;
    }
    // a body follows, or parameters of old C and then a body; a call is followed by ; or an operator
    for (++i; i < bare.size() && is_blank(bare[i]);) ++i;
    if (i < bare.size() && bare[i] == '{') return true;
    if (i < bare.size() && is_name(bare[i])) {
      const std::size_t body = bare.find('{', i), other = bare.find_first_of("()}", i);
      if (body != std::string::npos && body < other) return true;
    }
  }
  return false;
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

std::string kind_of(const fs::path& file) {
  const std::string kind = file.extension().string();
  return kind == ".C" ? ".cpp" : lower_case(kind);
}
bool is_c(const fs::path& file) { return kind_of(file) == ".c"; }
bool is_cxx(const fs::path& file) {
  const std::string kind = kind_of(file);
  return kind == ".cpp" || kind == ".cc" || kind == ".cxx" || kind == ".c++";
}
bool is_header(const fs::path& file) {
  const std::string kind = kind_of(file);
  return kind == ".h" || kind == ".hpp" || kind == ".hh" || kind == ".hxx";
}

fs::path resolve(const fs::path& folder, const std::string& name) {
  std::string plain = name;
  std::replace(plain.begin(), plain.end(), '\\', '/');
  std::error_code none;
  fs::path direct = folder / plain;
  if (fs::is_regular_file(direct, none)) return direct;
  // part by part, in any case
  fs::path at = fs::path(plain).is_absolute() ? fs::path("/") : folder;
  for (const fs::path& part : fs::path(plain).relative_path()) {
    if (part == "." || part == ".." || fs::exists(at / part, none)) {
      at /= part;
      continue;
    }
    std::vector<fs::path> same;
    for (fs::directory_iterator it(at, none), end; !none && it != end; it.increment(none))
      if (lower_case(it->path().filename().string()) == lower_case(part.string())) same.push_back(it->path());
    if (same.empty()) return {};
    at = *std::min_element(same.begin(), same.end());
  }
  return fs::is_regular_file(at, none) ? at : fs::path();
}

fs::path on_path(const std::string& name) {
  std::error_code none;
  const auto can_run = [&](const fs::path& file) {
    return fs::is_regular_file(file, none) && access(file.c_str(), X_OK) == 0;
  };
  if (name.empty()) return {};
  if (name.find('/') != std::string::npos) return can_run(name) ? fs::absolute(name, none) : fs::path();
  const char* path = std::getenv("PATH");
  for (const std::string& folder : sim::words_of(path ? path : "/usr/bin:/bin", ":"))
    if (can_run(fs::path(folder) / name)) return fs::absolute(fs::path(folder) / name, none);
  return {};
}

std::vector<std::string> names_of(const fs::path& folder) {
  std::error_code none;
  fs::path whole = fs::absolute(folder, none).lexically_normal();
  if (whole.filename().empty()) whole = whole.parent_path();
  std::vector<std::string> names = {whole.filename().string()};
  const std::string real = fs::weakly_canonical(whole, none).filename().string();
  if (real != names[0]) names.push_back(real);
  return names;
}

std::uint64_t hash_of(std::uint64_t h, const std::string& bytes) {
  for (const unsigned char c : bytes) h = sim::fold(h, std::uint64_t{c});
  return sim::fold(h, std::uint64_t{bytes.size()});
}

}  // namespace programs
