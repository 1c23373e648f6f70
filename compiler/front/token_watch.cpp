// SPDX-License-Identifier: MIT
#include "token_watch.h"

#include "compiler/cache/crash_words.h"

namespace cc {

using namespace clang;

std::string place_text(const SourceManager& sources, SourceLocation where) {
  const PresumedLoc at = sources.getPresumedLoc(sources.getExpansionLoc(where));
  return at.isValid() ? std::string(at.getFilename()) + ":" + std::to_string(at.getLine()) + ":" +
                            std::to_string(at.getColumn())
                      : "";
}

void TokenWatch::operator()(const Token& token) {
  if (begins_statement_) note_place(place_text(pp_.getSourceManager(), token.getLocation()));
  begins_statement_ = token.isOneOf(tok::semi, tok::l_brace, tok::r_brace);
  if (token.is(tok::l_square)) is_in_designator_ = before_ == tok::l_brace || before_ == tok::comma;
  if (token.is(tok::numeric_constant) && is_in_designator_) check_element(token);
  if (token.is(tok::r_square)) is_in_designator_ = false;
  before_ = token.getKind();
}

void TokenWatch::check_element(const Token& token) {
  // clang counts them in the chip's int; the window into flash has so many bytes and one more, RAM has fewer
  constexpr unsigned long long kMostElements = 0x7FFF;
  if (before_ != tok::l_square && before_ != tok::ellipsis) return;
  const std::string written = pp_.getSpelling(token);
  unsigned long long number = 0;
  const llvm::StringRef digits = llvm::StringRef(written).rtrim("uUlL");
  const bool is_number = !digits.getAsInteger(0, number);
  const bool is_too_long = !is_number && digits.size() > 20;
  if ((is_number && number < kMostElements) || (!is_number && !is_too_long)) return;
  auto& d = pp_.getDiagnostics();
  d.Report(token.getLocation(),
           d.getCustomDiagID(DiagnosticsEngine::Error,
                             "array: got element %0, expected below %1: no memory of the chip holds more"))
      << written << std::to_string(kMostElements);
  // the parser gets the last one that there may be, so that it makes no list of them
  static constexpr llvm::StringLiteral kLast = "32766";
  auto& last = const_cast<Token&>(token);
  last.setLiteralData(kLast.data());
  last.setLength(unsigned(kLast.size()));
}

}  // namespace cc
