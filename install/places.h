// SPDX-License-Identifier: MIT
// The one answer to where this product lies and where it may write. Everything is found from where the
// program, or the library that holds this code, lies now; a clone or an installed tree that was moved works.
//
//   run from a build folder                   installed below PREFIX
//   share_root()   the clone                  PREFIX/share/twinpuck
//   tools_folder() the build folder           PREFIX/lib/twinpuck
//   page_folder()  the build folder's page/   PREFIX/lib/twinpuck/page
//
// None of these is ever written to. What is made goes where the user says, or to cache_folder().
#pragma once
#include <filesystem>
#include <string>

namespace places {

/// Holds firmware/, worlds/, docs/ and the rest that people name: TWINPUCK_ROOT where that is
/// set, else product_share().
std::filesystem::path share_root();

/// Holds what belongs to this very compiler: firmware/include, firmware/libc, firmware/library,
/// hal_dspic. Empty path when the program lies neither in a build folder nor below a PREFIX, and no
/// `twinpuck` on PATH does.
std::filesystem::path product_share();

/// What files of product_share() are called in what was compiled with the product: below this folder,
/// wherever they lay and wherever they lie. It is right where the Debian package is installed.
inline constexpr const char* kUsualShare = "/usr/share/twinpuck";

/// Holds twinpuck-cc, twinpuck-translate.so, libcontroller.so, Controller.jar and library/, the objects that
/// are linked behind every program.
std::filesystem::path tools_folder();

/// Holds the page of the live view and of reports; it may not have been built.
std::filesystem::path page_folder();

/// The command `twinpuck` that belongs to this product.
std::filesystem::path command_file();

/// Whether this was installed, so share_root() is nobody's to write to.
bool is_installed();

/// The user's folder `name` for what can be made again; it is made if need be, for the user alone. The first
/// of these that the user owns and may write to, and whose disk is not full: $XDG_CACHE_HOME/twinpuck,
/// $HOME/.cache/twinpuck, twinpuck-UID in the temporary folder. Where none will do, the first of them:
/// whoever writes there then reports it, with why_not_writable().
std::filesystem::path cache_folder(const std::string& name);

/// "" when files can be made in `folder`, which is made if need be, and its disk has 1 MB left; else a line
/// for the user: "FOLDER: cache: got Read-only file system, expected a folder that can be written; set
/// XDG_CACHE_HOME to one".
std::string why_not_writable(const std::filesystem::path& folder);

}  // namespace places
