// SPDX-License-Identifier: MIT
#include "sim_core/load/world_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace sim {
namespace {

constexpr std::string_view kBlank = " \t\r";

std::string_view trim(std::string_view s) {
  const std::size_t begin = s.find_first_not_of(kBlank);
  return begin == std::string_view::npos ? std::string_view()
                                         : s.substr(begin, s.find_last_not_of(kBlank) - begin + 1);
}

std::size_t line_end(std::string_view text, std::size_t at) {
  const std::size_t end = text.find('\n', at);
  return end == std::string_view::npos ? text.size() : end;
}

std::size_t after_line(std::string_view text, std::size_t at) {
  return std::min(line_end(text, at) + 1, text.size());
}

/// Place behind a string that begins at `at`.
std::size_t skip_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  if (text.substr(at, 3) == std::string(3, quote)) {
    const std::size_t end = text.find(std::string(3, quote), at + 3);
    return end == std::string_view::npos ? text.size() : end + 3;
  }
  for (++at; at < text.size() && text[at] != '\n' && text[at] != quote; ++at)
    if (text[at] == '\\' && quote == '"') ++at;
  return std::min(at + 1, text.size());
}

/// Place behind a value that begins at `at`: lists and tables may go over several lines.
std::size_t skip_value(std::string_view text, std::size_t at) {
  int depth = 0;
  std::size_t end = at;
  while (at < text.size()) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      end = at = skip_string(text, at);
      continue;
    }
    if (c == '#') {
      if (depth == 0) break;
      at = line_end(text, at);
      continue;
    }
    if (c == '\n' && depth == 0) break;
    depth += (c == '[' || c == '{') - (c == ']' || c == '}');
    ++at;
    if (kBlank.find(c) == std::string_view::npos && c != '\n') end = at;
  }
  return end;
}

bool is_number_at(std::string_view text, std::size_t at) {
  if (at > 0 && (std::isalnum(static_cast<unsigned char>(text[at - 1])) || text[at - 1] == '_')) return false;
  const char* digits = "0123456789";
  const std::size_t first = text[at] == '-' || text[at] == '+' ? at + 1 : at;
  return first < text.size() && std::string_view(digits).find(text[first]) != std::string_view::npos;
}

/// The numbers of a value: where each begins and ends, comments and strings left out.
std::vector<std::pair<std::size_t, std::size_t>> numbers_of(std::string_view text) {
  std::vector<std::pair<std::size_t, std::size_t>> out;
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] == '"' || text[at] == '\'') {
      at = skip_string(text, at);
    } else if (text[at] == '#') {
      at = line_end(text, at);
    } else if (is_number_at(text, at)) {
      const std::size_t end = std::min(text.find_first_not_of("0123456789.+-eE_", at), text.size());
      out.emplace_back(at, end);
      at = end;
    } else {
      ++at;
    }
  }
  return out;
}

double number(std::string_view text) { return std::strtod(std::string(text).c_str(), nullptr); }

std::string number_like(std::string_view old, std::string_view fresh) {
  if (number(old) == number(fresh)) return std::string(old);
  const auto decimals = [](std::string_view s) {
    const std::size_t dot = s.find('.');
    return dot == std::string_view::npos ? std::size_t{0} : s.size() - dot - 1;
  };
  std::string out(fresh);
  if (old.find_first_of("eE_") != std::string_view::npos || out.find_first_of("eE") != std::string::npos)
    return out;
  const std::size_t has = decimals(out), wanted = decimals(old);
  if (has < wanted) out += (has == 0 ? "." : "") + std::string(wanted - has, '0');
  if (old[0] == '+' && out[0] != '-') out.insert(0, 1, '+');
  return out;
}

}  // namespace

std::string in_style_of(std::string_view old, const std::string& fresh) {
  const auto was = numbers_of(old), is = numbers_of(fresh);
  if (was.empty() || was.size() != is.size() || old.find_first_of("\"'") != std::string_view::npos)
    return fresh;
  std::string out;
  std::size_t from = 0;
  for (std::size_t i = 0; i < was.size(); ++i) {
    out += old.substr(from, was[i].first - from);
    out += number_like(old.substr(was[i].first, was[i].second - was[i].first),
                       std::string_view(fresh).substr(is[i].first, is[i].second - is[i].first));
    from = was[i].second;
  }
  out += old.substr(from);
  return out;
}

