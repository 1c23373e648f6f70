// SPDX-License-Identifier: MIT
#include "tools/dev/manual.h"

#include <fmt/format.h>

#include <cctype>
#include <sstream>
#include <vector>

namespace dev {

namespace {

/// Text as roff takes it: a hyphen that can be copied, no line that begins a request.
std::string escaped(const std::string& text) {
  std::string out;
  bool begins = true;
  for (const char c : text) {
    if (begins && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
    begins = c == '\n';
  }
  return out;
}

std::string head(const std::string& name, const std::string& about) {
  std::string title = name;
  for (char& c : title) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return fmt::format(
      ".\\\" made by `twinpuck-dev manual` of the command's own options\n"
      ".TH {} 1 \"" TWINPUCK_DATE "\" \"twinpuck " TWINPUCK_VERSION "\" \"Twinpuck\"\n.SH NAME\n{} \\- {}\n",
      escaped(title), escaped(name), escaped(about));
}

std::string first_lower(std::string text) {
  if (text.size() > 1 && std::islower(static_cast<unsigned char>(text[1])))
    text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

bool is_shown(const CLI::Option* o) { return !o->get_group().empty(); }
bool takes_value(const CLI::Option* o) { return o->get_items_expected_max() != 0; }

/// What may be given, as in "{sim,dspic}"; empty: anything.
std::vector<std::string> choices(const CLI::Option* o) {
  const std::string type = o->get_type_name();
  const std::size_t begin = type.find('{'), end = type.find('}', begin + 1);
  std::vector<std::string> words;
  if (begin == std::string::npos || end == std::string::npos) return words;
  std::istringstream list(type.substr(begin + 1, end - begin - 1));
  for (std::string word; std::getline(list, word, ',');) words.push_back(word);
  return words;
}

/// "TEXT", "FLOAT:0 to 100" or "INT:INT in [1 - 256]" as a reader wants it: sim|dspic, or the bounds.
std::string value_of(const CLI::Option* o) {
  std::string all;
  for (const std::string& word : choices(o)) all += (all.empty() ? "" : "|") + word;
  if (!all.empty()) return all;
  const std::string type = o->get_type_name();
  const std::string kind = type.substr(0, type.find(':'));
  return kind == "FLOAT" || kind == "INT" || kind == "UINT" ? "NUMBER" : kind.empty() ? "TEXT" : kind;
}

std::string bounds_of(const CLI::Option* o) {
  std::string type = o->get_type_name();
  const std::size_t colon = type.find(':');
  if (colon == std::string::npos || !choices(o).empty()) return "";
  type = type.substr(colon + 1);
  if (type == "NONNEGATIVE") return "0 or more";
  if (const std::size_t at = type.find("in ["); at != std::string::npos) {
    type = type.substr(at + 4, type.find(']') - at - 4);
    if (const std::size_t dash = type.find(" - "); dash != std::string::npos) type.replace(dash, 3, " to ");
  }
  return type;
}

std::string option_entry(const CLI::Option* o) {
  std::string names;
  std::istringstream all(o->get_name(false, true));
  for (std::string name; std::getline(all, name, ',');)
    names += (names.empty() ? "" : ", ") + ("\\fB" + escaped(name) + "\\fR");
  if (takes_value(o)) names += " \\fI" + escaped(value_of(o)) + "\\fR";
  std::string text = escaped(o->get_description());
  if (const std::string bounds = takes_value(o) ? bounds_of(o) : ""; !bounds.empty())
    text += "; " + escaped(bounds);
  if (!o->get_default_str().empty()) text += "; default: " + escaped(o->get_default_str());
  if (takes_value(o) && o->get_items_expected_max() > 1 && o->get_type_size_max() == 1)
    text += "; may be given several times";
  if (o->get_required()) text += "; required";
  return ".TP\n" + names + "\n" + text + "\n";
}

std::string positional(const CLI::Option* o) {
  const bool several = o->get_items_expected_max() > 1;
  const std::string name = "\\fI" + escaped(o->get_name(true)) + "\\fR" + (several ? " ..." : "");
  return o->get_required() ? name : "[" + name + "]";
}

std::string synopsis(const CLI::App& verb) {
  std::string text = ".SH SYNOPSIS\n\\fBtwinpuck " + escaped(verb.get_name()) + "\\fR [\\fIOPTIONS\\fR]";
  for (const CLI::Option* o : verb.get_options())
    if (o->get_positional() && is_shown(o)) text += " " + positional(o);
  return text + "\n";
}

std::string options(const CLI::App& verb) {
  std::string text;
  for (const CLI::Option* o : verb.get_options())
    if (o->get_positional() && is_shown(o))
      text += ".TP\n\\fI" + escaped(o->get_name(true)) + "\\fR\n" + escaped(o->get_description()) + "\n";
  for (const std::string& group : verb.get_groups()) {
    std::string entries;
    for (const CLI::Option* o : verb.get_options())
      if (!o->get_positional() && is_shown(o) && o->get_group() == group) entries += option_entry(o);
    if (!entries.empty() && group != "Options") text += ".SS " + escaped(group) + "\n";
    text += entries;
  }
  return text;
}

/// A footer's lines: examples, exit codes, and what else it says.
struct Footer {
  std::vector<std::string> examples, exits, others;
};
Footer read_footer(const CLI::App& app) {
  Footer footer;
  std::istringstream lines(app.get_footer());
  std::vector<std::string>* list = nullptr;  // of what a heading alone on its line began
  for (std::string line; std::getline(lines, line);) {
    const auto begins = [&](const char* word) { return line.rfind(word, 0) == 0; };
    if (line.empty()) {
      list = nullptr;
    } else if (begins("Example")) {
      const std::size_t at = line.find(": ");
      if (at != std::string::npos) footer.examples.push_back(line.substr(at + 2));
      list = &footer.examples;
    } else if (begins("Exit codes:")) {
      list = &footer.exits;
      if (line.size() > 12) footer.exits.push_back(line.substr(12));
    } else {
      (list ? *list : footer.others).push_back(line.substr(line.find_first_not_of(' ')));
    }
  }
  return footer;
}

std::string listing(const std::vector<std::string>& lines) {
  std::string text = ".nf\n";
  for (const std::string& line : lines) text += ".RS 4\n" + escaped(line) + "\n.RE\n";
  return text + ".fi\n";
}

constexpr const char* kExits =
    ".SH EXIT STATUS\n"
    ".TP\n.B 0\ngood\n"
    ".TP\n.B 1\na test failed, or an input has errors\n"
    ".TP\n.B 2\nwrong usage or bad input; nothing ran\n"
    ".TP\n.B 3\na firmware trapped or was reset; a supervisor crashed\n"
    ".TP\n.B 4\nno progress\n"
    ".TP\n.B 5\nnothing was selected\n"
    ".TP\n.B 6\ninternal error\n"
    ".TP\n.B 7\nan output was lost, or a replay came out otherwise\n"
    ".TP\n.B 124\nthe limit of real time was reached\n"
    ".TP\n.B 130\ninterrupted\n";

constexpr const char* kEnvironment =
    ".SH ENVIRONMENT\n"
    ".TP\n.B TWINPUCK_ROOT\nfolder with firmware, worlds and docs, instead of the product's own\n"
    ".TP\n.B XDG_CACHE_HOME\nfolder for what can be made again; else $HOME/.cache, else a folder of the user "
    "in "
    "$TMPDIR\n"
    ".TP\n.B TWINPUCK_CACHE_MB\nwhat the user's caches may hold together, in MB; 512 without it\n"
    ".TP\n.B TWINPUCK_LIBCONTROLLER\nthe library that programs of the PC are linked with, instead of the "
    "product's own\n"
    ".TP\n.B TWINPUCK_INTERPRET\nset: hot code is not translated; slower, with the same results\n";

constexpr const char* kFiles =
    ".SH FILES\n"
    ".TP\n.I PREFIX/share/twinpuck\nfirmware, the library's sources, worlds, examples; never written to\n"
    ".TP\n.I PREFIX/share/doc/twinpuck\nthe documentation\n"
    ".TP\n.I ~/.cache/twinpuck\nobjects, images, programs and translations; may be removed at any time\n";

std::string see_also(const std::string& but) {
  return ".SH SEE ALSO\n" + (but == "twinpuck" ? std::string("\\fI") : "\\fBtwinpuck\\fR(1), \\fI") +
         "PREFIX/share/doc/twinpuck\\fR\n";
}

std::vector<const CLI::App*> verbs_of(const CLI::App& app) {
  std::vector<const CLI::App*> verbs;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App* a) { return !a->get_group().empty(); }))
    verbs.push_back(verb);
  return verbs;
}

/// What the words behind an option or in the place of a positional are names of.
struct Meaning {
  const char *name, *kind;
};
constexpr Meaning kMeanings[] = {
    {"WORLD", "worlds"},
    {"--world", "worlds"},
    {"--fw", "firmware"},
    {"DIR", "controllers"},
    {"--supervisor", "supervisors"},
    {"--robot", "robots"},
    {"--extern", "robots"},
    {"VERB", "verbs"},
};
std::string kind_of(const std::string& verb, const CLI::Option* o) {
  const std::vector<std::string> words = choices(o);
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "= " : " ") + word;
  if (!list.empty()) return list;
  const std::string name = o->get_positional()
                               ? o->get_name(true)
                               : "--" + (o->get_lnames().empty() ? "" : o->get_lnames().front());
  for (const Meaning& meaning : kMeanings)
    if (name == meaning.name) return meaning.kind;
  if (verb == "cycles" && name == "FILE") return "controllers";
  if (verb == "new") return "none";
  return value_of(o) == "NUMBER" ? "none" : "files";
}

}  // namespace

