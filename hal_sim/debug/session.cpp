// SPDX-License-Identifier: MIT
#include "hal_sim/debug/session.h"

#include <algorithm>
#include <filesystem>

#include "hal_sim/chip/named_functions.h"
#include "sim_core/base/input_file.h"

namespace debug {

namespace {

constexpr auto kIdleEvery = std::chrono::milliseconds(20);
// so many cycles before it are looked at first when it goes back; then ever more
constexpr Cycle kFirstLookBack = 50'000, kLookBackGrows = 30;
constexpr std::size_t kLongestSource = 4u << 20;  // bytes
// a program may run beyond the window's end, to the end of an instruction or a stretch
constexpr Cycle kLongestBlock = 10'000;

/// May code that was made of `source` be of a file that lies at `path`? Not if both are there and differ.
bool is_possibly(const std::string& source, const std::string& path) {
  std::string one, other;
  if (!sim::read_input_file(source, kLongestSource, one).empty()) return true;
  return sim::read_input_file(path, kLongestSource, other).empty() && one == other;
}

}  // namespace

// --- worlds

std::unique_ptr<Session> Session::open(Setup setup, std::vector<std::string>& problems) {
  std::unique_ptr<Session> session(new Session(std::move(setup)));
  session->setup_.options.threads = 1;
  if (!session->open_world(problems)) return nullptr;
  session->start(0);
  Moment beginning;
  beginning.is_anywhere = true;
  session->target_ = beginning;
  session->stop_.why = Stop::Why::Entry;
  session->resume(nullptr);
  return session;
}

Session::~Session() { abandon(); }

bool Session::open_world(std::vector<std::string>& problems) {
  if (twin_ && setup_.closes) setup_.closes();
  machine_.reset();
  twin_.reset();  // the next world gets the addresses that this one had
  twin_ = twin::Twin::open(setup_.world, setup_.options, problems);
  if (!twin_) return false;
  // The first robot of that name, or the first one of all, that runs firmware.
  robot_ = -1;
  for (int i = 0; i < twin_->robots() && robot_ < 0; ++i) {
    const std::string& name = twin_->world().robots[static_cast<std::size_t>(i)].name;
    if (!setup_.robot.empty() && name != setup_.robot) continue;
    if (twin_->launch(i)) {
      problems.push_back(
          "debug: robot '" + name +
          "' runs a program of the PC, expected firmware; start it in a debugger of its language, and "
          "the run with --extern " +
          name);
      return false;
    }
    auto* const runner = dynamic_cast<chip::ChipRunner*>(twin_->mind(i).runner());
    if (!runner) continue;  // it has no program
    machine_ = std::make_unique<Machine>(*runner);
    robot_ = i;
    setup_.robot = name;
  }
  if (robot_ < 0) {
    problems.push_back(setup_.robot.empty()
                           ? "debug: firmware: got none, and none in the world, expected a program for a "
                             "robot; --fw, or launch's "
                             "firmware, gives it one"
                           : "debug: robot '" + setup_.robot + "' has no program, or is not there");
    return false;
  }
  // the next world runs the same images, without building them
  setup_.options.firmware.clear();
  for (int i = 0; i < twin_->robots(); ++i)
    if (!twin_->image_path(i).empty())
      setup_.options.firmware.push_back(
          {twin_->world().robots[static_cast<std::size_t>(i)].name, twin_->image_path(i)});
  set_marks();
  twin_->tell_flashes([this](int robot) {
    if (robot == robot_) follow_flash();
  });
  if (setup_.opened) setup_.opened(*twin_);
  return true;
}

// its thread stands until resume()
void Session::start(Cycle fast_until) {
  state_ = State::Stopped;
  abandoned_ = pause_ = false;
  fast_until_ = fast_until;
  put_off_.clear();
  trap_.clear();
  was_reset_ = last_repeats_ = false;
  next_poke_ = 0;
  watched_.clear();
  traps_ = 0;
  thread_ = std::thread([this] { run_world(); });
}

void Session::abandon() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    abandoned_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Session::run_world() {
  {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return state_ == State::Running || abandoned_; });
  }
  sim::Simulation& simulation = twin_->simulation();
  host::FirmwareMind& mind = twin_->mind(robot_);
  const sim::Clicks end = sim::from_seconds(setup_.seconds), tick = simulation.scene().tick_clicks();
  while (!abandoned_ && simulation.now() < end) {
    if (machine_->watch(this, mind.cycle_at(simulation.now() + tick) + kLongestBlock >= quiet_until()))
      mind.wake();  // what it has passed over is to be seen
    if (setup_.step)
      setup_.step(*twin_);
    else
      simulation.step();
    if (setup_.ticked && !is_repeating_ && !abandoned_) setup_.ticked();
    std::as_const(mind).runner();  // a robot that is idle has come as far as the world
  }
  machine_->watch(this, false);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    state_ = State::Ended;
    stop_ = {Stop::Why::End, 0, "the end of the world's time"};
  }
  changed_.notify_all();
}

