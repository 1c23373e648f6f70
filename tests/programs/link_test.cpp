// SPDX-License-Identifier: MIT
// The link's codec, and its table in the docs.
#include "programs/link/packet.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "tools/dev/doc_part.h"
#include "tools/dev/link_doc.h"
#include "twinpuck_paths.h"

namespace {

struct Packet : link_packet {
  Packet() : link_packet{} {}
  ~Packet() { link_free(this); }
  Packet(const Packet&) = delete;
  Packet& operator=(const Packet&) = delete;
};

TEST(Link, what_is_written_is_read) {
  Packet p;
  const double numbers[3] = {1.5, -2, 1e300};
  link_begin(&p, LINK_VALUE);
  link_int(&p, -1);
  link_int(&p, 7);
  link_numbers(&p, numbers, 3);
  link_text(&p, "nine chars");
  link_end(&p);
  link_begin(&p, LINK_READY);
  link_end(&p);
  // 8 of the head, 8 and 8, 8 + 24, 8 + 16; 8 of READY
  EXPECT_EQ(p.size, 8u + 16 + 32 + 24 + 8);
  link_reader reader;
  link_record record;
  link_read(&reader, p.bytes, p.size);
  ASSERT_TRUE(link_next(&reader, &record));
  EXPECT_EQ(record.number, LINK_VALUE);
  EXPECT_EQ(record.ints[0], -1);
  EXPECT_EQ(record.ints[1], 7);
  ASSERT_EQ(record.lists[0].count, 3u);
  EXPECT_EQ(record.lists[0].values[2], 1e300);
  EXPECT_EQ(std::string(record.texts[0].bytes, record.texts[0].size), "nine chars");
  ASSERT_TRUE(link_next(&reader, &record));
  EXPECT_EQ(record.number, LINK_READY);
  EXPECT_FALSE(link_next(&reader, &record));
  EXPECT_EQ(reader.error, nullptr);
}

TEST(Link, what_is_no_record_is_refused) {
  const auto error_of = [](std::vector<std::uint64_t> words, std::size_t bytes) {
    link_reader reader;
    link_record record;
    link_read(&reader, words.data(), bytes);
    while (link_next(&reader, &record)) continue;
    return std::string(reader.error ? reader.error : "");
  };
  const std::uint64_t step = std::uint64_t{8} << 32 | LINK_STEP;
  EXPECT_EQ(error_of({step, 32}, 16), "");
  EXPECT_EQ(error_of({step, 32}, 4), "got a packet that ends within a record");
  EXPECT_EQ(error_of({step, 32}, 8), "got a record that is longer than its packet");
  EXPECT_EQ(error_of({std::uint64_t{12} << 32 | LINK_STEP, 32, 0}, 24),
            "got a record that is longer than its packet");
  EXPECT_EQ(error_of({std::uint64_t{8} << 32 | 9999, 32}, 16),
            "got a record of a number that this version does not have");
  EXPECT_EQ(error_of({std::uint64_t{16} << 32 | LINK_STEP, 32, 0}, 24),
            "got a record whose members are not those of its number");
  // a text of more bytes than there are, and one of fewer than none
  for (const std::uint64_t size : {std::uint64_t{1} << 62, ~std::uint64_t{0}, std::uint64_t{9}})
    EXPECT_EQ(error_of({std::uint64_t{16} << 32 | LINK_CUSTOM, size, 0}, 24),
              "got a record whose members are not those of its number")
        << size;
}

TEST(Link, noise_never_leads_beyond_the_packet) {
  std::mt19937_64 chance(1);
  std::size_t count = 0;
  const link_row* rows = link_rows(&count);
  for (int round = 0; round < 200000; ++round) {
    // exactly as long as it is, so that a sanitizer sees a step beyond
    std::vector<std::uint64_t> words(1 + chance() % 12);
    for (std::uint64_t& word : words) word = chance() >> (chance() % 64);
    words[0] = (chance() % 96) << 32 | static_cast<std::uint64_t>(rows[chance() % count].number);
    link_reader reader;
    link_record record;
    link_read(&reader, words.data(), words.size() * 8);
    const char* const end = reinterpret_cast<const char*>(words.data() + words.size());
    while (link_next(&reader, &record))
      for (int i = 0; const char* m = std::strchr(link_row_of(record.number)->members, 's'); ++i) {
        if (!m || i > 0) break;
        ASSERT_LE(record.texts[0].bytes + record.texts[0].size, end);
      }
  }
}

TEST(Link, rows_are_in_their_order_and_read_back) {
  std::size_t count = 0;
  const link_row* rows = link_rows(&count);
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) {
      EXPECT_LT(rows[i - 1].number, rows[i].number);
    }
    EXPECT_EQ(link_row_of(rows[i].number), &rows[i]);
    // as many names as members, so that the page tells each
    const std::size_t members = std::strlen(rows[i].members);
    EXPECT_LE(members, 15u) << rows[i].name;
    EXPECT_EQ(members == 0, *rows[i].what == 0) << rows[i].name;
  }
  EXPECT_EQ(link_row_of(9), nullptr);
}

TEST(Link, the_page_has_the_table) {
  std::ifstream in(std::string(TWINPUCK_SOURCE_DIR) + "/docs/connecting.md");
  std::ostringstream page;
  page << in.rdbuf();
  EXPECT_EQ(dev::with_doc_part(page.str(), "records", dev::link_table()), page.str())
      << "run build/twinpuck-dev page docs/connecting.md";
}

}  // namespace
