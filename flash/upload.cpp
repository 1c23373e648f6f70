// SPDX-License-Identifier: MIT
#include "flash/upload.h"

#include <fmt/format.h>

#include <algorithm>

namespace flash {

namespace {

constexpr std::uint8_t kHello = 0xC1, kWrite = 0x60, kRead = 0xFE, kEnd = 0xFF;
constexpr std::size_t kRowBytes = 96, kFrameBytes = 4 + kRowBytes + 1;
constexpr std::uint8_t kBlinks = 100;  // of 13 ms
// the bootloader begins again after 1.1 s without a byte; a frame takes 9 ms, erasing and writing 4 ms. Radio
// links hold bytes back: assumed up to 0.3 s
constexpr double kSilence = 1.4, kAnswer = 0.35, kBetweenHellos = 0.1;
constexpr double kQuiet = 0.05;   // between the bytes of one answer
constexpr int kLostBytes = 8;     // so many are made up for one by one
constexpr int kReadProbes = 150;  // before a bootloader is said not to read back
constexpr int kRounds = 5;        // of reading everything back

using Bytes = std::vector<std::uint8_t>;

Bytes row_bytes(const FlashRow& row) {
  Bytes bytes;
  for (const std::uint32_t word : row)
    for (int lane = 0; lane < 3; ++lane) bytes.push_back(static_cast<std::uint8_t>(word >> 8 * lane));
  return bytes;
}

std::uint8_t sum_of(const Bytes& bytes) {
  unsigned sum = 0;
  for (const std::uint8_t b : bytes) sum += b;
  return static_cast<std::uint8_t>(sum);
}

// with its bytes adding up to `total`
Bytes frame_of(std::uint32_t address, std::uint8_t kind, const FlashRow& row, unsigned total) {
  Bytes frame{static_cast<std::uint8_t>(address), static_cast<std::uint8_t>(address >> 8),
              static_cast<std::uint8_t>(address >> 16), kind};
  const Bytes data = row_bytes(row);
  frame.insert(frame.end(), data.begin(), data.end());
  frame.push_back(static_cast<std::uint8_t>(total - sum_of(frame)));
  return frame;
}

class Uploader {
 public:
  Uploader(SerialLine& line, const UploadPlan& plan, const UploadSettings& settings,
           const std::function<void(const char*, int, int)>& progress)
      : line_(line), plan_(plan), settings_(settings), progress_(progress) {}

  Upload run() {
    if (!begin(settings_.wait_s)) return done(Upload::State::Untouched);
    const FlashRow& closed = plan_.rows.at(kBootloaderRow);
    if (!close(closed)) return done(Upload::State::Unknown);
    if (!write_all()) return done(Upload::State::Refused);
    for (int round = 0; round < kRounds; ++round) {
      bool was_whole = true;
      if (reads_back_ && !verify_all(was_whole)) return done(Upload::State::Refused);
      if (!was_whole) continue;
      if (!reads_back_ && repeated_ > 0) {
        why_ = fmt::format(
            "{} frames were spoiled on the way, and this bootloader cannot read back what it took",
            repeated_);
        return done(Upload::State::Refused);
      }
      FlashRow open = closed;
      std::copy(plan_.way_in.begin(), plan_.way_in.end(), open.end() - 4);
      if (!write(kBootloaderRow, open)) return done(Upload::State::Unknown);
      if (reads_back_ && !holds(kBootloaderRow, open)) {
        // what was written instead may stand anywhere
        if (!write(kBootloaderRow, closed)) return done(Upload::State::Unknown);
        continue;
      }
      line_.write({kBlinks, 0, 0, kEnd});
      return done(reads_back_ ? Upload::State::Verified : Upload::State::Written);
    }
    why_ = fmt::format("rows were still wrong after {} rounds of reading back", kRounds);
    return done(Upload::State::Refused);
  }

 private:
  enum class Answer { Yes, No, Garbled, Silent };

  // the way into the old program goes: from now on the robot starts none
  bool close(const FlashRow& closed) {
    if (!write(kBootloaderRow, closed)) return false;
    reads_back_ = finds_read(closed);
    for (int round = 0; reads_back_ && !holds(kBootloaderRow, closed); ++round) {
      why_ = "the way into the old program could not be closed";
      if (round == kRounds || !write(kBootloaderRow, closed)) return false;
    }
    return true;
  }

  Upload done(Upload::State state) {
    Upload result{state, repeated_, {}};
    if (state != Upload::State::Verified && state != Upload::State::Written) result.why = why_;
    return result;
  }

  // --- the bootloader's first answer

  bool begin(double wait_s) {
    const double end = line_.now_s() + wait_s;
    double next_reset = line_.now_s();
    while (line_.now_s() < end) {
      if (!settings_.reset_text.empty() && !has_begun_ && line_.now_s() >= next_reset) {
        if (!send(Bytes(settings_.reset_text.begin(), settings_.reset_text.end()))) return false;
        next_reset = line_.now_s() + 2;
      }
      if (!send({kHello})) return false;
      for (auto byte = line_.read(kBetweenHellos); byte; byte = line_.read(kBetweenHellos)) {
        heard_ = true;
        if (*byte != 'q' && *byte != 'K' && *byte != 'N') continue;
        if ((*byte == 'q' && line_.read(kAnswer) == 'K') || fill_up('N') == Answer::No)
          return has_begun_ = true;
      }
      // what it took for the beginning of a frame, it forgets
      if (has_begun_) be_silent();
    }
    why_ = fmt::format("got {} for {:g} s, expected a bootloader's answer (0x71 0x4B)",
                       heard_ ? "other bytes" : "no answer", wait_s);
    return false;
  }

