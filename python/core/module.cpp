// SPDX-License-Identifier: MIT
// twinpuck._core: World and what it is asked, as the Python files of twinpuck/ use it. Users see those.
//
// Running releases the interpreter's lock; each tick's Python callable, and Ctrl-C, take it again. A world
// that runs in one Python thread refuses questions of another.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <atomic>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <thread>

#include "hal_sim/faults/kinds.h"
#include "hal_sim/signals/condition.h"
#include "hal_sim/signals/signals.h"
#include "hal_sim/twin/world_file.h"
#include "install/places.h"
#include "python/core/values_in_python.h"
#include "python/core/world.h"
#include "sim_core/base/input_file.h"
#include "sim_core/load/world_loader.h"

namespace py = pybind11;

namespace python {

namespace {

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "\n") + line;
  return text;
}

std::once_flag numpy_read;
std::atomic<bool> is_numpy_read{false};

/// Before the first array is made. pybind11 imports numpy within a static variable's beginning, while Python lets other
/// threads go on: one that then waited for the variable kept Python's lock for ever. Here they wait without it.
void read_numpy() {
  if (is_numpy_read) return;
  py::gil_scoped_release free;
  std::call_once(numpy_read, [] {
    py::gil_scoped_acquire lock;
    py::dtype::of<double>();
    is_numpy_read = true;
  });
}

/// A world with a guard: who runs it, and whether it is still open.
class Handle {
 public:
  explicit Handle(std::unique_ptr<World> world) : world_(std::move(world)) {}

  World& world() {
    check();
    if (is_running_ && std::this_thread::get_id() != runner_)
      throw std::runtime_error(
          "world: got a question while it runs in another thread, expected it when run() has returned");
    return *world_;
  }
  int robot(int index) {
    if (index < 0 || index >= world().twin().robots())
      throw py::index_error("got robot " + std::to_string(index) + " of " +
                            std::to_string(world().twin().robots()));
    return index;
  }
  /// Marks it as running for as long as this lives.
  class Running {
   public:
    explicit Running(Handle& handle) : handle_(handle) {
      handle.check();
      if (handle.is_running_.exchange(true))
        throw std::runtime_error(
            "run: got a call from a callable of the world that runs, or another thread, expected one at a "
            "time");
      handle.runner_ = std::this_thread::get_id();
    }
    ~Running() { handle_.is_running_ = false; }

   private:
    Handle& handle_;
  };
  /// What was lost, a line each.
  std::string close() {
    std::string lost = finish();
    world_.reset();
    return lost;
  }
  /// Closes it, but for what it came to, which can be asked in a handle of its own. None: it was closed before.
  py::tuple close_and_keep() {
    const std::string lost = finish();
    return py::make_tuple(lost, world_ ? py::cast(std::make_unique<Handle>(std::move(world_))) : py::none());
  }
  bool is_open() const { return world_ != nullptr; }

 private:
  std::string finish() {
    if (!world_) return "";
    const Running running(*this);
    std::vector<std::string> problems;
    {
      py::gil_scoped_release free;
      world_->finish(problems);
    }
    return joined(problems);
  }
  void check() const {
    if (!world_) throw std::runtime_error("world: got a call behind close(), expected it before");
  }
  std::unique_ptr<World> world_;
  std::atomic<bool> is_running_{false};
  std::thread::id runner_;
};

/// What `ask` gives, whose refusals are ValueErrors; that a world is closed, or runs, is none.
template <typename Ask>
auto refusing(Handle& handle, const Ask& ask) {
  World& world = handle.world();
  try {
    return ask(world);
  } catch (const inputs::Json::exception& e) {
    throw std::invalid_argument(e.what());
  } catch (const std::runtime_error& e) {
    throw std::invalid_argument(e.what());
  }
}

/// A condition over signals of a world, for as long as that is open.
class Watch {
 public:
  Watch(Handle& handle, const std::string& text, int robot)
      : handle_(handle),
        condition_(
            refusing(handle, [&](World& world) { return signals::Condition(text, world.twin(), robot); })) {}
  double value() { return condition_.value(handle_.world().twin()); }
  bool holds() { return condition_.holds(handle_.world().twin()); }

