// SPDX-License-Identifier: MIT
// A strict reader of value change dumps (IEEE 1364, clause 18): fails the test at the first token that the
// standard does not allow where it stands.
#pragma once
#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace cli_test {

constexpr double kCycleNs = 1e9 / 14'745'600;

/// What a strict reader gets: the changes of every signal by its full name.
struct Dump {
  using Changes = std::vector<std::pair<long long, std::string>>;  // ns, value as written
  std::map<std::string, Changes> signals;
  long long first_ns = -1, last_ns = -1;
  std::string comment;
};

inline Dump parse(const std::string& text) {
  Dump dump;
  std::map<std::string, std::string> names;  // code -> full name
  std::map<std::string, int> widths;
  std::vector<std::string> scopes;
  std::istringstream in(text);
  std::string word;
  bool defined = false;
  const auto expect_end = [&] {
    in >> word;
    EXPECT_EQ(word, "$end");
  };
  while (in >> word) {
    if (word == "$version" || word == "$timescale" || word == "$comment") {
      std::string body, w;
      while (in >> w && w != "$end") body += w + " ";
      EXPECT_EQ(w, "$end");
      EXPECT_TRUE(word != "$timescale" || body == "1 ns ") << body;
      if (word == "$comment") dump.comment = body;
    } else if (word == "$scope") {
      std::string kind, name;
      in >> kind >> name;
      EXPECT_EQ(kind, "module");
      scopes.push_back(name);
      expect_end();
    } else if (word == "$upscope") {
      EXPECT_FALSE(scopes.empty());
      scopes.pop_back();
      expect_end();
    } else if (word == "$var") {
      EXPECT_FALSE(defined);
      std::string kind, code, name, rest;
      int width;
      in >> kind >> width >> code >> name >> rest;
      EXPECT_TRUE(kind == "wire" || kind == "real") << kind;
      if (rest != "$end") {
        EXPECT_EQ(rest, "[" + std::to_string(width - 1) + ":0]");
        expect_end();
      }
      std::string full;
      for (const auto& s : scopes) full += s + "/";
      EXPECT_TRUE(names.emplace(code, full + name).second) << "code twice: " << code;
      widths[code] = kind == "real" ? 0 : width;
      dump.signals[full + name];
    } else if (word == "$enddefinitions") {
      expect_end();
      EXPECT_TRUE(scopes.empty());
      defined = true;
    } else if (word == "$dumpvars" || word == "$end") {
      EXPECT_TRUE(defined);
    } else if (word[0] == '#') {
      const long long ns = std::stoll(word.substr(1));
      EXPECT_GT(ns, dump.last_ns) << "time does not grow";
      if (dump.first_ns < 0) dump.first_ns = ns;
      dump.last_ns = ns;
    } else {
      EXPECT_GE(dump.last_ns, 0) << "a value before any time";
      std::string value, code;
      if (word[0] == 'b' || word[0] == 'r') {
        value = word.substr(1);
        in >> code;
        EXPECT_EQ(widths[code] == 0, word[0] == 'r');
      } else {
        EXPECT_TRUE(word[0] == '0' || word[0] == '1' || word[0] == 'x') << word;
        value = word.substr(0, 1);
        code = word.substr(1);
        EXPECT_EQ(widths[code], 1);
      }
      const auto name = names.find(code);
      if (name == names.end()) {
        ADD_FAILURE() << "unknown code in " << word;
        return dump;
      }
      EXPECT_TRUE(widths[code] == 0 || static_cast<int>(value.size()) <= widths[code]) << word;
      dump.signals[name->second].emplace_back(dump.last_ns, value);
    }
  }
  EXPECT_TRUE(defined);
  return dump;
}

}  // namespace cli_test
