// UART0 as a PL011: queues of 32 bytes, characters that take their time, interrupts as the manual has them.
import { Words } from './registers.mjs';

const kDr = 0x00, kFr = 0x18, kIbrd = 0x24, kFbrd = 0x28, kLcrH = 0x2c, kCr = 0x30, kIfls = 0x34, kImsc = 0x38, kRis = 0x3c, kMis = 0x40, kIcr = 0x44;
const kRx = 1 << 4, kTx = 1 << 5, kTimeOut = 1 << 6, kOverrun = 1 << 10;
const kQueue = 32, kIrq = 20;
const kLevels = [4, 8, 16, 24, 28];

export class Uart {
  constructor(chip) {
    this.chip = chip;
    this.received = [];
    this.toSend = [];
    this.raw = 0;
    this.lost = 0;
    this.fromHost = []; // on their way to the chip
    this.onByte = () => {};
    this.words = new Words(chip, 'UART0', {
      initial: { [kIfls]: 0x12, [kCr]: 0x300 },
      reads: {
        [kDr]: () => this.read(),
        [kFr]: () => (this.received.length === 0 ? 1 << 4 : 0) | (this.toSend.length >= kQueue ? 1 << 5 : 0) |
          (this.received.length >= kQueue ? 1 << 6 : 0) | (this.toSend.length === 0 ? 1 << 7 : 0) | (this.sending ? 1 << 3 : 0),
        [kRis]: () => this.raw,
        [kMis]: () => this.raw & this.words.at(kImsc),
      },
      writes: {
        [kDr]: (value) => this.write(value & 0xff),
        [kIcr]: (value) => { this.raw &= ~value | (this.received.length >= this.rxLevel ? kRx : 0); this.interrupt(); },
        [kImsc]: () => this.interrupt(),
      },
    });
    this.txAlarm = chip.clock.createAlarm(() => this.sent());
    this.rxAlarm = chip.clock.createAlarm(() => this.arrive());
    this.quietAlarm = chip.clock.createAlarm(() => { if (this.received.length) { this.raw |= kTimeOut; this.interrupt(); } });
  }

  get bitNanos() {
    const divider = this.words.at(kIbrd) + this.words.at(kFbrd) / 64;
    return (16 * divider * 1e9) / this.chip.clkPeri;
  }
  get baud() {
    return 1e9 / this.bitNanos;
  }
  get on() {
    return (this.words.at(kCr) & 1) === 1 && (this.words.at(kLcrH) & 0x70) === 0x70;
  }
  get rxLevel() {
    return kLevels[(this.words.at(kIfls) >>> 3) & 7];
  }

  interrupt() {
    this.chip.setInterrupt(kIrq, (this.raw & this.words.at(kImsc)) !== 0);
  }

  write(byte) {
    if (!this.on || !(this.words.at(kCr) & 0x100)) return this.chip.complain('the UART does not send: it is off, or its queues are');
    if (this.chip.gpio[0].functionSelect !== 2) return this.chip.complain('the UART sends to no pin');
    if (this.toSend.length >= kQueue) return this.chip.complain('a byte was written to the full queue of the UART');
    this.toSend.push(byte);
    if (!this.sending) this.begin();
  }
  // The wire waits: nothing leaves the chip, which sees a queue that stays full.
  hold(on) {
    this.held = on;
    if (on) this.txAlarm.cancel();
    else if (this.sending) this.txAlarm.schedule(10 * this.bitNanos);
  }
  begin() {
    this.sending = this.toSend.length > 0;
    if (this.held) return;
    if (this.sending) this.txAlarm.schedule(10 * this.bitNanos);
  }
  sent() {
    const before = this.toSend.length;
    this.onByte(this.toSend.shift());
    const level = kLevels[this.words.at(kIfls) & 7];
    if (before > level && this.toSend.length <= level) this.raw |= kTx; // on the way down through the level
    this.begin();
    this.interrupt();
  }

  // The host's end of the wire.
  feed(bytes) {
    const idle = this.fromHost.length === 0;
    for (const byte of bytes) this.fromHost.push(byte);
    if (idle && this.fromHost.length) this.rxAlarm.schedule(10 * 1000);
  }
  arrive() {
    const byte = this.fromHost.shift();
    if (this.fromHost.length) this.rxAlarm.schedule(10 * 1000); // 1 Mbit/s, whatever the chip thinks
    if (!this.on || !(this.words.at(kCr) & 0x200) || this.chip.gpio[1].functionSelect !== 2) return;
    if (Math.abs(this.baud - 1e6) > 2e4) return; // another rate receives nothing of use
    if (this.received.length >= kQueue) {
      ++this.lost;
      this.raw |= kOverrun;
    } else {
      this.received.push(byte);
      if (this.received.length >= this.rxLevel) this.raw |= kRx;
      this.quietAlarm.schedule(32 * this.bitNanos);
    }
    this.interrupt();
  }
  read() {
    if (this.received.length === 0) this.chip.complain('an empty queue of the UART was read');
    const byte = this.received.shift() ?? 0;
    if (this.received.length < this.rxLevel) this.raw &= ~kRx;
    if (this.received.length === 0) this.raw &= ~kTimeOut;
    this.interrupt();
    return byte;
  }
}