// --- the face's side

Stop Session::resume(const std::function<bool()>& idle) {
  selected_.reset();
  std::unique_lock<std::mutex> lock(mutex_);
  if (state_ == State::Ended) return stop_;
  pause_ = false;
  state_ = State::Running;
  changed_.notify_all();
  while (!changed_.wait_for(lock, kIdleEvery, [this] { return state_ != State::Running; })) {
    lock.unlock();
    if (idle && idle()) pause_ = true;
    lock.lock();
  }
  target_.reset();
  return stop_;
}

Stop Session::run(Plan plan, const std::function<bool()>& idle) {
  if (plan >= Plan::BackInstruction) return go_back(plan, idle);
  if (has_ended()) return stop_;
  // what was changed by hand later than here has not happened
  while (!pokes_.empty() && pokes_.back().when.at > now()) pokes_.pop_back();
  next_poke_ = pokes_.size();
  traps_ = machine_->runner().traps().size();
  if ((plan == Plan::Line || plan == Plan::NextLine) && machine_->is_starting_up()) return go_to_main(idle);
  plan_ = plan;
  from_ = moment(now());
  return resume(idle);
}

// a step by lines in the start-up, which has none of the program's
Stop Session::go_to_main(const std::function<bool()>& idle) {
  std::string error;
  const Breakpoint* main = add_breakpoint("main", "", error);
  if (!main) return {Stop::Why::End, 0, error};
  const int id = main->id;
  plan_ = Plan::Continue;
  Stop stop = resume(idle);
  remove(id);
  last_id_ = id - 1;
  if (stop.id == id) stop = {Stop::Why::Step, 0, ""};
  return stop;
}

Stop Session::go_to(Cycle cycle, const std::function<bool()>& idle) {
  Moment to;
  to.at = cycle;
  to.is_anywhere = true;
  if (cycle < now() || has_ended()) return repeat_to(to, cycle, idle);
  if (cycle == now()) return stop_ = {Stop::Why::Step, 0, ""};
  plan_ = Plan::GoTo;
  target_ = to;
  fast_until_ = cycle;
  stop_ = {Stop::Why::Step, 0, ""};
  return resume(idle);
}

// a new world, up to `cycle`; instruction by instruction from `look_from` on
Stop Session::repeat_to(const Moment& to, Cycle look_from, const std::function<bool()>& idle) {
  abandon();
  std::vector<std::string> problems;
  is_repeating_ = true;
  if (!open_world(problems)) {  // a file has changed meanwhile
    state_ = State::Ended;
    return stop_ = {Stop::Why::End, 0, problems.empty() ? "the world cannot be opened again" : problems[0]};
  }
  start(look_from);
  target_ = to;
  stop_ = {Stop::Why::Step, 0, ""};
  Stop stop = resume(idle);
  is_repeating_ = false;
  if (setup_.repeated) setup_.repeated();
  return stop;
}

// runs again up to here, ever more of it instruction by instruction, for the latest moment that will do
Stop Session::go_back(Plan plan, const std::function<bool()>& idle) {
  from_ = moment(now());
  from_.is_anywhere = has_ended();
  const Moment here = from_;
  plan_ = plan;
  for (Cycle back = kFirstLookBack;; back *= kLookBackGrows) {
    const Cycle look_from = std::max<Cycle>(0, here.at - back);
    latest_.reset();
    looks_back_ = true;
    repeat_to(here, look_from, idle);
    looks_back_ = false;
    if (latest_ || look_from == 0 || pause_) break;
  }
  if (pause_) return {Stop::Why::Pause, 0, "paused"};
  Moment beginning;
  beginning.is_anywhere = true;
  const Moment to = latest_.value_or(beginning);
  Stop stop = repeat_to(to, to.at, idle);
  if (!latest_) return {Stop::Why::Entry, 0, "the beginning of the run"};
  if (to.hit) stop = {Stop::Why::Breakpoint, to.hit, "breakpoint " + std::to_string(to.hit)};
  return stop;
}

