import assert from 'node:assert/strict';
import { test } from 'node:test';
import { bench, expectNoComplaints, kImage, open, print } from './bench.mjs';
import { Host, id, mode } from './rig/host.mjs';
import { readUf2 } from './rig/image.mjs';
import { Pico } from './rig/pico.mjs';
import { Robot } from './rig/robot.mjs';
import { descriptor, request, UsbHost } from './rig/usb_host.mjs';

// The image that is flashed, at a USB host; `host` speaks the protocol through it.
function atUsb({ connected = true } = {}) {
  const pico = new Pico({ seed: 1, image: readUf2(kImage) });
  const robot = new Robot(pico), usb = new UsbHost(pico);
  const host = new Host(pico, (ms) => robot.advance(ms), usb);
  if (connected) usb.connect();
  else usb.waitFor(() => usb.attached, 1000);
  return { pico, robot, usb, host };
}
function expectClean({ pico, usb }) {
  expectNoComplaints(pico);
  assert.deepEqual(usb.errors, []);
}
// A seeded sequence of 32-bit numbers.
function numbers(seed) {
  let state = seed;
  return () => {
    state ^= state << 13;
    state ^= state >>> 17;
    state ^= state << 5;
    return (state >>>= 0);
  };
}

test('a host enumerates it step by step: numbers, texts, a serial number that is the robot\'s id', () => {
  const all = atUsb({ connected: false });
  const number = all.usb.enumerate();
  const { device, configuration } = all.usb;
  assert.equal(device.length, 18);
  assert.equal(device.readUInt16LE(8), 0x2e8a);
  assert.equal(device.readUInt16LE(10), 0x000a);
  assert.equal(device[7], 64);
  assert.equal(configuration.length, configuration.readUInt16LE(2));
  const endpoints = [];
  for (let at = 0; at < configuration.length; at += configuration[at]) if (configuration[at + 1] === 5) endpoints.push([...configuration.subarray(at + 2, at + 6)]);
  assert.deepEqual(endpoints, [[0x82, 3, 16, 0], [0x03, 2, 64, 0], [0x84, 2, 64, 0]]);
  all.usb.openPort();
  const hello = all.host.hello();
  assert.equal(hello.board, 'rp2040');
  assert.equal(number.toLowerCase(), hello.id);
  print(`serial number ${number}; enumerated ${(all.pico.now_ns / 1e6).toFixed(0)} ms after power-on, with the waits of a host`);
  expectClean(all);
});

test('it stays off the bus after every start until any host has noticed', () => {
  const { pico, usb } = atUsb({ connected: false });
  assert.ok(pico.now_ns > 300e6, 'a hub is asked every 255 ms');
  usb.connect();
  const begun = pico.now_ns;
  pico.powerOn();
  assert.ok(!usb.attached);
  assert.ok(usb.waitFor(() => usb.attached, 1000));
  assert.ok(pico.now_ns - begun > 256e6);
});

test('it takes its address after the status stage, and answers to no other', () => {
  const all = atUsb({ connected: false });
  all.usb.reset();
  assert.equal(all.usb.setAddress(9), 'done');
  assert.equal(all.usb.get(descriptor.device, 0, 18).bytes.length, 18);
  all.usb.address = 0;
  assert.equal(all.usb.get(descriptor.device, 0, 18).outcome, 'silent');
  all.usb.address = 9;
  assert.equal(all.usb.setAddress(11), 'done');
  assert.equal(all.usb.get(descriptor.device, 0, 18).outcome, 'done');
  expectClean(all);
});

test('a descriptor comes as far as the host asks, over as many packets as it takes', () => {
  const all = atUsb();
  for (const length of [1, 8, 9, 63, 64, 65, 74, 75, 255]) {
    const { outcome, bytes } = all.usb.get(descriptor.configuration, 0, length);
    assert.equal(outcome, 'done');
    assert.deepEqual(bytes, all.usb.configuration.subarray(0, Math.min(length, 75)));
  }
  expectClean(all);
});

