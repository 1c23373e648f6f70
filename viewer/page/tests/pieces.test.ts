// SPDX-License-Identifier: MIT
// What is asked of the server when pieces are moved, turned, copied or pasted: before a run in the file, in it where
// they are.
import assert from "node:assert/strict";
import test from "node:test";
import { FakeLink, freshDocument, settle } from "./dom";
import type { Frame } from "../src/link/protocol";
import { Client } from "../src/store/client";
import { Pieces } from "../src/store/pieces";
import { Store } from "../src/store/store";
import { robot, thing, world } from "./worlds";

const kBox = 1,
  kWall = 2,
  kRobot = 3,
  kLoose = 4, // a box that can be pushed, body 1
  kSound = 5;
const kTurned = 0.5; // rad, of both bodies in the run; in the file they look at 0

function start(time: number) {
  freshDocument();
  const store = new Store(),
    link = new FakeLink(),
    pieces = new Pieces(store, new Client(store, link));
  const keys = (...names: string[]) => ({ keys: names.map((key) => ({ key })) }) as never;
  store.schema = {
    box: keys("position", "heading", "colour"),
    wall: keys("points", "colour"),
    robot: keys("position", "heading", "colour"),
    sound: keys("position"),
  };
  store.takeWorld(
    world({
      things: [
        thing(kBox, { position: [0.1, 0.2, 0.3], heading: 0, name: "box 7" }),
        thing(kWall, {
          kind: "wall",
          points: [
            [0, 0],
            [0.2, 0],
          ] as never,
        }),
        thing(kLoose, { position: [0.5, 0.5], heading: 0, body: 1 }),
        thing(kSound, { kind: "sound", position: [0, 0, 0], heading: 0 }),
      ],
      robots: [robot(kRobot, { position: [0.3, 0.4] })],
    }),
    1,
  );
  const poses = new Float32Array([0.25, 0.75, 0, kTurned, 1, 0.5, 0, kTurned]);
  store.frame = { time, bodies: 2, poses } as Frame;
  return { store, link, pieces };
}
/** Edits that were asked for, one by one. */
const editsOf = (link: FakeLink) => link.of("edit").flatMap(({ group, ...edit }) => edit.edits ?? [edit]);
const set = (id: number, values: Record<string, unknown>) => ({ op: "set", thing: id, values });
const move = (body: number, x: number, y: number, heading: number) => ({ body, x, y, heading });

