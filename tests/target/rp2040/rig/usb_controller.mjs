// USBCTRL as a device, from the data sheet, 4.1: its registers, the memory that it shares with the processor, and what it
// answers to packets. The engine's own takes each packet at once and knows neither addresses nor toggles nor NAK.
import { Words } from './registers.mjs';

const kAddress = 0x00, kMain = 0x40, kSie = 0x4c, kStatus = 0x50, kBuffStatus = 0x58, kAbort = 0x60, kStallArm = 0x68, kMuxing = 0x74, kPower = 0x78, kInte = 0x90, kInts = 0x98;
const kKnown = new Set([kAddress, kMain, kSie, kStatus, kBuffStatus, kAbort, kStallArm, kMuxing, kPower, kInte, kInts]);
const kPullUp = 1 << 16, kEp0Interrupt = 1 << 29;
const status = { suspended: 1 << 4, resume: 1 << 11, setup: 1 << 17, reset: 1 << 19, sequence: 1 << 31 };
const kClearable = Object.values(status).reduce((all, bit) => all | bit);
const irqs = { buffers: 1 << 4, reset: 1 << 12, suspend: 1 << 14, resume: 1 << 15, setup: 1 << 16 };
const kIrq = 5;
const word = { length: 0x3ff, available: 1 << 10, stall: 1 << 11, pid: 1 << 13, full: 1 << 15 };
const kControls = 0x80, kEp0Buffer = 0x100, kBuffers = 0x180, kPacket = 64;
const kTransaction_ns = 62e3; // token, 64 bytes with all stuffing, handshake, at 12 Mbit/s
const kUsbClocks = 3; // of the processor, in which the controller's clock surely ticks once

export class UsbController {
  constructor(chip) {
    this.chip = chip;
    this.memory = chip.usbDPRAM;
    this.view = chip.usbDPRAMView;
    this.words = new Words(chip, 'USBCTRL', {
      reads: { [kStatus]: () => this.status, [kBuffStatus]: () => this.done, [kInts]: () => this.pending },
      writes: {
        [kStatus]: () => { this.status &= ~(this.words.rawWriteValue & kClearable); this.interrupt(); },
        [kBuffStatus]: () => { this.done &= ~this.words.rawWriteValue; this.interrupt(); },
        [kAbort]: (value) => { if (value) chip.complain('USB EP_ABORT is used, with which early chips refuse everything for ever (E2)'); },
        [kInte]: () => this.interrupt(),
      },
    });
    const write = this.words.writeUint32.bind(this.words);
    this.words.writeUint32 = (offset, value) => {
      if (!kKnown.has(offset)) chip.complain(`USBCTRL: a write of ${value.toString(16)} to an unknown register at ${offset.toString(16)}`);
      write(offset, value);
    };
    chip.usbCtrl.DPRAMUpdated = () => {};
    this.reset();
  }

  // The block is held in reset: the device is not at the bus.
  reset() {
    this.words.words.clear();
    this.status = this.done = 0;
    this.inReset = false;
    this.sequenceErrors = 0;
    this.onTakenBack = null; // a host that was just fetching the packet
    this.written = new Map(); // by offset of a control word: the core's cycle of the last store
    this.takenBack = new Map(); // by offset: until when the controller may still be at it
    this.givenUp = false; // endpoint 0's buffers: the host has sent another SETUP packet
    this.memory.fill(0);
    this.chip.setInterrupt(kIrq, false);
  }
  get awake() { return !(this.chip.resetWord & (1 << 24)); }
  get attached() {
    const phy = (1 << 3) | 1, power = (1 << 3) | (1 << 2);
    return this.awake && (this.words.at(kMain) & 1) === 1 && (this.words.at(kMuxing) & phy) === phy && (this.words.at(kPower) & power) === power && (this.words.at(kSie) & kPullUp) !== 0;
  }
  get pending() {
    const raw = (this.done ? irqs.buffers : 0) | (this.status & status.setup ? irqs.setup : 0) | (this.status & status.reset ? irqs.reset : 0) |
      (this.status & status.suspended ? irqs.suspend : 0) | (this.status & status.resume ? irqs.resume : 0);
    return raw & this.words.at(kInte);
  }
  interrupt() { this.chip.setInterrupt(kIrq, this.pending !== 0); }

