// SPDX-License-Identifier: MIT
// Looks at the tokens on their way to clang's parser: where it is, should it not come back (crash_words.h), and
// elements of arrays that no memory of the chip could have, for whose list clang would take minutes.
#pragma once
#include "clang/Basic/SourceManager.h"
#include "clang/Lex/Preprocessor.h"

namespace cc {

/// "main.c:12:5" of a place in what is compiled; "": there is none.
std::string place_text(const clang::SourceManager& sources, clang::SourceLocation at);

class TokenWatch {
 public:
  explicit TokenWatch(clang::Preprocessor& pp) : pp_(pp) {}
  void operator()(const clang::Token& token);

 private:
  void check_element(const clang::Token& token);

  clang::Preprocessor& pp_;
  bool begins_statement_ = true;
  bool is_in_designator_ = false;  // between the brackets of "{[3 ... 5] = 1}"
  clang::tok::TokenKind before_ = clang::tok::unknown;
};

}  // namespace cc
