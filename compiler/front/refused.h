// SPDX-License-Identifier: MIT
// What a PC offers and a robot does not: named here once, for headers and for functions, with
// what to use instead.
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

inline constexpr Refusal kRefusedFunctions[] = {
    {"gettimeofday", "count with an agenda, or resetTime() and getDiffTimeMs() of utility.h"},
    {"clock_gettime", "count with an agenda, or resetTime() and getDiffTimeMs() of utility.h"},
    {"localtime", "a robot has no calendar; count with an agenda"},
    {"gmtime", "a robot has no calendar; count with an agenda"},
    {"mktime", "a robot has no calendar; count with an agenda"},
    {"strftime", "a robot has no calendar; count with an agenda"},
    {"ctime", "a robot has no calendar; count with an agenda"},
    {"sleep", "use wait() of utility.h or an agenda"},
    {"usleep", "use wait() of utility.h or an agenda"},
    {"nanosleep", "use wait() of utility.h or an agenda"},
    {"alarm", "use an agenda"},
    {"fork", "use agendas (e_activate_agenda)"},
    {"pthread_create", "use agendas (e_activate_agenda) or a timer interrupt"},
    {"pthread_join", "use agendas (e_activate_agenda) or a timer interrupt"},
    {"pthread_mutex_lock", "use a volatile flag, or disi around the access"},
    {"pthread_mutex_unlock", "use a volatile flag, or disi around the access"},
    {"kill", "use reset() or abort()"},
    {"fopen", "send data over uart/e_uart_char.h; a robot has no files"},
    {"freopen", "send data over uart/e_uart_char.h; a robot has no files"},
    {"fclose", "send data over uart/e_uart_char.h; a robot has no files"},
    {"fread", "send data over uart/e_uart_char.h; a robot has no files"},
    {"fwrite", "send data over uart/e_uart_char.h; a robot has no files"},
    {"fgets", "use e_getchar_uart1() of uart/e_uart_char.h; a robot has no files"},
    {"fgetc", "use e_getchar_uart1() of uart/e_uart_char.h; a robot has no files"},
    {"fscanf", "use e_getchar_uart1() and sscanf(); a robot has no files"},
    {"fseek", "a robot has no files"},
    {"ftell", "a robot has no files"},
    {"remove", "a robot has no files"},
    {"rename", "a robot has no files"},
    {"tmpfile", "a robot has no files"},
    {"open", "send data over uart/e_uart_char.h; a robot has no files"},
    {"close", "send data over uart/e_uart_char.h; a robot has no files"},
    {"read", "use e_getchar_uart1() of uart/e_uart_char.h; a robot has no files"},
    {"scanf", "use e_getchar_uart1() and sscanf(); nobody types at a robot's keyboard"},
    {"getchar", "use e_getchar_uart1(); nobody types at a robot's keyboard"},
    {"gets", "use e_getchar_uart1(); nobody types at a robot's keyboard"},
    {"system", "a robot has no shell"},
    {"popen", "a robot has no shell"},
    {"execl", "a robot has no shell"},
    {"execv", "a robot has no shell"},
    {"getenv", "read the selector (getselector()) to choose a behaviour"},
    {"socket", "send data over uart/e_uart_char.h"},
    {"mmap", "declare a static array"},
    {"dlopen", "link everything into one program"},
};

/// What to use instead, or null when the header is allowed.
inline const char* refused_header(llvm::StringRef name) {
  for (const auto& r : kRefusedHeaders)
    if (name.equals_insensitive(r.name)) return r.instead;
  return nullptr;
}

inline const char* refused_function(llvm::StringRef name) {
  for (const auto& r : kRefusedFunctions)
    if (name == r.name) return r.instead;
  return name.startswith("pthread_") ? "use agendas (e_activate_agenda) or a timer interrupt" : nullptr;
}

}  // namespace cc