Cycle Session::now() const { return machine_->now(); }

double Session::seconds() const {
  const host::Runner& runner = machine_->runner();
  return runner.to_world_s ? runner.to_world_s(now()) : 0;
}

// --- the world's side

void Session::before(Cycle at) {
  if (abandoned_) return;
  apply_pokes();
  if (!wants_stop(at)) return;
  stand();
}

void Session::stand() {
  std::unique_lock<std::mutex> lock(mutex_);
  state_ = State::Stopped;
  changed_.notify_all();
  changed_.wait(lock, [this] { return state_ == State::Running || abandoned_; });
}

void Session::after(const chip::Step& step) {
  last_pc_ = step.pc;
  last_repeats_ = machine_->repeats(step);
  if (step.entered == dspic::kNoVector) return;
  put_off_.push_back({step.pc, machine_->nesting() - 1});
  if (step.entered < dspic::kFirstIrqVector)
    trap_ = std::string(dspic::vector_name(step.entered)) + " trap at " + file().code.describe(step.pc);
}

void Session::was_reset(Cycle) {
  was_reset_ = true;
  put_off_.clear();
}

bool Session::wants_stop(Cycle at) {
  const int nesting = machine_->nesting();
  while (!put_off_.empty() && put_off_.back().nesting > nesting) put_off_.pop_back();
  // an instruction that was put off has been stopped at already
  const bool comes_again =
      !put_off_.empty() && put_off_.back().nesting == nesting && put_off_.back().pc == pc();
  if (comes_again) put_off_.pop_back();
  // A run that repeats an earlier one stops only where that ends; on the way back it notes each place where
  // it might stop.
  if (target_ && is_reached(*target_)) return true;
  if (is_repeating_) {
    if (!looks_back_) return false;
    Moment here = moment(at);
    if (plan_ == Plan::BackContinue && !comes_again) here.hit = watch_hit() ? stop_.id : hit_here(false);
    if (is_way_back(here)) latest_ = here;
    return pause_;
  }
  // What stops any run: the user, a reset, a trap, a watchpoint.
  if (pause_) {
    stop_ = {Stop::Why::Pause, 0, "paused"};
    return true;
  }
  if (plan_ == Plan::GoTo) {
    was_reset_ = false;
    trap_.clear();
  }
  if (was_reset_ || !trap_.empty()) {
    stop_ =
        was_reset_ ? Stop{Stop::Why::Reset, 0, "the processor was reset"} : Stop{Stop::Why::Trap, 0, trap_};
    const auto& told = machine_->runner().traps();
    if (was_reset_ && told.size() > traps_) stop_.text += ": " + told.back().message;
    was_reset_ = false;
    trap_.clear();
    return true;
  }
  if (watch_hit() && plan_ != Plan::GoTo) return true;
  // Breakpoints, those of functions that the simulator plays included.
  if (comes_again || last_repeats_ || plan_ == Plan::GoTo) return false;
  if (const int id = hit_here(true)) {
    stop_ = {Stop::Why::Breakpoint, id, "breakpoint " + std::to_string(id)};
    if (const std::uint32_t called = marks_host_ ? machine_->code().host_function_called(pc()) : 0;
        called && marks_[called])
      stop_.text += ", calls " + machine_->code().function_at(called)->name + "()";
    const auto b =
        std::find_if(breakpoints_.begin(), breakpoints_.end(), [&](const auto& x) { return x.id == id; });
    if (b->once) {
      stop_.text = b->what;
      breakpoints_.erase(b);
      set_marks();
    }
    return true;
  }
  // The end of a step.
  if (plan_ == Plan::Continue || !is_step_over(at)) return false;
  stop_ = {Stop::Why::Step, 0, ""};
  return true;
}

