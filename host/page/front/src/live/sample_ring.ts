import type { Samples } from "./contract";

/**
 * The newest samples of each watched signal, in memory of a fixed size. Samples are numbered from the first that ever came; those
 * from `begin` to `end` are kept.
 */
export class SampleRing {
  end = 0;
  /** While it is true, what comes is dropped, so that somebody can look at what is kept. */
  frozen = false;
  private readonly times: Float64Array;
  private columns = new Map<string, Float64Array>();

  constructor(readonly capacity: number) {
    this.times = new Float64Array(capacity);
  }

  get begin() {
    return Math.max(0, this.end - this.capacity);
  }

  /** Keeps what is there of signals that stay; a new one has no values before now. */
  watch(names: string[]) {
    this.columns = new Map(names.map((name) => [name, this.columns.get(name) ?? new Float64Array(this.capacity).fill(NaN)]));
  }

  clear() {
    this.end = 0;
  }

  push({ t_s, signals }: Samples) {
    if (this.frozen || t_s.length === 0) return;
    // The clock of a robot that restarts begins again.
    if (this.end > 0 && t_s[0]! <= this.time(this.end - 1)) this.clear();
    t_s.forEach((t, i) => (this.times[(this.end + i) % this.capacity] = t));
    for (const [name, column] of this.columns) {
      const values = signals[name];
      for (let i = 0; i < t_s.length; ++i) column[(this.end + i) % this.capacity] = values?.[i] ?? NaN;
    }
    this.end += t_s.length;
  }

  time(sample: number): number {
    return this.times[sample % this.capacity]!;
  }

  /** NaN if there is none. */
  value(name: string, sample: number): number {
    return this.columns.get(name)?.[sample % this.capacity] ?? NaN;
  }

  column(name: string): Float64Array | undefined {
    return this.columns.get(name);
  }

  /** The first sample at or after this time; `end` if there is none. */
  at_or_after(t_s: number): number {
    let [low, high] = [this.begin, this.end];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.time(middle) < t_s) low = middle + 1;
      else high = middle;
    }
    return low;
  }
}
