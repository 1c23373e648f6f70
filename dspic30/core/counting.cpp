// SPDX-License-Identifier: MIT
#include "dspic30/core/counting.h"

#include <algorithm>
#include <cstring>

#include "dspic30/core/cpu.h"
#include "dspic30/core/semantics.h"

namespace dspic {

namespace {

constexpr unsigned kSrFlags = 0xF;  // C Z OV N
constexpr Cycle kMostRounds = 0x8000;

/// What an instruction does to words that move.
enum class Does : std::uint8_t {
  Other,       // no part of a loop that counts
  Nothing,     // but lead somewhere, by flags that stay
  Copies,      // no flags
  Tells,       // copies, and N and Z tell of it
  Adds,        // first and second operand
  Subtracts,   // the second from the first
  Reverses,    // the first from the second
  Steps,       // a constant is added
  Negates,     // the operand from a constant
  Fills,       // with a constant
  Calls,       // pushes constants
  WorksStill,  // anything, from operands that stay
};

struct Kind {
  Does does = Does::Other;
  bool reads_flags = false, sets_flags = false;  // all four
};

// What an instruction does to values that move; Other: it cannot be followed.
Kind kind_of(Insn id) {
  switch (id) {
    case Insn::Nop:
    case Insn::Nopr:
    case Insn::Bra_Expr:
    case Insn::Goto_Expr:
    case Insn::Repeat_lit14:
      return {Does::Nothing};
    case Insn::Bra_OV_Expr:
    case Insn::Bra_C_Expr:
    case Insn::Bra_Z_Expr:
    case Insn::Bra_N_Expr:
    case Insn::Bra_LE_Expr:
    case Insn::Bra_LT_Expr:
    case Insn::Bra_LEU_Expr:
    case Insn::Bra_NOV_Expr:
    case Insn::Bra_NC_Expr:
    case Insn::Bra_NZ_Expr:
    case Insn::Bra_NN_Expr:
    case Insn::Bra_GT_Expr:
    case Insn::Bra_GE_Expr:
    case Insn::Bra_GTU_Expr:
      return {Does::Nothing, true};
    case Insn::Mov_WREG_f:
    case Insn::Mov_f_Wnd:
    case Insn::Mov_Wns_f:
    case Insn::Mov_Wsslit10_Wnd:
    case Insn::Mov_Wns_Wdslit10:
    case Insn::Mov_Wso_Wdo:
    case Insn::Mov_D_Ws_Wnd:
    case Insn::Mov_D_Wns_Wd:
    case Insn::Push_f:
    case Insn::Pop_f:
      return {Does::Copies};
    case Insn::Mov_f:
      return {Does::Tells};
    case Insn::Add_f:
    case Insn::Add_lit10_Wn:
    case Insn::Add_Wb_lit5_Wd:
    case Insn::Add_Wb_Ws_Wd:
      return {Does::Adds, false, true};
    case Insn::Addc_f:
    case Insn::Addc_lit10_Wn:
    case Insn::Addc_Wb_lit5_Wd:
    case Insn::Addc_Wb_Ws_Wd:
      return {Does::Adds, true, true};
    case Insn::Sub_f:
    case Insn::Sub_Wb_lit5_Wd:
    case Insn::Sub_Wb_Ws_Wd:
    case Insn::Cp_f:
    case Insn::Cp_Wb_lit5:
    case Insn::Cp_Wb_Ws:
      return {Does::Subtracts, false, true};
    case Insn::Sub_lit10_Wn:
      return {Does::Reverses, false, true};
    case Insn::Subb_f:
    case Insn::Subb_Wb_lit5_Wd:
    case Insn::Subb_Wb_Ws_Wd:
    case Insn::Cpb_f:
    case Insn::Cpb_Wb_lit5:
    case Insn::Cpb_Wb_Ws:
      return {Does::Subtracts, true, true};
    case Insn::Subb_lit10_Wn:
      return {Does::Reverses, true, true};
    case Insn::Subr_f:
    case Insn::Subr_Wb_lit5_Wd:
    case Insn::Subr_Wb_Ws_Wd:
      return {Does::Reverses, false, true};
    case Insn::Subbr_f:
    case Insn::Subbr_Wb_lit5_Wd:
    case Insn::Subbr_Wb_Ws_Wd:
      return {Does::Reverses, true, true};
    case Insn::Inc_f:
    case Insn::Inc_Ws_Wd:
    case Insn::Inc2_f:
    case Insn::Inc2_Ws_Wd:
    case Insn::Dec_f:
    case Insn::Dec_Ws_Wd:
    case Insn::Dec2_f:
    case Insn::Dec2_Ws_Wd:
    case Insn::Cp0_f:
    case Insn::Cp0_Ws:
      return {Does::Steps, false, true};
    case Insn::Neg_f:
    case Insn::Neg_Ws_Wd:
      return {Does::Negates, false, true};
    case Insn::Clr_f:
    case Insn::Clr_WREG:
    case Insn::Clr_Wd:
    case Insn::Setm_f:
    case Insn::Setm_WREG:
    case Insn::Setm_Wd:
    case Insn::Mov_lit16_Wnd:
      return {Does::Fills};
    case Insn::Rcall_Expr:
    case Insn::Call_Expr:
      return {Does::Calls};
    case Insn::Rlc_f:
    case Insn::Rlc_Ws_Wd:
    case Insn::Rrc_f:
    case Insn::Rrc_Ws_Wd:
      return {Does::WorksStill, true};
    case Insn::And_f:
    case Insn::And_lit10_Wn:
    case Insn::And_Wb_lit5_Wd:
    case Insn::And_Wb_Ws_Wd:
    case Insn::Xor_f:
    case Insn::Xor_lit10_Wn:
    case Insn::Xor_Wb_lit5_Wd:
    case Insn::Xor_Wb_Ws_Wd:
    case Insn::Ior_f:
    case Insn::Ior_lit10_Wn:
    case Insn::Ior_Wb_lit5_Wd:
    case Insn::Ior_Wb_Ws_Wd:
    case Insn::Com_f:
    case Insn::Com_Ws_Wd:
    case Insn::Sl_f:
    case Insn::Sl_Ws_Wd:
    case Insn::Lsr_f:
    case Insn::Lsr_Ws_Wd:
    case Insn::Asr_f:
    case Insn::Asr_Ws_Wd:
    case Insn::Sl_Wb_lit4_Wnd:
    case Insn::Sl_Wb_Wns_Wnd:
    case Insn::Lsr_Wb_lit4_Wnd:
    case Insn::Lsr_Wb_Wns_Wnd:
    case Insn::Asr_Wb_lit4_Wnd:
    case Insn::Asr_Wb_Wns_Wnd:
    case Insn::Cpseq_Wb_Wn:
    case Insn::Cpsne_Wb_Wn:
    case Insn::Cpsgt_Wb_Wn:
    case Insn::Cpslt_Wb_Wn:
    case Insn::Mov_B_lit8_Wnd:
    case Insn::Se_Ws_Wnd:
    case Insn::Ze_Ws_Wnd:
    case Insn::Bset_f_bit:
    case Insn::Bclr_f_bit:
    case Insn::Btst_f_bit:
    case Insn::Btss_f_bit:
    case Insn::Btsc_f_bit:
    case Insn::Bset_Ws_bit4:
    case Insn::Bclr_Ws_bit4:
    case Insn::Btst_Ws_bit4:
    case Insn::Btst_Ws_Wb:
    case Insn::Btss_Ws_bit4:
    case Insn::Btsc_Ws_bit4:
    case Insn::Mul_UU_Wb_lit5_Wnd:
    case Insn::Mul_UU_Wb_Ws_Wnd:
    case Insn::Mul_US_Wb_Ws_Wnd:
    case Insn::Mul_SU_Wb_lit5_Wnd:
    case Insn::Mul_SU_Wb_Ws_Wnd:
    case Insn::Mul_SS_Wb_Ws_Wnd:
    case Insn::Return:
    case Insn::Lnk_lit14:
    case Insn::Ulnk:
      return {Does::WorksStill};
    default:
      return {};
  }
}

/// f with W0, and a result in either.
bool has_wreg(Insn id) {
  switch (id) {
    case Insn::Add_f:
    case Insn::Addc_f:
    case Insn::Sub_f:
    case Insn::Subb_f:
    case Insn::Subr_f:
    case Insn::Subbr_f:
    case Insn::And_f:
    case Insn::Xor_f:
    case Insn::Ior_f:
    case Insn::Cp_f:
    case Insn::Cpb_f:
      return true;
    default:
      return false;
  }
}

bool is_by_literal(Insn id) {
  switch (id) {
    case Insn::Add_lit10_Wn:
    case Insn::Addc_lit10_Wn:
    case Insn::Sub_lit10_Wn:
    case Insn::Subb_lit10_Wn:
    case Insn::And_lit10_Wn:
    case Insn::Xor_lit10_Wn:
    case Insn::Ior_lit10_Wn:
      return true;
    default:
      return false;
  }
}

bool stores_file(Insn id) {
  switch (id) {
    case Insn::Mov_WREG_f:
    case Insn::Mov_Wns_f:
    case Insn::Pop_f:
    case Insn::Clr_f:
    case Insn::Setm_f:
      return true;
    default:
      return false;
  }
}

}  // namespace

/// Follows a round with the multiples of the counter that each word holds.
class CountProof {
 public:
  CountProof(const Cpu& cpu, const KnownWaits::Wait& round, Count& count)
      : cpu_(cpu), round_(round), count_(count) {}

