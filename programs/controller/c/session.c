/* SPDX-License-Identifier: MIT
 * The connection to the simulator: how a program finds it, says who it is, steps, asks and leaves.
 */
#define _GNU_SOURCE
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "programs/controller/c/library.h"

#define MOST_WARNINGS 20 /* from one place: programs repeat their mistakes every step */

struct session session = {.state = SESSION_NONE, .basic_step_ms = 32, .speed_unit_rad_s = 0.00628, .stamp = 1};
int session_language;
static char* session_program; /* its name, where it is not the process's */
static int link_socket = -1;
static _Alignas(8) unsigned char packet[LINK_MOST_BYTES];

/* --- words */

void warn(int* told, const char* format, ...) {
  char text[512];
  va_list arguments;
  if (*told > MOST_WARNINGS) return;
  if ((*told)++ == MOST_WARNINGS) {
    fputs("Warning: there are more warnings of this kind, which are not shown\n", stderr);
    return;
  }
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  fprintf(stderr, "Warning: %s\n", text);
}

void fatal(const char* format, ...) {
  char text[1024];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  fprintf(stderr, "libcontroller: %s\n", text);
  session.state = SESSION_CLOSED; /* nothing is said on the way out */
  exit(1);
}

void* grow(void* old, size_t bytes) {
  void* now = realloc(old, bytes ? bytes : 1);
  if (!now) fatal("memory: got none for %zu bytes", bytes);
  return now;
}

char* copy_text(const char* bytes, size_t size) {
  char* text = grow(0, size + 1);
  if (size) memcpy(text, bytes, size);
  text[size] = 0;
  return text;
}

const char* absolute_path(const char* file) {
  static char path[PATH_MAX + 256];
  char folder[PATH_MAX];
  if (file[0] == '/' || !getcwd(folder, sizeof folder)) return file;
  snprintf(path, sizeof path, "%s/%s", folder, file);
  return path;
}

/* --- packets */

static void closed(void) {
  if (link_socket >= 0) close(link_socket);
  link_socket = -1;
  session.state = SESSION_CLOSED;
  session.stepping = false;
  link_clear(&session.out);
}

static void send_bytes(const unsigned char* bytes, size_t size) {
  while (size && session.state != SESSION_CLOSED) {
    if (send(link_socket, bytes, size, MSG_NOSIGNAL) >= 0) return;
    if (errno != EINTR) closed();
  }
}

void session_flush(void) {
  send_bytes(session.out.bytes, session.out.size);
  link_clear(&session.out);
}

struct link_packet* command(int record) {
  session_ready();
  if (session.state == SESSION_CLOSED) link_clear(&session.out);
  link_begin(&session.out, record);
  return &session.out;
}

void command_end(void) {
  struct link_packet* out = &session.out;
  size_t size = out->size - out->record;
  link_end(out);
  if (out->size < LINK_FLUSH_BYTES) return;
  /* what is too long for one packet cannot be said; what came before it can */
  if (size > LINK_MOST_BYTES) {
    out->size = out->record;
    WARN("a command is dropped: got %zu bytes, expected at most %d", size, LINK_MOST_BYTES);
  } else if (out->size > LINK_MOST_BYTES) {
    send_bytes(out->bytes, out->record);
    memmove(out->bytes, out->bytes + out->record, size);
    out->size = size;
    out->record = 0;
    return;
  }
  session_flush();
}

/* The next packet of the simulator's; false: nobody is there any more. */
static bool receive(struct link_reader* reader) {
  ssize_t size;
  if (session.state == SESSION_CLOSED) return false;
  do size = recv(link_socket, packet, sizeof packet, MSG_TRUNC);
  while (size < 0 && errno == EINTR);
  if (size > (ssize_t)sizeof packet)
    fatal("the simulator: got a packet of %zd bytes, expected at most %d", size, LINK_MOST_BYTES);
  if (size <= 0) {
    closed();
    return false;
  }
  link_read(reader, packet, (size_t)size);
  return true;
}

static bool next_record(struct link_reader* reader, struct link_record* record) {
  if (link_next(reader, record)) {
    if (record->number == LINK_REFUSED)
      fatal("the simulator ended the program: %.*s", (int)record->texts[0].size, record->texts[0].bytes);
    return true;
  }
  if (reader->error) fatal("the simulator: %s (record %d)", reader->error, reader->number);
  return false;
}

