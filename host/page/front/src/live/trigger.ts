import type { SampleRing } from "./sample_ring";

export interface Condition {
  signal: string;
  level: number;
  edge: "rising" | "falling";
}

/** How much of the window lies before the moment of a trigger. */
export const kBefore = 0.2;

/** When the signal first crosses the level in this way among samples [from, ring.end), s; null if it does not. */
export function crossing(ring: SampleRing, { signal, level, edge }: Condition, from: number): number | null {
  const sign = edge === "rising" ? 1 : -1;
  let before = NaN;
  for (let n = Math.max(from - 1, ring.begin); n < ring.end; ++n) {
    const above = sign * (ring.value(signal, n) - level);
    if (before < 0 && above >= 0) {
      const [t, earlier] = [ring.time(n), ring.time(n - 1)];
      return t - ((t - earlier) * above) / (above - before);
    }
    before = above;
  }
  return null;
}

/** Looks for the next crossing whose window is complete, and goes on behind it. */
export class Trigger {
  private from = 0;
  private found: number | null = null;

  /** Looks only at what comes from now on. */
  restart(ring: SampleRing) {
    this.from = ring.end;
    this.found = null;
  }

  /** The moment of a crossing behind which enough has come to fill the window; null until then. */
  next(ring: SampleRing, condition: Condition, window_s: number): number | null {
    if (ring.end < this.from) this.restart(ring);
    if (this.found === null) {
      this.found = crossing(ring, condition, this.from);
      this.from = ring.end;
    }
    if (this.found === null || ring.end === 0) return null;
    const complete_s = this.found + (1 - kBefore) * window_s;
    if (ring.time(ring.end - 1) < complete_s) return null;
    const found = this.found;
    this.from = ring.at_or_after(complete_s);
    this.found = null;
    return found;
  }
}