  bool holds(const std::vector<CountStep>& steps) {
    if (!only_words_change()) return false;
    for (const CountStep& step : steps)
      if (!follows(step)) return false;
    return ends_as_it_began();
  }

 private:
  struct Line {
    std::uint16_t value = 0, times = 0;
    bool moves() const { return times != 0; }
  };
  struct Word {
    std::uint16_t place = 0;
    Line line;
    bool was_read_first = false;
  };

  // all but registers, the DO loop's count and DC is as it was
  bool only_words_change() {
    const CoreState now(cpu_);
    for (const std::size_t i : {4u, 6u, 7u, 9u, 10u})
      if (now.words[i] != round_.state.words[i]) return false;
    if ((now.words[5] ^ round_.state.words[5]) & ~CoreState::kDc) return false;
    for (unsigned n = 0; n < 16; ++n)
      if (now.w(n) != round_.state.w(n)) changed_ |= static_cast<std::uint16_t>(1u << n);
    const std::uint64_t loops = round_.state.words[8];
    if (now.words[8] == loops) return true;
    count_.counter_ = Count::kLoopCount;
    count_.value_ = static_cast<std::uint16_t>(loops);
    count_.step_ = 0xFFFF;
    has_counter_ = true;
    return now.words[8] == loops - 1 && cpu_.loop_end;
  }

