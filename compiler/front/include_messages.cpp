// SPDX-License-Identifier: MIT
#include "include_messages.h"

#include "clang/Basic/SourceManager.h"
#include "clang/Lex/LexDiagnostic.h"
#include "include_finder.h"

namespace cc {

void IncludeMessages::HandleDiagnostic(clang::DiagnosticsEngine::Level level, const clang::Diagnostic& info) {
  using clang::DiagnosticsEngine;
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