bool Session::is_step_over(Cycle at) {
  if (plan_ == Plan::AnyInstruction) return true;
  const Moment here = moment(at);
  if (here.nesting > from_.nesting) return false;
  const bool is_deeper = here.nesting == from_.nesting && here.base > from_.base;
  switch (plan_) {
    case Plan::Instruction:
      return true;
    case Plan::NextInstruction:
      return !is_deeper;
    case Plan::Finish:
      // 0: where the caller's frame is not known, it has not returned
      return here.nesting < from_.nesting || (here.base != 0 && here.base < from_.base);
    case Plan::Line:
    case Plan::NextLine: {
      if (plan_ == Plan::NextLine && is_deeper) return false;
      const bool is_other =
          here.base != from_.base || here.nesting != from_.nesting || !is_same_line(here.pc, from_.pc);
      return begins_line(here.pc) && is_other;
    }
    default:
      return false;
  }
}

bool Session::is_way_back(const Moment& here) {
  if (plan_ == Plan::BackContinue) return here.hit != 0;
  if (here.nesting > from_.nesting || last_repeats_) return false;
  if (plan_ == Plan::BackInstruction) return true;
  // behind a reset there is no function to stay in
  return (here.base <= from_.base || from_.base == 0) && begins_line(here.pc) &&
         (here.base != from_.base || !is_same_line(here.pc, from_.pc));
}

bool Session::begins_line(std::uint32_t at) const {
  const auto* line = file().code.line_at(at);
  return line && line->address == at && line->is_statement;
}

bool Session::is_same_line(std::uint32_t a, std::uint32_t b) const {
  const auto *one = file().code.line_at(a), *other = file().code.line_at(b);
  return one && other && one->file == other->file && one->line == other->line;
}

Session::Moment Session::moment(Cycle at) {
  return {at, pc(), machine_->base(), machine_->nesting(), 0, false};
}

bool Session::is_reached(const Moment& moment) const {
  if (moment.is_anywhere || now() != moment.at) return now() >= moment.at;
  return pc() == moment.pc && machine_->base() == moment.base;
}

// --- breakpoints

int Session::hit_here(bool count) {
  std::uint32_t here = pc();
  if (here >= marks_.size()) return 0;
  // a function that the simulator plays is met where it is called
  if (const std::uint32_t called = marks_host_ ? machine_->code().host_function_called(here) : 0;
      called && marks_[called])
    here = called;
  if (!marks_[here]) return 0;
  for (Breakpoint& b : breakpoints_) {
    if (std::find(b.addresses.begin(), b.addresses.end(), here) == b.addresses.end() || !holds(b)) continue;
    if (count) ++b.hits;
    return b.id;
  }
  return 0;
}

bool Session::holds(const Breakpoint& b) const {
  CValue value;
  std::string error;
  return b.condition.empty() || !values().compute(b.condition, Want::Number, value, error) ||
         value.is_true();  // what cannot be told stops
}

bool Session::watch_hit() {
  bool hit = false;
  std::size_t n = 0;
  for (Breakpoint& b : breakpoints_) {
    if (b.data.bytes == 0) continue;
    const std::uint64_t value = values().read(b.data);
    const bool is_new = n >= watched_.size();
    if (is_new) watched_.push_back(value);
    std::uint64_t& old = watched_[n++];
    if (is_new || old == value) continue;
    const std::string change = b.what + ": " + values().brief(b.shape, old) + " -> " +
                               values().brief(b.shape, value) + ", by " + file().code.describe(last_pc_);
    old = value;
    if (hit || !holds(b)) continue;
    if (!is_repeating_) ++b.hits;
    stop_ = {Stop::Why::Watchpoint, b.id, change};
    hit = true;
  }
  return hit;
}

