// XIP_SSI and the chip select in IO_QSPI: whether the mapping reads the flash, and bytes sent by hand.
import { Words } from './registers.mjs';

const kCtrlr0 = 0x00, kSsienr = 0x08, kSer = 0x10, kBaudr = 0x14, kSr = 0x28, kDr0 = 0x60, kSpiCtrlr0 = 0xf4;
const kSelect = 0x0c;

export class FlashController {
  constructor(chip) {
    this.chip = chip;
    this.answers = [];
    this.sent = [];
    this.mappedByRom = false;
    this.pins = new Words(chip, 'IO_QSPI', { writes: { [kSelect]: () => this.selectChanged() } });
    this.ssi = new Words(chip, 'XIP_SSI', {
      initial: { [kBaudr]: 0 },
      reads: { [kSr]: () => 6 | (this.answers.length ? 8 : 0), [kDr0]: () => this.receive() },
      writes: {
        [kDr0]: (value) => this.send(value),
        [kSsienr]: () => { this.mappedByRom = false; },
        [kCtrlr0]: () => this.requireOff('CTRLR0'),
        [kBaudr]: () => this.requireOff('BAUDR'),
        [kSpiCtrlr0]: () => this.requireOff('SPI_CTRLR0'),
      },
    });
  }

  requireOff(name) {
    if (this.ssi.at(kSsienr) & 1) this.chip.complain(`${name} was written while the SSI is enabled`);
  }

  // Whether a read of the processor becomes command 03h with 24 bits of address and 32 of data on one line.
  get mapped() {
    if (this.mappedByRom) return true;
    const control = this.ssi.at(kCtrlr0);
    return (this.ssi.at(kSsienr) & 1) === 1 && (this.ssi.at(kSer) & 1) === 1 && this.ssi.at(kBaudr) >= 2 &&
      ((control >>> 16) & 31) === 31 && ((control >>> 8) & 3) === 3 && ((control >>> 21) & 3) === 0 &&
      this.ssi.at(kSpiCtrlr0) === 0x03000218;
  }

  // System clocks that a read of a word takes.
  get readCycles() {
    return 64 * (this.mappedByRom ? 6 : this.ssi.at(kBaudr));
  }

  // The boot ROM's functions.
  serial() {
    this.mappedByRom = false;
    this.ssi.words.set(kSsienr, 1);
    this.ssi.words.set(kSer, 1);
    this.ssi.words.set(kBaudr, 6);
    this.ssi.words.set(kCtrlr0, 7 << 16);
    this.ssi.words.set(kSpiCtrlr0, 0);
  }
  map() {
    this.mappedByRom = true;
  }
  releaseSelect() {
    this.pins.words.set(kSelect, 0);
    this.selectChanged();
  }

  get selected() {
    return ((this.pins.at(kSelect) >>> 8) & 3) === 2;
  }
  selectChanged() {
    this.sent = [];
  }

  send(byte) {
    if (!this.selected) this.chip.complain('a byte for the flash was sent while its chip select was not held');
    if (((this.ssi.at(kCtrlr0) >>> 16) & 31) !== 7) this.chip.complain('bytes were sent in words of another size');
    this.sent.push(byte & 0xff);
    const at = this.sent.length - 6;
    if (this.sent[0] !== 0x4b) this.chip.complain(`the flash does not know the command ${this.sent[0].toString(16)}`);
    this.answers.push(at >= 0 && at < 8 ? this.chip.flashPart.number[at] : 0xff);
  }
  receive() {
    if (this.answers.length === 0) this.chip.complain('an empty queue of the SSI was read');
    return this.answers.shift() ?? 0;
  }
}
