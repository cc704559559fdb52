// A peripheral of plain words, with the aliases that set, clear and flip bits. `reads` and `writes` have what a word does
// besides keeping its value, by offset.
import { BasePeripheral } from 'rp2040js';

export class Words extends BasePeripheral {
  constructor(chip, name, { initial = {}, reads = {}, writes = {} } = {}) {
    super(chip, name);
    this.words = new Map(Object.entries(initial).map(([offset, value]) => [Number(offset), value]));
    this.reads = reads;
    this.writes = writes;
  }

  at(offset) {
    return (this.words.get(offset) ?? 0) >>> 0;
  }

  readUint32(offset) {
    const plain = offset & 0xfff;
    return (this.reads[plain]?.() ?? this.at(plain)) >>> 0;
  }

  writeUint32(offset, value) {
    this.words.set(offset, value >>> 0);
    this.writes[offset]?.(value >>> 0);
  }
}
