// SPDX-License-Identifier: MIT
// Streams of C++ for firmware, small ones over the C library: text and numbers in and out of the console,
// strings and files. No wide characters, no languages, no exceptions; a stream that fails says so by fail().
#pragma once
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <string>

namespace std {

class ios_base {
 public:
  using fmtflags = unsigned;
  using openmode = unsigned;
  using iostate = unsigned;
  static constexpr fmtflags dec = 1, hex = 2, oct = 4, basefield = 7, fixed = 8, scientific = 16,
                            floatfield = 24, left = 32, right = 64, internal = 128, adjustfield = 224,
                            boolalpha = 256, showpos = 512, uppercase = 1024, showbase = 2048,
                            showpoint = 4096, skipws = 8192, unitbuf = 16384;
  static constexpr openmode in = 1, out = 2, app = 4, ate = 8, trunc = 16, binary = 32;
  static constexpr iostate goodbit = 0, eofbit = 1, failbit = 2, badbit = 4;
  enum seekdir { beg, cur, end };

  fmtflags flags() const { return flags_; }
  fmtflags flags(fmtflags f) { return exchange(flags_, f); }
  fmtflags setf(fmtflags f) { return exchange(flags_, flags_ | f); }
  fmtflags setf(fmtflags f, fmtflags mask) { return exchange(flags_, (flags_ & ~mask) | (f & mask)); }
  void unsetf(fmtflags f) { flags_ &= ~f; }
  streamsize precision() const { return precision_; }
  streamsize precision(streamsize digits) { return exchange(precision_, static_cast<int>(digits)); }
  streamsize width() const { return width_; }
  streamsize width(streamsize w) { return exchange(width_, static_cast<int>(w)); }
  static bool sync_with_stdio(bool = true) { return true; }

 protected:
  fmtflags flags_ = dec;
  int precision_ = 6, width_ = 0;

 private:
  template <class T>
  static T exchange(T& place, T value) {
    T before = place;
    place = value;
    return before;
  }
};

template <>
class basic_ios<char, char_traits<char>> : public ios_base {
 public:
  virtual ~basic_ios() {}
  bool good() const { return state_ == 0; }
  bool eof() const { return state_ & eofbit; }
  bool fail() const { return state_ & (failbit | badbit); }
  bool bad() const { return state_ & badbit; }
  explicit operator bool() const { return !fail(); }
  bool operator!() const { return fail(); }
  iostate rdstate() const { return state_; }
  void clear(iostate state = goodbit) { state_ = state; }
  void setstate(iostate state) { state_ |= state; }
  char fill() const { return fill_; }
  char fill(char c) {
    char before = fill_;
    fill_ = c;
    return before;
  }

 protected:
  iostate state_ = goodbit;
  char fill_ = ' ';
};

template <>
class basic_ostream<char, char_traits<char>> : virtual public basic_ios<char> {
 public:
  ostream& operator<<(bool v);
  ostream& operator<<(short v) { return integer(v, v < 0); }
  ostream& operator<<(unsigned short v) { return integer(v, false); }
  ostream& operator<<(int v) { return integer(v, v < 0); }
  ostream& operator<<(unsigned v) { return integer(v, false); }
  ostream& operator<<(long v) { return integer(v, v < 0); }
  ostream& operator<<(unsigned long v) { return integer(static_cast<long long>(v), false); }
  ostream& operator<<(long long v) { return integer(v, v < 0); }
  ostream& operator<<(unsigned long long v) { return integer(static_cast<long long>(v), false); }
  ostream& operator<<(double v);
  ostream& operator<<(float v) { return *this << static_cast<double>(v); }
  ostream& operator<<(long double v) { return *this << static_cast<double>(v); }
  ostream& operator<<(const void* v);
  ostream& operator<<(ostream& (*how)(ostream&)) { return how(*this); }
  ostream& operator<<(ios_base& (*how)(ios_base&)) {
    how(*this);
    return *this;
  }
  ostream& put(char c) { return write(&c, 1); }
  ostream& write(const char* text, streamsize n) {
    put_text(text, static_cast<size_t>(n));
    return *this;
  }
  /// Text, filled up to the width that was set.
  ostream& padded(const char* text, size_t n);
  virtual ostream& flush() { return *this; }

 protected:
  virtual void put_text(const char* text, size_t n) = 0;

