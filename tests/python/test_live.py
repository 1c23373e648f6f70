# SPDX-License-Identifier: MIT
"""The live view's Python client, and that an edit of a long world is cheap for the server."""
import os
import pathlib
import time

import pytest
from conftest import TWINPUCK

from twinpuck import live

DRIVE = """#include <motor_led/e_init_port.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/advance_one_timer/e_agenda.h>
int main(void) {
  e_init_port(); e_init_motors(); e_start_agendas_processing();
  e_set_speed_left(500); e_set_speed_right(500);
  while (1);
}
"""
WORLD = """twinpuck = 1
[arena]
size = [4.0, 4.0]
[[box]]
name = "box"
position = [1.0, 1.0]
size = [0.1, 0.1, 0.1]
[[robot]]
name = "puck"
firmware = "drive"
position = [0.0, 0.0]
"""


@pytest.fixture
def view(tmp_path):
    (tmp_path / "drive").mkdir()
    (tmp_path / "drive/main.c").write_text(DRIVE)

    def start(world=WORLD, *options):
        (tmp_path / "world.toml").write_text(world)
        return live.start("world.toml", *options, command=TWINPUCK, cwd=tmp_path, timeout=300)
    return start


def test_a_client_steps_looks_and_touches(view):
    with view() as page:
        assert page.hello["world"]["robots"][0]["name"] == "puck"
        units = page.ask("subscribe", names=["puck.x", "puck.left_steps"])["units"]
        assert units[0] == "m"
        page.ask("step", unit="control", count=100)
        frame = page.frame(lambda f: f.time_s > 3.19)
        assert frame.time_s == pytest.approx(3.2, abs=0.002)
        assert frame.poses[0][0] == pytest.approx(frame.values[0], abs=1e-6) and frame.values[0] > 0.15
        assert len(frame.leds) == len(frame.states) == 1 and not frame.plays and not frame.ended
        page.ask("rays", robots=["puck"])
        assert len(page.frame(lambda f: f.rays).rays) == 8
        page.ask("play")
        assert page.frame(lambda f: f.plays).time_s >= frame.time_s


def test_who_is_refused_gets_what_stands_there(view):
    with view() as page:
        with pytest.raises(live.Refused) as refused:
            page.ask("write_source", program="drive", file="main.c", text="int x;", base="")
        assert refused.value.more["conflict"]["text"] == DRIVE


def cpu_s(process):
    """Processor time of a process and its threads, s."""
    words = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")


def test_an_edit_of_a_long_world_costs_little(view, record_property):
    boxes = "".join(f"[[box]]\nposition = [{-1.9 + 0.1 * (i % 39):.2f}, {-1.9 + 0.1 * (i // 39):.2f}]\n"
                    "size = [0.02, 0.02, 0.1]\n\n" for i in range(500))
    with view(WORLD.replace("position = [0.0, 0.0]", "position = [1.5, 1.5]") + boxes) as page:
        box = next(t["id"] for t in page.hello["world"]["things"] if t.get("name") == "box")
        page.ask("step")
        time.sleep(0.3)
        batches, edits, best_ms = 8, 25, 1e9
        for batch in range(batches):
            before = cpu_s(page._process)
            for i in range(edits):
                place = [1.0 + 0.001 * (edits * batch + i), 1.0]
                page.ask("edit", op="set", thing=box, values={"position": place}, group=7)
            best_ms = min(best_ms, (cpu_s(page._process) - before) / edits * 1000)
        print(f"an edit of a world of {len((WORLD + boxes).splitlines())} lines: {best_ms:.1f} ms of the server's processor")
        record_property("best_ms", best_ms)
        assert best_ms < 10  # 4 are asked for; beside other programs it may take twice that
        page.ask("state")  # all events are there
        with live.connect(page.address) as other:
            assert page.world == other.hello["world"]
