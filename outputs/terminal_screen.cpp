// SPDX-License-Identifier: MIT
#include "outputs/terminal_screen.h"

#include <fmt/format.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <cstring>

namespace outputs {

namespace {

constexpr char kTake[] = "\x1b[?1049h\x1b[?25l\x1b[2J";
constexpr char kGiveBack[] = "\x1b[0m\x1b[?25h\x1b[?1049l";
constexpr int kShortGap = 4;  // characters

// signals and the guard's thread come to these
std::atomic<bool> is_taken{false}, is_raw{false};
termios before;

void write_all(const char* bytes, std::size_t count) {
  for (std::size_t done = 0; done < count;) {
    const ssize_t n = ::write(STDOUT_FILENO, bytes + done, count - done);
    if (n <= 0) return;  // nobody looks
    done += static_cast<std::size_t>(n);
  }
}

void on_abort(int) {
  TerminalScreen::give_back();
  signal(SIGABRT, SIG_DFL);
  raise(SIGABRT);
}

bool says(const char* name, const char* value) {
  const char* const text = std::getenv(name);
  return text && std::strcmp(text, value) == 0;
}

}  // namespace

std::string TerminalPainter::changes(const TerminalPicture& picture) {
  std::string out;
  const bool is_new = !(picture.size == shown_.size) || shown_.cells.size() != picture.cells.size();
  if (is_new) out += "\x1b[0m\x1b[2J";
  int fore = -1, back = -1;
  const auto put = [&](const TerminalPicture::Cell& cell) {
    if (cell.sign.empty()) return;  // it came with the one before
    if ((cell.fore < 0 && fore >= 0) || (cell.back < 0 && back >= 0)) {
      out += "\x1b[0m";
      fore = back = -1;
    }
    if (cell.fore != fore) out += fmt::format("\x1b[38;5;{}m", fore = cell.fore);
    if (cell.back != back) out += fmt::format("\x1b[48;5;{}m", back = cell.back);
    out += cell.sign;
  };
  for (int row = 0; row < picture.size.rows; ++row) {
    const auto* const cells = &picture.cells[static_cast<std::size_t>(row * picture.size.columns)];
    const auto* const old =
        is_new ? nullptr : &shown_.cells[static_cast<std::size_t>(row * picture.size.columns)];
    int next = -kShortGap - 1;  // the column where the terminal's cursor stands
    for (int x = 0; x < picture.size.columns; ++x) {
      if (is_new ? cells[x] == TerminalPicture::Cell{} : cells[x] == old[x]) continue;
      // a few characters are shorter than the order that passes over them
      if (x - next > kShortGap)
        out += fmt::format("\x1b[{};{}H", row + 1, x + 1);
      else
        for (; next < x; ++next) put(cells[next]);
      put(cells[x]);
      next = x + 1;
    }
  }
  if (fore >= 0 || back >= 0) out += "\x1b[0m";
  shown_ = picture;
  return out;
}

TerminalKind TerminalKind::of_environment() {
  TerminalKind kind;
  const char* const no_colour = std::getenv("NO_COLOR");  // https://no-color.org: any text
  kind.is_dumb = says("TERM", "dumb");
  kind.colours = !kind.is_dumb && !(no_colour && *no_colour);
  return kind;
}

TerminalScreen::TerminalScreen(TerminalKind kind) : kind_(kind) {
  termios now;
  if (isatty(STDIN_FILENO) && tcgetattr(STDIN_FILENO, &before) == 0) {
    now = before;
    now.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    now.c_cc[VMIN] = now.c_cc[VTIME] = 0;
    now.c_cc[VSUSP] = _POSIX_VDISABLE;  // a run that is stopped would leave the terminal as it is
    has_keys_ = tcsetattr(STDIN_FILENO, TCSANOW, &now) == 0;
    is_raw = has_keys_;
  }
  signal(SIGABRT, on_abort);  // nobody else gives the terminal back then
  std::atexit(give_back);
  if (kind_.is_dumb) return;
  is_taken = true;
  write_all(kTake, sizeof kTake - 1);
}

TerminalScreen::~TerminalScreen() {
  give_back();
  signal(SIGABRT, SIG_DFL);
}

TerminalSize TerminalScreen::size() {
  winsize w{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &w) != 0 || w.ws_col == 0 || w.ws_row == 0) return {};
  return {w.ws_col, w.ws_row};
}

char TerminalScreen::key() const {
  char c = 0;
  return has_keys_ && ::read(STDIN_FILENO, &c, 1) == 1 ? c : '\0';
}

void TerminalScreen::show(const TerminalPicture& picture) {
  const std::string bytes = painter_.changes(picture);
  write_all(bytes.data(), bytes.size());
}

void TerminalScreen::line(const std::string& text) {
  std::string plain;
  for (const char c : text)
    if (static_cast<unsigned char>(c) >= 32 && c != 127) plain += c;
  plain += '\n';
  write_all(plain.data(), plain.size());
}

void TerminalScreen::give_back() {
  if (is_taken.exchange(false)) write_all(kGiveBack, sizeof kGiveBack - 1);
  if (is_raw.exchange(false)) tcsetattr(STDIN_FILENO, TCSANOW, &before);
}

}  // namespace outputs