  // Memory, as the processor sees it.
  readMemory(offset) { return this.view.getUint32(offset, true); }
  writeMemory(offset, value) {
    const { chip, view } = this, before = this.readMemory(offset);
    if (offset >= kControls && offset < kEp0Buffer) this.checkControl(offset, before, value >>> 0);
    else if (offset >= kEp0Buffer) this.checkBuffer(offset);
    view.setUint32(offset, value, true);
    this.written.set(offset, chip.core.cycles);
  }
  checkControl(offset, before, value) {
    const { chip } = this, name = `USB buffer control ${offset.toString(16)}`;
    const quiet = this.inReset || (offset < kControls + 8 && this.givenUp);
    if (before & word.available && !quiet) {
      if (value !== (before & ~word.available) >>> 0) chip.complain(`${name} was changed while the controller has the buffer`);
      this.takenBack.set(offset, chip.clock.nanos + kTransaction_ns);
      const place = (offset - kControls) / 4;
      if (before & word.full) this.onTakenBack?.(place, this.packetAt(place, before));
    } else if (this.takenBack.has(offset) && !quiet) {
      if (chip.clock.nanos < this.takenBack.get(offset)) chip.complain(`${name} was changed while the controller may still be at its last packet`);
      this.takenBack.delete(offset);
    }
    const acts = word.available | word.stall;
    if (!(value & acts & ~before)) return;
    if ((value & ~acts) !== (before & ~acts)) chip.complain(`${name}: what makes the controller act is stored together with the rest`);
    if (chip.core.cycles - (this.written.get(offset) ?? 0) < kUsbClocks) chip.complain(`${name}: what makes the controller act is stored too soon after the rest`);
    if (value & word.available) this.givenUp = offset < kControls + 8 ? false : this.givenUp;
  }
  checkBuffer(offset) {
    for (let place = 0; place < 32; ++place)
      if (place !== 1 && this.control(place) & word.available && offset >= this.bufferAt(place) && offset < this.bufferAt(place) + kPacket)
        this.chip.complain(`the USB buffer at ${offset.toString(16)} was written while the controller has it`);
  }

  // Endpoint n towards the host is place 2n, from the host 2n + 1.
  control(place) { return this.readMemory(kControls + 4 * place); }
  setControl(place, value) { this.view.setUint32(kControls + 4 * place, value, true); }
  bufferAt(place) {
    if (place < 2) return kEp0Buffer;
    const at = this.readMemory(4 * place) & 0xffff;
    return at;
  }
  enabled(place) {
    if (place < 2) return true;
    const setting = this.readMemory(4 * place);
    if (!(setting & (1 << 31))) return false;
    const at = setting & 0xffff;
    if (at % kPacket || at < kBuffers || at + kPacket > this.memory.length) this.chip.complain(`the USB endpoint ${place >> 1} has its buffer at ${at.toString(16)}`);
    return true;
  }
  stalls(place) {
    return (this.control(place) & word.stall) !== 0 && (place > 1 || (this.words.at(kStallArm) & (1 << place)) !== 0);
  }
  finish(place, value) {
    this.setControl(place, value);
    const interrupts = place < 2 ? this.words.at(kSie) & kEp0Interrupt : this.readMemory(4 * place) & (1 << 29);
    if (interrupts) this.done |= 1 << place;
    this.interrupt();
  }
  hears(address) { return this.attached && !this.inReset && address === (this.words.at(kAddress) & 0x7f); }

  // Packets, as a host sends them. null: nobody answers.
  setup(address, bytes) {
    if (!this.hears(address)) return null;
    this.memory.set(bytes, 0);
    this.words.words.set(kStallArm, 0);
    this.givenUp = true;
    this.status |= status.setup;
    this.interrupt();
    return 'ack';
  }
  // 'nak', 'stall', or { data1, bytes }. `taken` is false if the host does not hear the packet, and so does not acknowledge it.
  in(address, endpoint, taken = true) {
    const place = 2 * endpoint;
    if (!this.hears(address) || !this.enabled(place)) return null;
    if (this.stalls(place)) return 'stall';
    const control = this.control(place), wanted = word.available | word.full;
    if ((control & wanted) !== wanted) return 'nak';
    const packet = this.packetAt(place, control);
    if (taken) packet.finish();
    return packet;
  }
  packetAt(place, control) {
    const at = this.bufferAt(place), length = control & word.length;
    if (length > kPacket) this.chip.complain(`a USB packet of ${length} bytes at endpoint ${place >> 1}`);
    const bytes = Buffer.from(this.memory.subarray(at, at + length));
    return { data1: (control & word.pid) !== 0, bytes, finish: () => this.finish(place, control & (word.length | word.pid)) };
  }
  out(address, endpoint, data1, bytes) {
    const place = 2 * endpoint + 1;
    if (!this.hears(address) || !this.enabled(place)) return null;
    if (this.stalls(place)) return 'stall';
    const control = this.control(place);
    if (!(control & word.available) || control & word.full) return 'nak';
    if (((control & word.pid) !== 0) !== data1) { // the host has not heard the acknowledgement of the packet before
      this.status |= status.sequence;
      ++this.sequenceErrors;
      return 'ack';
    }
    if (bytes.length > (control & word.length)) this.chip.complain(`${bytes.length} bytes came for a USB buffer of ${control & word.length}`);
    this.memory.set(bytes, this.bufferAt(place));
    this.finish(place, word.full | (control & word.pid) | bytes.length);
    return 'ack';
  }

  beginReset() {
    this.inReset = true;
    this.status |= status.reset;
    this.interrupt();
  }
  endReset() { this.inReset = false; }
  // No packet for 3 ms: the host sleeps, or the cable is out.
  fallSilent() {
    this.status |= status.suspended;
    this.interrupt();
  }
  resume() {
    this.status |= status.resume;
    this.interrupt();
  }
}
