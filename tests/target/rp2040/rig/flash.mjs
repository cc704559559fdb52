// The flash part (2 MB of serial NOR): what a read sees, what erase and program leave behind, also if the supply ends in the
// middle. It outlives the chip.
export const kSectorBytes = 4096;
export const kPageBytes = 256;

export class Flash {
  constructor(seed = 1) {
    this.bytes = new Uint8Array(2 << 20).fill(0xff);
    this.erasures = new Uint32Array(this.bytes.length / kSectorBytes);
    this.state = (seed * 2654435761 + 12345) >>> 0;
    this.number = Uint8Array.from({ length: 8 }, () => this.random() & 0xff);
    this.times = { erase: 45e6, program: 0.4e6 }; // nanoseconds
  }

  random() {
    this.state ^= this.state << 13;
    this.state ^= this.state >>> 17;
    this.state ^= this.state << 5;
    this.state >>>= 0;
    return this.state;
  }

  load(at, bytes) {
    this.bytes.set(bytes, at);
  }

  erase(at, size) {
    this.bytes.fill(0xff, at, at + size);
    for (let sector = at / kSectorBytes; sector < (at + size) / kSectorBytes; ++sector) ++this.erasures[sector];
  }

  program(at, bytes) {
    bytes.forEach((byte, i) => (this.bytes[at + i] &= byte));
  }

  // The supply has ended: each bit is as it was or as it should have become, and nobody can say which.
  tear(operation) {
    const { at, size, bytes } = operation;
    for (let i = 0; i < size; ++i) {
      const before = this.bytes[at + i];
      const after = bytes ? before & bytes[i] : 0xff;
      const mixed = this.random() & 0xff;
      this.bytes[at + i] = (before & mixed) | (after & ~mixed);
    }
    if (!bytes) for (let s = at / kSectorBytes; s < (at + size) / kSectorBytes; ++s) ++this.erasures[s];
  }
}
