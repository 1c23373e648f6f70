// SPDX-License-Identifier: MIT
// Values of a robot's program as Python's: numbers, lists for arrays, dicts for structs.
#pragma once
#include <pybind11/pybind11.h>

#include <cstdint>
#include <functional>
#include <string>

#include "hal_sim/debug/values.h"

namespace python {

/// What an expression of C is worth: int, float, a pointer as int, list, dict; None: the optimiser keeps it
/// nowhere. Throws std::invalid_argument that says why there is none.
pybind11::object value_of(const chip::ChipRunner& runner, const std::string& expression);
/// Changes a place in data to hold the bits `raw`.
using Write = std::function<void(const debug::Data& to, std::uint64_t raw)>;
/// Changes a variable, an element, a member or a register as an assignment of C would; a list or dict
/// changes an array or a struct element by element. Throws std::invalid_argument; nothing is changed then.
void assign(const chip::ChipRunner& runner, const std::string& expression, const pybind11::object& value,
            const Write& write);

}  // namespace python