Session::CodePlace Session::find_code(const std::string& where, std::string& error) const {
  CodePlace code;
  const dspic::CodeMap& map = file().code;
  const std::size_t colon = where.rfind(':');
  const std::string number = where.substr(colon == std::string::npos ? 0 : colon + 1);
  const bool is_number = !number.empty() && number.find_first_not_of("0123456789") == std::string::npos;
  // A line, of the file where the program stands when none is named.
  if (is_number && number.size() < 9) {
    const auto* line = map.line_at(pc());
    const std::string source = colon != std::string::npos ? where.substr(0, colon)
                               : line                     ? map.lines().files[line->file]
                                                          : "";
    int found = 0;
    const std::vector<std::size_t> files = files_meant(source);
    code.addresses = map.addresses_of(files, std::stoi(number), found);
    if (code.addresses.empty())
      error = "got '" + where + "', expected a line with code in a file of the program" +
              (map.lines().rows.empty() ? "; this image has no lines"
               : files.empty()          ? "; it has no such file"
                                        : "");
    else
      code.what = source.substr(source.rfind('/') + 1) + ":" + std::to_string(found);
  } else if (const auto label = file().functions.find(where); label != file().functions.end()) {
    code.addresses = chip::copies_of(file(), where);
    code.addresses.insert(code.addresses.begin(), label->second);
    code.what = where;
    code.is_function = true;
  } else if (const auto copies = chip::copies_of(file(), where); !copies.empty()) {
    code.addresses = copies;
    code.what = where;
  } else {
    std::int64_t address = 0;
    const bool is_address = where.rfind("0x", 0) == 0 || where.rfind('*', 0) == 0;
    if (is_address && values().evaluate(where.substr(where[0] == '*'), address, error) && address >= 0 &&
        address < machine_->code_end() && machine_->is_code(static_cast<std::uint32_t>(address))) {
      code.addresses = {static_cast<std::uint32_t>(address)};
      code.what = where;
    } else {
      error = "got '" + where + "', expected a function, file:line, or an address of code such as 0x1a0";
      if (!is_address) error += "; as a function, it " + chip::why_no_code(file(), where);
    }
  }
  return code;
}

const Breakpoint* Session::add_breakpoint(const std::string& where, const std::string& condition,
                                          std::string& error) {
  Breakpoint b;
  if (!place(b, where, error)) return nullptr;
  // A condition has to make sense at the breakpoint, or there is none.
  std::int64_t value = 0;
  std::string wrong;
  if (!condition.empty() && !values(b.addresses[0]).evaluate(condition, value, wrong)) {
    error = "condition: " + wrong;
    return nullptr;
  }
  b.condition = condition;
  b.id = ++last_id_;
  breakpoints_.push_back(std::move(b));
  set_marks();
  return &breakpoints_.back();
}

/// Where it is in the program's code, and how it is called.
bool Session::place(Breakpoint& b, const std::string& where, std::string& error) const {
  CodePlace code = find_code(where, error);
  b.addresses = std::move(code.addresses);
  // of a function, where conditions see its arguments
  if (code.is_function)
    for (std::uint32_t& address : b.addresses) address = machine_->body_of(address);
  if (!b.addresses.empty()) b.what = std::move(code.what);
  return !b.addresses.empty();
}

/// The robot has another program from here on, and begins it. Breakpoints are where they are in that; what it has
/// not is not met.
void Session::follow_flash() {
  auto* const runner = dynamic_cast<chip::ChipRunner*>(twin_->mind(robot_).runner());
  if (!runner) return;  // programs of the PC are not flashed into a robot of the chip
  const bool is_watched = machine_->is_watched();
  machine_ = std::make_unique<Machine>(*runner);
  machine_->watch(this, is_watched);
  put_off_.clear();
  trap_.clear();
  traps_ = 0;
  last_repeats_ = false;
  for (Breakpoint& b : breakpoints_) {
    std::string none;
    if (b.data.bytes == 0)
      place(b, b.what, none);
    else if (const auto data = values().find_data(b.what)) {
      b.data = *data;
      b.shape = values().shape_of(b.what);
    }
  }
  set_marks();
  watched_.clear();
}

std::string Session::note_of(const Breakpoint& b) const {
  const bool is_inlined =
      !b.addresses.empty() && !file().functions.count(b.what) && !chip::copies_of(file(), b.what).empty();
  return is_inlined ? b.what + "() " + chip::why_no_code(file(), b.what) : "";
}

std::vector<std::size_t> Session::files_meant(const std::string& path) const {
  namespace fs = std::filesystem;
  std::error_code none;
  const auto& files = file().code.lines().files;
  std::vector<std::size_t> found;
  if (path.empty()) return found;
  // The very file; else those whose paths end in what was named.
  const fs::path wanted = fs::weakly_canonical(path, none);
  for (std::size_t i = 0; i < files.size(); ++i)
    if (fs::path(files[i]).is_absolute() && fs::weakly_canonical(files[i], none) == wanted)
      found.push_back(i);
  if (!found.empty()) return found;
  const std::string end = dspic::whole_path("", path);
  for (std::size_t i = 0; i < files.size(); ++i)
    if (dspic::ends_path(files[i], end)) found.push_back(i);
  if (!found.empty() || !fs::path(path).is_absolute()) return found;
  // the image was made somewhere else, or of files that were copied
  std::size_t longest = 0;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::string &a = files[i], b = wanted.string();
    std::size_t same = 0, names = 0;
    while (same < a.size() && same < b.size() && a[a.size() - 1 - same] == b[b.size() - 1 - same])
      names += b[b.size() - 1 - same++] == '/';
    names += same == a.size() ? 1 : 0;
    if (names == 0 || names < longest || !is_possibly(a, b)) continue;
    if (names > longest) found.clear();
    longest = names;
    found.push_back(i);
  }
  return found;
}