std::string manual_of_command(const CLI::App& app) {
  std::string text = head("twinpuck", "the firmware twin of the e-puck robot");
  text += ".SH SYNOPSIS\n\\fBtwinpuck\\fR \\fIVERB\\fR [\\fIOPTIONS\\fR] ...\n";
  text +=
      ".SH DESCRIPTION\n"
      "The e\\-puck robot as software: the robot's own C program runs on a PC, in virtual time, in a "
      "simulated world. Each verb has a page of its own.\n"
      ".SH VERBS\n";
  for (const CLI::App* verb : verbs_of(app))
    text += ".TP\n\\fB" + escaped(verb->get_name()) + "\\fR\n" + escaped(verb->get_description()) + "\n";
  text += ".SH EXAMPLES\n" + listing(read_footer(app).examples);
  return text + kExits + kEnvironment + kFiles + see_also("twinpuck");
}

std::string manual_of_verb(const CLI::App& verb) {
  std::string text = head("twinpuck-" + verb.get_name(), first_lower(verb.get_description()));
  text += synopsis(verb);
  const Footer footer = read_footer(verb);
  text += ".SH DESCRIPTION\n" + escaped(verb.get_description()) + ".\n";
  for (const std::string& line : footer.others) text += escaped(line) + "\n";
  text += ".SH OPTIONS\n" + options(verb);
  if (!footer.examples.empty()) text += ".SH EXAMPLES\n" + listing(footer.examples);
  if (footer.exits.empty()) {
    text += kExits;
  } else {
    text += ".SH EXIT STATUS\n";
    for (const std::string& line : footer.exits) text += escaped(line) + "\n";
  }
  return text + kEnvironment + kFiles + see_also(verb.get_name());
}

