// A host at the serial port, written from common/protocol/README.md: frames, and the few messages that the tests need.
const kTable = Uint32Array.from({ length: 256 }, (_, n) => {
  let c = n;
  for (let i = 0; i < 8; ++i) c = c & 1 ? (c >>> 1) ^ 0xedb88320 : c >>> 1;
  return c;
});
export function crc32(bytes) {
  let sum = 0xffffffff;
  for (const byte of bytes) sum = (sum >>> 8) ^ kTable[(sum ^ byte) & 0xff];
  return (sum ^ 0xffffffff) >>> 0;
}

export function stuff(bytes) {
  const out = [0];
  let mark = 0;
  for (const byte of bytes) {
    if (byte !== 0) out.push(byte);
    if (byte === 0 || out.length - mark === 255) {
      out[mark] = out.length - mark;
      mark = out.length;
      out.push(0);
    }
  }
  out[mark] = out.length - mark;
  return out;
}
export function unstuff(bytes) {
  const out = [];
  for (let at = 0; at < bytes.length;) {
    const length = bytes[at];
    for (let i = 1; i < length && at + i < bytes.length; ++i) out.push(bytes[at + i]);
    at += length;
    if (length < 255 && at < bytes.length) out.push(0);
  }
  return out;
}

export const id = {
  hello: 0x01, status: 0x03, arm: 0x04, disarm: 0x05, stop: 0x06, velocity: 0x08, segment: 0x09, parameter: 0x0c, stage: 0x0d,
  commit: 0x0e, revert: 0x0f, telemetry: 0x11, reboot: 0x14, bootloader: 0x15,
  ack: 0x7e, error: 0x7f, booted: 0xc3, segmentDone: 0xc1,
};
export const mode = { disarmed: 0, idle: 1, velocity: 2, segment: 3, stopping: 4, fault: 5, boot: 6 };
export const cause = { powerOn: 0, software: 1, watchdog: 2, fault: 3, pin: 4, unknown: 5 };
export const kWatchdogFault = 1 << 14;

export class Refused extends Error {}
export class NoAnswer extends Error {}

export class Host {
  // `advance(ms)` lets the robot's time pass; false ends all waiting. `wire` is the port: the serial one, or a UsbHost.
  constructor(pico, advance = (ms) => pico.runFor(ms * 1e6), wire = pico.serial) {
    this.wire = wire;
    this.advance = advance;
    this.number = 0;
    this.waiting = [];
    this.events = [];
    this.bad = 0;
  }

  send(message, fields = Buffer.alloc(0), number = 0) {
    const body = Buffer.concat([Buffer.from([message, number & 0xff, number >>> 8]), fields]);
    const sum = Buffer.alloc(4);
    sum.writeUInt32LE(crc32(body));
    this.wire.feed([0, ...stuff([...body, ...sum]), 0]);
  }

  // The bodies that have arrived.
  receive() {
    const bodies = [];
    for (const byte of this.wire.takeReceived()) {
      if (byte !== 0) { this.waiting.push(byte); continue; }
      const frame = Buffer.from(unstuff(this.waiting.splice(0)));
      if (frame.length === 0) continue;
      const body = frame.subarray(0, -4);
      if (frame.length >= 7 && crc32(body) === frame.readUInt32LE(frame.length - 4)) bodies.push(body);
      else ++this.bad;
    }
    return bodies;
  }
  // Collects events; returns the reply of request `number` if it is among what has arrived.
  collect(number) {
    let reply = null;
    for (const body of this.receive()) {
      if (body.readUInt16LE(1) === 0) this.events.push(body);
      else if (body.readUInt16LE(1) === number) reply = body;
    }
    return reply;
  }

  request(message, fields, within_ms = 1000) {
    this.number = (this.number % 0x7fff) + 1;
    this.send(message, fields, this.number);
    for (let ms = 0; ms < within_ms; ++ms) {
      if (!this.advance(1)) break;
      const reply = this.collect(this.number);
      if (!reply) continue;
      if (reply[0] === id.error) throw new Refused(`request ${message} was refused: error ${reply[3]}, ${reply.readUInt16LE(4)}`);
      return reply;
    }
    throw new NoAnswer(`no answer to request ${message} within ${within_ms} ms`);
  }