 private:
  Handle& handle_;
  signals::Condition condition_;
};

template <typename T>
T option(const py::dict& options, const char* key, T usual) {
  return options.contains(key) && !options[key].is_none() ? options[key].cast<T>() : usual;
}

std::unique_ptr<Handle> open_world(const std::string& text, const std::string& file,
                                   const py::dict& options) {
  Opening o;
  o.text = text;
  o.file = file;
  if (options.contains("seed") && !options["seed"].is_none()) o.seed = options["seed"].cast<std::uint64_t>();
  using Choices = std::vector<std::pair<std::string, std::string>>;
  const auto choices = [&](const char* key, std::vector<twin::Choice>& to) {
    for (const auto& [robot, value] : option<Choices>(options, key, {})) to.push_back({robot, value});
  };
  choices("firmware", o.options.firmware);
  choices("uart1", o.options.uart1);
  choices("uart2", o.options.uart2);
  o.options.threads = option<int>(options, "threads", 1);
  o.options.hal = option<std::string>(options, "hal", "");
  o.options.optimisation = option<std::string>(options, "optimise", "");
  o.options.sanitize = option<bool>(options, "sanitize", false);
  o.options.coverage = option<std::string>(options, "coverage", "");
  o.supervisors = option<std::vector<std::string>>(options, "supervisors", {});
  o.measured = option<std::vector<std::string>>(options, "measured", {});
  std::vector<std::string> problems;
  std::unique_ptr<World> world;
  {
    py::gil_scoped_release free;
    world = World::open(o, problems);
  }
  if (!world) throw std::invalid_argument(joined(problems));
  return std::make_unique<Handle>(std::move(world));
}

/// Runs up to `end` clicks; why it ended, in a word.
std::string run(Handle& handle, sim::Clicks end, const py::object& each_tick, bool stops_at_traps) {
  const Handle::Running running(handle);
  World& world = handle.world();
  std::exception_ptr thrown;
  // Python is asked with its lock held; what it throws ends the run and is thrown again behind it.
  const auto guarded = [&thrown](const std::function<bool()>& ask) {
    py::gil_scoped_acquire lock;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      return ask();
    } catch (...) {
      thrown = std::current_exception();
      return true;
    }
  };
  std::function<bool()> on_tick;
  if (!each_tick.is_none())
    on_tick = [&] { return guarded([&] { return py::bool_(each_tick()).cast<bool>(); }); };
  world.should_stop = [&] { return thrown || guarded([] { return false; }); };
  // The simulation runs without Python's lock.
  World::Why why;
  {
    py::gil_scoped_release free;
    why = world.run(end, on_tick, stops_at_traps);
  }
  world.should_stop = nullptr;
  if (thrown) std::rethrow_exception(thrown);
  switch (why) {
    case World::Why::Time:
      return "time";
    case World::Why::Asked:
      return "asked";
    case World::Why::Trap:
      return "trap";
    case World::Why::Ended:
      return "ended";
    case World::Why::Stopped:
      break;
  }
  return "stopped";
}

py::dict dict_of(const host::TrapReport& trap) {
  py::dict d;
  d["robot"] = trap.robot;
  d["kind"] = host::trap_name(trap.kind);
  d["vector"] = trap.vector;
  d["message"] = trap.message;
  d["function"] = trap.place.function;
  d["file"] = trap.place.file;
  d["line"] = trap.place.line;
  d["cycle"] = trap.cycle;
  d["time_s"] = trap.time_s;
  d["count"] = trap.count;
  py::list back;
  for (const auto& place : trap.backtrace) back.append(to_string(place));
  d["backtrace"] = back;
  return d;
}

py::list traps_of(Handle& handle, int robot) {
  py::list list;
  if (const host::Runner* runner = handle.world().runner(handle.robot(robot)))
    for (const auto& trap : runner->traps()) list.append(dict_of(trap));
  return list;
}

py::list diagnoses_of(Handle& handle, int robot) {
  py::list list;
  const host::Runner* const runner = handle.world().runner(handle.robot(robot));
  if (!runner) return list;
  for (const auto& diagnosis : runner->diagnoses()) {
    py::dict d;
    d["cause"] = diagnosis.cause;
    d["place"] = diagnosis.place;
    d["message"] = diagnosis.message;
    d["hint"] = diagnosis.hint;
    d["time_s"] = diagnosis.first_s;
    d["count"] = diagnosis.count;
    list.append(d);
  }
  return list;
}

