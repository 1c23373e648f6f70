// SPDX-License-Identifier: MIT
// What clang says of headers, but for those that are there and may not be read: it does not see them, and would
// say that they are missing.
#pragma once
#include <set>
#include <string>

#include "clang/Frontend/TextDiagnosticPrinter.h"
#include "compiler/cache/readable_files.h"

namespace cc {

class IncludeMessages : public clang::TextDiagnosticPrinter {
 public:
  /// `refused`: names that bounded_file_system() did not show.
  IncludeMessages(llvm::raw_ostream& out, clang::DiagnosticOptions* options, const ReadableFiles& readable,
                  const std::set<std::string>& refused)
      : TextDiagnosticPrinter(out, options), out_(out), readable_(readable), refused_(refused) {}
  void HandleDiagnostic(clang::DiagnosticsEngine::Level level, const clang::Diagnostic& info) override;

 private:
  llvm::raw_ostream& out_;
  const ReadableFiles& readable_;
  const std::set<std::string>& refused_;
};

}  // namespace cc
