// SPDX-License-Identifier: MIT
#include "dspic30/load/line_table.h"

#include <gelf.h>
#include <libelf.h>

#include <cstring>

#include "dspic30/load/cursor.h"
#include "dspic30/load/debug_info.h"
#include "dspic30/load/rows.h"

namespace dspic {

namespace {

constexpr std::size_t kMostLines = 1u << 20;  // of a hostile file

/// One unit's line program [DWARF 4, 6.2].
class LineProgram {
 public:
  LineProgram(LineTable& table, Cursor unit, std::string folder)
      : table_(table), unit_(unit), folder_(std::move(folder)) {}

  void run(std::uint32_t place) {
    if (!read_head()) return;
    table_.unit_files[place] = files_;
    while (!unit_.is_at_end() && table_.rows.size() < kMostLines) {
      const std::uint8_t code = unit_.byte();
      if (code >= opcode_base_)
        special(code);
      else if (code == 0)
        extended();
      else
        standard(code);
    }
  }

 private:
  enum Standard {
    Copy = 1,
    AdvancePc,
    AdvanceLine,
    SetFile,
    SetColumn,
    NegateStatement,
    Block,
    ConstAddPc,
    FixedAdvancePc,
    PrologueEnd
  };
  enum Extended { EndSequence = 1, SetAddress, DefineFile };

  bool read_head() {
    const unsigned version = unit_.number(2);
    if (version < 2 || version > 4) return false;
    const std::uint32_t length = unit_.number(4);
    Cursor head = unit_.part(length);
    shortest_ = head.byte();
    if (version == 4) head.byte();  // operations an instruction
    starts_statement_ = head.byte() != 0;
    line_base_ = (head.byte() ^ 0x80) - 0x80;  // it has a sign
    line_range_ = head.byte();
    opcode_base_ = head.byte();
    if (line_range_ == 0 || opcode_base_ == 0) return false;
    for (int i = 1; i < opcode_base_; ++i) operands_.push_back(head.byte());
    std::vector<std::string> folders{""};
    for (std::string folder; !(folder = head.text()).empty();) folders.push_back(folder);
    std::vector<std::string> whole(folders.size());  // of those that files lie in
    for (std::string name; !(name = head.text()).empty();) {
      const std::size_t folder = head.leb();
      head.leb();
      head.leb();
      const bool is_known = folder < folders.size();
      if (is_known && whole[folder].empty()) whole[folder] = whole_path(folder_, folders[folder]);
      files_.push_back(file_number(whole_path(is_known ? whole[folder] : folder_, name)));
    }
    begin();
    return true;
  }

  std::uint16_t file_number(std::string name) {
    if (const std::string& from = table_.moved_from; !from.empty() && name.rfind(from + "/", 0) == 0)
      name.replace(0, from.size(), table_.moved_to);
    const auto known = std::find(table_.files.begin(), table_.files.end(), name);
    if (known != table_.files.end()) return static_cast<std::uint16_t>(known - table_.files.begin());
    if (table_.files.size() >= 0xFFFF) return 0;
    table_.files.push_back(name);
    return static_cast<std::uint16_t>(table_.files.size() - 1);
  }

  void begin() {
    sequence_ = table_.rows.size();
    row_ = {};
    row_.is_statement = starts_statement_;
    file_ = 1;
    line_ = 1;
  }
  void emit() {
    row_.line = file_ - 1 < files_.size() ? std::max(0, line_) : 0;
    row_.file = row_.line ? files_[file_ - 1] : std::uint16_t{0};
    table_.rows.push_back(row_);
    row_.is_body = false;
  }
  void advance(std::uint32_t instructions) { row_.address += instructions * shortest_; }

  void special(std::uint8_t code) {
    const int adjusted = code - opcode_base_;
    advance(static_cast<std::uint32_t>(adjusted / line_range_));
    line_ += line_base_ + adjusted % line_range_;
    emit();
  }

  void extended() {
    Cursor rest = unit_.part(unit_.leb());
    switch (rest.byte()) {
      case EndSequence:
        row_.is_end = true;
        emit();
        table_.rows.back().line = 0;
        // what the linker left out stands at 0, where no C code can be
        if (table_.rows[sequence_].address == 0) {
          const auto from = table_.rows.begin() + static_cast<std::ptrdiff_t>(sequence_);
          if (table_.left_out.size() < kMostLines)
            table_.left_out.insert(table_.left_out.end(), from, table_.rows.end());
          table_.rows.erase(from, table_.rows.end());
        }
        return begin();
      case SetAddress:
        row_.address = rest.number(rest.left());
        return;
      case DefineFile:
        files_.push_back(file_number(whole_path(folder_, rest.text())));
        return;
      default:
        return;
    }
  }