std::string bash_completion(const CLI::App& app, std::string text) {
  std::string verbs, options, kinds;
  for (const CLI::App* verb : verbs_of(app)) {
    const std::string& name = verb->get_name();
    verbs += (verbs.empty() ? "" : " ") + name;
    std::string words;
    std::vector<std::string> places;
    for (const CLI::Option* o : verb->get_options()) {
      if (!is_shown(o)) continue;
      if (o->get_positional()) {
        places.push_back(kind_of(name, o));
        if (o->get_items_expected_max() > 1) places.back() += "+";
        continue;
      }
      for (const std::string& l : o->get_lnames()) words += " --" + l;
      for (const std::string& s : o->get_snames()) words += " -" + s;
      if (!takes_value(o)) continue;
      std::string patterns;
      for (const std::string& l : o->get_lnames())
        patterns += (patterns.empty() ? "" : "|") + (name + " --" + l);
      for (const std::string& s : o->get_snames())
        patterns += (patterns.empty() ? "" : "|") + (name + " -" + s);
      std::string quoted;
      std::istringstream each(patterns);
      for (std::string p; std::getline(each, p, '|');) quoted += (quoted.empty() ? "\"" : "|\"") + p + "\"";
      kinds += "    " + quoted + ") echo '" + kind_of(name, o) + "' ;;\n";
    }
    options += "    " + name + ") echo '" + (words.empty() ? "" : words.substr(1)) + "' ;;\n";
    for (std::size_t i = 0; i < places.size(); ++i) {
      const bool goes_on = places[i].back() == '+';
      if (goes_on) places[i].pop_back();
      kinds += fmt::format("    \"{} {}\"{}) echo '{}' ;;\n", name, i, goes_on ? "*" : "", places[i]);
    }
  }
  const auto put = [&](const std::string& key, const std::string& value) {
    for (std::size_t at = 0; (at = text.find(key, at)) != std::string::npos; at += value.size())
      text.replace(at, key.size(), value);
  };
  put("@VERBS@", verbs);
  put("@OPTIONS@", options);
  put("@KINDS@", kinds);
  return text;
}

}  // namespace dev