py::dict dict_of(const chip::Spread& spread) {
  py::dict d;
  d["count"] = spread.count;
  d["total"] = spread.sum;
  d["min"] = spread.min;
  d["mean"] = spread.mean();
  d["max"] = spread.max;
  return d;
}

py::object profile_of(Handle& handle, int robot) {
  const auto report = handle.world().profile(handle.robot(robot));
  if (!report) return py::none();
  py::dict d, functions, interrupts;
  for (const auto& f : report->functions) {
    py::dict entry = dict_of(f.cycles);
    entry["place"] = f.place;
    entry["own"] = f.own;
    entry["max_caller"] = f.max_caller;
    functions[py::str(f.name)] = entry;
  }
  for (const auto& i : report->interrupts) {
    py::dict entry = dict_of(i.cycles);
    entry["latency"] = dict_of(i.latency);
    entry["period"] = dict_of(i.period);
    entry["merged"] = i.merged;
    entry["missed"] = i.missed;
    interrupts[py::str(i.name)] = entry;
  }
  py::list waits;
  for (const auto& w : report->waits) {
    py::dict entry = dict_of(w.cycles);
    entry["place"] = w.place;
    entry["counts"] = w.counts;
    waits.append(entry);
  }
  d["cycles"] = report->to - report->from;
  d["load"] = report->load();
  d["slept"] = report->slept;
  d["waited"] = report->waited;
  d["in_handlers"] = report->in_handlers;
  d["turn"] = dict_of(report->turn);
  d["turn_place"] = report->turn_place;
  d["stack_bytes"] = report->stack_bytes;
  d["stack_free"] = report->stack_free;
  d["stack_path"] = report->stack_path;
  d["data_bytes"] = report->data_bytes;
  d["functions"] = functions;
  d["interrupts"] = interrupts;
  d["waits"] = waits;
  return d;
}

py::object picture_of(Handle& handle, int robot) {
  const board::CameraPicture* const picture = handle.world().picture(handle.robot(robot));
  if (!picture) return py::none();
  const auto rgb = board::decode_picture(*picture);
  read_numpy();
  py::array_t<std::uint8_t> array({picture->rows, picture->columns, 3});
  std::copy(rgb.begin(), rgb.end(), array.mutable_data());
  return py::make_tuple(picture->number, array);
}

debug::Machine& machine_of(Handle& handle, int robot) {
  debug::Machine* const machine = handle.world().machine(handle.robot(robot));
  if (!machine)
    throw std::invalid_argument(
        "robot '" + handle.world().twin().world().robots[static_cast<std::size_t>(robot)].name +
        "': program: got none of the chip, expected one for variables, registers and why()");
  return *machine;
}

py::tuple cost_of(Handle& handle, int robot, const std::string& function) {
  chip::CallCost cost;
  std::string error;
  if (!handle.world().cost_of(handle.robot(robot), function, cost, error)) throw std::invalid_argument(error);
  const auto cycles = [](double value) { return static_cast<std::int64_t>(value); };
  return py::make_tuple(cost.calls, cost.total, cycles(cost.min),
                        cost.mean < 0 ? py::object(py::none()) : py::float_(cost.mean), cycles(cost.max));
}

void assign_to(Handle& handle, int robot, const std::string& expression, const py::object& value) {
  const debug::Machine& machine = machine_of(handle, robot);
  const std::string name = handle.world().twin().world().robots[static_cast<std::size_t>(robot)].name;
  assign(machine.runner(), expression, value, [&](const debug::Data& to, std::uint64_t raw) {
    debug::Data whole = to;
    whole.width = 0;
    if (to.width > 0) {
      const std::uint64_t mask = ((std::uint64_t{1} << to.width) - 1) << to.bit;
      std::uint64_t before = 0;
      machine.read(whole, &before);
      raw = (before & ~mask) | (raw << to.bit & mask);
    }
    handle.world().apply({{"do", "write"},
                          {"robot", name},
                          {"address", whole.address},
                          {"bytes", whole.bytes},
                          {"value", raw}});
  });
}

