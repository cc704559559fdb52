import assert from 'node:assert/strict';
import { test } from 'node:test';
import { bench, expectNoComplaints, print, symbols } from './bench.mjs';
import { Host, id, kWatchdogFault } from './rig/host.mjs';
import { UsbHost } from './rig/usb_host.mjs';

const kTick = 16, kCycles_us = 125;
const kSpin = 1, kArc = 2;

// Watches every tick of a chip: how many instructions and cycles it takes until the interrupt returns, what other
// interrupts take in between not counted because none may, and how late it begins.
class TickProfile {
  constructor(chip) {
    this.worst = { instructions: 0, cycles: 0, late_ns: 0 };
    this.sum = { ticks: 0, instructions: 0, cycles: 0 };
    this.due_ns = null;
    let begun = null;
    const { core } = chip;
    const enter = core.exceptionEntry.bind(core), leave = core.exceptionReturn.bind(core);
    core.exceptionEntry = (number) => {
      if (number === kTick) {
        begun = { instructions: chip.instructions, cycles: core.cycles };
        const now = chip.clock.nanos;
        if (this.due_ns !== null) this.worst.late_ns = Math.max(this.worst.late_ns, now - this.due_ns);
        this.due_ns = (this.due_ns ?? now) + 1e6;
      }
      enter(number);
    };
    core.exceptionReturn = (value) => {
      if (core.IPSR === kTick) {
        // The registers that the core stores and loads again: 15 and 13 cycles.
        const took = { instructions: chip.instructions - begun.instructions, cycles: core.cycles - begun.cycles + 28 };
        ++this.sum.ticks;
        for (const what of ['instructions', 'cycles']) {
          this.worst[what] = Math.max(this.worst[what], took[what]);
          this.sum[what] += took[what];
        }
      }
      leave(value);
    };
  }
  get mean_us() { return this.sum.cycles / this.sum.ticks / kCycles_us; }
  get worst_us() { return this.worst.cycles / kCycles_us; }
  toString() {
    return `${this.sum.ticks} ticks, ${(this.sum.instructions / this.sum.ticks).toFixed(0)} / ${this.worst.instructions} instructions, ` +
      `${this.mean_us.toFixed(1)} / ${this.worst_us.toFixed(1)} us mean / worst, at most ${(this.worst.late_ns / 1000).toFixed(1)} us late`;
  }
}

// `drive` begins a drive; `again` keeps it going.
function measured(drive, again = (host) => host.status()) {
  const all = bench();
  all.host.hello();
  if (drive) all.host.request(id.arm);
  drive?.(all.host);
  const profile = new TickProfile(all.pico.chip);
  for (let round = 0; round < 20; ++round) {
    again(all.host);
    for (let ms = 0; ms < 50; ++ms) all.host.advance(1);
  }
  assert.equal(all.host.status().overruns, 0);
  assert.equal(Math.abs(all.pico.counts[1]) > 1000, drive !== null, 'the robot drives, or does not');
  expectNoComplaints(all.pico);
  return profile;
}

test('a tick takes at most 70 us of its millisecond, whatever the robot does', () => {
  const figures = {
    rest: measured(null),
    velocity: measured((host) => host.velocity(300000, 500000), (host) => host.velocity(300000, 500000)),
    spin: measured((host) => host.segment({ kind: kSpin, tag: 1, turns: 2 })),
    arc: measured((host) => host.segment({ kind: kArc, tag: 1, length_m: 1, turns: 0.25 })),
  };
  for (const [what, profile] of Object.entries(figures)) print(`${what}: ${profile}`);
  for (const [what, profile] of Object.entries(figures)) {
    assert.ok(profile.sum.ticks > 900, what);
    assert.ok(profile.worst_us <= 70, `${what}: ${profile.worst_us} us`);
    // What holds interrupts: the main loop while it uses what it shares with the tick, and the queues of the ports.
    assert.ok(profile.worst.late_ns <= 15e3, `${what}: ${profile.worst.late_ns} ns late`);
  }
});

