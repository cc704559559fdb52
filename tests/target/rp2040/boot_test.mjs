import assert from 'node:assert/strict';
import { test } from 'node:test';
import { bench, expectNoComplaints, kImage, open, print } from './bench.mjs';
import { cause, mode } from './rig/host.mjs';
import { readUf2 } from './rig/image.mjs';
import { Pico, pins } from './rig/pico.mjs';

test('the image that is flashed starts, ticks and answers at its serial port', () => {
  const { pico, host } = bench();
  const kTimer0 = 16;
  let first_ms = null;
  while (first_ms === null && pico.now_ns < 1e9) {
    pico.runFor(1000);
    if (pico.chip.core.IPSR === kTimer0) first_ms = pico.now_ns / 1e6;
  }
  const hello = host.hello(), status = host.status();
  print(`first tick ${first_ms.toFixed(1)} ms after power-on`);
  assert.equal(hello.board, 'rp2040');
  assert.equal(status.cause, cause.powerOn);
  assert.equal(status.mode, mode.disarmed);
  assert.equal(status.faults, 0);
  assert.equal(status.overruns, 0);
  assert.ok(Math.abs(status.battery_mV - 12000) <= 10, `battery ${status.battery_mV} mV; a step of the converter is 7.4 mV`);
  assert.ok(first_ms < 150);
  expectNoComplaints(pico);
});

test('no pin of the bridges rises from power-on until somebody arms the robot', () => {
  const { pico, host } = bench();
  const risen = [];
  pico.powerOn();
  for (const pin of [...pins.bridge.flat(), pins.enable])
    pico.chip.gpio[pin].addListener((state) => { if (state === 1) risen.push(pin); });
  host.hello();
  host.advance(500);
  assert.deepEqual(risen, []);
  assert.deepEqual(pico.bridges(), open);
  host.request(0x04);
  host.velocity(200000, 0);
  host.advance(50);
  assert.ok(risen.includes(pins.enable), 'the listener hears a pin that does rise');
});

test('a chip whose second stage is damaged waits in its boot loader', () => {
  const image = readUf2(kImage).map(({ at, bytes }) => ({ at, bytes: Buffer.from(bytes) }));
  image[0].bytes[10] ^= 1;
  const pico = new Pico({ image });
  assert.equal(pico.runFor(1e6), false);
  assert.match(pico.chip.loaderReason, /check sum/);
});

test('two robots have different numbers, and one keeps its own', () => {
  const [one, other] = [bench({ seed: 1 }), bench({ seed: 2 })];
  const number = one.host.hello().id;
  assert.notEqual(number, other.host.hello().id);
  one.pico.powerOn();
  assert.equal(one.host.hello().id, number);
  assert.match(number, /^[0-9a-f]{16}0{16}$/);
});
