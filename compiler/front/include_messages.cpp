// SPDX-License-Identifier: MIT
#include "include_messages.h"

#include "clang/Basic/SourceManager.h"
#include "clang/Lex/LexDiagnostic.h"
#include "clang/Lex/Preprocessor.h"
#include "include_finder.h"

namespace cc {

bool IncludeMessages::is_own_pi(const clang::Diagnostic& info) const {
  if (info.getID() != clang::diag::ext_pp_macro_redef || !pp_ ||
      info.getArgKind(0) != clang::DiagnosticsEngine::ArgumentKind::ak_identifierinfo)
    return false;
  const clang::IdentifierInfo* name = info.getArgIdentifier(0);
  const clang::MacroInfo* first = pp_->getMacroInfo(name);
  return name->isStr("PI") && first &&
         info.getSourceManager().getFilename(first->getDefinitionLoc()).endswith("libc/include/math.h");
}

void IncludeMessages::HandleDiagnostic(clang::DiagnosticsEngine::Level level, const clang::Diagnostic& info) {
  using clang::DiagnosticsEngine;
  const bool is_note = level == DiagnosticsEngine::Note;
  if (is_note && drops_note_) return;
  drops_note_ = is_own_pi(info);
  if (drops_note_) return;
  const std::string name = info.getID() != clang::diag::err_pp_file_not_found ? ""
                           : info.getArgKind(0) == DiagnosticsEngine::ArgumentKind::ak_c_string
                               ? info.getArgCStr(0)
                               : info.getArgStdStr(0);
  if (!is_refused(refused_, name)) return TextDiagnosticPrinter::HandleDiagnostic(level, info);
  ++NumErrors;  // what is not printed by the parent is not counted by it
  if (const clang::PresumedLoc at = info.getSourceManager().getPresumedLoc(info.getLocation()); at.isValid())
    out_ << at.getFilename() << ":" << at.getLine() << ":" << at.getColumn() << ": ";
  out_ << "error: " << readable_.refusal("include", name) << "\n";
}

}  // namespace cc