py::tuple place_of(Handle& handle, int robot) {
  const host::Runner* const runner = handle.world().runner(handle.robot(robot));
  const host::Place place = runner ? runner->data().place_now() : host::Place{};
  return py::make_tuple(place.function, place.file, place.line);
}

std::string why_of(Handle& handle, int robot) { return machine_of(handle, robot).why(); }

/// A line of commands from Python as an input's object.
void apply(Handle& handle, const std::string& json) {
  refusing(handle, [&](World& world) { world.apply(inputs::Json::parse(json)); });
}

py::dict dict_of(const faults::Status& status) {
  const auto time = [](double s) { return s < 0 ? py::object(py::none()) : py::float_(s); };
  py::dict d;
  d["what"] = faults::said(status.fault);
  d["begun_s"] = time(status.begun_s);
  d["took_effect_s"] = time(status.took_effect_s);
  d["ended_s"] = time(status.ended_s);
  return d;
}

/// Numbers of the faults that the text of a file asks for; `where` is the file, or empty.
std::vector<int> add_faults(Handle& handle, const std::string& text, const std::string& where) {
  const auto before = static_cast<int>(handle.world().faults().statuses().size());
  refusing(handle, [&](World& world) { world.apply({{"do", "faults"}, {"text", text}, {"of", where}}); });
  std::vector<int> ids(handle.world().faults().statuses().size() - static_cast<std::size_t>(before));
  std::iota(ids.begin(), ids.end(), before);
  return ids;
}

