# SPDX-License-Identifier: MIT
"""What each room holds, in a line. Who may include whom stands in scripts/check.py, which makes one table of both."""

HOLDS = {
    "firmware": "controllers, one a folder with its `test.cpp`; `include/` the contract, `lab/` solutions of the lab, `webots/` Webots' interface on the chip",
    "firmware/library": "the half of the e-puck library that touches no register",
    "firmware/libc": "the C library of programs",
    "hal_dspic": "the half on the chip's registers; `runtime/` what runs beneath a program; `bootloader/`",
    "install": "where the product lies and may write, how large its caches are, what is installed",
    "compiler/cache": "objects kept by content; child processes and their memory",
    "compiler/projects": "which files are a program: MPLAB projects, Makefiles, drivers",
    "compiler/build": "from a folder to an image",
    "compiler/front": "`twinpuck-cc`: one C or assembler file becomes an object",
    "hal_sim/board": "the electrical e-puck, and the parts plugged into it",
    "hal_sim/drivers": "the busy drivers in closed form: agendas with motors, converter scan",
    "hal_sim/api": "the busy drivers' functions as host functions, and the cycles of calls",
    "hal_sim/host": "what others may ask of whatever runs a robot's program; that robot in the world",
    "hal_sim/chip": "the chip on the board and a program on it: endings, memory check, coverage, cycles, profile",
    "hal_sim/trace": "signals (VCD) and time line (JSON) of a robot",
    "hal_sim/twin": "a world with firmware in it: ties board, chip, compiler and world together",
    "hal_sim/debug": "the debugger: session, expressions, terminal and DAP",
    "hal_sim/signals": "all of a running world that has a name and a number; conditions over it",
    "hal_sim/faults": "faults and stimuli: one table, the file, the injector",
    "hal_sim/runs": "a world that is open, with all who have a hand in it: twin, programs of the PC, inputs, coverage",
    "hal_sim/inputs": "what changes a running world from outside, and its recording",
    "programs/link": "the records between programs of the PC and the simulator, and their codec",
    "programs/process": "a program as a process: socket, output, end",
    "programs/build": "what a program of the PC is, how it is compiled and started",
    "programs/puck": "the e-puck as a program commands it",
    "programs/world": "nodes and fields of a running world, for supervisors",
    "programs/team": "gives programs their turns and reports how they ended",
    "programs/controller": "the libraries that programs link with or import: C, C++, Python, Java",
    "programs/supervisors": "supervisors of ours",
    "viewer": "the live view: server, session, the file that is edited; `page/` in TypeScript",
    "import": "worlds of Webots become world files",
    "python": "the Python module, the pytest plug-in, `*.test.toml`, grading",
    "embed": "`libtwinpuck.so` and its headers",
    "outputs": "what a run leaves behind and shows: recordings, pictures, traces, profiles, summary, the terminal's picture",
    "exercises": "the lab's exercises: table, trials, a class of programs",
    "flash": "programs into a robot through its bootloader",
    "tools": "the command, one file a verb; `dev/` the makers' command `twinpuck-dev`",
    "tests": "mirrors the rooms",
    "bench": "measurements of speed",
    "sim_core/base": "clock, hash, messages' suggestions, reproducible sine and cosine, threads, `CHECK`",
    "sim_core/random": "random numbers by key and counter",
    "sim_core/geometry": "poses, solids, rays, neighbours, overlap",
    "sim_core/physics": "the motion engines; falling and bouncing",
    "sim_core/world": "a world's description and layout, the frozen `Scene`, the seam to robots",
    "sim_core/light": "proximity sensors' optics and profiles, ambient light",
    "sim_core/camera": "pictures",
    "sim_core/sound": "sources, air, WAV files",
    "sim_core/radio": "packets and short-range links between robots",
    "sim_core/record": "CSV, pictures, heat maps, films",
    "sim_core/load": "world files: schema, messages, checks",
    "dspic30/memory": "time, tables of registers and interrupts, the bus, diagnoses",
    "dspic30/periph": "a pair of files a peripheral; `outside.h`, the seam to the board",
    "dspic30/device": "the whole chip, the front door; `sfr.csv`, the registers",
    "dspic30/core": "the processor: instruction table, semantics, loop, memory check",
    "dspic30/routines": "routines of the runtime in closed form",
    "dspic30/asm": "the assembler",
    "dspic30/load": "HEX, ELF and debug information",
    "dspic30/link": "the linker",
    "dspic30/llvm": "the chip as a target of LLVM",
    "dspic30/translate": "hot code as the PC's",
}


def table(may_include, core, chip, free):
    """Markdown: rooms, what they hold, what they may include. Rooms in a row include those before them."""
    lines = ["", "| room | holds | may include, beside itself |", "|---|---|---|"]
    for room in sorted(set(may_include) | {name for name in HOLDS if name.count("/") == 0 or name.startswith("programs/")} | set(free)):
        if room not in HOLDS:
            continue
        allowed = "anything" if room in free else ", ".join("`%s`" % name for name in may_include.get(room, [])) or "nothing"
        lines.append("| `%s` | %s | %s |" % (room, HOLDS[room], allowed))
    for top, row in (("sim_core", core), ("dspic30", chip)):
        lines += ["", "Rooms of `%s`, each of which may include those above it:" % top, "", "| room | holds |", "|---|---|"]
        lines += ["| `%s` | %s |" % (name, HOLDS.get("%s/%s" % (top, name), "")) for name in row]
    return "\n".join(lines) + "\n\n"


def missing(rooms):
    """Rooms without a line here, and lines without a room."""
    return sorted(set(rooms) - set(HOLDS)), sorted(set(HOLDS) - set(rooms))
