// SPDX-License-Identifier: MIT
// Headers that a PC offers and a robot does not, with what to use instead.
#pragma once

#include "llvm/ADT/StringRef.h"

namespace cc {

struct Refusal {
  const char* name;
  const char* instead;
};

inline constexpr Refusal kRefusedHeaders[] = {
    {"unistd.h", "use wait() of utility.h or an agenda instead of sleep()"},
    {"pthread.h", "use agendas (e_activate_agenda) or a timer interrupt instead of threads"},
    {"threads.h", "use agendas (e_activate_agenda) or a timer interrupt instead of threads"},
    {"semaphore.h", "use a volatile flag set by an interrupt instead"},
    {"fcntl.h", "send data over uart/e_uart_char.h instead of files"},
    {"dirent.h", "send data over uart/e_uart_char.h instead of files"},
    {"sys/time.h", "use resetTime() and getDiffTimeMs() of utility.h, or an agenda"},
    {"sys/stat.h", "send data over uart/e_uart_char.h instead of files"},
    {"sys/socket.h", "send data over uart/e_uart_char.h instead of sockets"},
    {"netinet/in.h", "send data over uart/e_uart_char.h instead of sockets"},
    {"windows.h", "use wait() of utility.h or an agenda"},
    {"conio.h", "use e_getchar_uart1() of uart/e_uart_char.h"},
    {"iostream", "firmware is C, not C++; send text over uart/e_uart_char.h"},
};

/// What to use instead, or null when the header is allowed.
inline const char* refused_header(llvm::StringRef name) {
  for (const auto& r : kRefusedHeaders)
    if (name.equals_insensitive(r.name)) return r.instead;
  return nullptr;
}

}  // namespace cc