template <typename T>
py::array_t<T> view(std::vector<T>& numbers, std::vector<py::ssize_t> shape, const py::object& owner) {
  read_numpy();
  py::array_t<T> array(std::move(shape), numbers.data(), owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

py::array_t<double> rows_of(const Record& record) {
  const auto rows = static_cast<py::ssize_t>(record.rows.size() / Record::kColumns);
  read_numpy();
  py::array_t<double> array({rows, py::ssize_t{Record::kColumns}});
  std::copy(record.rows.begin(), record.rows.end(), array.mutable_data());
  return array;
}

/// A property of a row a robot.
template <int kColumns, class Numbers>
auto rows_in(Numbers Arrays::*numbers) {
  return [numbers](const py::object& self) {
    auto& a = self.cast<Arrays&>();
    return view(a.*numbers, {static_cast<py::ssize_t>(a.battery_v.size()), kColumns}, self);
  };
}

void bind_arrays(py::module_& module) {
  py::class_<Arrays, std::shared_ptr<Arrays>>(module, "Arrays")
      .def(py::init<std::size_t>())
      .def_property_readonly("poses", rows_in<3>(&Arrays::poses))
      .def_property_readonly("proximity", rows_in<8>(&Arrays::proximity))
      .def_property_readonly("leds", rows_in<10>(&Arrays::leds))
      .def_property_readonly("steps", rows_in<2>(&Arrays::steps))
      .def_property_readonly("battery_v", [](const py::object& self) {
        auto& a = self.cast<Arrays&>();
        return view(a.battery_v, {static_cast<py::ssize_t>(a.battery_v.size())}, self);
      });
  py::class_<Record, std::shared_ptr<Record>>(module, "Record")
      .def_property_readonly("rows", [](const Record& r) { return rows_of(r); });
}

/// Name, unit, least, most and what it is, of all signals.
py::list signal_table() {
  py::list table;
  for (const signals::Signal& s : signals::all())
    table.append(
        py::make_tuple(s.count > 0 ? std::string(s.name) + "0" : s.name, s.unit, s.least, s.most, s.what));
  return table;
}

void bind_robots(py::class_<Handle>& world) {
  world
      .def("pose",
           [](Handle& h, int r) {
             const sim::Pose2 pose = h.world().simulation().pose(h.robot(r));
             return py::make_tuple(pose.x_m, pose.y_m, pose.heading_rad);
           })
      .def("distance_m", [](Handle& h, int r) { return h.world().simulation().distance_m(h.robot(r)); })
      .def("touches",
           [](Handle& h, int r) {
             const sim::TouchReport t = h.world().simulation().touches(h.robot(r));
             return py::make_tuple(t.collisions, t.longest_wall_touch_s);
           })
      .def("report",
           [](Handle& h, int r) {
             const sim::MindReport report = h.world().mind(h.robot(r)).report();
             return py::make_tuple(report.left_steps, report.right_steps, report.leds);
           })
      .def("pin",
           [](Handle& h, int r, const std::string& name) {
             h.robot(r);
             return refusing(h, [&](World& world) {
               return signals::find_pin(world.twin(), r, name).value(world.twin()) != 0;
             });
           })
      .def("is_register",
           [](Handle&, const std::string& name) { return debug::Machine::find_register(name).has_value(); })
      .def("proximity",
           [](Handle& h, int r, int sensor) {
             return h.world().mind(h.robot(r)).proximity_counts(h.world().simulation().scene(), sensor);
           })
      .def("selector", [](Handle& h, int r) { return h.world().mind(h.robot(r)).board().selector(); })
      .def("battery",
           [](Handle& h, int r) {
             host::FirmwareMind& mind = h.world().mind(h.robot(r));
             return mind.board().power().battery().voltage(mind.now());
           })
      .def("cycles", [](Handle& h, int r) { return h.world().mind(h.robot(r)).now(); })
      .def("load",
           [](Handle& h, int r) {
             const host::Runner* runner = h.world().runner(h.robot(r));
             return runner ? runner->cpu_load() : 0.0;
           })
      .def("interrupts_served",
           [](Handle& h, int r) {
             const host::Runner* runner = h.world().runner(h.robot(r));
             return runner ? runner->interrupts_served() : 0;
           })
      .def("has_program", [](Handle& h, int r) { return h.world().runner(h.robot(r)) != nullptr; })
      .def("has_stopped",
           [](Handle& h, int r) {
             const host::Runner* runner = h.world().runner(h.robot(r));
             return runner && runner->has_stopped();
           })
      .def("heard", [](Handle& h, int r, int port) { return py::bytes(h.world().heard(h.robot(r), port)); })
      .def("heard_bytes", [](Handle& h, int r, int port) { return h.world().heard(h.robot(r), port).size(); })
      .def("console", [](Handle& h, int r) { return h.world().console(r < 0 ? -1 : h.robot(r)); })
      .def("place", &place_of)
      .def("why", &why_of)
      .def("traps", &traps_of)
      .def("diagnoses", &diagnoses_of)
      .def("profile", &profile_of)
      .def("cost_of", &cost_of)
      .def("picture", &picture_of)
      .def("value",
           [](Handle& h, int r, const std::string& e) { return value_of(machine_of(h, r).runner(), e); })
      .def("assign", &assign_to)
      .def("program", [](Handle& h, int r) {
        return py::make_tuple(h.world().twin().program(h.robot(r)).path, h.world().twin().image_path(r),
                              h.world().twin().hal(r));
      });
}

/// What names of worlds and programs mean, without opening anything.
void bind_names(py::module_& module) {
  module.def("read_world", [](const std::string& path) {
    std::string text;
    const std::string wrong = sim::read_input_file(path, sim::kLongestWorld, text);
    if (!wrong.empty()) throw std::invalid_argument(path + ": " + wrong);
    return text;
  });
  module.def("find_world", [](const std::string& name) {
    std::vector<std::string> problems;
    const twin::FoundWorld found = twin::find_world(name, problems);
    if (!problems.empty()) throw std::invalid_argument(joined(problems));
    return found.file;
  });
  // what is wrong with a world's text, with the name of a program; empty: nothing
  module.def("check_world", [](const std::string& text, const std::string& file) {
    const sim::LoadedWorld loaded = twin::parse_world(text, file);
    return loaded.world ? std::string() : loaded.report(file);
  });
  module.def("check_firmware", [](const std::string& name, const std::string& from_folder) {
    std::vector<std::string> problems;
    twin::find_firmware(name, from_folder, problems);
    return joined(problems);
  });
}

}  // namespace

}  // namespace python

