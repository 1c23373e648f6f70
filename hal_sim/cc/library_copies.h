// SPDX-License-Identifier: MIT
// Copies of the e-puck library inside a project. Many projects carry the library along, whole or in parts.
// Its drivers reach hardware that the native way has no registers for (converter, codec, I2C, camera), partly
// in assembler, and a whole copy holds several variants of one function; so Twinpuck's own library takes the
// place of such files, and the build says so.
#pragma once
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace cc {

struct LibraryCopies {
  std::vector<std::filesystem::path> kept;      ///< sources to compile, in the order given
  std::vector<std::filesystem::path> replaced;  ///< sources that are left out
  std::vector<std::filesystem::path> roots;     ///< folders that hold a copy in the library's own folders
  std::vector<std::filesystem::path> replaced_whole;  ///< drivers that are ours, half assembler there
};

/// Splits a project's sources. Left out are files that lie below the project's folder where the library has
/// them (a_d/e_prox.c, codec/e_sound.c ...), and files that have only the name of a library's file and cannot
/// work here: they name a register that is not simulated, contain assembler, or belong to the camera's
/// driver.
LibraryCopies find_library_copies(const std::filesystem::path& project,
                                  const std::vector<std::filesystem::path>& sources);

/// The register way runs such files, as the robot's linker would run the library's archive: only those that
/// something asks for. Splits sources into the program's own (`kept`) and members (`replaced`). A whole copy
/// holds several variants of one function: those whose header the program includes come first, then the
/// library's usual choice, the advanced ones; of two files of one name the one nearer to the project's
/// folder.
///
/// A driver of which the original has one half in assembler (the fast camera's, the codec's) is taken from
/// Twinpuck's library as a whole (`replaced_whole`), unless the project's C files have the handler too. With
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