int ask(struct link_record* answer) {
  struct link_reader reader;
  command_end();
  if (session.stepping) {
    WARN("a question between wb_robot_step_begin() and wb_robot_step_end() is not answered");
    session.out.size = session.out.record;
    return 0;
  }
  session_flush();
  while (receive(&reader))
    while (next_record(&reader, answer)) {
      if (answer->number == LINK_END)
        session.state = SESSION_OVER;
      else if (answer->number != LINK_CUSTOM)
        return answer->number;
    }
  return 0;
}

/* --- the beginning */

static int connect_to(const char* path) {
  struct sockaddr_un address = {.sun_family = AF_UNIX};
  int fd;
  if (strlen(path) >= sizeof address.sun_path)
    fatal("TWINPUCK_CONTROLLER: got a path of %zu characters, expected at most %zu", strlen(path),
          sizeof address.sun_path - 1);
  strcpy(address.sun_path, path);
  fd = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
  if (fd < 0 || connect(fd, (struct sockaddr*)&address, sizeof address) != 0)
    fatal("%s: got nobody who waits there (%s), expected a simulation; start one first: twinpuck run WORLD --extern ROBOT", path,
          strerror(errno));
  return fd;
}

/* A socket begins with the number of its simulator's process, which may have been killed since. */
static bool is_left_over(const char* name) {
  char* rest;
  long pid = strtol(name, &rest, 10);
  return pid > 0 && *rest == '-' && kill((pid_t)pid, 0) != 0 && errno == ESRCH;
}

/* The one robot that waits for a program from outside. */
static int connect_to_the_one(void) {
  const char* base = getenv("XDG_RUNTIME_DIR");
  char folder[PATH_MAX], found[PATH_MAX + 256] = "", names[400] = "";
  int count = 0;
  DIR* dir;
  struct dirent* entry;
  snprintf(folder, sizeof folder, "%s/twinpuck-%d", base && *base ? base : "/tmp", (int)getuid());
  dir = opendir(folder);
  while (dir && (entry = readdir(dir))) {
    size_t n = strlen(entry->d_name);
    if (n < 6 || strcmp(entry->d_name + n - 5, ".sock") != 0 || is_left_over(entry->d_name)) continue;
    count++;
    snprintf(found, sizeof found, "%s/%s", folder, entry->d_name);
    if (strlen(names) + n + 2 < sizeof names) strcat(strcat(names, " "), entry->d_name);
  }
  if (dir) closedir(dir);
  if (count == 1) return connect_to(found);
  if (count == 0)
    fatal(
        "this program belongs to a simulation, and none waits for it. Let a world start it (twinpuck run WORLD), or "
        "start a simulation that waits (twinpuck run WORLD --extern ROBOT) and then this program");
  fatal("several robots wait for a program; choose one: TWINPUCK_CONTROLLER=unix:%s/NAME of%s", folder, names);
}

static int connect_socket(void) {
  const char* where = getenv("TWINPUCK_CONTROLLER");
  struct stat status;
  int fd;
  if (!where || !*where) return connect_to_the_one();
  if (strncmp(where, "unix:", 5) == 0) return connect_to(where + 5);
  if (strncmp(where, "fd:", 3) != 0) fatal("TWINPUCK_CONTROLLER: got '%s', expected fd:NUMBER or unix:PATH", where);
  fd = atoi(where + 3);
  if (fstat(fd, &status) != 0 || !S_ISSOCK(status.st_mode))
    fatal("TWINPUCK_CONTROLLER: got '%s', expected the number of an open socket", where);
  fcntl(fd, F_SETFD, FD_CLOEXEC);
  unsetenv("TWINPUCK_CONTROLLER"); /* it means nothing to programs that this one starts */
  return fd;
}

static char* text_of(const struct link_record* record, int index) {
  return copy_text(record->texts[index].bytes, record->texts[index].size);
}