test('the tick is not late while USB carries all that it can and the cable is pulled', () => {
  const { pico, robot } = bench();
  const usb = new UsbHost(pico), host = new Host(pico, (ms) => robot.advance(ms), usb);
  usb.connect();
  host.hello();
  const fields = Buffer.alloc(6);
  fields.writeUInt16LE(1, 0);
  fields.writeUInt32LE(1, 2);
  host.request(id.telemetry, fields);
  const profile = new TickProfile(pico.chip);
  let came = 0;
  for (let ms = 0; ms < 1000; ++ms) {
    if (usb.toSend.length === 0) usb.feed(Buffer.alloc(1024)); // ends of frames without content
    host.advance(1);
    came += usb.takeReceived().length;
  }
  usb.reads = false;
  host.advance(20);
  usb.closePort(); // takes a packet back
  usb.unplug();
  print(`${came} bytes a second to the host: ${profile}`);
  assert.ok(came > 20e3);
  assert.ok(profile.worst_us <= 70);
  assert.ok(profile.worst.late_ns <= 15e3, `${profile.worst.late_ns} ns late`);
  assert.equal(new Host(pico, (ms) => robot.advance(ms)).status().overruns, 0);
  expectNoComplaints(pico);
});

test('the tick is not late while the flash erases and programs', () => {
  const { pico, host } = bench();
  host.hello();
  const operations = [];
  pico.chip.onFlashOperation = (operation) => operations.push(operation.bytes ? 'program' : 'erase');
  const profile = new TickProfile(pico.chip);
  for (let commit = 0; commit < 60 && !operations.includes('erase'); ++commit) host.commit(1, (1 << 30) + commit);
  assert.ok(operations.includes('erase') && operations.includes('program'));
  print(`${operations.length} operations of the flash: ${profile}`);
  assert.ok(profile.worst.late_ns <= 15e3);
  const status = host.status();
  assert.equal(status.overruns, 0);
  assert.equal(status.faults & kWatchdogFault, 0);
  expectNoComplaints(pico);
});

test('a flash as slow as its maker allows neither delays the tick nor meets the watchdog', () => {
  const { pico, host } = bench();
  pico.flash.times = { erase: 400e6, program: 3e6 };
  host.hello();
  const erased = [];
  pico.chip.onFlashOperation = ({ bytes }) => { if (!bytes) erased.push(pico.now_ns); };
  const profile = new TickProfile(pico.chip);
  for (let commit = 0; commit < 20 && erased.length === 0; ++commit) host.commit(1, (1 << 30) + commit);
  assert.ok(erased.length > 0);
  assert.equal(pico.restarts, 0);
  assert.ok(profile.worst.late_ns <= 15e3);
  assert.equal(host.status().overruns, 0);
});

test('tick and clock go on when the lower word of the timer begins anew, after 71 minutes', () => {
  const { pico, host } = bench();
  const kWrap_us = 2 ** 32;
  pico.chip.clock.nanosCounter = (kWrap_us - 300e3) * 1000; // as if it had been counting for so long before the start
  host.hello();
  const before = host.status();
  const times = [before.time_us];
  for (let i = 0; i < 60; ++i) {
    for (let ms = 0; ms < 10; ++ms) host.advance(1);
    times.push(host.status().time_us);
  }
  const after = host.status();
  assert.ok(times[0] < kWrap_us && times.at(-1) > kWrap_us, `${times[0]} to ${times.at(-1)} us`);
  for (let i = 1; i < times.length; ++i) assert.ok(times[i] > times[i - 1] && times[i] < times[i - 1] + 30e3, `${times[i - 1]} then ${times[i]}`);
  assert.ok(Math.abs(after.ticks - before.ticks - (times.at(-1) - times[0]) / 1000) <= 2, 'a tick a millisecond');
  assert.equal(after.overruns, 0);
  expectNoComplaints(pico);
});

test('the stack never takes more than two thirds of what it has', () => {
  const { pico, host } = bench();
  const bottom = symbols.get('stack_bottom'), top = symbols.get('stack_top'), kPaint = 0xa5a5a5a5;
  pico.runFor(60e6); // the copy is done
  for (let at = bottom; at < (pico.chip.core.SP - 256) >>> 0; at += 4) pico.setWord(at, kPaint);
  host.hello();
  host.request(id.arm);
  host.segment({ kind: kArc, tag: 1, length_m: 0.2, turns: 0.1 });
  assert.equal(host.finished(1, 5000), 0);
  host.request(id.disarm);
  for (let ms = 0; ms < 1000; ++ms) host.advance(1); // the wheels come to rest
  for (let commit = 0; commit < 45; ++commit) host.commit(1, (1 << 30) + commit);
  let used = top - bottom;
  for (let at = bottom; at < top && pico.word(at) === kPaint; at += 4) used -= 4;
  print(`stack: ${used} of ${top - bottom} bytes were used`);
  assert.ok(used > 200 && used <= ((top - bottom) * 2) / 3);
});