const kRows: [string, number, number[], (p: Pieces) => unknown, { edits?: unknown[]; moves?: unknown[] }][] = [
  // [what, time of the run, what is selected, what is done, what is asked]
  ["the height stays", 0, [kBox], (p) => p.nudge(0, 1, 0.01), { edits: [set(kBox, { position: [0.1, 0.21, 0.3] })] }],
  [
    "places are rounded to 10 um",
    0,
    [kBox],
    (p) => p.nudge(1, -1, 0.000014),
    { edits: [set(kBox, { position: [0.10001, 0.19999, 0.3] })] },
  ],
  [
    "in a run a robot is moved and looks where it looked",
    1,
    [kRobot],
    (p) => p.nudge(1, 0, 0.5),
    { moves: [move(0, 0.75, 0.75, kTurned)] },
  ],
  ["so is a loose thing", 1, [kLoose], (p) => p.nudge(0, -1, 0.25), { moves: [move(1, 1, 0.25, kTurned)] }],
  [
    "a turn in the file",
    0,
    [kBox],
    (p) => p.turn(90),
    { edits: [set(kBox, { position: [0.1, 0.2, 0.3], heading: 90 })] },
  ],
  [
    "a turn in a run goes on from where it looks",
    1,
    [kRobot],
    (p) => p.turn(90),
    { moves: [move(0, 0.25, 0.75, kTurned + Math.PI / 2)] },
  ],
  [
    "a wall turns about its middle",
    0,
    [kWall],
    (p) => p.turn(90),
    {
      edits: [
        set(kWall, {
          points: [
            [0.1, -0.1],
            [0.1, 0.1],
          ],
        }),
      ],
    },
  ],
  ["a sound has no side to turn, and no colour", 0, [kSound], (p) => (p.turn(90), p.paint([1, 0, 0])), {}],
  [
    "paint goes to what has a colour",
    0,
    [kSound, kBox],
    (p) => p.paint([1, 0, 0]),
    { edits: [set(kBox, { colour: [1, 0, 0] })] },
  ],
  [
    "several turn about their middle",
    1,
    [kRobot, kLoose],
    (p) => p.turn(180),
    { moves: [move(0, 1, 0.5, kTurned + Math.PI), move(1, 0.25, 0.75, kTurned + Math.PI)] },
  ],
  [
    "several in the file turn about the middle of their points, and a box in itself",
    0,
    [kBox, kWall],
    (p) => p.turn(90),
    {
      edits: [
        set(kBox, { position: [-0.03333, 0.06667, 0.3], heading: 90 }),
        set(kWall, {
          points: [
            [0.16667, -0.03333],
            [0.16667, 0.16667],
          ],
        }),
      ],
    },
  ],
  [
    "a copy lies beside it, at its height, and has the next free name",
    0,
    [kBox],
    (p) => p.copy(),
    { edits: [{ op: "copy", thing: kBox, values: { position: [0.2, 0.1, 0.3], name: "box 2" } }] },
  ],
  [
    "a copy of a wall",
    0,
    [kWall],
    (p) => p.copy(),
    {
      edits: [
        {
          op: "copy",
          thing: kWall,
          values: {
            points: [
              [0.05, -0.05],
              [0.25, -0.05],
            ],
          },
        },
      ],
    },
  ],
];

test("what is done to pieces, before a run and in it", async () => {
  for (const [what, time, selected, act, { edits = [], moves = [] }] of kRows) {
    const { store, link, pieces } = start(time);
    store.selectAll(selected);
    await act(pieces);
    await settle();
    const asked = editsOf(link);
    assert.deepEqual(asked, edits, what);
    assert.deepEqual(link.of("move"), moves, what);
  }
});

test("a piece is put where it is said to be, a wall by its first point", () => {
  const { link, pieces, store } = start(0);
  const [box, wall] = store.world.things;
  pieces.put([
    { piece: box as never, at: [1, 2] },
    { piece: wall as never, at: [0.5, -0.25] },
  ]);
  assert.deepEqual(editsOf(link), [
    set(kBox, { position: [1, 2, 0.3] }),
    set(kWall, {
      points: [
        [0.5, -0.25],
        [0.7, -0.25],
      ],
    }),
  ]);
  // from somewhere else than the origin, too
  wall.points = [
    [0.2, 0.3],
    [0.4, 0.6],
  ] as never;
  pieces.put([{ piece: wall as never, at: [1, 1] }]);
  assert.deepEqual(
    editsOf(link).at(-1),
    set(kWall, {
      points: [
        [1, 1],
        [1.2, 1.3],
      ],
    }),
  );
});

test("what is pasted again lies further, and something else begins anew", async () => {
  const { link, pieces } = start(0);
  for (const text of ["[[box]]\n", "[[box]]\n", "words", "[[lamp]]\n"]) await pieces.paste(text);
  assert.deepEqual(
    link.of("edit").map((e) => [e.text, e.dx, e.dy]),
    [
      ["[[box]]\n", 0.1, -0.1],
      ["[[box]]\n", 0.2, -0.2],
      ["[[lamp]]\n", 0.1, -0.1],
    ],
  );
});

test("names of copies", () => {
  const { pieces } = start(0);
  for (const [like, taken, name] of [
    ["puck", [], "puck2"],
    ["puck", ["puck2"], "puck3"],
    ["box 7", [], "box 2"],
    ["box_7", [], "box2"],
    ["9", [], "thing2"],
  ] as [string, string[], string][])
    assert.equal(pieces.freeName(like, new Set(taken)), name);
});