static void welcome(const struct link_record* r) {
  if (r->ints[0] != LINK_VERSION)
    fatal("the simulator: got version %d of the link, expected %d; build the program anew", (int)r->ints[0],
          LINK_VERSION);
  session.supervisor = r->ints[1] == 1;
  session.nue = r->ints[2] == 1;
  session.seed = r->ints[4];
  session.time_ns = r->ints[5]; /* of a program that was started anew: the world's goes on */
  session.robot = text_of(r, 0);
  session.model = text_of(r, 1);
  session.project = text_of(r, 2);
  session.world = text_of(r, 3);
  session.title = text_of(r, 4);
  session.custom = text_of(r, 5);
  session.basic_step_ms = r->reals[0];
  if (r->reals[1] > 0) session.speed_unit_rad_s = r->reals[1];
}

/* what a program said before it ends is said, though it does not clean up */
static void at_end(void) {
  if (session.state == SESSION_RUNS || session.state == SESSION_OVER) {
    if (!session.stepping) session_flush();
    closed();
  }
}

void session_begin(void) {
  struct link_packet* out = &session.out;
  struct link_reader reader;
  struct link_record record;
  bool is_told = false;

  link_socket = connect_socket();
  session.state = SESSION_RUNS;
  if (!isatty(STDOUT_FILENO)) setvbuf(stdout, 0, _IOLBF, 0);

  /* who is there, on both sides */
  link_begin(out, LINK_HELLO);
  link_int(out, LINK_VERSION);
  link_int(out, session_language);
  link_text(out, session_program ? session_program : program_invocation_short_name);
  link_end(out);
  session_flush();
  while (!is_told) {
    if (!receive(&reader)) fatal("the simulator closed the connection before the program began");
    while (next_record(&reader, &record)) {
      if (record.number == LINK_WELCOME && !session.robot) welcome(&record);
      if (record.number == LINK_DEVICE) device_add(&record);
      if (record.number == LINK_READY) is_told = true;
    }
  }
  if (!session.robot) fatal("the simulator: got no WELCOME before READY");
  crash_install(link_socket);
  atexit(at_end);
}

void twinpuck_language(int language, const char* program) {
  session_language = language;
  free(session_program);
  session_program = program ? copy_text(program, strlen(program)) : 0;
}

int wb_robot_init(void) {
  session_ready();
  return 1;
}

/* --- steps */

static int ended(void) {
  if (!session.told_end) {
    session.told_end = true;
    return -1;
  }
  exit(0); /* it was told and goes on, as if it ran for ever */
}

int wb_robot_step_begin(int duration) {
  session_ready();
  if (session.state != SESSION_RUNS) return -1;
  if (session.stepping) return 0;
  if (duration < 0) {
    WARN("wb_robot_step(): got %d ms, expected 0 or more", duration);
    duration = 0;
  }
  followed_step();
  link_int(command(LINK_STEP), duration);
  command_end();
  session_flush();
  session.stepping = true;
  return 0;
}

int twinpuck_wait(void) {
  struct pollfd line = {link_socket, POLLIN, 0};
  return !session.stepping || poll(&line, 1, -1) != -1;
}

int wb_robot_step_end(void) {
  struct link_reader reader;
  struct link_record record;
  bool is_done = false;
  session_ready();
  if (session.state != SESSION_RUNS) return ended();
  if (!session.stepping) return 0;
  keyboard_step();
  while (!is_done && receive(&reader))
    while (next_record(&reader, &record)) {
      if (record.number == LINK_DONE) {
        session.time_ns = record.ints[0];
        session.passed_ms = record.ints[1];
        is_done = true;
      } else if (record.number == LINK_END) {
        session.state = SESSION_OVER;
        is_done = true;
      } else {
        take_sample(&record);
      }
    }
  session.stepping = false;
  session.stamp++;
  session.steps++;
  emitters_step();
  speakers_step();
  if (session.state != SESSION_RUNS) return ended();
  old_supervisor_step();
  return 0;
}

int wb_robot_step(int duration) {
  if (wb_robot_step_begin(duration) < 0) return ended();
  return wb_robot_step_end();
}

void wb_robot_cleanup(void) {
  fflush(stdout);
  if (session.state != SESSION_RUNS && session.state != SESSION_OVER) return;
  session_flush();
  closed();
  session.told_end = true;
}
