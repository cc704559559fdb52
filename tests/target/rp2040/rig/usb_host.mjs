// A host at the Pico's USB: enumerates as Linux does, opens the serial port, and moves its bytes in packets, on the chip's clock.
// Strict: a packet with the wrong toggle, or one that is longer than its endpoint's, is an error.
export const request = {
  status: 0, clearFeature: 1, setFeature: 3, setAddress: 5, descriptor: 6, configuration: 8, setConfiguration: 9, interface: 10, setInterface: 11,
  setLineCoding: 0x20, lineCoding: 0x21, setLineState: 0x22, sendBreak: 0x23,
};
export const descriptor = { device: 1, configuration: 2, string: 3, qualifier: 6, otherSpeed: 7 };
const kOut = 3, kIn = 4, kPacket = 64, kAddress = 7;
const kPoll_ns = 60e3; // a packet of 64 bytes and its handshake

export class UsbHost {
  constructor(pico, { reads = true } = {}) {
    this.pico = pico;
    this.reads = reads; // false: a program that has the port open and does not read
    this.pause = () => 0; // nanoseconds more until the next packet
    this.afterSetup_us = 0; // until the stage that follows a SETUP packet
    this.plugged = true;
    this.errors = [];
    this.forget();
    const started = pico.onStart;
    pico.onStart = (chip) => { started(chip); this.bind(chip); };
    this.bind(pico.chip);
  }
  get usb() { return this.pico.chip.usb; }
  get attached() { return this.plugged && this.usb.attached; }

  // The chip has started anew: the device has left the bus, and the host knows nothing of it any more.
  bind(chip) {
    this.forget();
    this.alarm = chip.clock.createAlarm(() => this.poll());
    this.alarm.schedule(kPoll_ns);
  }
  forget() {
    this.address = 0;
    this.open = false; // the host polls the data endpoints
    this.toggles = { in: false, out: false };
    this.toSend = [];
    this.received = [];
  }

  pass(us) { return this.pico.runFor(us * 1000); }
  waitFor(what, within_ms) {
    for (let us = 0; us < within_ms * 1000; us += 100) {
      if (what()) return true;
      if (!this.pass(100)) return false;
    }
    return false;
  }

  // The data endpoints: one packet each way. The device may leave between two of them.
  poll() {
    this.alarm.schedule(kPoll_ns + this.pause());
    if (!this.open || !this.attached) return;
    if (this.reads) this.take(this.usb.in(this.address, kIn));
    if (!this.toSend.length) return;
    const bytes = Buffer.from(this.toSend.slice(0, kPacket));
    if (this.usb.out(this.address, kOut, this.toggles.out, bytes) !== 'ack') return;
    this.toSend.splice(0, bytes.length);
    this.toggles.out = !this.toggles.out;
  }
  take(packet) {
    if (packet === null || typeof packet === 'string') return packet;
    if (packet.data1 !== this.toggles.in) this.errors.push('a packet came with the wrong toggle');
    if (packet.bytes.length > kPacket) this.errors.push(`a packet of ${packet.bytes.length} bytes came`);
    this.toggles.in = !this.toggles.in;
    for (const byte of packet.bytes) this.received.push(byte);
    this.lastLength = packet.bytes.length;
    return packet;
  }
  // From now on a packet that the device takes back is one that this host was just fetching.
  fetchWhatIsTakenBack() {
    this.usb.onTakenBack = (place, packet) => {
      const fetched = this.pico.chip.clock.createAlarm(() => { packet.finish(); if (place === 2 * kIn) this.take(packet); });
      fetched.schedule(kPoll_ns / 2);
    };
  }
  // For a host of the protocol (host.mjs).
  feed(bytes) { this.toSend.push(...bytes); }
  takeReceived() { return this.received.splice(0); }

