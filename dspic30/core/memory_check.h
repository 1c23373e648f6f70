// SPDX-License-Identifier: MIT
// Looks after a program's RAM while it is interpreted: what was written, what belongs to nobody, where the
// stack ends. A shadow bit for each bit of RAM and of the W registers says whether anybody ever gave it a
// value; it goes the way of the values, so a copy of an unwritten byte is no finding, and a branch, an
// address or a register of the chip that depends on one is.
//
//   Cpu --begins(), reads(), writes()--> MemoryCheck --found()--> MemoryFindings
//
// Nobody pays for it where there is none, and it changes nothing that the program does. Not followed:
// accumulators, and values in the flags across a handler; they count as written.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>

namespace dspic {

class Cpu;
struct Decoded;

struct MemoryFinding {
  enum class Kind : std::uint8_t {
    Unwritten,   ///< what was read there decides something, and nobody wrote it
    Outside,     ///< an access to what belongs to nobody
    Freed,       ///< ... to what was given back
    AboveStack,  ///< ... beyond the top of the stack
    Null         ///< ... through a null pointer: the W registers lie there
  };
  enum class Use : std::uint8_t { Branch, Address, Register };
  Kind kind = Kind::Outside;
  Use use = Use::Branch;  ///< of Unwritten: what depends on it
  unsigned address = 0;   ///< of the access; of Unwritten: where it was read
  unsigned bytes = 1;
  unsigned pc = 0;  ///< of the instruction; of Unwritten: the one that read it
  bool writes = false;
};

class MemoryFindings {
 public:
  virtual ~MemoryFindings() = default;
  virtual void found(const MemoryFinding& finding) = 0;
  /// The function that was waited for (MemoryCheck::await_return) has returned: what it gives is in W0.
  virtual void returned(std::uint16_t w0) = 0;
  /// W15 has fallen: nothing from there on is anybody's any more.
  virtual void stack_fell(unsigned top) = 0;
};

class MemoryCheck {
 public:
  enum class State : std::uint8_t { Plain, Outside, Freed };

  explicit MemoryCheck(MemoryFindings& findings);
  ~MemoryCheck();

  // --- what is known from elsewhere; addresses of RAM
  void mark(unsigned begin, unsigned end, State state);
  /// As if nobody had written it; or as if somebody had.
  void forget(unsigned begin, unsigned end) { set_bits(begin, end, 0xFF); }
  void define(unsigned begin, unsigned end) { set_bits(begin, end, 0); }
  /// Has anybody written a part of it? `address`: of RAM.
  bool is_written(unsigned address) const { return bits_[address - kStart] != 0xFF; }
  /// What runs from now on until the function that has just begun returns is not looked at, as it
  /// knows its memory better.
  void await_return(const Cpu& cpu);
  /// Is one awaited?
  bool is_away() const { return is_away_; }
  void restart();

  // --- from the core
  /// An instruction begins; all before it are through.
  void begins(const Cpu& cpu, const Decoded* d);
  /// What comes next is no instruction's, but an interrupt's entry.
  void cut(const Cpu& cpu);
  /// `ea`: of RAM, a word's is even.
  void reads(const Cpu& cpu, unsigned ea, unsigned bits);
  /// ... or of a register.
  void writes(const Cpu& cpu, unsigned ea, unsigned bits);
  /// An access to a W register by its address, which no compiler makes but through a pointer.
  void meets_null(const Cpu& cpu, unsigned ea, unsigned bits, bool is_write);

 private:
  static constexpr unsigned kStart = 0x800, kBytes = 0x2000, kStackPointer = 15, kRegisterBytes = 32;
  struct Origin {
    unsigned pc = 0, address = 0;
  };
  struct Access {
    unsigned address = 0, bytes = 0, value = 0, bits = 0;  // bits: nobody wrote them
  };
  struct Value {
    unsigned bits = 0, value = 0;
    Origin origin;
  };
  struct Shape;
  void set_bits(unsigned begin, unsigned end, std::uint8_t bits);
  /// True: there is something to say.
  bool look_at(const Cpu& cpu, unsigned ea, unsigned bytes, bool is_write);
  bool is_plain(unsigned i, unsigned bits) const;
  void move_top(unsigned top);
  void come_back(const Cpu& cpu, const Decoded* d);
  void before(const Cpu& cpu, const Decoded* d);
  void finish(const Cpu& cpu);
  const Shape& shape_of(const Cpu& cpu, unsigned pc);
  Value of_register(unsigned n, bool byte) const;
  Value of_memory(unsigned n) const;
  Value source(const Shape& shape, unsigned& reads) const;
  Value second_operand(const Shape& shape) const;
  unsigned shifted(const Shape& shape, const Value& a, const Value& b) const;
  void copy_pair(const Shape& shape, unsigned pc);
  void finish_bit(const Shape& shape, const Value& a, unsigned pc);
  void multiplied(const Shape& shape, unsigned either, const Origin& origin);
  void set_register(unsigned n, unsigned bits, bool byte, const Origin& origin);
  void set_written(unsigned n, unsigned bits, unsigned pc, const Origin& origin);
  void put(const Shape& shape, const Value& value, unsigned pc);
  void set_flags(const Value& value);
  void depends(MemoryFinding::Use use, const Origin& origin, unsigned pc);

  MemoryFindings& findings_;
  std::array<std::uint8_t, kBytes> bits_;  // nobody wrote them
  std::array<State, kBytes> states_;
  std::array<std::uint16_t, 16> register_bits_{};
  std::array<Origin, 16> origins_{};
  unsigned unwritten_ = 0;  // registers with such bits
  bool flags_unwritten_ = false;
  Origin flags_origin_;
  // the instruction under way
  const Decoded* at_ = nullptr;
  std::array<std::uint16_t, 16> w_{};  // before it
  std::array<Access, 2> read_{}, written_{};
  unsigned reads_ = 0, writes_ = 0;
  bool read_unwritten_ = false;
  // the stack
  unsigned top_ = kStart, base_ = 0;  // base 0: not known yet
  // a function that is not looked at
  unsigned return_pc_ = 0, return_top_ = 0;
  bool is_away_ = false;
  std::unordered_map<unsigned, std::unique_ptr<Shape>> shapes_;
};

}  // namespace dspic
