// SPDX-License-Identifier: MIT
// C++ for firmware: see tp_streams.h. Numbers are written and read by the C library.
#include <ctype.h>
#include <iomanip>

namespace std {

// --- out

ostream& ostream::padded(const char* text, size_t n) {
  const int missing = width_ - static_cast<int>(n);
  width_ = 0;
  if (!(flags_ & left))
    for (int i = 0; i < missing; ++i) put_text(&fill_, 1);
  put_text(text, n);
  if (flags_ & left)
    for (int i = 0; i < missing; ++i) put_text(&fill_, 1);
  return *this;
}

ostream& ostream::integer(long long v, bool negative) {
  char text[24];
  const char* how = flags_ & hex ? (flags_ & uppercase ? "%llX" : "%llx") : flags_ & oct ? "%llo" : "%llu";
  char* at = text;
  if (flags_ & dec && negative)
    *at++ = '-', v = -v;
  else if (flags_ & dec && flags_ & showpos)
    *at++ = '+';
  if (flags_ & showbase && flags_ & hex) *at++ = '0', *at++ = 'x';
  snprintf(at, sizeof text - 3, how, v);
  return padded(text, strlen(text));
}

ostream& ostream::operator<<(bool v) {
  return flags_ & boolalpha ? padded(v ? "true" : "false", v ? 4 : 5) : padded(v ? "1" : "0", 1);
}

ostream& ostream::operator<<(double v) {
  char text[64], how[12];
  snprintf(how, sizeof how, "%%%s.%d%c", flags_ & showpos ? "+" : "", precision_,
           flags_ & fixed        ? 'f'
           : flags_ & scientific ? 'e'
                                 : 'g');
  snprintf(text, sizeof text, how, v);
  return padded(text, strlen(text));
}

ostream& ostream::operator<<(const void* v) {
  char text[24];
  snprintf(text, sizeof text, "0x%p", v);
  return padded(text, strlen(text));
}

// --- in

int istream::get() {
  const int c = kept_ == kNone ? take() : kept_;
  kept_ = kNone;
  last_ = c;
  count_ = c != EOF;
  if (c == EOF) setstate(eofbit | failbit);
  return c;
}

int istream::peek() {
  if (kept_ == kNone) kept_ = take();
  if (kept_ == EOF) setstate(eofbit);
  return kept_;
}

istream& istream::unget() {
  if (last_ != kNone) kept_ = last_;
  clear(rdstate() & ~eofbit);
  return *this;
}

istream& istream::get(char& c) {
  const int next = get();
  if (next != EOF) c = static_cast<char>(next);
  return *this;
}

istream& istream::operator>>(char& c) {
  ws(*this);
  return get(c);
}

bool istream::word(string& to) {
  to.clear();
  if (fail()) return false;
  ws(*this);
  while (peek() != EOF && !isspace(peek())) to += static_cast<char>(get());
  if (to.empty()) setstate(failbit);
  return !to.empty();
}

istream& istream::operator>>(string& to) {
  word(to);
  return *this;
}

istream& istream::operator>>(char* to) {
  string read;
  if (word(read)) strcpy(to, read.c_str());
  return *this;
}

istream& istream::operator>>(bool& v) {
  int number = 0;
  *this >> number;
  v = number != 0;
  return *this;
}

bool istream::digits(string& to, const char* also) {
  if (fail()) return false;
  ws(*this);
  for (int c; (c = peek()) != EOF && (isdigit(c) || strchr(also, c));) {
    // a sign stands at the beginning or behind the e
    if ((c == '-' || c == '+') && !to.empty() && to.back() != 'e' && to.back() != 'E') break;
    to += static_cast<char>(get());
  }
  return !to.empty();
}

long long istream::number(bool& good) {
  string text;
  char* end = nullptr;
  long v = 0;
  if (digits(text, "+-")) v = strtol(text.c_str(), &end, 10);
  good = end && *end == 0 && end != text.c_str();
  if (!good) setstate(failbit);
  return v;
}

istream& istream::operator>>(double& v) {
  string text;
  char* end = nullptr;
  v = 0;
  if (digits(text, "+-.eE")) v = strtod(text.c_str(), &end);
  if (!end || *end != 0) setstate(failbit);
  return *this;
}

istream& istream::getline(char* line, streamsize size, char end) {
  streamsize n = 0;
  for (int c; n + 1 < size && (c = get()) != EOF && c != end;) line[n++] = static_cast<char>(c);
  line[n] = 0;
  if (n > 0 && eof()) clear(eofbit);
  count_ = n;
  return *this;
}

istream& istream::ignore(streamsize n, int end) {
  for (int c; n > 0 && (c = peek()) != EOF; --n) {
    get();
    if (c == end) break;
  }
  return *this;
}

istream& istream::read(char* to, streamsize n) {
  streamsize got = 0;
  for (int c; got < n && (c = get()) != EOF;) to[got++] = static_cast<char>(c);
  count_ = got;
  return *this;
}

istream& getline(istream& from, string& line, char end) {
  line.clear();
  if (from.fail()) return from;
  int c;
  while ((c = from.get()) != EOF && c != end) line += static_cast<char>(c);
  // a last line without its end is a line
  if (c == EOF && !line.empty()) from.clear(ios_base::eofbit);
  return from;
}

// --- the console

namespace {

class Console : public ostream {
 protected:
  void put_text(const char* text, size_t n) override { fwrite(text, 1, n, stdout); }
};

class Nobody : public istream {
 protected:
  int take() override { return EOF; }
};

Console console;
Nobody nobody;

}  // namespace

ostream &cout = console, &cerr = console, &clog = console;
istream& cin = nobody;

}  // namespace std