test('what it does not know it refuses, and goes on', () => {
  const all = atUsb();
  const refused = [
    [0xc0, 0x55, 0, 0, 4], [0x80, request.descriptor, 0x0900, 0, 4], [0x80, request.descriptor, descriptor.qualifier << 8, 0, 10],
    [0x80, request.descriptor, descriptor.otherSpeed << 8, 0, 9], [0x80, request.descriptor, (descriptor.string << 8) | 4, 0, 255],
    [0x81, request.status, 0, 2, 2], [0x82, request.status, 0, 0x85, 2], [0x00, request.setConfiguration, 2], [0x01, request.setInterface, 1, 1],
    [0x21, request.setLineCoding, 0, 0, Buffer.alloc(6)], [0x21, request.setLineCoding, 0, 1, Buffer.alloc(7)],
  ];
  for (const words of refused) {
    assert.equal(all.usb.control(...words).outcome, 'stalled', words.join(' '));
    assert.equal(all.usb.get(descriptor.device, 0, 18).outcome, 'done', 'the next SETUP packet ends it');
  }
  assert.equal(all.host.hello().board, 'rp2040');
  expectClean(all);
});

test('it tells status, configuration and setting, and keeps the line coding', () => {
  const all = atUsb(), { usb } = all;
  const told = (...words) => [...usb.control(...words).bytes];
  assert.deepEqual(told(0x80, request.status, 0, 0, 2), [1, 0]);
  assert.deepEqual(told(0x81, request.status, 0, 1, 2), [0, 0]);
  assert.deepEqual(told(0x80, request.configuration, 0, 0, 1), [1]);
  assert.deepEqual(told(0x81, request.interface, 0, 1, 1), [0]);
  const coding = Buffer.from([0x00, 0xc2, 0x01, 0x00, 2, 1, 7]);
  assert.equal(usb.control(0x21, request.setLineCoding, 0, 0, coding).outcome, 'done');
  assert.deepEqual(told(0xa1, request.lineCoding, 0, 0, 7), [...coding]);
  assert.equal(usb.control(0x21, request.sendBreak, 100).outcome, 'done');
  expectClean(all);
});

test('a request that the host gives up is dropped', () => {
  const all = atUsb(), { usb } = all;
  usb.afterSetup_us = 150; // the chip itself drops nothing: the interrupt does, which a tick may delay
  for (const given_up of [[0x80, request.descriptor, 0x0200, 0, 75], [0x21, request.setLineCoding, 0, 0, 7]]) {
    assert.equal(usb.setupOnly(...given_up), 'ack');
    usb.pass(1000);
    assert.equal(usb.get(descriptor.device, 0, 18).bytes[1], descriptor.device);
  }
  assert.equal(usb.setupOnly(0x80, request.descriptor, 0x0200, 0, 75), 'ack');
  usb.pass(1000);
  assert.equal(usb.usb.in(usb.address, 0).bytes.length, 64); // one of two packets
  usb.pass(1000);
  assert.equal(usb.get(descriptor.device, 0, 18).bytes.length, 18);
  expectClean(all);
});

test('each endpoint is halted and goes on from DATA0, with the packet that the host has not had', () => {
  const all = atUsb(), { usb, host } = all;
  host.hello();
  for (const [address, refuses] of [[0x84, () => usb.usb.in(usb.address, 4)], [0x03, () => usb.usb.out(usb.address, 3, usb.toggles.out, Buffer.alloc(1))]]) {
    usb.open = false;
    usb.pass(200);
    assert.equal(usb.control(0x02, request.setFeature, 0, address).outcome, 'done');
    assert.equal(refuses(), 'stall');
    assert.deepEqual([...usb.control(0x82, request.status, 0, address, 2).bytes], [1, 0]);
    assert.equal(usb.control(0x02, request.clearFeature, 0, address).outcome, 'done');
    usb.toggles[address & 0x80 ? 'in' : 'out'] = false;
    usb.open = true;
    assert.equal(host.hello().board, 'rp2040');
  }
  expectClean(all);
});

