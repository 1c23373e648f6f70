// SPDX-License-Identifier: MIT
// The terminal that a picture stands on: only what differs from the picture before is written, keys are read
// without Enter, and what was there before comes back at every end. The environment says what it can do:
// NO_COLOR (any text) no colours, TERM=dumb no escapes at all: then lines of text follow one another.
#pragma once
#include <string>

#include "outputs/terminal_view.h"

namespace outputs {

/// What of a picture a terminal has to be told.
class TerminalPainter {
 public:
  /// Bytes that make the last picture this one; all of it where its size is another.
  std::string changes(const TerminalPicture& picture);

 private:
  TerminalPicture shown_;
};

/// What the environment says of the terminal.
struct TerminalKind {
  bool colours = true;
  bool is_dumb = false;
  static TerminalKind of_environment();
};

/// The terminal belongs to the run as long as this lives. One at a time.
class TerminalScreen {
 public:
  /// `kind.is_dumb`: nothing is written but lines.
  explicit TerminalScreen(TerminalKind kind);
  ~TerminalScreen();
  TerminalScreen(const TerminalScreen&) = delete;
  TerminalScreen& operator=(const TerminalScreen&) = delete;

  /// The terminal's size now; 80 by 24 where it does not say one.
  static TerminalSize size();
  /// False where keys cannot be read: stdin is no terminal.
  bool has_keys() const { return has_keys_; }
  /// The key that was pressed; 0: none. Never waits.
  char key() const;
  void show(const TerminalPicture& picture);
  /// A line of plain text, on a dumb terminal.
  void line(const std::string& text);
  bool is_dumb() const { return kind_.is_dumb; }
  /// From any thread, and twice, too.
  static void give_back();

 private:
  TerminalKind kind_;
  bool has_keys_ = false;
  TerminalPainter painter_;
};

}  // namespace outputs