  void standard(std::uint8_t code) {
    switch (code) {
      case Copy:
        return emit();
      case AdvancePc:
        return advance(unit_.leb());
      case AdvanceLine:
        line_ += unit_.signed_leb();
        return;
      case SetFile:
        file_ = unit_.leb();
        return;
      case NegateStatement:
        row_.is_statement = !row_.is_statement;
        return;
      case ConstAddPc:
        return advance(static_cast<std::uint32_t>((255 - opcode_base_) / line_range_));
      case FixedAdvancePc:
        row_.address += unit_.number(2);
        return;
      case PrologueEnd:
        row_.is_body = true;
        return;
      default:
        for (int i = 0; i < operands_[code - 1u]; ++i) unit_.leb();
    }
  }

  LineTable& table_;
  Cursor unit_;
  std::string folder_;  // that names are relative to; empty: not known
  std::vector<std::uint8_t> operands_;
  std::vector<std::uint16_t> files_;  // numbers in the map; the unit counts from 1
  bool starts_statement_ = true;
  int line_base_ = 0, line_range_ = 1, opcode_base_ = 1, line_ = 1;
  std::uint32_t shortest_ = 1, file_ = 1;
  std::size_t sequence_ = 0;  // its first row
  LineTable::Row row_;
};

}  // namespace

std::string whole_path(const std::string& folder, const std::string& path) {
  const auto is_letter = [](char c) { return (c | 0x20) >= 'a' && (c | 0x20) <= 'z'; };
  const auto is_whole = [&](const std::string& p) {
    const bool has_drive = p.size() > 2 && is_letter(p[0]) && p[1] == ':' && (p[2] == '/' || p[2] == '\\');
    return has_drive || (!p.empty() && (p[0] == '/' || p[0] == '\\'));
  };
  std::string all = is_whole(path) || folder.empty() ? path : folder + "/" + path;
  // Windows' separators, where nothing says that the name has a backslash in it
  if (all.find('/') == std::string::npos || (all.size() > 1 && all[1] == ':'))
    std::replace(all.begin(), all.end(), '\\', '/');
  std::vector<std::string> parts;
  for (std::size_t from = 0; from <= all.size();) {
    const std::size_t end = std::min(all.find('/', from), all.size());
    const std::string part = all.substr(from, end - from);
    from = end + 1;
    if (part == ".." && !parts.empty() && parts.back() != "..")
      parts.pop_back();
    else if (!part.empty() && part != ".")
      parts.push_back(part);
  }
  std::string out = all[0] == '/' ? "/" : "";
  for (std::size_t i = 0; i < parts.size(); ++i) out += (i > 0 ? "/" : "") + parts[i];
  return out;
}

void LineTable::add(const unsigned char* bytes, std::size_t size,
                    const std::map<std::uint32_t, std::string>& folders) {
  Cursor section(bytes, size);
  // a row takes two bytes or more, nearly always; pages that none comes to cost nothing
  for (std::vector<Row>* all : {&rows, &left_out})
    if (all->empty()) all->reserve(std::min(size / 2, kMostLines));
  while (section.left() > 4) {
    const auto place = static_cast<std::uint32_t>(size - section.left());
    const auto folder = folders.find(place);
    const std::uint32_t length = section.number(4);
    if (length > section.left()) return;
    LineProgram(*this, section.part(length), folder == folders.end() ? "" : folder->second).run(place);
  }
}

void LineTable::sort() {
  // an end of a sequence goes before what begins at the same address
  sort_rows(rows, [](const Row& a, const Row& b) {
    return a.address != b.address ? a.address < b.address : a.is_end && !b.is_end;
  });
}

const LineTable::Row* LineTable::line_at(std::uint32_t address) const {
  auto found = last_before(rows, address, [](const Row& l) { return l.address; });
  if (found == rows.end()) return nullptr;
  while (found->line == 0 && !found->is_end && found != rows.begin()) --found;
  return found->line > 0 ? &*found : nullptr;
}

void read_elf(std::string& bytes, LineTable& into) {
  Elf* const elf = elf_memory(bytes.data(), bytes.size());
  std::size_t names = 0;
  if (elf && elf_getshdrstrndx(elf, &names) == 0) {
    const Elf_Data* lines = nullptr;
    for (Elf_Scn* s = nullptr; (s = elf_nextscn(elf, s));) {
      GElf_Shdr head;
      const char* const name = gelf_getshdr(s, &head) ? elf_strptr(elf, names, head.sh_name) : nullptr;
      if (!name || std::strcmp(name, ".debug_line") != 0) continue;
      if (const Elf_Data* data = elf_getdata(s, nullptr); data && data->d_buf) lines = data;
    }
    if (lines)
      into.add(static_cast<const unsigned char*>(lines->d_buf), lines->d_size, DebugInfo::folders_in(elf));
    into.sort();
  }
  elf_end(elf);
}

}  // namespace dspic