test('bytes go both ways in order, whoever waits for whom', () => {
  const all = atUsb(), { usb, host } = all, random = numbers(20261127);
  usb.pause = () => (random() % 8 === 0 ? random() % 3e6 : 0); // the host does something else now and then
  host.hello();
  // An answer must follow for each request, and each is checked by its sum.
  let asked = 0;
  for (let round = 0; round < 40; ++round) {
    const parameters = Array.from({ length: 1 + (random() % 12) }, () => random() % 20);
    const waits = new Set();
    for (const parameter of parameters) {
      host.number = (host.number % 0x7fff) + 1;
      waits.add(host.number);
      host.send(id.parameter, Buffer.from([parameter, 0]), host.number);
    }
    asked += parameters.length;
    const order = [];
    for (let ms = 0; ms < 500 && order.length < parameters.length; ++ms) {
      host.advance(1);
      for (const body of host.receive()) if (waits.has(body.readUInt16LE(1))) order.push(body.readUInt16LE(1));
    }
    assert.deepEqual(order, [...waits], `round ${round}`);
  }
  print(`${asked} requests in bursts of up to 12, each answered in order; ${host.bad} bad frames`);
  assert.equal(host.bad, 0);
  assert.equal(host.status().bad, 0);
  assert.equal(usb.usb.sequenceErrors, 0);
  expectClean(all);
});

test('transfers of exactly full packets arrive with the empty one behind them or without', () => {
  const all = atUsb(), { usb, host } = all;
  host.hello();
  for (const size of [64, 128, 448])
    for (const empty of [true, false]) {
      const frames = [];
      const wire = host.wire;
      host.wire = { feed: (bytes) => frames.push(...bytes), takeReceived: () => wire.takeReceived() };
      host.send(id.status, undefined, 77);
      host.wire = wire;
      usb.feed([...Array(size - frames.length).fill(0), ...frames]); // zeros end frames without content
      for (let us = 0; us < 50e3 && usb.toSend.length; us += 100) usb.pass(100);
      if (empty) {
        assert.equal(usb.untilReady(() => usb.usb.out(usb.address, 3, usb.toggles.out, Buffer.alloc(0))), 'ack');
        usb.toggles.out = !usb.toggles.out;
      }
      let reply = null;
      for (let ms = 0; ms < 100 && !reply; ++ms) { host.advance(1); reply = host.collect(77); }
      assert.ok(reply, `${size} bytes ${empty ? 'with' : 'without'}`);
    }
  expectClean(all);
});

test('a packet whose acknowledgement was lost is taken once', () => {
  const all = atUsb(), { usb, host } = all;
  host.hello();
  const before = host.status();
  usb.open = false;
  // From the host: the same packet again.
  const frames = [];
  new Host(all.pico, undefined, { feed: (bytes) => frames.push(...bytes) }).send(id.status, undefined, 500);
  for (const again of [false, true]) {
    assert.equal(usb.untilReady(() => usb.usb.out(usb.address, 3, usb.toggles.out, Buffer.from(frames))), 'ack');
    if (again) usb.toggles.out = !usb.toggles.out;
  }
  // To the host: the packet is not acknowledged, and so comes again with the same toggle.
  const [first, again] = [0, 1].map(() => usb.untilReady(() => usb.usb.in(usb.address, 4, false)));
  assert.deepEqual([again.data1, again.bytes], [first.data1, first.bytes]);
  usb.open = true;
  let replies = 0;
  for (let ms = 0; ms < 50; ++ms) { host.advance(1); for (const body of host.receive()) if (body.readUInt16LE(1) === 500) ++replies; }
  assert.equal(replies, 1);
  assert.equal(usb.usb.sequenceErrors, 1, 'the controller has dropped the repetition');
  assert.equal(host.status().bad, before.bad);
  expectClean(all);
});

test('a program that does not read blocks nothing, and the next one gets nothing that was meant for it', () => {
  const all = atUsb(), { usb, host, pico } = all;
  host.hello();
  const fields = Buffer.alloc(6);
  fields.writeUInt16LE(1, 0);
  fields.writeUInt32LE(1, 2);
  host.request(id.telemetry, fields); // a pose every millisecond
  usb.reads = false;
  const uart = new Host(pico, host.advance);
  uart.hello();
  const before = uart.status();
  for (let ms = 0; ms < 500; ++ms) host.advance(1);
  const after = uart.status();
  assert.ok(Math.abs(after.ticks - before.ticks - (after.time_us - before.time_us) / 1000) <= 2, 'a tick a millisecond');
  assert.equal(after.overruns, 0);
  usb.closePort();
  usb.received = [];
  usb.reads = true;
  usb.open = true;
  host.waiting = [];
  for (let ms = 0; ms < 20; ++ms) host.advance(1);
  assert.deepEqual(usb.received, [], 'the packet that lay ready, too, was taken back');
  usb.open = false;
  const opened_us = uart.status().time_us;
  usb.openPort();
  host.events = [];
  for (let ms = 0; ms < 20; ++ms) { host.advance(1); host.collect(0); }
  const poses = host.events.filter((event) => event[0] === 0xc0);
  for (const pose of poses) assert.ok(Number(pose.readBigUInt64LE(3)) + 1000 >= opened_us);
  assert.equal(host.bad, 0);
  expectClean(all);
});

