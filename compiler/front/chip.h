// SPDX-License-Identifier: MIT
// From clang's syntax tree to the dsPIC30F's code generator (dspic30/llvm). Stages, in order:
//
//   target.cpp        what clang must know of the chip; XC16's attributes
//   accumulators.cpp  built-in functions of the DSP unit
//   lower.cpp         registers, attributes, bit-fields, lists of arguments: what the code generator takes
//   shared_reads.cpp  loads of what an interrupt may change, done where they stand
//   checks.cpp        --sanitize: locals and failed checks are told
//   pipeline.cpp      the optimiser's passes, in our own order
//   emit.cpp          object, assembler text or IR
#pragma once
#include "frontend.h"

namespace clang {
class TargetInfo;
class TargetOptions;
class ASTContext;
class Decl;
}  // namespace clang
namespace llvm {
class StringRef;
class TargetMachine;
class Value;
}  // namespace llvm

namespace cc {
struct Unit;

/// clang's notion of the chip: 16-bit int and pointers, double as wide as float.
clang::TargetInfo* make_chip_target(std::shared_ptr<clang::TargetOptions> options);

/// XC16's attributes that place a variable, in the parser's spelling (the token filter writes it so).
inline constexpr const char* kAttributePrefix = "tp_";
/// Gives variables whose attributes were read since the last call their sections.
void place_variables(clang::ASTContext& context);

/// Prefix of annotations by which attributes of functions and variables travel from clang to the
/// later stages: "dspic:save=_a,_b".
inline constexpr const char* kNote = "dspic:";
/// What the text of an annotation says behind it; empty when it is nobody's of ours.
llvm::StringRef note_in(const llvm::Value* text);

/// Variables of a function in an accumulator of the DSP unit, `register int x asm("A")`, get a note that ends
/// in its name.
void note_accumulators(clang::Decl* decl, clang::ASTContext& context);
inline constexpr const char* kAccumulatorNote = "accumulator ";
/// Built-in functions that take or give accumulators (__builtin_mac and its like) become instructions.
void lower_accumulators(Unit& unit);

/// --sanitize: what a check of the program's memory must be told, and clang's own checks in a form that costs
/// the chip little (checks.cpp). Before the optimiser.
void prepare_checks(Unit& unit);
/// Before the optimiser; false after an error.
bool lower_for_chip(Unit& unit);
void optimise_for_chip(Unit& unit, llvm::TargetMachine& machine);
/// All stages after the front end, and writes what the options ask for. The exit code of twinpuck-cc.
int compile_for_chip(Unit& unit);
/// A .s file instead of a .c file. The exit code of twinpuck-cc.
int assemble_for_chip(const Options& options);
/// Counts a message of assembler text, and ends the process, with exit code 1, after too many: a macro that uses
/// itself has a million.
void end_after_many(const std::string& file, unsigned& told);
/// What the vendor's compiler does with a .S file: #include, #define, #if. `text`: of the file, then the
/// result, with lines that say where each part is from; `found`: what it includes. False after an error.
bool preprocess_assembler(const Options& options, std::string& text, std::vector<std::string>& found);

}  // namespace cc
