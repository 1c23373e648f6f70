// SPDX-License-Identifier: MIT
#ifndef WB_NODE_HPP
#define WB_NODE_HPP
#include "Supervisor.hpp"
#endif