WorldText::WorldText(std::string text) : text_(std::move(text)) { scan({}); }

/// Finds tables and entries; elements get `ids` in their order, then new ones.
void WorldText::scan(const std::vector<int>& ids) {
  elements_.clear();
  tables_.clear();
  const std::string_view text = text_;
  // A table begins, of its own element or within the last one of that name.
  const auto begin_table = [&](std::string path, bool many, std::size_t top, std::size_t begin) {
    const std::size_t dot = path.find('.');
    const std::string owner = path.substr(0, dot);
    std::size_t element = elements_.size();
    if (dot != std::string::npos)  // of the last element of that name
      for (std::size_t i = elements_.size(); i-- > 0 && element == elements_.size();)
        if (elements_[i].path == owner) element = i;
    const bool own = element == elements_.size();
    if (own) {
      const int id = element < ids.size() ? ids[element] : next_id_++;
      elements_.push_back({id, owner, many && dot == std::string::npos, 0, 0});
    }
    tables_.push_back({static_cast<int>(element), own, std::move(path), top, begin, 0, {}});
  };
  // Line by line: blank, comment, head of a table, or an entry whose value may take several lines.
  begin_table("", false, 0, 0);
  std::size_t comment = std::string::npos;  // where the comment begins that ends right above
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t start = text.find_first_not_of(kBlank, at);
    if (start == std::string_view::npos || text[start] == '\n') {
      comment = std::string::npos;
      at = start == std::string_view::npos ? text.size() : start + 1;
    } else if (text[start] == '#') {
      if (comment == std::string::npos) comment = at;
      at = after_line(text, start);
    } else if (text[start] == '[') {
      const bool many = text.substr(start, 2) == "[[";
      const std::size_t from = start + (many ? 2 : 1);
      const std::size_t end = std::min(text.find(']', from), line_end(text, from));
      begin_table(std::string(trim(text.substr(from, end - from))), many,
                  comment == std::string::npos ? at : comment, at);
      comment = std::string::npos;
      at = after_line(text, start);
    } else {
      const std::size_t equals = std::min(text.find('=', start), line_end(text, start));
      Entry entry;
      entry.key = trim(text.substr(start, equals - start));
      entry.line = at;
      const std::size_t value = std::min(equals + 1, text.size());
      entry.begin = std::min(text.find_first_not_of(kBlank, value), text.size());
      entry.end = skip_value(text, entry.begin);
      entry.next = after_line(text, entry.end);
      at = entry.next;
      comment = std::string::npos;
      tables_.back().entries.push_back(std::move(entry));
    }
  }
  // Each table ends where the next one begins, with the comment above that.
  for (std::size_t i = 0; i < tables_.size(); ++i)
    tables_[i].end = i + 1 < tables_.size() ? tables_[i + 1].top : text.size();
  // Lines of the elements, counted once through the text.
  std::size_t counted = 0;
  int line = 1;
  const auto line_at = [&](std::size_t at) {
    line += static_cast<int>(std::count(text.begin() + static_cast<std::ptrdiff_t>(counted),
                                        text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
    counted = at;
    return line;
  };
  for (const Table& table : tables_) {
    Element& e = elements_[static_cast<std::size_t>(table.element)];
    const int first = line_at(table.top);
    if (table.own) e.first_line = first;
    const int next = line_at(table.end);
    e.last_line = std::max(e.first_line, table.end == text.size() ? next : next - 1);
  }
  index_ids();
}

std::vector<int> WorldText::ids() const {
  std::vector<int> out;
  for (const Element& e : elements_) out.push_back(e.id);
  return out;
}

std::size_t WorldText::end_of(int element) const {
  std::size_t end = 0;
  for (const Table& t : tables_)
    if (t.element == element) end = t.end;
  return end;
}

int WorldText::index_of(int id) const {
  return id < 0 || id >= static_cast<int>(index_of_id_.size()) ? -1
                                                               : index_of_id_[static_cast<std::size_t>(id)];
}

void WorldText::index_ids() {
  index_of_id_.assign(static_cast<std::size_t>(next_id_), -1);
  for (std::size_t i = 0; i < elements_.size(); ++i)
    index_of_id_[static_cast<std::size_t>(elements_[i].id)] = static_cast<int>(i);
}

const WorldText::Element* WorldText::find(int id) const {
  const int i = index_of(id);
  return i < 0 ? nullptr : &elements_[static_cast<std::size_t>(i)];
}

const WorldText::Element* WorldText::at_line(int line) const {
  // they begin in their order; one whose table stands further below reaches over those between
  auto e = std::upper_bound(elements_.begin(), elements_.end(), line,
                            [](int at, const Element& other) { return at < other.first_line; });
  while (e != elements_.begin())
    if ((--e)->last_line >= line) return &*e;
  return nullptr;
}

const WorldText::Table* WorldText::own_table(int id) const {
  const int index = index_of(id);
  for (const Table& t : tables_)
    if (t.own && t.element == index) return &t;
  return nullptr;
}

std::string WorldText::value(int id, const std::string& key) const {
  const Table* table = own_table(id);
  if (!table) return "";
  for (const Entry& e : table->entries)
    if (e.key == key) return text_.substr(e.begin, e.end - e.begin);
  return "";
}

WorldText::Values WorldText::values(int id) const {
  Values out;
  if (const Table* table = own_table(id))
    for (const Entry& e : table->entries) out.emplace_back(e.key, text_.substr(e.begin, e.end - e.begin));
  return out;
}

bool WorldText::set(int id, const std::string& key, const std::string& value) {
  const Table* table = own_table(id);
  if (!table) return false;
  const auto entry = std::find_if(table->entries.begin(), table->entries.end(),
                                  [&](const Entry& e) { return e.key == key; });
  if (entry != table->entries.end()) {
    if (value.empty())
      text_.erase(entry->line, entry->next - entry->line);
    else
      text_.replace(
          entry->begin, entry->end - entry->begin,
          in_style_of(std::string_view(text_).substr(entry->begin, entry->end - entry->begin), value));
  } else if (!value.empty()) {
    std::size_t at = table->entries.empty() ? after_line(text_, table->begin) : table->entries.back().next;
    if (table->element == 0 && table->entries.empty()) at = 0;
    std::string line = fmt::format("{} = {}\n", key, value);
    if (at > 0 && text_[at - 1] != '\n') line = "\n" + line;
    text_.insert(at, line);
  }
  scan(ids());
  return true;
}

bool WorldText::remove(int id) {
  const int index = index_of(id);
  if (index <= 0) return false;  // the top of the file stays
  for (std::size_t i = tables_.size(); i-- > 0;)
    if (tables_[i].element == index) text_.erase(tables_[i].top, tables_[i].end - tables_[i].top);
  std::vector<int> left = ids();
  left.erase(left.begin() + index);
  scan(left);
  return true;
}

int WorldText::add(const std::string& path, const Values& values, bool many) {
  std::string table = fmt::format(many ? "[[{}]]\n" : "[{}]\n", path);
  for (const auto& [key, value] : values) table += fmt::format("{} = {}\n", key, value);
  return insert(path, table);
}

int WorldText::append(const std::string& element) {
  const WorldText alone(element);
  std::string path;
  for (const Element& e : alone.elements_)
    if (path.empty()) path = e.path;
  std::string table = element;
  while (!table.empty() && table.back() == '\n') table.pop_back();
  return insert(path, table + "\n");
}

int WorldText::insert(const std::string& path, const std::string& table) {
  int after = -1;
  for (std::size_t i = 0; i < elements_.size(); ++i)
    if (elements_[i].path == path) after = static_cast<int>(i);
  if (after < 0) after = static_cast<int>(elements_.size()) - 1;
  const std::size_t at = end_of(after);
  const auto ends_with = [&](const char* end) {
    const std::string_view before = std::string_view(text_).substr(0, at);
    const std::string_view tail(end);
    return before.size() >= tail.size() && before.substr(before.size() - tail.size()) == tail;
  };
  std::string gap = at == 0 || ends_with("\n\n") ? "" : ends_with("\n") ? "\n" : "\n\n";
  text_.insert(at, gap + table + (at < text_.size() ? "\n" : ""));
  std::vector<int> all = ids();
  const int id = next_id_++;
  all.insert(all.begin() + after + 1, id);
  scan(all);
  return id;
}

std::string WorldText::text_of(int id, bool commented) const {
  std::string out;
  for (const Table& t : tables_)
    if (elements_[static_cast<std::size_t>(t.element)].id == id) {
      const std::size_t begin = commented || !out.empty() ? t.top : t.begin;
      out += text_.substr(begin, t.end - begin);
    }
  return out;
}

std::vector<int> WorldText::ids_of(const std::string& path) const {
  std::vector<int> ids;
  for (const Element& e : elements_)
    if (e.path == path) ids.push_back(e.id);
  return ids;
}

std::vector<int> WorldText::differing(const WorldText& before) const {
  // each element's texts lie one behind another
  const auto texts_of = [](const WorldText& text) {
    std::vector<std::string> texts(text.elements_.size());
    for (const Table& t : text.tables_)
      texts[static_cast<std::size_t>(t.element)].append(text.text_, t.begin, t.end - t.begin);
    return texts;
  };
  const std::vector<std::string> is = texts_of(*this), was = texts_of(before);
  std::vector<int> ids;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const int known = before.index_of(elements_[i].id);
    if (known < 0 || was[static_cast<std::size_t>(known)] != is[i]) ids.push_back(elements_[i].id);
  }
  return ids;
}

