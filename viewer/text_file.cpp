// SPDX-License-Identifier: MIT
#include "viewer/text_file.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <vector>

#include "compiler/cache/object_cache.h"
#include "sim_core/base/input_file.h"
#include "sim_core/base/utf8.h"

namespace viewer {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMark = "\xEF\xBB\xBF";
constexpr std::size_t kLongestFile = 16u << 20;  // bytes, of what is compared
constexpr std::size_t kLookAhead = 200;          // lines, for one that was moved down

struct Line {
  std::string_view text, end;
};

std::vector<Line> lines_of(std::string_view text) {
  std::vector<Line> lines;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    const std::size_t next = end + (text.substr(end, 2) == "\r\n" ? 2 : end < text.size() ? 1 : 0);
    lines.push_back({text.substr(at, end - at), text.substr(end, next - end)});
    if (next == end) break;
    at = next;
  }
  return lines;
}

bool is_utf8(std::string_view text) {
  for (std::size_t at = 0, length = 0; at < text.size(); at += length)
    if ((length = sim::utf8_length(text, at)) == 0) return false;
  return true;
}

std::string utf8_to_latin(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto u = static_cast<unsigned char>(text[i]);
    if (u < 0x80) {
      out += text[i];
    } else if (u == 0xC2 || u == 0xC3) {
      out += static_cast<char>((u & 3) << 6 | (static_cast<unsigned char>(text[++i]) & 0x3F));
    } else {
      const std::size_t end = text.find('\n', i);
      throw std::runtime_error("text: got '" +
                               text.substr(i, std::min<std::size_t>(end - i, u < 0xE0   ? 2
                                                                             : u < 0xF0 ? 3
                                                                                        : 4)) +
                               "', expected characters of Latin-1, as the file is written in");
    }
  }
  return out;
}

}  // namespace

std::string latin_to_utf8(std::string_view bytes) {
  std::string out;
  for (const char c : bytes) {
    const auto u = static_cast<unsigned char>(c);
    if (u >= 0x80) out += static_cast<char>(0xC0 | u >> 6);
    out += u < 0x80 ? c : static_cast<char>(0x80 | (u & 0x3F));
  }
  return out;
}

PlainText plain_text(const std::string& bytes) {
  std::string_view rest = bytes;
  if (rest.substr(0, kMark.size()) == kMark) rest.remove_prefix(kMark.size());
  PlainText plain;
  plain.is_latin = !is_utf8(rest);
  for (const Line& line : lines_of(rest)) {
    plain.text += line.text;
    if (!line.end.empty()) plain.text += '\n';
  }
  if (plain.is_latin) plain.text = latin_to_utf8(plain.text);
  return plain;
}

std::string bytes_like(const std::string& old, const std::string& text) {
  std::string_view was = old;
  const bool is_marked = was.substr(0, kMark.size()) == kMark;
  if (is_marked) was.remove_prefix(kMark.size());
  const std::string fresh = is_utf8(was) ? text : utf8_to_latin(text);
  const std::vector<Line> before = lines_of(was), now = lines_of(fresh);
  // what most lines end with
  std::array<std::pair<int, std::string_view>, 3> ends{{{0, "\n"}, {0, "\r\n"}, {0, "\r"}}};
  for (const Line& line : before)
    for (auto& [count, end] : ends) count += line.end == end;
  const std::string_view usual =
      std::max_element(ends.begin(), ends.end(), [](auto& a, auto& b) { return a.first < b.first; })->second;
  std::string out(is_marked ? kMark : std::string_view());
  std::size_t seen = 0;  // lines of `before` that lie above
  for (const Line& line : now) {
    out += line.text;
    std::string_view end = usual;
    for (std::size_t i = seen; i < std::min(before.size(), seen + kLookAhead); ++i)
      if (before[i].text == line.text) {
        if (!before[i].end.empty()) end = before[i].end;
        seen = i + 1;
        break;
      }
    if (!line.end.empty()) out += end;
  }
  return out;
}

std::string base_of(const std::string& bytes) { return cc::content_hash(bytes); }

std::optional<std::string> bytes_at(const std::string& path, std::size_t longest) {
  std::string bytes;
  if (!sim::read_input_file(path, longest, bytes).empty()) return std::nullopt;
  return bytes;
}

Stamp stamp_of(const std::string& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0) return {-1, -1};
  return {info.st_mtim.tv_sec * 1000000000ll + info.st_mtim.tv_nsec, info.st_size};
}

bool is_writable(const std::string& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0) return true;
  // root may write anything, and yet means it when a file is protected
  return (info.st_mode & 0222) != 0 && ::access(path.c_str(), W_OK) == 0;
}

std::string replace_file(const std::string& path, const std::string& bytes) {
  std::error_code none;
  const fs::path target = fs::weakly_canonical(path, none);  // a link goes on being one
  const std::string fresh =
      (target.parent_path() / (".#" + target.filename().string() + "." + std::to_string(::getpid())))
          .string();
  struct stat was {};
  const mode_t mode = ::stat(target.c_str(), &was) == 0 ? was.st_mode & 07777 : 0644;
  const int file = ::open(fresh.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, mode);
  const auto fail = [&] {
    const std::string why = std::strerror(errno);
    ::unlink(fresh.c_str());
    return path + ": cannot be written: " + why;
  };
  if (file < 0) return fail();
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = ::write(file, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    done += static_cast<std::size_t>(n);
  }
  const bool good = done == bytes.size() && ::fchmod(file, mode) == 0 && ::fsync(file) == 0;
  if (::close(file) != 0 || !good || ::rename(fresh.c_str(), target.c_str()) != 0) return fail();
  return "";
}

void replace_known(const std::string& path, const std::string& bytes, const std::string& base,
                   bool overwrite) {
  const std::string name = fs::path(path).filename().string();
  if (!is_writable(path)) throw Refusal(name + ": is read-only, and stays as it is", {{"readonly", true}});
  const auto there = bytes_at(path, kLongestFile);
  if (!overwrite && (there ? base_of(*there) : "") != base)
    throw Refusal(name + (there ? ": was changed on the disk by something else" : ": is gone from the disk"),
                  {{"conflict",
                    {{"base", there ? base_of(*there) : ""},
                     {"text", there ? nlohmann::json(plain_text(*there).text) : nlohmann::json()}}}});
  if (const std::string wrong = replace_file(path, bytes); !wrong.empty()) throw std::runtime_error(wrong);
}

void remove_left_over(const std::string& path) {
  std::error_code none;
  const fs::path target = fs::weakly_canonical(path, none);
  const std::string begin = ".#" + target.filename().string() + ".";
  for (fs::directory_iterator it(target.parent_path(), none), end; !none && it != end; it.increment(none)) {
    const std::string name = it->path().filename().string();
    if (name.compare(0, begin.size(), begin) != 0) continue;
    const std::string digits = name.substr(begin.size());
    if (digits.empty() || digits.size() > 9 || digits.find_first_not_of("0123456789") != std::string::npos)
      continue;
    if (::kill(std::stoi(digits), 0) != 0 && errno == ESRCH) fs::remove(it->path(), none);
  }
}

}  // namespace viewer