test('a packet that the host is just fetching when the port closes counts as sent', () => {
  const all = atUsb(), { usb, host } = all;
  host.hello();
  const fields = Buffer.alloc(6);
  fields.writeUInt16LE(1, 0);
  fields.writeUInt32LE(1, 2);
  host.request(id.telemetry, fields);
  let taken = 0;
  for (let i = 0; i < 10; ++i) {
    usb.reads = false;
    for (let ms = 0; ms < 10; ++ms) host.advance(1);
    usb.received = [];
    usb.fetchWhatIsTakenBack();
    usb.closePort();
    usb.usb.onTakenBack = null;
    taken += usb.received.length > 0 ? 1 : 0;
    usb.reads = true;
    usb.openPort();
    host.waiting = [];
    usb.received = [];
    assert.equal(host.status().overruns, 0, 'the toggles of both sides agree, or nothing would come');
  }
  assert.equal(taken, 10);
  expectClean(all);
});

test('it is silent while it is suspended, and tells nothing old afterwards', () => {
  const all = atUsb(), { usb, host, pico } = all;
  host.hello();
  const fields = Buffer.alloc(6);
  fields.writeUInt16LE(1, 0);
  fields.writeUInt32LE(1, 2);
  host.request(id.telemetry, fields);
  usb.sleep();
  for (let ms = 0; ms < 100; ++ms) host.advance(1);
  usb.received = [];
  host.waiting = [];
  const resumed_us = new Host(pico, host.advance).status().time_us;
  usb.wake();
  host.events = [];
  for (let ms = 0; ms < 20; ++ms) { host.advance(1); host.collect(0); }
  const poses = host.events.filter((event) => event[0] === 0xc0);
  assert.ok(poses.length >= 10);
  for (const pose of poses) assert.ok(Number(pose.readBigUInt64LE(3)) + 1000 >= resumed_us);
  assert.equal(host.bad, 0);
  expectClean(all);
});

test('a hundred reconnects, by bus reset and by the cable: the robot lives, and no tick is late', () => {
  const all = atUsb(), { usb, pico } = all, random = numbers(37);
  const uart = new Host(pico, all.host.advance);
  all.host.hello();
  for (let i = 0; i < 100; ++i) {
    // At any moment: also in the middle of a request, or with a packet that lies ready.
    if (i % 3 === 0) usb.setupOnly(0x80, request.descriptor, 0x0200, 0, 75);
    if (i % 4 === 0) { all.host.send(id.status, undefined, 1); usb.reads = i % 8 !== 0; }
    usb.pass(random() % 2000);
    usb.reads = true;
    if (i % 2 === 0) {
      usb.unplug();
      usb.pass(random() % 20e3);
      usb.plugIn();
    }
    usb.reset();
    assert.equal(usb.get(descriptor.device, 0, 18).outcome, 'done', `reconnect ${i}`);
    assert.equal(usb.setAddress(1 + (random() % 127)), 'done');
    assert.equal(usb.control(0, request.setConfiguration, 1).outcome, 'done');
    usb.openPort();
    all.host.waiting = [];
    assert.equal(all.host.request(id.hello, Buffer.from([5, 0]), 200)[0] !== id.error, true, `reconnect ${i}`);
  }
  const status = uart.status();
  print(`100 reconnects in ${(status.time_us / 1e6).toFixed(1)} s: ${status.ticks} ticks, ${status.overruns} missed, longest gap ${status.longest_us} us`);
  assert.equal(pico.restarts, 0);
  assert.equal(status.overruns, 0);
  assert.ok(status.longest_us <= 1002, 'a tick is at most as late as the longest hold of interrupts');
  expectClean(all);
});