  // Asks until the robot listens and has finished its start.
  hello() {
    let reply = null;
    for (let tries = 0; reply === null; ++tries)
      try {
        reply = this.request(id.hello, words16(5), 200);
      } catch (error) {
        if (!(error instanceof NoAnswer) || tries > 10) throw error;
      }
    while (this.status().mode === mode.boot) this.advance(10);
    return { board: reply.toString('latin1', 24, 48).replace(/\0.*/s, ''), id: reply.toString('hex', 8, 24) };
  }
  status() {
    const reply = this.request(id.status);
    return {
      time_us: Number(reply.readBigUInt64LE(3)), mode: reply[11], faults: reply.readUInt32LE(12), battery_mV: reply.readInt32LE(20), ticks: reply.readUInt32LE(24),
      overruns: reply.readUInt32LE(28), longest_us: reply.readUInt32LE(32), bad: reply.readUInt32LE(36), cause: reply[40],
    };
  }
  parameter(number) {
    return this.request(id.parameter, words16(number)).readInt32LE(5);
  }
  // Sends only; the answer to a commit may never come.
  commit(number, value) {
    this.request(id.revert);
    const fields = Buffer.alloc(30);
    fields.writeUInt16LE(number, 0);
    fields.writeInt32LE(value, 2);
    this.request(id.stage, fields);
    return this.request(id.commit, undefined, 3000);
  }
  velocity(v_umps, omega_uradps) {
    const fields = Buffer.alloc(8);
    fields.writeInt32LE(v_umps, 0);
    fields.writeInt32LE(omega_uradps, 4);
    return this.request(id.velocity, fields);
  }
  segment({ kind, tag, length_m = 0, turns = 0 }) {
    const fields = Buffer.alloc(31);
    fields.writeUInt8(kind, 0);
    fields.writeUInt16LE(tag, 1);
    fields.writeBigInt64LE(BigInt(Math.round(length_m * 1e9)), 3);
    fields.writeBigInt64LE(BigInt(Math.round(turns * 2 ** 32)), 11);
    return this.request(id.segment, fields);
  }
  // The end of the segment `tag`, with its outcome; keeps the drive alive meanwhile.
  finished(tag, within_ms) {
    for (let ms = 0; ms < within_ms; ms += 50) {
      this.status();
      for (let i = 0; i < 50; ++i) this.advance(1);
      this.collect(0);
      const done = this.events.find((event) => event[0] === id.segmentDone && event.readUInt16LE(3) === tag);
      if (done) return done[5];
    }
    throw new NoAnswer(`segment ${tag} did not end within ${within_ms} ms`);
  }
  // The pose of the next telemetry: metres and turns.
  pose() {
    const fields = Buffer.alloc(6);
    fields.writeUInt16LE(10, 0);
    fields.writeUInt32LE(1, 2);
    this.request(id.telemetry, fields);
    this.events = [];
    for (let ms = 0; ms < 200; ++ms) {
      this.advance(1);
      this.collect(0);
      const sample = this.events.find((event) => event[0] === 0xc0);
      if (!sample) continue;
      this.request(id.telemetry, Buffer.alloc(6));
      return {
        x_m: Number(sample.readBigInt64LE(15)) / 2 ** 40, y_m: Number(sample.readBigInt64LE(23)) / 2 ** 40,
        turns: Number(sample.readBigUInt64LE(31)) / 2 ** 64 + sample.readInt32LE(39),
      };
    }
    throw new NoAnswer('no telemetry');
  }
}

function words16(...values) {
  const bytes = Buffer.alloc(2 * values.length);
  values.forEach((value, i) => bytes.writeUInt16LE(value, 2 * i));
  return bytes;
}