std::string WorldText::inner_text(int id) const {
  const int index = index_of(id);
  std::string out;
  for (const Table& t : tables_)
    if (!t.own && t.element == index) out += text_.substr(t.begin, t.end - t.begin);
  return out;
}

bool WorldText::add_inner(int id, const std::string& path, const Values& values) {
  const int index = index_of(id);
  if (index < 0) return false;
  std::string table = fmt::format("[[{}]]\n", path);
  for (const auto& [key, value] : values) table += fmt::format("{} = {}\n", key, value);
  const std::size_t at = end_of(index);
  if (at > 0 && text_[at - 1] != '\n') table = "\n" + table;
  const bool has_gap = at > 1 && text_[at - 1] == '\n' && text_[at - 2] == '\n';
  // the blank line that stood below the element goes on doing so
  if (has_gap)
    text_.insert(at - 1, table);
  else
    text_.insert(at, table);
  scan(ids());
  return true;
}

bool WorldText::remove_inner(int id, const std::string& path, int index) {
  const int element = index_of(id);
  for (const Table& t : tables_)
    if (!t.own && t.element == element && t.path == path && index-- == 0) {
      // nor does the blank line go that stands between elements
      const bool is_last = &t == &tables_.back() || (&t + 1)->own;
      std::size_t end = t.end;
      if (is_last && end < text_.size() && end > t.begin && text_[end - 1] == '\n' && text_[end - 2] == '\n')
        --end;
      text_.erase(t.top, end - t.top);
      scan(ids());
      return true;
    }
  return false;
}

