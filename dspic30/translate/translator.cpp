// SPDX-License-Identifier: MIT
// The compiler of stretches, in a library of its own: LLVM takes longer to load than most runs take.
#include <llvm/Bitcode/BitcodeReader.h>
#include <llvm/IR/LegacyPassManager.h>
#include <llvm/MC/TargetRegistry.h>
#include <llvm/Object/ELFObjectFile.h>
#include <llvm/Support/TargetSelect.h>
#include <llvm/Target/TargetMachine.h>

#include "dspic30/translate/machine_code.h"
#include "dspic30/translate/region.h"

extern "C" const char dspic_semantics[], dspic_semantics_end[];

namespace dspic::translate {

namespace {

using namespace llvm;

// --- an object file as machine code

/// Sections that are loaded, one behind the other, that of the instructions first.
std::map<object::SectionRef, std::uint64_t> laid_out(const object::ObjectFile& object, std::string& bytes) {
  std::map<object::SectionRef, std::uint64_t> places;
  for (const bool is_code : {true, false})
    for (const object::ELFSectionRef section : object.sections()) {
      if (!(section.getFlags() & ELF::SHF_ALLOC) || section.isText() != is_code || section.getSize() == 0)
        continue;
      bytes.resize(alignTo(bytes.size(), section.getAlignment()));
      places[section] = bytes.size();
      bytes += cantFail(section.getContents());
    }
  return places;
}

/// Whether each place that refers to another is one of 64 bits.
bool take_addresses(const object::ObjectFile& object, MachineCode& code) {
  const auto places = laid_out(object, code.bytes);
  for (const object::SectionRef section : object.sections()) {
    const auto holder =
        section.relocations().empty() ? places.end() : places.find(*cantFail(section.getRelocatedSection()));
    if (holder == places.end()) continue;
    for (const object::ELFRelocationRef relocation : section.relocations()) {
      const object::SymbolRef symbol = *relocation.getSymbol();
      const object::section_iterator home = cantFail(symbol.getSection());
      MachineCode::Address a;
      a.offset = static_cast<std::uint32_t>(holder->second + relocation.getOffset());
      a.addend = static_cast<std::uint32_t>(cantFail(relocation.getAddend()));
      if (home == object.section_end())
        a.name = cantFail(symbol.getName()).str();
      else if (const auto place = places.find(*home); place != places.end())
        a.addend += static_cast<std::uint32_t>(place->second + cantFail(symbol.getValue()));
      else
        return false;
      if (relocation.getType() != ELF::R_X86_64_64) return false;
      code.addresses.push_back(std::move(a));
    }
  }
  return true;
}

// --- the compiler

struct Compiler {
  LLVMContext context;
  std::unique_ptr<TargetMachine> machine;
  std::unique_ptr<Semantics> semantics;

  Compiler() {
    InitializeNativeTarget();
    InitializeNativeTargetAsmPrinter();
    std::string error;
    const Target* const target = TargetRegistry::lookupTarget(LLVM_HOST_TRIPLE, error);
    if (!target) return;
    TargetOptions options;
    options.EnableFastISel = false;
    // it may lie anywhere, and so may what it calls
    machine.reset(target->createTargetMachine(LLVM_HOST_TRIPLE, "", "", options, Reloc::Static,
                                              CodeModel::Large, CodeGenOpt::Default));
    const StringRef bitcode(dspic_semantics, static_cast<std::size_t>(dspic_semantics_end - dspic_semantics));
    if (auto module = getLazyBitcodeModule({bitcode, "semantics"}, context))
      semantics = std::make_unique<Semantics>(std::move(*module));
    else
      consumeError(module.takeError());
  }

  /// Empty: it cannot be done.
  SmallVector<char, 0> object_of(Module& module) const {
    SmallVector<char, 0> bytes;
    raw_svector_ostream out(bytes);
    legacy::PassManager passes;
    MCContext* context = nullptr;
    if (!machine->addPassesToEmitMC(passes, context, out)) passes.run(module);
    return bytes;
  }
};

}  // namespace
}  // namespace dspic::translate

/// For the program that loads this: one that was built of other headers has the core's fields elsewhere.
extern "C" const std::size_t dspic_translate_cpu_bytes = sizeof(dspic::Cpu);

/// `code` stays empty where something in the stretch cannot be translated, or on a machine that
/// LLVM does not know.
extern "C" void dspic_translate(const dspic::Cpu& cpu, const std::vector<dspic::translate::Item>& items,
                                dspic::translate::MachineCode& code) {
  static auto* const compiler = new dspic::translate::Compiler;
  if (!compiler->machine || !compiler->semantics) return;
  const auto module = dspic::translate::translate(*compiler->semantics, cpu, items, "stretch");
  if (!module) return;
  const auto bytes = compiler->object_of(*module);
  auto object = llvm::object::ObjectFile::createELFObjectFile({{bytes.data(), bytes.size()}, "stretch"});
  if (!object) {
    llvm::consumeError(object.takeError());
  } else if (!dspic::translate::take_addresses(**object, code)) {
    code = {};
  }
}
