// SPDX-License-Identifier: MIT
// What clang says of headers, but for those that are there and may not be read: it does not see them, and would
// say that they are missing. And but for a program's own PI, which is no second one: the C standard's math.h has
// none, ours has it for programs that rely on the compiler's.
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
  void BeginSourceFile(const clang::LangOptions& language, const clang::Preprocessor* pp) override {
    pp_ = pp ? pp : pp_;
    TextDiagnosticPrinter::BeginSourceFile(language, pp);
  }
  void HandleDiagnostic(clang::DiagnosticsEngine::Level level, const clang::Diagnostic& info) override;

 private:
  bool is_own_pi(const clang::Diagnostic& info) const;

  const clang::Preprocessor* pp_ = nullptr;
  bool drops_note_ = false;  // the next one, which says where the first PI is
  llvm::raw_ostream& out_;
  const ReadableFiles& readable_;
  const std::set<std::string>& refused_;
};

}  // namespace cc
