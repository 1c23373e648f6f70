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
#include "viewer/text_file.h"

namespace viewer {

class Document {
 public:
  /// `bytes`: what `file` holds.
  Document(std::string file, std::string bytes);

  const std::string& file() const { return file_; }
  /// With lines that end with LF, whatever the file's end with.
  const sim::WorldText& text() const { return text_; }
  /// Names the text.
  std::string base() const;
  const sim::LoadedWorld& loaded() const { return loaded_; }
  bool is_saved() const { return text_.text() == saved_text_; }
  bool can_undo() const { return !undo_.empty(); }
  bool can_redo() const { return !redo_.empty(); }

  /// An edit (docs/connecting.md, "edit"), or a list of them in `edits`: all or none. Returns the ids of
  /// what is new, 0 for an edit that makes nothing. Throws std::runtime_error when it cannot be done,
  /// Refusal with `conflict` when the text is another than the one that was edited. Edits of one `group`
  /// other than 0 are undone together.
  std::vector<int> edit(const nlohmann::json& request);
  /// As it was before the last edit(), as if that had not been.
  void take_back();
  bool undo();
  bool redo();
  /// The pieces of these ids, as they are written.
  std::string text_of(const std::vector<int>& ids) const;

  /// Over the file as it was read; else Refusal (text_file.h), if it is not to be overwritten. Throws
  /// std::runtime_error when the disk does not take it.
  void save(bool overwrite);
  /// Likewise as another file, of `folder`, which is then this one's.
  void save_as(const std::string& folder, const std::string& name, bool overwrite);
  /// What is on the disk becomes the text, as one edit. Throws std::runtime_error when there is nothing.
  void reload();
  /// Has the file become another since it was read, written or looked at? Its base, "" when it is gone.
  std::optional<std::string> disk_change();

 private:
  void put(sim::WorldText next, int group);
  std::vector<int> edit_one(sim::WorldText& next, const nlohmann::json& request) const;
  std::vector<int> paste(sim::WorldText& next, const nlohmann::json& request) const;
  void disk_holds(std::string bytes);
  void remember(int group);
  void load();
  bool go_to_last(std::vector<sim::WorldText>& from, std::vector<sim::WorldText>& back);
  std::string file_, bytes_, saved_text_;  // what the file held when it was read or written, and its text
  std::string disk_;                       // base of what it holds
  bool is_new_ = false;                    // it was not there when it was opened
  Stamp stamp_;                            // its time, ns, and size, then
  sim::WorldText text_;
  sim::LoadedWorld loaded_;
  sim::KnownWorld known_;
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

}  // namespace viewer