PYBIND11_MODULE(_core, module) {
  using namespace python;
  module.attr("CLICKS_PER_SECOND") = sim::kClicksPerSecond;
  bind_names(module);
  module.def("project_root", [] { return places::share_root().string(); });
  module.def("command_file", [] { return places::command_file().string(); });
  bind_arrays(module);
  module.def("signals", &signal_table);
  module.def("fault_kinds", [] { return faults::kind_names(); });
  py::class_<Handle> world(module, "World");
  py::class_<Watch>(module, "Watch")
      .def(py::init<Handle&, const std::string&, int>(), py::keep_alive<1, 2>())
      .def_property_readonly("value", &Watch::value)
      .def("holds", &Watch::holds);
  world.def(py::init(&open_world))
      .def("close", &Handle::close)
      .def("close_and_keep", &Handle::close_and_keep)
      .def_property_readonly("is_open", &Handle::is_open)
      .def_property_readonly("now", [](Handle& h) { return h.world().simulation().now(); })
      .def_property_readonly("tick_s", [](Handle& h) { return h.world().simulation().scene().tick_s(); })
      .def_property_readonly("digest", [](Handle& h) { return h.world().simulation().digest(); })
      .def_property_readonly("seed", [](Handle& h) { return h.world().twin().world().seed; })
      .def_property_readonly("title", [](Handle& h) { return h.world().twin().world().title; })
      .def_property_readonly("names",
                             [](Handle& h) {
                               std::vector<std::string> names;
                               for (const auto& robot : h.world().twin().world().robots)
                                 names.push_back(robot.name);
                               return names;
                             })
      .def_property_readonly(
          "bodies",
          [](Handle& h) {
            const sim::Layout& layout = h.world().simulation().scene().layout();
            std::vector<std::string> names = layout.moving_name;
            const std::size_t robots = names.size() - layout.loose_object.size();
            // as the file calls them; "box 2" where it does not
            for (std::size_t i = robots; i < names.size(); ++i)
              if (const auto& object = h.world().twin().world().objects[static_cast<std::size_t>(
                      layout.loose_object[i - robots])];
                  !object.name.empty())
                names[i] = object.name;
            return names;
          })
      .def_property_readonly("lamps",
                             [](Handle& h) {
                               std::vector<std::string> names;
                               for (const auto& lamp : h.world().twin().world().lamps)
                                 names.push_back(lamp.name);
                               return names;
                             })
      .def("signal",
           [](Handle& h, int robot, const std::string& name) {
             twin::Twin& twin = h.world().twin();
             const signals::Named found = signals::find(twin, robot, name);
             return py::make_tuple(found.value(twin), found.unit);
           })
      .def_property_readonly("notices", [](Handle& h) { return h.world().notices(); })
      .def_property_readonly("outcome",
                             [](Handle& h) {
                               const programs::Outcome& o = h.world().outcome();
                               return py::make_tuple(o.ended, o.crashed, o.code, o.text);
                             })
      .def("run", &run)
      .def("apply", &apply)
      .def("add_faults", &add_faults)
      .def("fault", [](Handle& h, int id) { return dict_of(h.world().faults().status(id)); })
      .def("faults",
           [](Handle& h) {
             py::list list;
             for (const auto& status : h.world().faults().statuses()) list.append(dict_of(status));
             return list;
           })
      .def("fault_problems", [](Handle& h) { return h.world().faults().problems(); })
      .def("save_recording",
           [](Handle& h, const std::string& file) { return h.world().save_recording(file); })
      .def("draw",
           [](Handle& h, const std::string& file, const std::string& caption, bool rays, int width_px) {
             const std::string wrong = h.world().draw(file, caption, rays, width_px);
             if (!wrong.empty()) throw std::runtime_error(wrong);
           })
      .def("refresh", [](Handle& h, Arrays& arrays, bool poses, bool proximity,
                         bool others) { h.world().refresh(arrays, poses, proximity, others); })
      .def("body_pose",
           [](Handle& h, int body) {
             const sim::Pose2 pose = h.world().simulation().pose(body);
             return py::make_tuple(pose.x_m, pose.y_m, pose.heading_rad);
           })
      .def("record", [](Handle& h, double every_s) { return h.world().record(every_s); });
  bind_robots(world);
}