const Breakpoint* Session::add_watchpoint(const std::string& what, const std::string& condition,
                                          std::string& error) {
  Breakpoint b;
  b.what = what;
  std::int64_t value = 0;
  if (const auto data = values().find_data(what)) {
    b.data = *data;
    b.shape = values().shape_of(what);
    if (data->bytes > 8) {
      error = "got '" + what + "' of " + std::to_string(data->bytes) +
              " bytes, expected at most 8; watch a part of it";
      return nullptr;
    }
  } else if (!what.empty() && what[0] == '*') {  // a word at an address
    if (!values().evaluate(what.substr(1), value, error)) return nullptr;
    b.data = {static_cast<Address>(value) & kAddressMask, 2};
  } else {
    error = "got '" + what + "', expected a variable, a register or *address";
    return nullptr;
  }
  if (!condition.empty() && !values().evaluate(condition, value, error)) return nullptr;
  b.condition = condition;
  b.id = ++last_id_;
  breakpoints_.push_back(std::move(b));
  look_at_watchpoints();
  return &breakpoints_.back();
}

void Session::look_at_watchpoints() {
  watched_.clear();
  for (const Breakpoint& b : breakpoints_)
    if (b.data.bytes) watched_.push_back(values().read(b.data));
}

bool Session::remove(int id) {
  const auto gone =
      std::remove_if(breakpoints_.begin(), breakpoints_.end(), [&](const auto& b) { return b.id == id; });
  const bool found = gone != breakpoints_.end();
  breakpoints_.erase(gone, breakpoints_.end());
  look_at_watchpoints();
  set_marks();
  return found;
}

void Session::set_marks() {
  marks_.assign(Machine::code_end(), 0);
  marks_host_ = false;
  for (const Breakpoint& b : breakpoints_)
    for (const std::uint32_t a : b.addresses) {
      marks_[a] = 1;
      marks_host_ |= dspic::is_host_place(chip::goto_target(file(), a));
    }
}

// --- data

bool Session::select_frame(std::size_t number) {
  const std::vector<Frame> all = frames();
  if (number >= all.size()) return false;
  selected_.reset();
  if (number > 0) selected_ = all[number];
  return true;
}

bool Session::assign(const std::string& name, const std::string& expression, std::string& error) {
  Data to;
  std::uint64_t raw = 0;
  if (!values().assignment(name, expression, to, raw, error)) return false;
  if (write(to, raw)) return true;
  error = "got '" + name + "', expected a variable of up to 8 bytes or a register";
  return false;
}

bool Session::write(const Data& data, std::uint64_t value) {
  if (data.bytes > 8) return false;
  Data whole = data;
  whole.width = 0;
  if (data.width > 0) {
    const std::uint64_t mask = ((std::uint64_t{1} << data.width) - 1) << data.bit;
    value = (values().read(whole) & ~mask) | (value << data.bit & mask);
  }
  if (!machine_->write(whole, &value)) return false;
  if (has_ended()) return true;
  twin_->mind(robot_).wake();
  pokes_.push_back({moment(now()), whole, value});
  next_poke_ = pokes_.size();
  return true;
}

void Session::apply_pokes() {
  for (; next_poke_ < pokes_.size() && is_reached(pokes_[next_poke_].when); ++next_poke_) {
    machine_->write(pokes_[next_poke_].data, &pokes_[next_poke_].value);
    twin_->mind(robot_).wake();
  }
}

/// Nobody has to look before.
Cycle Session::quiet_until() const {
  return next_poke_ < pokes_.size() ? std::min(fast_until_, pokes_[next_poke_].when.at) : fast_until_;
}

}  // namespace debug