  // --- words

  Line counter(int place, std::uint16_t value, std::uint16_t later) {
    if (has_counter_ && count_.counter_ != place) is_one_ = false;
    has_counter_ = true;
    count_.counter_ = place;
    count_.value_ = value;
    count_.step_ = static_cast<std::uint16_t>(later - value);
    return {value, 1};
  }
  Line of_register(unsigned n) {
    const unsigned bit = 1u << n;
    if ((written_ | read_first_) & bit) return registers_[n];
    read_first_ |= static_cast<std::uint16_t>(bit);
    const std::uint16_t value = round_.state.w(n);
    return registers_[n] = changed_ & bit ? counter(static_cast<int>(n), value, cpu_.w[n]) : Line{value, 0};
  }
  void put_register(unsigned n, Line line) {
    if (n == 15) stays(line);  // it is even
    written_ |= static_cast<std::uint16_t>(1u << n);
    registers_[n] = line;
  }
  Word* find(unsigned place) {
    for (std::size_t i = 0; i < words_count_; ++i)
      if (words_[i].place == place) return &words_[i];
    return nullptr;
  }
  Word& add(unsigned place) {
    Word& word = words_[std::min(words_count_, words_.size() - 1)];
    if (words_count_ == words_.size()) is_one_ = false;
    words_count_ = std::min(words_count_ + 1, words_.size());
    word = Word{static_cast<std::uint16_t>(place), {}, false};
    return word;
  }
  std::uint16_t in_ram(unsigned place) const {
    std::uint16_t value;
    std::memcpy(&value, &cpu_.ram[place], 2);
    return value;
  }
  Line of_ram(unsigned place) {
    if (const Word* const known = find(place)) return known->line;
    Word& word = add(place);
    word.was_read_first = true;
    const std::uint16_t value = round_.memory.found(place), later = in_ram(place);
    return word.line =
               value != later ? counter(Count::kRam + static_cast<int>(place), value, later) : Line{value, 0};
  }
  void put_ram(unsigned place, Line line) {
    Word* const known = find(place);
    (known ? *known : add(place)).line = line;
  }
  // of what forms an address or is worked on in another way
  void stays(Line line) { is_one_ = is_one_ && !line.moves(); }

  // --- an instruction

