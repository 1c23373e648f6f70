// SPDX-License-Identifier: MIT
// The world file as the page edits it: text, what the loader makes of it, undo and redo, saving. The file on
// disk is either the old or the new one whatever happens while it is written.
#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim_core/load/world_loader.h"
#include "sim_core/load/world_text.h"

namespace viewer {

class Document {
 public:
  Document(std::string file, std::string text);

  const std::string& file() const { return file_; }
  const sim::WorldText& text() const { return text_; }
  const sim::LoadedWorld& loaded() const { return loaded_; }
  bool is_saved() const { return text_.text() == saved_; }
  bool can_undo() const { return !undo_.empty(); }
  bool can_redo() const { return !redo_.empty(); }

  /// One edit (docs/connecting.md, "edit"). Returns the id of what is new, otherwise 0. Throws
  /// std::runtime_error when it cannot be done. Edits of one `group` other than 0 are undone together.
  int edit(const nlohmann::json& request);
  /// As it was before the last edit(), as if that had not been.
  void take_back();
  bool undo();
  bool redo();
  /// Returns an empty string, or what is wrong. `name`: another file of the same folder; empty: the same.
  std::string save(const std::string& name);

 private:
  void remember(int group);
  void load();

  std::string file_, saved_;
  sim::WorldText text_;
  sim::LoadedWorld loaded_;
  std::vector<sim::WorldText> undo_, redo_;
  struct Before {
    sim::WorldText text;
    std::vector<sim::WorldText> redo;
    bool remembered;
    int group;
  };
  std::optional<Before> before_;  // of the last edit
  int group_ = 0;
};

/// Writes a file so that it is the old or the new one at every instant. Empty, or what is wrong.
std::string replace_file(const std::string& path, const std::string& bytes);

}  // namespace viewer
