// SPDX-License-Identifier: MIT
// Two people's changes of one text, brought together by lines.
import { diff3Merge } from "node-diff3";

export interface Merged {
  /** Both changes; where they touch the same lines, mine. */
  text: string;
  /** Those lines: where they stand in `text` (1-based), and what the other one has there. */
  conflicts: { line: number; mine: string[]; theirs: string[] }[];
}

export function merge(base: string, mine: string, theirs: string): Merged {
  if (mine === base) return { text: theirs, conflicts: [] };
  if (theirs === base) return { text: mine, conflicts: [] };
  const lines: string[] = [],
    conflicts: Merged["conflicts"] = [];
  for (const part of diff3Merge(mine.split("\n"), base.split("\n"), theirs.split("\n"), {
    excludeFalseConflicts: true,
  })) {
    if (part.ok) lines.push(...part.ok);
    else if (part.conflict) {
      conflicts.push({ line: lines.length + 1, mine: part.conflict.a, theirs: part.conflict.b });
      lines.push(...part.conflict.a);
    }
  }
  return { text: lines.join("\n"), conflicts };
}