  // the next word of RAM that it reads or writes; -1: it is none of RAM
  int next_touched(bool written) {
    for (unsigned& i = touch_[written ? 1 : 0]; i < step_->touched.count;)
      if (const unsigned place = step_->touched.places[i++]; (place & 1) == (written ? 1 : 0))
        return static_cast<int>(place & 0xFFFE);
    return -1;
  }
  void source(Line line) {
    if (sources_count_ < sources_.size()) sources_[sources_count_] = line;
    ++sources_count_;
  }
  void source_in_ram() {
    const int place = next_touched(false);
    source(place >= 0 ? of_ram(static_cast<unsigned>(place)) : Line{});  // a peripheral's stays, or flash
  }
  void pointer(unsigned n) { stays(of_register(n)); }

  // notes what an operand reads, by which pointers, and where the result goes
  void operand(Operand kind, Insn id, const Fields& f) {
    switch (kind) {
      case Operand::Wb:
        return source(of_register(f.w));
      case Operand::Rs:
        return source(of_register(f.s));
      case Operand::RsPair:
        source(of_register(2 * f.s));
        return source(of_register(2 * f.s + 1));
      case Operand::Source:
      case Operand::SourceOffset: {
        const unsigned mode = f.p | f.g;
        const bool is_pair = id == Insn::Mov_D_Ws_Wnd;
        if (mode == 0) {
          source(of_register(f.s));
          if (is_pair) source(of_register(f.s + 1));
          return;
        }
        pointer(f.s);
        if (mode >= 6) pointer(f.w);
        source_in_ram();
        if (is_pair) source_in_ram();
        return;
      }
      case Operand::SourceLiteral:
        pointer(f.s);
        return source_in_ram();
      case Operand::Literal:
      case Operand::LiteralTwice:
      case Operand::Bit:
      case Operand::Shift4:
        return source({});
      case Operand::Rd:
        if (is_by_literal(id)) source(of_register(f.d));
        to_register_ = static_cast<int>(f.d);
        return;
      case Operand::RdPair:
        to_register_ = static_cast<int>(2 * f.d);
        return;
      case Operand::Destination:
      case Operand::DestinationOffset: {
        const unsigned mode = f.q | f.h;
        if (mode == 0) {
          to_register_ = static_cast<int>(f.d);
          return;
        }
        pointer(f.d);
        if (mode >= 6) pointer(f.w);
        to_ram_ = true;
        return;
      }
      case Operand::DestinationLiteral:
        pointer(f.d);
        to_ram_ = true;
        return;
      case Operand::File:
      case Operand::FileWord:
        if (stores_file(id)) {
          to_ram_ = true;
          return;
        }
        source_in_ram();
        if (has_wreg(id)) source(of_register(0));
        return;
      case Operand::FileBit:
        source_in_ram();
        to_ram_ = true;
        return;
      case Operand::WregOption:
        f.D ? to_ram_ = true : to_register_ = 0;
        return;
      case Operand::Wreg:
        id == Insn::Mov_WREG_f ? source(of_register(0)) : static_cast<void>(to_register_ = 0);
        return;
      default:
        return;
    }
  }

  // flags that tell of a moving value
  void tells(Line line, bool is_result) {
    if (!line.moves()) return;
    if (count_.moving_count_ == Count::kMostMoving) {
      is_one_ = false;
      return;
    }
    count_.moving_[count_.moving_count_++] = {line.value, line.times, is_result};
  }
  Line combined(Line a, Line b, std::uint16_t times) {
    if (a.moves() && b.moves()) is_one_ = false;
    tells(a, false);
    tells(b, false);
    const Line result{step_->result, times};
    tells(result, true);
    return result;
  }

  /// A function of the host's that has no effect: what it is given and reads stays, and so its answer does, up to
  /// where the look is over anyway.
  bool asks_host() {
    constexpr unsigned kArguments = 4, kScratch = 8;
    for (unsigned n = 0; n < kArguments; ++n) stays(of_register(n));
    for (unsigned n = kArguments; n < kScratch; ++n)
      if (written_ >> n & 1) stays(registers_[n]);
    works_on_ram();
    put_register(0, {});
    return is_one_;
  }

