// SPDX-License-Identifier: MIT
// Firmware has no languages: text is what it is.
#pragma once