  void be_silent() {
    const double end = line_.now_s() + kSilence;
    while (line_.now_s() < end) line_.read(end - line_.now_s());
  }

  bool begin_again() {
    be_silent();
    return begin(10 * kSilence);
  }

  bool send(const Bytes& bytes) {
    if (line_.write(bytes)) return true;
    why_ = "the serial line is gone";
    return false;
  }

  // --- frames

  Answer ask(const Bytes& frame, char yes) {
    while (needs_quiet_ && line_.read(kQuiet)) {
    }
    if (!send(frame)) return Answer::Silent;
    const Answer answer = fill_up(yes);
    needs_quiet_ = answer != Answer::Yes && answer != Answer::No;
    return answer;
  }

  // The robot's answer. When none comes, bytes were lost, and others make up for them, until the robot has
  // its frame; or the answer was lost, and they are a whole frame, to which it says 'N'. Ones: a frame of
  // them has a wrong sum
  Answer fill_up(char yes) {
    for (int lost = 0; lost <= 2 * kLostBytes + 1; ++lost) {
      if (const auto byte = line_.read(kAnswer))
        return *byte == static_cast<unsigned char>(yes) ? Answer::Yes
               : *byte == 'N'                           ? Answer::No
                                                        : Answer::Garbled;
      const bool all = lost == kLostBytes;
      if (!send(Bytes(all ? kFrameBytes - kLostBytes : 1, 1))) return Answer::Silent;
    }
    return Answer::Silent;
  }

  bool write(std::uint32_t address, const FlashRow& row) {
    const Bytes frame = frame_of(address, kWrite, row, 0);
    int refused = 0;
    for (int tries = 0; tries < settings_.tries; ++tries) {
      const Answer answer = ask(frame, 'K');
      if (answer == Answer::Yes) return true;
      refused += answer == Answer::No;
      ++repeated_;
      if (answer == Answer::Silent && !begin_again()) return false;
    }
    why_ = fmt::format(
        "row {:#08x} was not taken in {} tries, {} of them answered 'N'; {}", address, settings_.tries,
        refused, refused == settings_.tries ? "the bootloader protects this row" : "the line is too bad");
    return false;
  }

  // the row as it stands in flash; nothing when no answer was whole
  std::optional<Bytes> read_row(std::uint32_t address, const FlashRow& row, int tries) {
    const Bytes frame = frame_of(address, kRead, row, 1);
    for (int i = 0; i < tries; ++i) {
      const Answer answer = ask(frame, 'R');
      if (answer == Answer::Yes) {
        Bytes bytes;
        while (bytes.size() <= kRowBytes) {
          const auto byte = line_.read(kQuiet);
          if (!byte) break;
          bytes.push_back(*byte);
        }
        if (bytes.size() == kRowBytes + 1 && sum_of(bytes) == 0) {
          bytes.pop_back();
          return bytes;
        }
        needs_quiet_ = true;
      }
      ++repeated_;
      if (answer == Answer::Silent && !begin_again()) return std::nullopt;
    }
    why_ = fmt::format("row {:#08x} was not read back in {} tries; the line is too bad", address, tries);
    return std::nullopt;
  }

  // a bootloader that cannot read back says 'N' to the frame, for its sum is wrong on purpose
  bool finds_read(const FlashRow& closed) {
    const int before = repeated_;
    const bool reads = read_row(kBootloaderRow, closed, kReadProbes).has_value();
    if (!reads) repeated_ = before;
    return reads;
  }

  bool holds(std::uint32_t address, const FlashRow& row) {
    const Bytes wanted = row_bytes(row);
    // one answer may be garbled and add up all the same, two alike are none
    for (int i = 0; i < 2; ++i)
      if (read_row(address, row, settings_.tries) == wanted) return true;
    return false;
  }

  bool write_all() {
    int count = 0;
    for (const auto& [address, row] : plan_.rows) {
      progress_("written", count++, static_cast<int>(plan_.rows.size()));
      if (address != kBootloaderRow && !write(address, row)) return false;
    }
    progress_("written", count, count);
    return true;
  }

  // writes again what is wrong. False: the line failed
  bool verify_all(bool& was_whole) {
    int count = 0;
    for (const auto& [address, row] : plan_.rows) {
      progress_("verified", count++, static_cast<int>(plan_.rows.size()));
      if (holds(address, row)) continue;
      was_whole = false;
      ++repeated_;
      if (!write(address, row)) return false;
    }
    progress_("verified", count, count);
    return true;
  }

  SerialLine& line_;
  const UploadPlan& plan_;
  const UploadSettings& settings_;
  const std::function<void(const char*, int, int)>& progress_;
  std::string why_;
  int repeated_ = 0;
  bool has_begun_ = false, heard_ = false, reads_back_ = false;
  bool needs_quiet_ = false;  // more bytes of a spoiled answer may come
};

}  // namespace

Upload upload(SerialLine& line, const UploadPlan& plan, const UploadSettings& settings,
              const std::function<void(const char* phase, int done, int total)>& progress) {
  return Uploader(line, plan, settings, progress).run();
}

}  // namespace flash