  bool follows(const CountStep& step) {
    const unsigned address = cpu_.address_of(step.at);
    // What cannot be followed ends the proof.
    if (address >= kFlashEnd || step.touched.count > step.touched.places.size()) return false;
    if (cpu_.table().plain(step.at) == &call_host) {
      step_ = &step;
      return asks_host();
    }
    const Row* const row = find_row(cpu_.program.read(address));
    if (!row) return false;
    const Fields f = fields_of(*row, cpu_.program.read(address));
    Kind kind = kind_of(row->id);
    if (kind.does == Does::Other) return false;
    if (f.B) kind.does = Does::WorksStill;
    // what is repeated belongs to this step
    if (row->id == Insn::Repeat_lit14 && function_of(cpu_.program.read(address + 2)) != &no_operation)
      return false;
    if (kind.reads_flags && !flags_are_set_) count_.reads_flags_ = true;
    flags_are_set_ = flags_are_set_ || kind.sets_flags;
    // The operands, with those that the row does not name: stack pointer and frame pointer.
    step_ = &step;
    touch_ = {};
    sources_count_ = 0;
    to_register_ = -1;
    to_ram_ = false;
    if (row->id == Insn::Pop_f || row->id == Insn::Push_f || kind.does == Does::Calls ||
        row->id == Insn::Return)
      pointer(15);
    if (row->id == Insn::Lnk_lit14 || row->id == Insn::Ulnk) {
      pointer(14);
      pointer(15);
    }
    if (row->id == Insn::Pop_f) source_in_ram();
    if (row->id == Insn::Push_f) to_ram_ = true;
    for (const Operand operand_kind : row->kinds) operand(operand_kind, row->id, f);
    if (f.B && to_register_ >= 0) stays(of_register(static_cast<unsigned>(to_register_)));
    return sources_count_ <= sources_.size() && works(kind.does, *row) && is_one_;
  }

  bool works(Does does, const Row& row) {
    // A result moves as its operands do: their multiples of the counter are added or subtracted.
    const Line a = sources_[0], b = sources_[1];
    const auto times = [](int value) { return static_cast<std::uint16_t>(value); };
    switch (does) {
      case Does::Nothing:
        return step_->touched.count == 0;
      case Does::Copies:
        put(a);
        if (row.id == Insn::Mov_D_Ws_Wnd) put_register(static_cast<unsigned>(to_register_ + 1), b);
        if (row.id == Insn::Mov_D_Wns_Wd) {
          if (to_ram_) return put_next(b);
          put_register(static_cast<unsigned>(to_register_ + 1), b);
        }
        return true;
      case Does::Tells:
        tells(a, true);
        put(a);
        return true;
      case Does::Adds:
        put(combined(a, b, times(a.times + b.times)));
        return true;
      case Does::Subtracts:
        put(combined(a, b, times(a.times - b.times)));
        return true;
      case Does::Reverses:
        put(combined(a, b, times(b.times - a.times)));
        return true;
      case Does::Steps:
        put(combined(a, {}, a.times));
        return true;
      case Does::Negates:
        put(combined(a, {}, times(-a.times)));
        return true;
      case Does::Fills:
        put({});
        return true;
      case Does::Calls:
        return step_->touched.count == 2 && put_next({}) && put_next({});
      case Does::WorksStill:
        return works_still();
      default:
        return false;
    }
  }

  void put(Line line) {
    if (to_register_ >= 0) put_register(static_cast<unsigned>(to_register_), line);
    if (to_ram_) put_next(line);
  }
  bool put_next(Line line) {
    const int place = next_touched(true);
    if (place >= 0) put_ram(static_cast<unsigned>(place), line);
    return true;
  }

  void works_on_ram() {
    for (unsigned i = 0; i < step_->touched.count; ++i)
      if (const unsigned place = step_->touched.places[i]; !(place & 1)) stays(of_ram(place));
    for (unsigned i = 0; i < step_->touched.count; ++i)
      if (const unsigned place = step_->touched.places[i]; place & 1) put_ram(place & 0xFFFE, {});
  }
  // what it takes stays, so what it gives stays
  bool works_still() {
    for (std::size_t i = 0; i < sources_count_; ++i) stays(sources_[i]);
    works_on_ram();
    for (unsigned n = 0; n < 16; ++n)
      if (step_->at->writes >> n & 1) put_register(n, {});
    if (to_register_ >= 0) put_register(static_cast<unsigned>(to_register_), {});
    return is_one_;
  }

