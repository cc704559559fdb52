/** Words before the bytes: how many were put and taken so far, each modulo 2^32; a count of news, at which the other side waits; the state. */
const kPut = 0;
const kTaken = 1;
const kNews = 2;
const kState = 3;
const kWords = 4;

/**
 * Bytes from the page to a worker, first in, first out, in memory that both share: a worker that waits for them hears no messages. Beside
 * them is one number, the state of what they come from.
 */
export class SharedBytes {
  private words: Int32Array;
  private bytes: Uint8Array;

  constructor(readonly memory: SharedArrayBuffer) {
    this.words = new Int32Array(memory, 0, kWords);
    this.bytes = new Uint8Array(memory, 4 * kWords);
  }

  /** `size`: a power of two, so that the counts may overflow. */
  static of_size(size: number): SharedBytes {
    return new SharedBytes(new SharedArrayBuffer(4 * kWords + size));
  }

  get state() {
    return Atomics.load(this.words, kState);
  }
  set state(value: number) {
    Atomics.store(this.words, kState, value);
    this.wake();
  }

  /** False, and nothing changes, if it is not `from` any more. */
  change_state(from: number, to: number): boolean {
    const changed = Atomics.compareExchange(this.words, kState, from, to) === from;
    if (changed) this.wake();
    return changed;
  }

  /** All of them or, where there is no room, none. */
  put(from: Uint8Array): boolean {
    const at = Atomics.load(this.words, kPut);
    if (from.length > this.bytes.length - this.waiting) return false;
    this.parts(at, from.length, (part, done) => part.set(from.subarray(done, done + part.length)));
    Atomics.store(this.words, kPut, at + from.length);
    this.wake();
    return true;
  }

  /** As many as there are and `into` has room for; how many. */
  take(into: Uint8Array): number {
    const at = Atomics.load(this.words, kTaken);
    const count = Math.min(this.waiting, into.length);
    this.parts(at, count, (part, done) => into.set(part, done));
    Atomics.store(this.words, kTaken, at + count);
    return count;
  }

  get waiting() {
    return (Atomics.load(this.words, kPut) - Atomics.load(this.words, kTaken)) >>> 0;
  }

  /** In a worker: until `done`, or this time has passed. */
  wait_until(done: () => boolean, most_ms: number) {
    const end = performance.now() + most_ms;
    for (;;) {
      const news = Atomics.load(this.words, kNews);
      const left_ms = end - performance.now();
      if (done() || left_ms <= 0) return;
      Atomics.wait(this.words, kNews, news, left_ms);
    }
  }

  private wake() {
    Atomics.add(this.words, kNews, 1);
    Atomics.notify(this.words, kNews);
  }

  private parts(at: number, count: number, use: (part: Uint8Array, done: number) => void) {
    const begin = (at >>> 0) % this.bytes.length;
    const first = Math.min(count, this.bytes.length - begin);
    use(this.bytes.subarray(begin, begin + first), 0);
    if (first < count) use(this.bytes.subarray(0, count - first), first);
  }
}