  // A request at endpoint 0: { outcome: 'done', 'stalled' or 'silent', bytes }.
  control(type, number, value = 0, index = 0, lengthOrData = 0) {
    const towardsHost = (type & 0x80) !== 0;
    const data = towardsHost ? null : Buffer.from(lengthOrData || []);
    const length = towardsHost ? lengthOrData : data.length;
    if (this.setupOnly(type, number, value, index, length) === null) return { outcome: 'silent', bytes: Buffer.alloc(0) };
    this.pass(this.afterSetup_us);
    const bytes = [];
    let data1 = true, answer = null;
    if (towardsHost) {
      while (bytes.length < length) {
        answer = this.untilReady(() => this.usb.in(this.address, 0));
        if (answer === null || typeof answer === 'string') return { outcome: answer === 'stall' ? 'stalled' : 'silent', bytes: Buffer.from(bytes) };
        if (answer.data1 !== data1) this.errors.push(`request ${number}: a packet with the wrong toggle`);
        data1 = !data1;
        bytes.push(...answer.bytes);
        if (answer.bytes.length < kPacket) break;
      }
      if (bytes.length > length) this.errors.push(`request ${number}: ${bytes.length} bytes came instead of ${length}`);
      answer = this.untilReady(() => this.usb.out(this.address, 0, true, Buffer.alloc(0)));
    } else {
      if (data.length) {
        answer = this.untilReady(() => this.usb.out(this.address, 0, true, data));
        if (answer !== 'ack') return { outcome: answer === 'stall' ? 'stalled' : 'silent', bytes: Buffer.alloc(0) };
      }
      answer = this.untilReady(() => this.usb.in(this.address, 0));
      if (answer && typeof answer !== 'string') {
        if (!answer.data1 || answer.bytes.length) this.errors.push(`request ${number}: its last stage is no empty DATA1`);
        answer = 'ack';
      }
    }
    this.pass(50);
    return { outcome: answer === 'ack' ? 'done' : answer === 'stall' ? 'stalled' : 'silent', bytes: Buffer.from(bytes) };
  }
  setupOnly(type, number, value, index, length) {
    return this.usb.setup(this.address, Buffer.from([type, number, value & 0xff, value >> 8, index & 0xff, index >> 8, length & 0xff, length >> 8]));
  }
  untilReady(transact) {
    for (let us = 0; us < 50e3; us += 20) {
      const answer = this.plugged ? transact() : null;
      if (answer !== 'nak') return answer;
      if (!this.pass(20)) return null;
    }
    return null;
  }

  // The bus.
  reset(ms = 10) {
    this.forget();
    this.usb.beginReset();
    this.pass(ms * 1000);
    this.usb.endReset();
    this.pass(10e3); // which the device has to recover (USB 2.0, 7.1.7.5)
  }
  unplug() {
    this.plugged = false;
    this.forget();
    this.pass(3000);
    this.usb.fallSilent();
  }
  plugIn() { this.plugged = true; }
  sleep() {
    this.asleep = this.open;
    this.open = false;
    this.pass(3000);
    this.usb.fallSilent();
  }
  wake() {
    this.usb.resume();
    this.open = this.asleep;
  }

  get(type, number, length) { return this.control(0x80, request.descriptor, (type << 8) | number, 0, length); }
  setAddress(address) {
    const { outcome } = this.control(0, request.setAddress, address);
    if (outcome === 'done') this.address = address;
    this.pass(2000); // which the device has to take it (9.2.6.3)
    return outcome;
  }
  // As Linux does it; the text of the serial number.
  enumerate() {
    const must = ({ outcome, bytes }, what) => {
      if (outcome !== 'done') throw new Error(`${what}: ${outcome}`);
      return bytes;
    };
    if (!this.waitFor(() => this.attached, 1000)) throw new Error('the device does not come to the bus');
    this.pass(100e3); // until the contacts have settled
    this.reset();
    must(this.get(descriptor.device, 0, 64), 'the first eight bytes');
    this.reset();
    must({ outcome: this.setAddress(kAddress) }, 'the address');
    this.device = must(this.get(descriptor.device, 0, 18), 'the device descriptor');
    this.get(descriptor.qualifier, 0, 10); // a device without high speed refuses
    const total = must(this.get(descriptor.configuration, 0, 9), 'the length of the configuration').readUInt16LE(2);
    this.configuration = must(this.get(descriptor.configuration, 0, total), 'the configuration');
    for (const text of [0, 2, 1]) must(this.get(descriptor.string, text, 255), `text ${text}`);
    const number = must(this.get(descriptor.string, 3, 255), 'the serial number');
    must(this.control(0, request.setConfiguration, 1), 'the configuration');
    this.toggles = { in: false, out: false };
    return number.toString('utf16le', 2);
  }
  setBaud(baud) {
    const coding = Buffer.from([0, 0, 0, 0, 0, 0, 8]);
    coding.writeUInt32LE(baud);
    return this.control(0x21, request.setLineCoding, 0, 0, coding).outcome;
  }
  openPort() {
    const { outcome } = this.control(0x21, request.setLineState, 3);
    this.open = true;
    return outcome;
  }
  closePort() {
    const { outcome } = this.control(0x21, request.setLineState, 0);
    this.open = false;
    return outcome;
  }
  connect() {
    const number = this.enumerate();
    this.setBaud(115200);
    this.openPort();
    return number;
  }
}
