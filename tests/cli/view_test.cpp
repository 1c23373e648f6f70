// SPDX-License-Identifier: MIT
// twinpuck view from the terminal: it ends at a signal with its recording whole, and run
// --replay does it again.
#include "tests/cli/command.h"

namespace {

using namespace cli_test;

class View : public CommandTest {
 protected:
  /// A view of the maze, stepped by the example client of docs/connecting.md, then ended by a signal.
  Said stepped() {
    const std::string line = "sh -c '\"$@\" >" + path("out") +
                             " & p=$!; n=0; until [ $n = 200 ] || grep -q ^open " + path("out") +
                             " 2>/dev/null; do sleep 0.05; n=$((n + 1)); done; "
                             "python3 tests/viewer/example_client.py $(sed -n \"s/^open //p\" " +
                             path("out") + "); kill -s TERM $p; wait $p' sh";
    return twinpuck("view worlds/maze.toml --record-inputs " + path("inputs.jsonl"), line);
  }
};

TEST_F(View, a_signal_ends_it_and_its_recording_replays) {
  const Said view = stepped();
  EXPECT_EQ(view.exit_code, 0) << view.text;
  const Said replay = twinpuck("run --replay " + path("inputs.jsonl") + " --summary " + path("s.json"));
  EXPECT_EQ(replay.exit_code, 0) << replay.text;
  EXPECT_NE(read(path("s.json")).find("\"simulated_s\": 1.92"), std::string::npos) << read(path("s.json"));
}

TEST_F(View, a_replay_that_diverges_is_an_invalid_run) {
  stepped();
  std::string text = read(path("inputs.jsonl"));
  const std::size_t digest = text.rfind("\"digest\":\"") + 10;
  ASSERT_LT(digest, text.size());
  text[digest] = text[digest] == '0' ? '1' : '0';
  std::ofstream(folder / "inputs.jsonl") << text;
  const Said replay = twinpuck("run -q --replay " + path("inputs.jsonl"));
  EXPECT_EQ(replay.exit_code, 7);
  EXPECT_TRUE(reads(replay.text,
                    "replay: got digest …, expected … as recorded; world, program or Twinpuck are others"));
}

}  // namespace
