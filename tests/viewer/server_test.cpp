// SPDX-License-Identifier: MIT
// Who is let in, and that nobody who is can harm the run.
#include <arpa/inet.h>
#include <civetweb.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "tests/viewer/page_client.h"

namespace {

using namespace viewer_test;

class Server : public ViewTest {
 protected:
  Server() {
    write(
        "world.toml",
        "twinpuck = 1\n[arena]\nsize = [1, 1]\n[[ball]]\nradius = 0.02\nposition = [0, 0]\nmovable = true\n");
    write("page/index.html", "<title>page</title>");
    write("page/secret.txt", "secret");
    write("secret.txt", "secret");
    open("world.toml");
  }
  int port() { return view().server().port(); }
  std::string own(const std::string& file = "") { return "/" + view().server().token() + "/" + file; }
  std::string host() { return "Host: 127.0.0.1:" + std::to_string(port()) + "\r\n"; }
};

TEST_F(Server, gives_the_page_to_whoever_has_its_address) {
  std::string body;
  EXPECT_EQ(get_status(port(), own(), host(), &body), 200);
  EXPECT_NE(body.find("<title>page</title>"), std::string::npos);
  EXPECT_NE(body.find("Content-Security-Policy: default-src 'none'"), std::string::npos);
}

TEST_F(Server, refuses_other_tokens_hosts_and_origins) {
  const std::string wrong(32, '0');
  EXPECT_EQ(get_status(port(), "/", host()), 403);
  EXPECT_EQ(get_status(port(), "/" + wrong + "/", host()), 403);
  EXPECT_EQ(get_status(port(), "/" + view().server().token().substr(1) + "/", host()), 403);
  EXPECT_EQ(get_status(port(), own(), "Host: evil.example\r\n"),
            403);  // a name that was made to mean this machine
  EXPECT_EQ(get_status(port(), own(), "Host: evil.example:" + std::to_string(port()) + "\r\n"), 403);
  EXPECT_EQ(get_status(port(), own(), host() + "Origin: http://evil.example\r\n"), 403);
  EXPECT_FALSE(Page(view(), wrong).is_open());
  EXPECT_FALSE(Page(view(), "", "http://evil.example").is_open());
  EXPECT_FALSE(Page(view(), "", "null").is_open());
  EXPECT_TRUE(Page(view(), "", "http://127.0.0.1:" + std::to_string(port())).is_open());
}

TEST_F(Server, gives_no_other_file) {
  for (const char* path :
       {"secret.txt", "../secret.txt", "%2e%2e/secret.txt", "..%2fworld.toml", "/etc/passwd", "index.html/"})
    EXPECT_GE(get_status(port(), own(path), host()), 400) << path;
}

TEST_F(Server, hangs_up_on_garbage_and_lives_on) {
  Page good(view());
  good.event("hello");
  {
    Page binary(view());
    binary.send_raw(MG_WEBSOCKET_OPCODE_BINARY, std::string(100, '\x7f'));
    EXPECT_TRUE(binary.is_closed());
  }
  {
    Page large(view());
    large.send_raw(MG_WEBSOCKET_OPCODE_TEXT, std::string(100u << 20, 'x'));
    EXPECT_TRUE(large.is_closed());
  }
  // texts that mean nothing are answered, and that is all
  for (const char* text :
       {"", "{", "[]", "42", "{\"do\": 7}", "{\"id\": {\"a\": []}}", "{\"do\":\"step\",\"unit\":[]}",
        "\xff\xfe", "{\"do\":\"speed\",\"factor\":\"fast\"}"})
    good.send_raw(MG_WEBSOCKET_OPCODE_TEXT, text);
  good.send_raw(MG_WEBSOCKET_OPCODE_TEXT, std::string(100000, '['));
  EXPECT_TRUE(good.good({{"do", "state"}}).contains("state"));
}

// a page that does not read holds nobody up: the run goes on, and others get their frames
TEST_F(Server, waits_for_no_slow_page) {
  const int s = ::socket(AF_INET, SOCK_STREAM, 0);
  const int small = 4096;
  ::setsockopt(s, SOL_SOCKET, SO_RCVBUF, &small, sizeof small);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(port()));
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(::connect(s, reinterpret_cast<sockaddr*>(&to), sizeof to), 0);
  const std::string hello = "GET " + own("live") + " HTTP/1.1\r\n" + host() +
                            "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                            "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
  ASSERT_GT(::send(s, hello.data(), hello.size(), 0), 0);
  Page page(view());
  page.good({{"do", "steer"}});
  page.good({{"do", "speed"}, {"factor", "max"}});
  page.good({{"do", "play"}});
  page.frame([](const Frame& f) { return f.time_s > 100; });
  const int before = page.frames();
  page.frame([](const Frame& f) { return f.time_s > 200; });
  EXPECT_GE(page.frames(), before);
  ::close(s);
}

// who connects and says nothing keeps nobody from opening the page
TEST_F(Server, idle_connections_do_not_keep_the_page_from_opening) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(port()));
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  std::vector<int> idle;
  for (int i = 0; i < 300; ++i) {
    idle.push_back(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    ASSERT_EQ(::connect(idle.back(), reinterpret_cast<sockaddr*>(&to), sizeof to), 0);
  }
  // on a busy PC the first one may come before the server has let an idle one go; a browser asks again
  int status = 0;
  for (int asked = 0; asked < 50 && status != 200; ++asked) {
    if (asked > 0) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    status = get_status(port(), own(""), host());
  }
  EXPECT_EQ(status, 200);
  Page page(view());
  EXPECT_TRUE(page.is_open());
  page.event("hello");
  for (const int s : idle) ::close(s);
}

TEST_F(Server, listens_on_the_loopback_alone) {
  std::ifstream table("/proc/net/tcp");
  const std::string own_port = fmt::format(":{:04X}", port());
  int listening = 0;
  for (std::string line; std::getline(table, line);) {
    std::istringstream words(line);
    std::string number, local, remote, state;
    words >> number >> local >> remote >> state;
    if (state != "0A" || local.size() < 5 || local.substr(local.size() - 5) != own_port) continue;
    EXPECT_EQ(local, "0100007F" + own_port) << "127.0.0.1";
    ++listening;
  }
  EXPECT_EQ(listening, 1);
}

TEST_F(Server, a_port_that_is_taken_is_told) {
  std::vector<std::string> problems;
  inputs::Opening opening;
  opening.file = path("world.toml");
  opening.text = read("world.toml");
  EXPECT_FALSE(viewer::LiveView::open(opening, "", port(), path("page"), problems));
  ASSERT_FALSE(problems.empty());
  EXPECT_TRUE(wording::reads(problems.back(),
                             "port: got …, which another program has, expected a free one; 0 takes any"));
}

}  // namespace
