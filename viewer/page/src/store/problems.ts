// SPDX-License-Identifier: MIT
// All that is wrong, from wherever it is known: the world file, the compiler, traps, diagnoses, the run itself.
import type { Finding, Program } from "../link/protocol";
import type { Diagnosis, SourceLine, Store, Trap } from "./store";

export type Weight = "error" | "warning" | "note";
export interface Wrong {
  /** Where it comes from. */
  of: "run" | "world" | "compiler" | "trap" | "diagnosis" | "recording" | "file";
  weight: Weight;
  text: string;
  /** Of the world file; 0: none. */
  line?: number;
  source?: SourceLine;
  /** The piece of the world that it is about. */
  piece?: number;
}

export const textOfTrap = (e: Trap) => `${e.robot}: ${e.kind}: ${e.text}, at ${e.place}, ${e.time_s.toFixed(3)} s`;
export const textOfDiagnosis = (d: Diagnosis) =>
  `${d.robot}: ${d.cause} at ${d.place}, ${d.time_s.toFixed(3)} s: ${d.text}${d.hint ? "; " + d.hint : ""}`;

/** A line of one of the robot's sources, out of a text like `main() (main.c:3)`. */
export function placeIn(programs: Program[], robot: string, place: string): SourceLine | undefined {
  const found = place.match(/([\w./+-]+\.(?:c|h|cpp|hpp|cc|s|inc)):(\d+)/);
  if (!found) return undefined;
  for (const program of programs.filter((p) => p.robots.includes(robot)))
    for (const file of program.files)
      if (`/${program.folder}/${file}`.endsWith(`/${found[1]}`) || `/${found[1]}`.endsWith(`/${file}`))
        return { program: program.name, file, line: Number(found[2]) };
}

/** `file:line:column: error: text`, as compilers write. */
export function findingOf(told: string, kind: Finding["kind"], files: string[]): Finding {
  const m = told.match(/^([^\s:]+):(\d+)(?::(\d+))?:\s*(?:(?:fatal )?(error|warning|note):\s*)?(.*)$/s);
  if (!m) return { kind, file: "", line: 0, column: 0, text: told };
  const file = files.find((f) => `/${m[1]}`.endsWith(`/${f}`)) ?? m[1];
  return { kind, file, line: Number(m[2]), column: Number(m[3] ?? 0), text: m[5] };
}

export function wrongsOf(store: Store): Wrong[] {
  const { world, programs } = store;
  const list: Wrong[] = [];
  for (const p of world.problems)
    list.push({ of: "world", weight: "error", text: p.text, line: p.line, piece: p.id || undefined });
  for (const program of programs) {
    const found = program.findings ?? [];
    for (const f of found) {
      const known = program.files.includes(f.file);
      const where = f.line ? `${f.file}:${f.line}${f.column ? ":" + f.column : ""}: ` : f.file ? `${f.file}: ` : "";
      list.push({
        of: "compiler",
        weight: f.kind,
        text: `${program.name}: ${where}${f.text}`,
        source: known && f.line ? { program: program.name, file: f.file, line: f.line, column: f.column } : undefined,
      });
    }
    if (program.built && program.ok === false && !found.some((f) => f.kind === "error"))
      list.push({ of: "compiler", weight: "error", text: `${program.name} was not built` });
  }
  // why there is no run, unless it is one of those above
  for (const text of store.noRun)
    if (!list.some((w) => w.weight === "error" && text.includes(w.text)))
      list.unshift({ of: "run", weight: "error", text: `No run: ${text}` });
  if (!store.state.runs && !store.recorded && store.revision > 0 && !list.some((w) => w.weight === "error"))
    list.unshift({ of: "run", weight: "error", text: "There is no run." });
  const { recording } = store.state;
  if (recording?.error)
    list.push({ of: "recording", weight: "error", text: `The recording ${recording.file}: ${recording.error}` });
  for (const t of store.traps)
    list.push({ of: "trap", weight: "error", text: textOfTrap(t), source: placeIn(programs, t.robot, t.place) });
  for (const d of store.diagnoses)
    list.push({
      of: "diagnosis",
      weight: "warning",
      text: textOfDiagnosis(d),
      source: placeIn(programs, d.robot, d.place),
    });
  return list;
}
