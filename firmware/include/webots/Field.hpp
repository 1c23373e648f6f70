// SPDX-License-Identifier: MIT
#ifndef WB_FIELD_HPP
#define WB_FIELD_HPP
#include "Supervisor.hpp"
#endif