 private:
  ostream& integer(long long v, bool negative);
};

inline ostream& operator<<(ostream& to, char c) { return to.padded(&c, 1); }
inline ostream& operator<<(ostream& to, signed char c) { return to << static_cast<char>(c); }
inline ostream& operator<<(ostream& to, unsigned char c) { return to << static_cast<char>(c); }
inline ostream& operator<<(ostream& to, const char* text) {
  return text ? to.padded(text, strlen(text)) : to.padded("(null)", 6);
}
inline ostream& operator<<(ostream& to, const unsigned char* text) {
  return to << reinterpret_cast<const char*>(text);
}
inline ostream& operator<<(ostream& to, const string& text) { return to.padded(text.data(), text.size()); }
inline ostream& endl(ostream& to) { return to.put('\n').flush(); }
inline ostream& flush(ostream& to) { return to.flush(); }
inline ostream& ends(ostream& to) { return to.put('\0'); }

template <>
class basic_istream<char, char_traits<char>> : virtual public basic_ios<char> {
 public:
  istream& operator>>(char& c);
  istream& operator>>(string& word);
  istream& operator>>(char* word);
  istream& operator>>(bool& v);
  istream& operator>>(short& v) { return integer(v); }
  istream& operator>>(unsigned short& v) { return integer(v); }
  istream& operator>>(int& v) { return integer(v); }
  istream& operator>>(unsigned& v) { return integer(v); }
  istream& operator>>(long& v) { return integer(v); }
  istream& operator>>(unsigned long& v) { return integer(v); }
  istream& operator>>(long long& v) { return integer(v); }
  istream& operator>>(unsigned long long& v) { return integer(v); }
  istream& operator>>(double& v);
  istream& operator>>(float& v) {
    double d = 0;
    *this >> d;
    v = static_cast<float>(d);
    return *this;
  }
  istream& operator>>(istream& (*how)(istream&)) { return how(*this); }
  istream& operator>>(ios_base& (*)(ios_base&)) { return *this; }
  /// The next character, EOF at the end.
  int get();
  istream& get(char& c);
  istream& getline(char* line, streamsize size, char end = '\n');
  istream& ignore(streamsize n = 1, int end = EOF);
  istream& read(char* to, streamsize n);
  int peek();
  istream& unget();
  istream& putback(char) { return unget(); }
  streamsize gcount() const { return count_; }
  /// The next word: characters up to white space.
  bool word(string& to);

 protected:
  /// The next character of the source, EOF at its end.
  virtual int take() = 0;
  void forget() { kept_ = kNone; }

 private:
  static constexpr int kNone = -2;
  template <class T>
  istream& integer(T& v) {
    bool good = false;
    long long wide = number(good);
    v = good ? static_cast<T>(wide) : T(0);
    return *this;
  }
  long long number(bool& good);
  /// A number's characters, which end where it cannot go on.
  bool digits(string& to, const char* also);
  int kept_ = kNone, last_ = kNone;
  streamsize count_ = 0;
};

inline istream& ws(istream& from) {
  while (from.peek() == ' ' || from.peek() == '\n' || from.peek() == '\t' || from.peek() == '\r') from.get();
  return from;
}
istream& getline(istream& from, string& line, char end = '\n');

template <>
class basic_iostream<char, char_traits<char>> : public basic_istream<char>, public basic_ostream<char> {};

// --- strings

template <>
class basic_ostringstream<char, char_traits<char>, allocator<char>> : public basic_ostream<char> {
 public:
  explicit basic_ostringstream(openmode = out) {}
  explicit basic_ostringstream(const string& text, openmode = out) : text_(text) {}
  string str() const { return text_; }
  void str(const string& text) { text_ = text; }

 protected:
  void put_text(const char* text, size_t n) override { text_.append(text, n); }

 private:
  string text_;
};

template <>
class basic_istringstream<char, char_traits<char>, allocator<char>> : public basic_istream<char> {
 public:
  explicit basic_istringstream(openmode = in) {}
  explicit basic_istringstream(const string& text, openmode = in) : text_(text) {}
  string str() const { return text_; }
  void str(const string& text) {
    text_ = text;
    at_ = 0;
    forget();
  }

 protected:
  int take() override { return at_ < text_.size() ? static_cast<unsigned char>(text_[at_++]) : EOF; }

 private:
  string text_;
  size_t at_ = 0;
};

template <>
class basic_stringstream<char, char_traits<char>, allocator<char>> : public basic_iostream<char> {
 public:
  explicit basic_stringstream(openmode = in | out) {}
  explicit basic_stringstream(const string& text, openmode = in | out) : text_(text) {}
  string str() const { return text_; }
  void str(const string& text) {
    text_ = text;
    at_ = 0;
    forget();
  }

 protected:
  void put_text(const char* text, size_t n) override { text_.append(text, n); }
  int take() override { return at_ < text_.size() ? static_cast<unsigned char>(text_[at_++]) : EOF; }

 private:
  string text_;
  size_t at_ = 0;
};

// --- the console

extern ostream &cout, &cerr, &clog;
extern istream& cin;  // nobody types: at its end from the beginning

}  // namespace std
