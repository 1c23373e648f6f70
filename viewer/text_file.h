// SPDX-License-Identifier: MIT
// A text file that several editors may write: read as lines, written back with the line ends, the mark at its
// beginning and the encoding that it had, and only over what was read before.
#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace viewer {

/// A request that is not done; `more` goes into its answer beside the sentence.
class Refusal : public std::runtime_error {
 public:
  Refusal(const std::string& sentence, nlohmann::json more)
      : std::runtime_error(sentence), more_(std::move(more)) {}
  const nlohmann::json& more() const { return more_; }

 private:
  nlohmann::json more_;
};

/// Each byte as the character of Latin-1 that it is.
std::string latin_to_utf8(std::string_view bytes);

/// Text as a page shows it: UTF-8, lines end with LF, no byte order mark.
struct PlainText {
  std::string text;
  bool is_latin = false;  ///< the bytes are no UTF-8: each is a character of Latin-1
};
PlainText plain_text(const std::string& bytes);
/// `text` as bytes, written as `old` is: its mark, encoding and line ends; lines that `old` has, too, keep
/// theirs, others get what most have. Throws std::runtime_error where Latin-1 has no such character.
std::string bytes_like(const std::string& old, const std::string& text);

/// Names a content; equal contents have equal names.
std::string base_of(const std::string& bytes);
/// What lies at `path`; nothing: it is gone or cannot be read. At most `longest` bytes.
std::optional<std::string> bytes_at(const std::string& path, std::size_t longest);
/// Time of the last change, ns, and size, bytes; both -1: it is not there.
using Stamp = std::pair<long long, long long>;
Stamp stamp_of(const std::string& path);
/// Has it a permission to be written? True of a file that is not there.
bool is_writable(const std::string& path);

/// Writes a file so that it is the old or the new one at every instant. Empty, or what is wrong.
std::string replace_file(const std::string& path, const std::string& bytes);
/// The same, if the file holds what `base` names or is to be overwritten. Throws Refusal with `conflict`
/// {base, text} or `readonly`, std::runtime_error when the disk does not take it.
void replace_known(const std::string& path, const std::string& bytes, const std::string& base,
                   bool overwrite);
/// Removes what writers of `path` left that died in the middle.
void remove_left_over(const std::string& path);

}  // namespace viewer
