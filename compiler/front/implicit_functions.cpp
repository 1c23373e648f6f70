// SPDX-License-Identifier: MIT
// See implicit_functions.h.
#include "implicit_functions.h"

#include <set>

#include "clang/AST/ASTContext.h"
#include "clang/AST/Decl.h"
#include "clang/Basic/Builtins.h"
#include "clang/Sema/Lookup.h"
#include "clang/Sema/Sema.h"

namespace cc {
namespace {

using namespace clang;

class ImplicitFunctions : public ExternalSemaSource {
 public:
  explicit ImplicitFunctions(bool is_told) : is_told_(is_told) {}
  void InitializeSema(Sema& sema) override { sema_ = &sema; }
  void ForgetSema() override { sema_ = nullptr; }

  /// Asked for names that nothing declares.
  bool LookupUnqualified(LookupResult& result, Scope*) override {
    if (!sema_ || result.isForRedeclaration() || result.getLookupKind() != Sema::LookupOrdinaryName)
      return false;
    const IdentifierInfo* name = result.getLookupName().getAsIdentifierInfo();
    const unsigned id = name ? library_function(name->getName()) : 0;
    FunctionDecl* function = id ? declare(id, result) : nullptr;
    if (!function) return false;
    result.addDecl(function);
    result.resolveKind();
    return true;
  }

 private:
  /// clang's number of a function of the headers below; 0 for none.
  unsigned library_function(llvm::StringRef name) const {
    const Builtin::Context& known = sema_->Context.BuiltinInfo;
    for (unsigned id = 1; id < Builtin::FirstTSBuiltin; ++id) {
      const char* header = known.getHeaderName(id);
      if (!header || name != known.getName(id)) continue;
      for (const char* one : {"stdio.h", "stdlib.h", "string.h", "math.h", "ctype.h"})
        if (header == llvm::StringRef(one)) return id;
    }
    return 0;
  }

  FunctionDecl* declare(unsigned id, const LookupResult& result) {
    ASTContext& context = sema_->Context;
    ASTContext::GetBuiltinTypeError error = ASTContext::GE_None;
    const QualType type = context.GetBuiltinType(id, error);
    if (error != ASTContext::GE_None) return nullptr;  // it takes a FILE
    TranslationUnitDecl* unit = context.getTranslationUnitDecl();
    const SourceLocation at = result.getNameLoc();
    FunctionDecl* function =
        FunctionDecl::Create(context, unit, at, at, result.getLookupName(), type, nullptr, SC_Extern);
    if (const auto* prototype = type->getAs<FunctionProtoType>()) {
      SmallVector<ParmVarDecl*, 8> parameters;
      for (unsigned i = 0; i < prototype->getNumParams(); ++i) {
        parameters.push_back(ParmVarDecl::Create(context, function, at, at, nullptr,
                                                 prototype->getParamType(i), nullptr, SC_None, nullptr));
        parameters.back()->setScopeInfo(0, i);
      }
      function->setParams(parameters);
    }
    function->setImplicit();
    unit->addDecl(function);
    sema_->PushOnScopeChains(function, sema_->TUScope, /*AddToContext=*/false);
    if (is_told_ && told_.insert(id).second) {
      DiagnosticsEngine& diagnostics = sema_->Diags;
      diagnostics.Report(at, diagnostics.getCustomDiagID(DiagnosticsEngine::Warning,
                                                         "%0() is not declared here; expected #include <%1>"))
          << context.BuiltinInfo.getName(id) << context.BuiltinInfo.getHeaderName(id);
    }
    return function;
  }

  const bool is_told_;
  Sema* sema_ = nullptr;
  std::set<unsigned> told_;
};

}  // namespace

llvm::IntrusiveRefCntPtr<ExternalSemaSource> implicit_functions(bool is_told) {
  return llvm::makeIntrusiveRefCnt<ImplicitFunctions>(is_told);
}

}  // namespace cc
