// SPDX-License-Identifier: MIT
#include "dspic30/load/code_map.h"

#include <algorithm>
#include <cstdio>

#include "dspic30/load/cursor.h"

namespace dspic {

namespace {

constexpr std::size_t kMostLines = 1u << 20;  // of a hostile file

/// One unit's line program [DWARF 4, 6.2].
class LineProgram {
 public:
  LineProgram(CodeMap& map, Cursor unit, std::string folder)
      : map_(map), unit_(unit), folder_(std::move(folder)) {}

  void run(std::uint32_t place) {
    if (!read_head()) return;
    map_.unit_files[place] = files_;
    while (!unit_.is_at_end() && map_.lines.size() < kMostLines) {
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
    FixedAdvancePc
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
    if (const std::string& from = map_.moved_from; !from.empty() && name.rfind(from + "/", 0) == 0)
      name.replace(0, from.size(), map_.moved_to);
    const auto known = std::find(map_.files.begin(), map_.files.end(), name);
    if (known != map_.files.end()) return static_cast<std::uint16_t>(known - map_.files.begin());
    if (map_.files.size() >= 0xFFFF) return 0;
    map_.files.push_back(name);
    return static_cast<std::uint16_t>(map_.files.size() - 1);
  }

  void begin() {
    sequence_ = map_.lines.size();
    row_ = {};
    row_.is_statement = starts_statement_;
    file_ = 1;
    line_ = 1;
  }
  void emit() {
    row_.line = file_ - 1 < files_.size() ? std::max(0, line_) : 0;
    row_.file = row_.line ? files_[file_ - 1] : std::uint16_t{0};
    map_.lines.push_back(row_);
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
        map_.lines.back().line = 0;
        // what the linker left out stands at 0, where no C code can be
        if (map_.lines[sequence_].address == 0) {
          const auto from = map_.lines.begin() + static_cast<std::ptrdiff_t>(sequence_);
          if (map_.left_out.size() < kMostLines)
            map_.left_out.insert(map_.left_out.end(), from, map_.lines.end());
          map_.lines.erase(from, map_.lines.end());
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
      default:
        for (int i = 0; i < operands_[code - 1u]; ++i) unit_.leb();
    }
  }

  CodeMap& map_;
  Cursor unit_;
  std::string folder_;  // that names are relative to; empty: not known
  std::vector<std::uint8_t> operands_;
  std::vector<std::uint16_t> files_;  // numbers in the map; the unit counts from 1
  bool starts_statement_ = true;
  int line_base_ = 0, line_range_ = 1, opcode_base_ = 1, line_ = 1;
  std::uint32_t shortest_ = 1, file_ = 1;
  std::size_t sequence_ = 0;  // its first row
  CodeMap::Line row_;
};

/// The last of `rows`, sorted by `address`, that begins at or before one; end() if none does.
template <typename Rows, typename Address>
typename Rows::const_iterator last_before(const Rows& rows, std::uint32_t address, Address of) {
  const auto after = std::upper_bound(rows.begin(), rows.end(), address,
                                      [&](std::uint32_t a, const auto& row) { return a < of(row); });
  return after == rows.begin() ? rows.end() : after - 1;
}

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

bool ends_path(const std::string& path, const std::string& end) {
  if (path.size() < end.size() || path.compare(path.size() - end.size(), end.size(), end) != 0) return false;
  return path.size() == end.size() || path[path.size() - end.size() - 1] == '/' || end[0] == '/';
}

void CodeMap::add_lines(const unsigned char* bytes, std::size_t size,
                        const std::map<std::uint32_t, std::string>& folders) {
  Cursor section(bytes, size);
  // a row takes two bytes or more, nearly always; pages that none comes to cost nothing
  for (std::vector<Line>* rows : {&lines, &left_out})
    if (rows->empty()) rows->reserve(std::min(size / 2, kMostLines));
  while (section.left() > 4) {
    const auto place = static_cast<std::uint32_t>(size - section.left());
    const auto folder = folders.find(place);
    const std::uint32_t length = section.number(4);
    if (length > section.left()) return;
    LineProgram(*this, section.part(length), folder == folders.end() ? "" : folder->second).run(place);
  }
}

void CodeMap::sort() {
  // an end of a sequence goes before what begins at the same address
  const auto sort = [](auto& all, const auto& before) {
    if (!std::is_sorted(all.begin(), all.end(), before)) std::stable_sort(all.begin(), all.end(), before);
  };
  sort(lines, [](const Line& a, const Line& b) {
    return a.address != b.address ? a.address < b.address : a.is_end && !b.is_end;
  });
  sort(functions, [](const Function& a, const Function& b) { return a.begin < b.begin; });
  for (std::size_t i = 0; i + 1 < functions.size(); ++i)
    functions[i].end = std::min(functions[i].end, functions[i + 1].begin);
}

const CodeMap::Function* CodeMap::function_at(std::uint32_t address) const {
  const auto found = last_before(functions, address, [](const Function& f) { return f.begin; });
  return found != functions.end() && address < found->end ? &*found : nullptr;
}

const CodeMap::Function* CodeMap::function_named(const std::string& name) const {
  const auto found =
      std::find_if(functions.begin(), functions.end(), [&](const Function& f) { return f.name == name; });
  return found == functions.end() ? nullptr : &*found;
}

const CodeMap::Line* CodeMap::line_at(std::uint32_t address) const {
  auto found = last_before(lines, address, [](const Line& l) { return l.address; });
  if (found == lines.end()) return nullptr;
  while (found->line == 0 && !found->is_end && found != lines.begin()) --found;
  return found->line > 0 ? &*found : nullptr;
}

std::vector<std::uint32_t> CodeMap::addresses_of(const std::string& file, int line, int& found) const {
  std::vector<std::size_t> among;
  for (std::size_t i = 0; i < files.size(); ++i)
    if (ends_path(files[i], file)) among.push_back(i);
  return addresses_of(among, line, found);
}

std::vector<std::uint32_t> CodeMap::addresses_of(const std::vector<std::size_t>& among, int line,
                                                 int& found) const {
  std::vector<std::uint32_t> addresses;
  std::vector<char> is_meant(files.size());
  for (const std::size_t file : among) is_meant[file] = 1;
  found = 0;
  for (const Line& l : lines)
    if (l.is_statement && l.line >= line && (found == 0 || l.line < found) && is_meant[l.file])
      found = l.line;
  if (found == 0) return addresses;
  const Line* before = nullptr;
  for (const Line& l : lines) {
    const bool is_it = l.line == found && is_meant[l.file];
    const bool goes_on = before && before->line == l.line && before->file == l.file;
    // of a loop's several pieces only the first in each function
    if (is_it && l.is_statement && !goes_on &&
        (addresses.empty() || function_at(addresses.back()) != function_at(l.address)))
      addresses.push_back(l.address);
    before = &l;
  }
  return addresses;
}

std::string CodeMap::describe(std::uint32_t address) const {
  const Function* function = function_at(address);
  const Line* line = line_at(address);
  char plain[16];
  std::snprintf(plain, sizeof plain, "0x%06x", address);
  if (!function && !line) return plain;
  const std::string place =
      line ? files[line->file].substr(files[line->file].rfind('/') + 1) + ":" + std::to_string(line->line)
           : plain;
  return function ? function->name + "() (" + place + ")" : place;
}

}  // namespace dspic