test('the robot stops when the cable is pulled', () => {
  const all = atUsb(), { usb, host, pico } = all;
  host.hello();
  host.request(id.arm);
  host.velocity(200000, 0);
  for (let ms = 0; ms < 100; ++ms) host.advance(1);
  assert.notDeepEqual(pico.bridges(), open);
  usb.unplug();
  for (let ms = 0; ms < 1500; ++ms) host.advance(1);
  assert.deepEqual(pico.bridges(), open);
  assert.equal(new Host(pico, host.advance).status().mode, mode.fault);
});

test('a host that sets 1200 baud gets the boot loader of a robot at rest, and not of an armed one', () => {
  const all = atUsb(), { usb, host, pico } = all;
  host.hello();
  host.request(id.arm);
  usb.setBaud(1200);
  for (let ms = 0; ms < 300; ++ms) assert.ok(host.advance(1));
  host.request(id.disarm);
  for (let ms = 0; ms < 300; ++ms) assert.ok(host.advance(1), 'nor later: it was asked when it could not');
  usb.setBaud(9600);
  usb.setBaud(1200);
  const asked = pico.now_ns;
  while (pico.chip.ended !== 'loader' && pico.now_ns - asked < 500e6) host.advance(1);
  assert.equal(pico.chip.ended, 'loader');
  assert.ok(!usb.attached, 'it has left the bus first');
  assert.deepEqual(pico.bridges(), open);
  expectClean(all);
});

test('EnterBootloader by USB reaches the boot loader', () => {
  const all = atUsb();
  all.host.hello();
  all.host.send(id.bootloader, undefined, 10);
  for (let ms = 0; ms < 500 && all.pico.chip.ended !== 'loader'; ++ms) all.host.advance(1);
  assert.equal(all.pico.chip.ended, 'loader');
  assert.ok(!all.usb.attached);
  expectClean(all);
});

// What other people read in the data sheet: no NAK, toggles or addresses, but registers, buffers and interrupts of their own.
test('the engine\'s own controller is served as well as the rig\'s', () => {
  const pico = new Pico({ seed: 1, image: readUf2(kImage) }), { chip } = pico, engine = chip.usbCtrl;
  delete engine.DPRAMUpdated; // the rig has switched it off
  chip.peripherals[0x50110] = engine;
  chip.usb.writeMemory = (offset, value) => { chip.usbDPRAMView.setUint32(offset, value, true); engine.DPRAMUpdated(offset, value); };
  const came = new Map();
  let enabled = false;
  engine.onUSBEnabled = () => { enabled = true; };
  engine.onEndpointWrite = (endpoint, bytes) => came.set(endpoint, [...(came.get(endpoint) ?? []), Buffer.from(bytes)]);
  const until = (what) => { for (let us = 0; us < 1e6 && !what(); us += 20) pico.runFor(20e3); assert.ok(what()); };
  const take = (endpoint) => { until(() => came.get(endpoint)?.length); return came.get(endpoint).shift(); };
  const ask = (...bytes) => { engine.sendSetupPacket(Uint8Array.from(bytes)); };
  const read = (length, ...bytes) => {
    ask(...bytes, length & 0xff, length >> 8);
    const all = [];
    for (let packet = take(0); ; packet = take(0)) {
      all.push(packet);
      if (packet.length < 64 || all.length * 64 >= length) break;
    }
    engine.endpointReadDone(0, new Uint8Array(0));
    pico.runFor(100e3);
    return Buffer.concat(all);
  };
  const write = (...bytes) => { ask(...bytes, 0, 0); assert.equal(take(0).length, 0); pico.runFor(100e3); };
  until(() => enabled);
  engine.resetDevice();
  pico.runFor(20e6);
  assert.equal(read(18, 0x80, request.descriptor, 0, descriptor.device, 0, 0).readUInt16LE(8), 0x2e8a);
  write(0, request.setAddress, 5, 0, 0, 0);
  assert.equal(engine.readUint32(0), 5);
  assert.equal(read(75, 0x80, request.descriptor, 0, descriptor.configuration, 0, 0).length, 75);
  write(0, request.setConfiguration, 1, 0, 0, 0);
  write(0x21, request.setLineState, 3, 0, 0, 0);
  const wire = {
    feed: (bytes) => engine.endpointReadDone(3, Uint8Array.from(bytes)),
    takeReceived: () => (came.get(4) ?? []).splice(0).flatMap((packet) => [...packet]),
  };
  const host = new Host(pico, undefined, wire);
  assert.equal(host.hello().board, 'rp2040');
  assert.equal(host.bad, 0);
});