int WorldText::copy(int id) {
  const int index = index_of(id);
  if (index < 0 || !elements_[static_cast<std::size_t>(index)].many) return 0;
  const std::size_t at = end_of(index);
  std::string table = text_of(id, true);
  while (table.size() > 1 && table[table.size() - 1] == '\n' && table[table.size() - 2] == '\n')
    table.pop_back();
  if (table.back() != '\n') table += '\n';
  const bool at_end = at == text_.size();
  if (at > 0 && text_[at - 1] != '\n') table = "\n" + table;
  const bool has_gap = at > 1 && text_[at - 1] == '\n' && text_[at - 2] == '\n';
  text_.insert(at, (has_gap ? "" : "\n") + table + (at_end ? "" : "\n"));
  std::vector<int> all = ids();
  const int fresh = next_id_++;
  all.insert(all.begin() + index + 1, fresh);
  scan(all);
  return fresh;
}

void WorldText::replace(std::string text) {
  const std::vector<Element> was = elements_;
  text_ = std::move(text);
  scan({});
  std::vector<bool> taken(was.size(), false);
  for (Element& e : elements_)
    for (std::size_t i = 0; i < was.size(); ++i)
      if (!taken[i] && was[i].path == e.path) {
        taken[i] = true;
        e.id = was[i].id;
        break;
      }
  index_ids();
}

}  // namespace sim