  // the counter has counted, and nothing else that was looked at moves
  bool ends_as_it_began() {
    if (!has_counter_ || !is_one_) return false;
    for (unsigned n = 0; n < 16; ++n) {
      if (!(read_first_ >> n & 1)) continue;
      const std::uint16_t wanted = count_.counter_ == static_cast<int>(n) ? 1 : 0;
      if (registers_[n].times != wanted) return false;
    }
    for (std::size_t i = 0; i < words_count_; ++i) {
      const Word& word = words_[i];
      const std::uint16_t wanted = count_.counter_ == Count::kRam + word.place ? 1 : 0;
      if (word.was_read_first && word.line.times != wanted) return false;
    }
    count_.registers_ = read_first_;
    if (count_.counter_ < 16) count_.registers_ &= static_cast<std::uint16_t>(~(1u << count_.counter_));
    return true;
  }

  const Cpu& cpu_;
  const KnownWaits::Wait& round_;
  Count& count_;
  std::uint16_t changed_ = 0, written_ = 0, read_first_ = 0;
  bool has_counter_ = false, is_one_ = true, flags_are_set_ = false;
  std::array<Line, 16> registers_{};
  std::array<Word, 48> words_{};
  std::size_t words_count_ = 0;
  // of the instruction
  const CountStep* step_ = nullptr;
  std::array<unsigned, 2> touch_{};
  std::array<Line, 3> sources_{};
  std::size_t sources_count_ = 0;
  int to_register_ = -1;
  bool to_ram_ = false;
};

bool Count::prove(const Cpu& cpu, const KnownWaits::Wait& round, const std::vector<CountStep>& steps) {
  counter_ = 0;
  reads_flags_ = false;
  moving_count_ = 0;
  if (!CountProof(cpu, round, *this).holds(steps)) return false;
  round_ = round;
  flags_ = static_cast<std::uint8_t>(cpu.sr_low() & kSrFlags);
  return true;
}

std::uint16_t Count::counter_now(const Cpu& cpu) const {
  if (counter_ < kLoopCount) return cpu.w[static_cast<std::size_t>(counter_)];
  if (counter_ == kLoopCount) return static_cast<std::uint16_t>(cpu.loop.count);
  std::uint16_t value;
  std::memcpy(&value, &cpu.ram[static_cast<std::size_t>(counter_ - kRam)], 2);
  return value;
}

bool Count::is_over(const Cpu& cpu) const {
  const unsigned but_for = counter_ >= kRam ? static_cast<unsigned>(counter_ - kRam) : Cpu::kRamBytes;
  return !round_.memory.are_as_read(cpu.ram.data(), but_for);
}

bool Count::is_plain(const Cpu& cpu) const { return !cpu.loop_end && cpu.modcon == 0; }

bool Count::is_core_as_proven(const Cpu& cpu) const {
  const CoreState now(cpu);
  return now.words[9] == round_.state.words[9] && now.words[10] == round_.state.words[10];
}

Cycle Count::rounds_from(const Cpu& cpu) const {
  for (unsigned n = 0; n < 16; ++n)
    if ((registers_ >> n & 1) && cpu.w[n] != round_.state.w(n)) return -1;
  if (!is_core_as_proven(cpu)) return -1;
  if (reads_flags_ && (cpu.sr_low() & kSrFlags) != flags_) return -1;
  if (is_over(cpu)) return -1;
  const std::uint16_t value = counter_now(cpu);
  Cycle rounds = counter_ == kLoopCount ? value : kMostRounds;
  const auto since = static_cast<std::uint16_t>(value - value_);
  for (std::size_t i = 0; i < moving_count_; ++i) {
    const Moving& m = moving_[i];
    const auto at = static_cast<std::uint16_t>(m.value + m.times * since);
    if (((at ^ m.value) & 0x8000) || (m.is_result && (at == 0 || m.value == 0))) return 0;
    const int slope = static_cast<std::int16_t>(m.times * step_), below = at & 0x7FFF;
    const int left = slope > 0   ? (0x7FFF - below) / slope
                     : slope < 0 ? (at < 0x8000 && m.is_result ? below - 1 : below) / -slope
                                 : 0x7FFF;
    rounds = std::min<Cycle>(rounds, 1 + left);
  }
  return rounds;
}

void Count::advance(Cpu& cpu, Cycle rounds) const {
  const auto value = static_cast<std::uint16_t>(counter_now(cpu) + step_ * rounds);
  if (counter_ < kLoopCount)
    cpu.w[static_cast<std::size_t>(counter_)] = value;
  else if (counter_ == kLoopCount)
    cpu.loop.count = value;
  else
    std::memcpy(&cpu.ram[static_cast<std::size_t>(counter_ - kRam)], &value, 2);
}

}  // namespace dspic
