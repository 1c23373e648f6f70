// SPDX-License-Identifier: MIT
#include "tests/controller/fake_simulator.h"

#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace fake {

namespace {
alignas(8) unsigned char packet_bytes[LINK_MOST_BYTES];

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error("fake simulator: " + what); }

Record copied(const link_record& from) {
  Record record;
  record.number = from.number;
  int i = 0, f = 0, s = 0, l = 0;
  for (const char* m = link_row_of(from.number)->members; *m; ++m) {
    if (*m == 'i') record.ints.push_back(from.ints[i++]);
    if (*m == 'f') record.reals.push_back(from.reals[f++]);
    if (*m == 's') record.texts.emplace_back(from.texts[s].bytes, from.texts[s].size), ++s;
    if (*m == 'F')
      record.lists.emplace_back(from.lists[l].values, from.lists[l].values + from.lists[l].count), ++l;
  }
  return record;
}
}  // namespace

void Simulator::start(const std::function<void()>& program) {
  int ends[2], out[2], err[2];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends) != 0 || pipe(out) != 0 || pipe(err) != 0)
    fail("no sockets");
  child_ = fork();
  if (child_ < 0) fail("no process");
  if (child_ == 0) {
    ::close(ends[0]), ::close(out[0]), ::close(err[0]);
    dup2(out[1], 1), dup2(err[1], 2);
    setenv("TWINPUCK_CONTROLLER", ("fd:" + std::to_string(ends[1])).c_str(), 1);
    program();
    exit(0);
  }
  ::close(ends[1]), ::close(out[1]), ::close(err[1]);
  socket_ = ends[0], out_ = out[0], err_ = err[0];
  const timeval most{20, 0};
  setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &most, sizeof most);
}

Simulator::Simulator(const std::function<void()>& program) { start(program); }

Simulator::Simulator(const std::string& file, const std::string& folder) {
  start([&] {
    if (chdir(folder.c_str()) == 0) execl(file.c_str(), file.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  });
}

Simulator::~Simulator() {
  close();
  if (child_ > 0) {
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
  }
  if (out_ >= 0) ::close(out_);
  if (err_ >= 0) ::close(err_);
}

std::size_t Simulator::next_raw() {
  const ssize_t size = recv(socket_, packet_bytes, sizeof packet_bytes, 0);
  if (size < 0) fail(errno == EAGAIN ? "waited 20 s for the program" : std::strerror(errno));
  return static_cast<std::size_t>(size);
}

std::vector<Record> Simulator::next() {
  const std::size_t size = next_raw();
  std::vector<Record> records;
  link_reader reader;
  link_record record;
  link_read(&reader, packet_bytes, size);
  while (link_next(&reader, &record)) records.push_back(copied(record));
  if (reader.error) fail(reader.error);
  return records;
}

void Simulator::send(const Packet& packet) {
  if (::send(socket_, packet.bytes(), packet.size(), MSG_NOSIGNAL) < 0) fail("cannot send");
}

void Simulator::send_bytes(const std::string& bytes) {
  if (::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) < 0) fail("cannot send");
}

Record Simulator::welcome(const World& world) {
  const std::vector<Record> hello = next();
  if (hello.size() != 1 || hello[0].number != LINK_HELLO) fail("expected HELLO");
  Packet packet;
  packet.add(LINK_WELCOME, world.version, int{world.supervisor}, int{world.nue}, 0, world.seed, world.time_ns,
             "puck", "GCtronic e-puck", "project", "project/worlds/w.wbt", "title", "custom", 32.0, 0.00628);
  for (const Device& d : world.devices)
    packet.add(LINK_DEVICE, d.tag, d.kind, d.name, d.name + " model", d.numbers);
  packet.add(LINK_READY);
  send(packet);
  return hello[0];
}

std::vector<Record> Simulator::until_step() {
  std::vector<Record> records = next();
  if (records.empty() || records.back().number != LINK_STEP) fail("expected STEP");
  asked_ms_ = records.back().ints[0];
  records.pop_back();
  return records;
}

void Simulator::done(std::int64_t time_ns, Packet& samples) { send(samples.add(LINK_DONE, time_ns, 32)); }
void Simulator::done(std::int64_t time_ns) {
  Packet samples;
  done(time_ns, samples);
}

void Simulator::close() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
}

int Simulator::wait() {
  pollfd ends[2] = {{out_, POLLIN, 0}, {err_, POLLIN, 0}};
  while (ends[0].fd >= 0 || ends[1].fd >= 0) {
    if (poll(ends, 2, 20000) <= 0) fail("waited 20 s for the program's end");
    for (pollfd& end : ends) {
      if (end.fd < 0 || !end.revents) continue;
      char bytes[4096];
      const ssize_t n = read(end.fd, bytes, sizeof bytes);
      if (n > 0)
        (end.fd == out_ ? output_ : errors_).append(bytes, static_cast<std::size_t>(n));
      else
        end.fd = -1;
    }
  }
  int status = 0;
  waitpid(child_, &status, 0);
  child_ = -1;
  return WIFSIGNALED(status) ? 1000 + WTERMSIG(status) : WEXITSTATUS(status);
}

std::vector<Record> of(const std::vector<Record>& records, int number) {
  std::vector<Record> found;
  for (const Record& r : records)
    if (r.number == number) found.push_back(r);
  return found;
}

}  // namespace fake
