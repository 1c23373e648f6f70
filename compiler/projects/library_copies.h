// SPDX-License-Identifier: MIT
// Copies of the e-puck library inside a project. Many projects carry the library along, whole or in parts,
// and a whole copy holds several variants of one function. It is linked as the robot's linker would link an
// archive: only those files that something asks for.
#pragma once
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace cc {

struct LibraryCopies {
  std::vector<std::filesystem::path> kept;      ///< the program's own sources, in the order given
  std::vector<std::filesystem::path> members;   ///< of the copy, those to be linked first come first
  std::vector<std::filesystem::path> left_out;  ///< drivers that are ours, half assembler there
};

/// Splits a project's sources into the program's own and members of a copy of the library. Of two variants of
/// one function that one comes first whose header the program includes, then the library's usual choice, the
/// advanced one; of two files of one name the one nearer to the project's folder.
///
/// A driver of which the original has one half in assembler (the fast camera's, the codec's) is taken from
/// Twinpuck's library as a whole (`left_out`), unless the project's C files have the handler too. With
/// the fast camera goes the slow one that lies beside it: the same functions, which nobody asked for.
/// `unlisted`: sources that the project file does not name; what it names wins. `assembler`: the program's
/// files that are assembled, which may have the other halves.
LibraryCopies find_library_members(const std::filesystem::path& project,
                                   const std::vector<std::filesystem::path>& sources,
                                   const std::set<std::filesystem::path>& unlisted = {},
                                   const std::vector<std::filesystem::path>& assembler = {});

/// File names differ in case from system to system: `text` in lower case.
std::string lower(std::string text);

/// The place in the library that a file has by its folder and its name ("a_d/e_prox.c"), "" for none.
std::string library_place(const std::filesystem::path& source);

std::string without_comments(const std::string& text);

/// What an assembler source defines, by its names in C.
std::vector<std::string> functions_in_assembler(const std::filesystem::path& file);

/// Whether an assembler source has the name of one of the library's, which Twinpuck's library has in C.
bool is_library_assembler(const std::filesystem::path& file);

/// Whether such a file lies where the library has it, "codec/e_isr_dci.s".
bool is_in_library_folder(const std::filesystem::path& assembler);

/// The line that tells of it; "" when nothing was left out.
std::string library_copies_message(const std::filesystem::path& project, const LibraryCopies& copies);

}  // namespace cc
